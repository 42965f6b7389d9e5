// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The loader on small files written here, format by format and fault by fault.
#include "fcl_prob/mesh_io.h"

#include <sys/stat.h>

#include <cstring>

#include "catch.h"
#include "temporary_folder.h"

using namespace fcl_prob;
using fcl_prob_test::TemporaryFolder;

namespace {

const char* const kTetrahedronObj =
    "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 4\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";

Eigen::AlignedBox3d boundingBox(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const fcl::Vector3d& v : mesh.vertices) box.extend(v);
  return box;
}

void checkBox(const TriangleMesh& mesh, const Eigen::Vector3d& lo, const Eigen::Vector3d& hi) {
  const Eigen::AlignedBox3d box = boundingBox(mesh);
  CAPTURE(box.min().transpose(), box.max().transpose());
  CHECK((box.min() - lo).cwiseAbs().maxCoeff() < 1e-6);
  CHECK((box.max() - hi).cwiseAbs().maxCoeff() < 1e-6);
}

std::string faultOf(const std::string& path, const MeshOptions& options = {},
                    const ImportLimits& limits = {}) {
  try {
    loadMesh(path, options, limits);
  } catch (const Exception& error) {
    return error.what();
  }
  return "";
}

/// One triangle (0,0,0) (1,0,0) (0,1,0) as binary data: three vertices, then three 16-bit indices.
std::string triangleBuffer() {
  const float positions[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::uint16_t indices[3] = {0, 1, 2};
  std::string bytes(sizeof positions + sizeof indices, '\0');
  std::memcpy(bytes.data(), positions, sizeof positions);
  std::memcpy(bytes.data() + sizeof positions, indices, sizeof indices);
  return bytes;
}

}  // namespace

TEST_CASE("the formats and their shared vertices", "[io]") {
  const TemporaryFolder folder;
  const Eigen::Vector3d lo(0, 0, 0);

  SECTION("OBJ") {
    const TriangleMesh mesh = loadMesh(folder.write("t.obj", kTetrahedronObj));
    CHECK(mesh.triangles.size() == 4);
    CHECK(mesh.vertices.size() == 4);
    checkBox(mesh, lo, {1, 2, 4});
  }
  SECTION("text STL, whose triangles share nothing in the file") {
    const TriangleMesh mesh = loadMesh(folder.write(
        "t.STL",
        "solid a\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
        "endloop\nendfacet\nfacet normal 0 0 0\nouter loop\nvertex 1 0 0\nvertex -0.0 1 0\n"
        "vertex 0 0 1\nendloop\nendfacet\nendsolid a\n"));
    CHECK(mesh.triangles.size() == 2);
    CHECK(mesh.vertices.size() == 4);  // -0 and 0 are one vertex
  }
  SECTION("PLY with a quadrilateral") {
    const TriangleMesh mesh = loadMesh(folder.write(
        "t.ply",
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
        "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n"));
    CHECK(mesh.triangles.size() == 2);
    CHECK(mesh.vertices.size() == 4);
  }
  SECTION("OFF with comments") {
    const TriangleMesh mesh =
        loadMesh(folder.write("t.off", "OFF # a\n# b\n3 1 0\n0 0 0\n1 0 0\n0 3 0\n3 0 1 2\n"));
    CHECK(mesh.triangles.size() == 1);
    checkBox(mesh, lo, {1, 3, 0});
  }
}

TEST_CASE("node transforms and declared units are applied, axes are kept", "[io]") {
  const TemporaryFolder folder;
  SECTION("COLLADA: millimetres, z up, a node moved by 1000 units along z") {
    const TriangleMesh mesh = loadMesh(folder.write("t.dae", R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="millimeter" meter="0.001"/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="g" name="g"><mesh>
<source id="p"><float_array id="pa" count="9">0 0 0 1000 0 0 0 2000 0</float_array>
<technique_common><accessor source="#pa" count="3" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n"><translate>0 0 1000</translate>
<instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>)"));
    CHECK(mesh.triangles.size() == 1);
    checkBox(mesh, {0, 0, 1}, {1, 2, 1});
  }
  SECTION("glTF: one mesh at two nodes, one of them below a scaled parent") {
    folder.write("t.bin", triangleBuffer());
    const std::string path = folder.write("t.gltf", R"({"asset": {"version": "2.0"},
"buffers": [{"uri": "t.bin", "byteLength": 42}],
"bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36},
                {"buffer": 0, "byteOffset": 36, "byteLength": 6}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
               "min": [0, 0, 0], "max": [1, 1, 0]},
              {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
"nodes": [{"mesh": 0, "translation": [0, 0, 5]}, {"scale": [2, 2, 2], "children": [2]},
          {"mesh": 0, "translation": [1, 0, 0]}],
"scenes": [{"nodes": [0, 1]}], "scene": 0})");
    const TriangleMesh mesh = loadMesh(path);
    CHECK(mesh.triangles.size() == 2);
    checkBox(mesh, {0, 0, 0}, {4, 2, 5});
  }
}

TEST_CASE("scale and normalize", "[io]") {
  const TemporaryFolder folder;
  const std::string path = folder.write("t.obj", kTetrahedronObj);
  MeshOptions options;
  options.scale = 0.001;
  checkBox(loadMesh(path, options), {0, 0, 0}, {0.001, 0.002, 0.004});
  options.scale = 1.0;
  options.normalize = true;
  checkBox(loadMesh(path, options), {-0.125, -0.25, -0.5}, {0.125, 0.25, 0.5});
  options.scale = 2.0;
  checkBox(loadMesh(path, options), {-0.25, -0.5, -1.0}, {0.25, 0.5, 1.0});
  for (const double bad : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    options.scale = bad;
    CHECK_THROWS_AS(loadMesh(path, options), InvalidRequest);
  }
  options.scale = 1e308;
  CHECK_THROWS_AS(loadMesh(path, {false, 1e308}), InvalidGeometry);
}

TEST_CASE("messages name the file and the fault", "[io]") {
  const TemporaryFolder folder;
  const auto check = [&](const std::string& name, const std::string& content,
                         const std::string& fault) {
    const std::string path = folder.write(name, content);
    const std::string message = faultOf(path);
    CAPTURE(message);
    CHECK(message.rfind(path + ": ", 0) == 0);
    CHECK(message.find(fault) != std::string::npos);
  };
  CHECK(faultOf(folder.path("missing.obj")) == folder.path("missing.obj") + ": no such file");
  CHECK(faultOf(folder.path("")).find("not a regular file") != std::string::npos);
  REQUIRE(::mkfifo(folder.path("pipe.obj").c_str(), 0600) == 0);
  CHECK(faultOf(folder.path("pipe.obj")).find("not a regular file") != std::string::npos);

  check("a.xyz", "1 2 3", "unknown kind of mesh file '.xyz'");
  check("empty.obj", "", "empty");
  check("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\np 1 2 3\n", "no triangles");
  check("nan.obj", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "line 1: a vertex has");
  check("word.obj", "v 0 0 zero\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "line 1: 'zero' is not a number");
  check("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", "line 4: vertex index 4");
  check("back.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -4\n", "'-4' is not the index");
  check("control.obj", "v 0 0 \x01\x1b\nf 1 2 3\n", "'\\x01\\x1b' is not a number");
  check("short.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n", "ends before its vertex 3 of 3");
  check("long.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "'3' is not the index");
  check("half.ply", "ply\nformat ascii 1.0\nelement vertex 1\n", "no end");
  check("half.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n", "endsolid");
  check("half.dae", "<?xml version=\"1.0\"?><COLLADA><asset>", "the importer refused it");
  check("half.gltf", "{\"asset\": {", "not a valid glTF");
  check("half.glb", std::string("glTF\2\0\0\0\377\377\0\0", 12), "truncated");
  check("far.obj", "v 1e15 0 0\nv 1000000000000064 0 0\nv 1e15 64 0\nf 1 2 3\n",
        "lost in double precision");

  ImportLimits limits;
  limits.file_bytes = 10;
  CHECK(faultOf(folder.write("t.obj", kTetrahedronObj), {}, limits).find("more than the limit") !=
        std::string::npos);
}

TEST_CASE("every prefix of a mesh file is refused or is a whole mesh", "[io]") {
  const TemporaryFolder folder;
  const std::string text = kTetrahedronObj;
  int refused = 0;
  for (std::size_t length = 0; length < text.size(); ++length) {
    const std::string path = folder.write("t.obj", text.substr(0, length));
    try {
      validateMesh(loadMesh(path));
    } catch (const Exception& error) {
      CHECK(std::string(error.what()).rfind(path, 0) == 0);
      ++refused;
    }
  }
  CHECK(refused > 30);
}

TEST_CASE("a tree for every bounding volume, or a clear refusal", "[io]") {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  CHECK(buildModel<fcl::AABBd>(mesh)->getNumBVs() == 7);
  CHECK(buildModel<fcl::OBBd>(mesh)->getNumBVs() == 7);
  CHECK(buildModel<fcl::RSSd>(mesh)->getNumBVs() == 7);
  CHECK(buildModel<fcl::kIOSd>(mesh)->getNumBVs() == 7);
  CHECK(buildModel<fcl::OBBRSSd>(mesh)->getNumBVs() == 7);
  CHECK(buildModel<fcl::KDOPd<16>>(mesh)->getNumBVs() == 7);
  CHECK(buildModel<fcl::KDOPd<18>>(mesh)->getNumBVs() == 7);
  CHECK(buildModel<fcl::KDOPd<24>>(mesh)->getNumBVs() == 7);
  CHECK(buildModel<fcl::OBBRSSd>(mesh)->aabb_local.max_ == fcl::Vector3d(1, 1, 1));

  TriangleMesh bad = mesh;
  bad.triangles[2][1] = 4;
  CHECK_THROWS_WITH(buildModel<fcl::OBBRSSd>(bad),
                    "mesh: triangle 2 has vertex index 4, but there are only 4 vertices");
  bad = mesh;
  bad.vertices[3].y() = std::nan("");
  CHECK_THROWS_WITH(buildModel<fcl::OBBRSSd>(bad),
                    "mesh: vertex 3 has a coordinate that is not finite");
  CHECK_THROWS_WITH(buildModel<fcl::OBBRSSd>(TriangleMesh{}), "mesh: no triangles");
}
