// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Scene files: what is read, and that everything else is refused with its place.
#include "fcl_prob/scene_io.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/plane.h>
#include <fcl/geometry/shape/sphere.h>

#include <filesystem>
#include <sstream>

#include "catch.h"
#include "temporary_folder.h"

using namespace fcl_prob;
using fcl_prob_test::TemporaryFolder;

namespace {

const char* const kDisplacement = R"("displacement": {"sigma": [1, 2, 3]})";

template <typename Shape>
std::shared_ptr<Shape> shapeOf(const TemporaryFolder& folder, const std::string& text) {
  const Scene scene = loadScene(folder.write(
      "s.json", R"({"a": {)" + text + R"(}, "b": {"sphere": 1}, )" + kDisplacement + "}"));
  auto shape = std::dynamic_pointer_cast<Shape>(std::get<PrimitiveShape>(scene.a.shape));
  REQUIRE(shape);
  return shape;
}

}  // namespace

TEST_CASE("a pose error in place of the displacement", "[io]") {
  TemporaryFolder folder;
  const auto load = [&](const std::string& error) {
    return loadScene(
        folder.write("scene.json", R"({"a": {"sphere": 1}, "b": {"sphere": 1}, )" + error + "}"));
  };
  const auto fault = [&](const std::string& error) {
    try {
      load(error);
    } catch (const FileError& failure) {
      return std::string(failure.what());
    }
    return std::string();
  };
  const Scene scene = load(
      R"("pose_error": {"sigma": [1, 2, 3, 0.1, 0.2, 0.3], "mean": [0, 0, 1, 0, 0, 0.1],
                        "convention": "body"})");
  REQUIRE(scene.pose_error);
  CHECK(scene.pose_error->covariance()(4, 4) == Approx(0.04));
  CHECK(scene.pose_error->mean()[5] == 0.1);
  CHECK(scene.pose_error->convention() == PoseConvention::body_rotation_vector);
  CHECK(scene.displacement.covariance()(1, 1) == Approx(4));
  CHECK(scene.displacement.mean().z() == Approx(1));
  const Scene full = load(
      R"("pose_error": {"covariance": [1,0,0,0,0,0.1, 1,0,0,0,0, 1,0,0,0, 0.1,0,0, 0.1,0, 0.1]})");
  CHECK(full.pose_error->covariance()(0, 5) == 0.1);
  CHECK(full.pose_error->covariance()(5, 0) == 0.1);
  CHECK(full.pose_error->covariance()(2, 2) == 1.0);
  const Scene of_ros = load(
      R"("pose_error": {"covariance": [1,0,0,0,0,0.1, 0,1,0,0,0,0, 0,0,1,0,0,0, 0,0,0,0.1,0,0,
                                       0,0,0,0,0.1,0, 0.1,0,0,0,0,0.1]})");
  CHECK((of_ros.pose_error->covariance() - full.pose_error->covariance()).isZero(1e-15));
  CHECK_FALSE(load(R"("displacement": {"sigma": [1, 2, 3]})").pose_error);

  CHECK(fault(R"("pose_error": {"sigma": [1, 2, 3]})").find("pose_error: sigma: it needs 6") !=
        std::string::npos);
  CHECK(fault(R"("pose_error": {"covariance": [1, 2, 3]})").find("36 numbers, or 21") !=
        std::string::npos);
  CHECK(fault(R"("pose_error": {"sigma": [1, 2, 3, 0, 0, 45]})").find("degrees") !=
        std::string::npos);
  CHECK(fault(R"("pose_error": {"sigma": [1, 2, 3, 0, 0, 0], "convention": "x"})")
            .find("convention") != std::string::npos);
  CHECK(
      fault(R"("pose_error": {"sigma": [1, 2, 3, 0, 0, 0]}, "displacement": {"sigma": [1, 2, 3]})")
          .find("exactly one") != std::string::npos);
}

TEST_CASE("six numbers of a pose are x, y, z, roll, pitch, yaw as in URDF", "[io]") {
  const TemporaryFolder folder;
  const auto pose = [&](const std::string& numbers) {
    return loadScene(folder.write("s.json", R"({"a": {"sphere": 1, "pose": [)" + numbers +
                                                R"(]}, "b": {"sphere": 1}, "displacement":
 {"sigma": [1, 1, 1]}})"))
        .a.pose;
  };
  const double r = 0.3, p = -1.1, y = 2.4;
  Eigen::Matrix3d about_x, about_y, about_z;
  about_x << 1, 0, 0, 0, std::cos(r), -std::sin(r), 0, std::sin(r), std::cos(r);
  about_y << std::cos(p), 0, std::sin(p), 0, 1, 0, -std::sin(p), 0, std::cos(p);
  about_z << std::cos(y), -std::sin(y), 0, std::sin(y), std::cos(y), 0, 0, 0, 1;
  const fcl::Transform3d turned = pose("1, 2, 3, 0.3, -1.1, 2.4");
  CHECK(turned.translation() == Eigen::Vector3d(1, 2, 3));
  CHECK((turned.linear() - about_z * about_y * about_x).cwiseAbs().maxCoeff() < 1e-15);
  CHECK(pose("0, 0, 0, 0, 0, 6.283185307179586").linear().isIdentity(1e-15));
  CHECK_THROWS_WITH(pose("0, 0, 0, 0, 0, 90"),
                    Catch::Contains("a: pose: a pose: an angle of 90 radians is more than a turn"));
}

TEST_CASE("a scene file with everything in it", "[io]") {
  const TemporaryFolder folder;
  const Scene scene = loadScene(folder.write("s.json", R"({
"description": "all", "a": {"mesh": "sub/../part.stl", "scale": 0.001, "normalize": true,
"pose": [1, 2, 3, 1, 0, 0, 1]}, "b": {"mesh": "/abs/b.obj"},
"displacement": {"covariance": [4, 1, 0, 4, 0, 9], "mean": [0.5, 0, -1]},
"request": {"method": "monte-carlo", "contact": "solid", "relative_tolerance": 0.1,
"absolute_tolerance": 1e-9, "threshold": 0.05, "time_limit": 2, "confidence": 0.95,
"samples": 123, "seed": 18446744073709551615}})"));
  const MeshFile& a = std::get<MeshFile>(scene.a.shape);
  CHECK(a.path == folder.path("part.stl"));
  CHECK(a.options.scale == 0.001);
  CHECK(a.options.normalize);
  CHECK(scene.a.pose.translation() == Eigen::Vector3d(1, 2, 3));
  CHECK((scene.a.pose.linear() * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitY()).norm() <
        1e-15);
  CHECK(std::get<MeshFile>(scene.b.shape).path == "/abs/b.obj");
  CHECK(scene.b.pose.matrix() == fcl::Transform3d::Identity().matrix());
  CHECK(scene.displacement.covariance()(0, 1) == Approx(1).margin(1e-14));
  CHECK(scene.displacement.covariance()(2, 2) == Approx(9));
  CHECK(scene.displacement.mean() == Eigen::Vector3d(0.5, 0, -1));
  CHECK(scene.request.method == ProbabilityMethod::monte_carlo);
  CHECK(scene.request.contact == ContactMeaning::solid);
  CHECK(scene.request.relative_tolerance == 0.1);
  CHECK(scene.request.absolute_tolerance == 1e-9);
  CHECK(scene.request.threshold == 0.05);
  CHECK(scene.request.time_limit == 2.0);
  CHECK(scene.request.confidence == 0.95);
  CHECK(scene.request.samples == 123);
  CHECK(scene.request.seed == 18446744073709551615U);
}

TEST_CASE("every primitive of a scene file", "[io]") {
  const TemporaryFolder folder;
  CHECK(shapeOf<fcl::Boxd>(folder, R"("box": [1, 2, 3])")->side == fcl::Vector3d(1, 2, 3));
  CHECK(shapeOf<fcl::Sphered>(folder, R"("sphere": 2)")->radius == 2);
  CHECK(shapeOf<fcl::Ellipsoidd>(folder, R"("ellipsoid": [1, 2, 3])")->radii ==
        fcl::Vector3d(1, 2, 3));
  CHECK(shapeOf<fcl::Capsuled>(folder, R"("capsule": {"radius": 1, "length": 2})")->lz == 2);
  CHECK(shapeOf<fcl::Coned>(folder, R"("cone": {"radius": 1, "length": 2})")->radius == 1);
  CHECK(shapeOf<fcl::Cylinderd>(folder, R"("cylinder": {"radius": 1, "length": 2})")->lz == 2);
  const auto plane = shapeOf<fcl::Planed>(folder, R"("plane": {"normal": [0, 3, 4], "offset": 5})");
  CHECK((plane->n - fcl::Vector3d(0, 0.6, 0.8)).norm() < 1e-15);
  CHECK(plane->d == 5);
  const auto halfspace =
      shapeOf<fcl::Halfspaced>(folder, R"("halfspace": {"normal": [0, 0, 2], "offset": -1})");
  CHECK(halfspace->n == fcl::Vector3d(0, 0, 1));
}

TEST_CASE("the displacement by standard deviations and axes", "[io]") {
  const TemporaryFolder folder;
  const Scene scene = loadScene(folder.write("s.json", R"({"a": {"sphere": 1}, "b": {"sphere": 1},
"displacement": {"sigma": [1, 2, 0], "sigma_axes": [1, 0, 0, 1]}})"));
  CHECK(scene.displacement.rank() == 2);
  CHECK(scene.displacement.covariance()(0, 0) == Approx(4));
  CHECK(scene.displacement.covariance()(1, 1) == Approx(1));
}

TEST_CASE("faults of a scene file are named with file and key", "[io]") {
  const TemporaryFolder folder;
  const auto faultOf = [&](const std::string& text) -> std::string {
    const std::string path = folder.write("s.json", text);
    try {
      loadScene(path);
    } catch (const FileError& error) {
      const std::string message = error.what();
      REQUIRE(message.rfind(path + ": ", 0) == 0);
      return message.substr(path.size() + 2);
    }
    return "no fault";
  };
  const auto inA = [&](const std::string& a) {
    return faultOf(R"({"a": {)" + a + R"(}, "b": {"sphere": 1}, )" + kDisplacement + "}");
  };
  const auto inD = [&](const std::string& displacement) {
    return faultOf(R"({"a": {"sphere": 1}, "b": {"sphere": 1}, "displacement": {)" + displacement +
                   "}}");
  };
  const auto inR = [&](const std::string& request) {
    return faultOf(R"({"a": {"sphere": 1}, "b": {"sphere": 1}, )" + std::string(kDisplacement) +
                   R"(, "request": {)" + request + "}}");
  };

  CHECK_THROWS_AS(loadScene(folder.path("missing.json")), FileError);
  CHECK(faultOf("").find("not valid JSON") == 0);
  CHECK(faultOf("{\"a\": ").find("not valid JSON") == 0);
  CHECK(faultOf("[1]") == "not an object");
  CHECK(faultOf(R"({"a": 1})") == "a: not an object");
  CHECK(faultOf(std::string("{\"a\": NaN}")).find("not valid JSON") == 0);
  CHECK(inA(R"("sphere": 1)") == "no fault");
  CHECK(inA(R"("sphere": 1, "sphere": 2)") == "the key 'sphere' is given twice");
  CHECK(inA(R"("sphere": 1, "colour": 2)") == "a: 'colour': unknown key");
  CHECK(inA(R"("sphere": 1, "scale": 2)") == "a: 'scale': unknown key");
  CHECK(inA(R"("pose": [1, 2, 3])").find("a: needs exactly one of mesh, box,") == 0);
  CHECK(inA(R"("sphere": 1, "box": [1, 1, 1])").find("a: needs exactly one of") == 0);
  CHECK(inA(R"("sphere": -1)") == "a: sphere: must be a length > 0");
  CHECK(inA(R"("sphere": 1e999)").find("not valid JSON") == 0);
  CHECK(inA(R"("sphere": "1")") == "a: sphere: not a number");
  CHECK(inA(R"("box": [1, 2])") == "a: box: must be three lengths");
  CHECK(inA(R"("cone": {"radius": 1})") == "a: cone: length: missing");
  CHECK(inA(R"("plane": {"normal": [0, 0, 0], "offset": 1})") ==
        "a: plane: normal: must not be zero");
  CHECK(inA(R"("sphere": 1, "pose": [1, 2])").find("a: pose: a pose needs 3, 6, 7") == 0);
  CHECK(inA(R"("sphere": 1, "pose": [0, 0, 0, 0, 0, 0, 0])").find("a: pose: a quaternion") == 0);
  CHECK(inA(R"("sphere": 1, "pose": ["10mm", 0, 0])") == "a: pose: not a list of numbers");
  CHECK(inA(R"("mesh": "x.stl", "scale": 0)") == "a: scale: must be > 0");
  CHECK(inA(R"("mesh": 3)") == "a: mesh: not a string");
  CHECK(inD(R"("mean": [0, 0, 0])") == "displacement: needs exactly one of covariance, sigma");
  CHECK(inD(R"("sigma": [1, 1])").find("displacement: sigma: it needs 3 numbers") == 0);
  CHECK(inD(R"("sigma": [1, 1, -1])").find("displacement: sigma: ") == 0);
  CHECK(inD(R"("covariance": [1, 0, 0, 1, 0])").find("displacement: covariance: a cov") == 0);
  CHECK(inD(R"("covariance": [1, 2, 0, 1, 0, 1])").find("displacement: covariance: ") == 0);
  CHECK(inD(R"("covariance": [1, 0, 0, 1, 0, 1], "sigma_axes": [1, 0, 0, 0])") ==
        "displacement: 'sigma_axes': unknown key");
  CHECK(inR(R"("method": "magic")") == "request: method: unknown method");
  CHECK(inR(R"("contact": "both")") == "request: contact: none of fcl, solid, contained");
  CHECK(inR(R"("samples": -1)") == "request: samples: not a whole number >= 0");
  CHECK(inR(R"("samples": 1.5)") == "request: samples: not a whole number >= 0");
  CHECK(inR(R"("speed": 1)") == "request: 'speed': unknown key");
}

TEST_CASE("the scenes and meshes of data/ are sound", "[io]") {
  int scenes = 0;
  int meshes = 0;
  std::uintmax_t bytes = 0;
  const std::filesystem::path data = std::filesystem::path(FCL_PROB_SOURCE_DIR) / "data";
  for (const auto& entry : std::filesystem::directory_iterator(data)) {
    bytes += entry.file_size();
    CAPTURE(entry.path().string());
    // The arm and its motion are read in test/robot.
    if (entry.path().stem().string().rfind("arm", 0) == 0) continue;
    const std::string kind = entry.path().extension().string();
    if (kind == ".md" || kind == ".bt") continue;  // a map is read by the scene that has it
    if (kind != ".json") {
      loadMesh(entry.path().string());
      ++meshes;
      continue;
    }
    const Scene scene = loadScene(entry.path().string());
    for (const SceneObject* object : {&scene.a, &scene.b}) {
      if (const auto* mesh = std::get_if<MeshFile>(&object->shape)) {
        CHECK(std::filesystem::exists(mesh->path));
      }
    }
    ++scenes;
  }
  CHECK(scenes >= 9);
  CHECK(meshes == 8);
  CHECK(bytes < 1'000'000);
}

TEST_CASE("a scene that was written is read back to the last bit", "[io]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("tetrahedron.obj",
                                        "v 0 0 0.1\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                                        "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  const auto check = [&](const std::string& content) {
    const Scene scene = loadScene(folder.write("scene.json", content));
    std::ostringstream text;
    writeScene(scene, "a fault", text);
    const Scene again = loadScene(folder.write("again.json", text.str()));
    for (const auto& [one, other] :
         {std::pair(&scene.a, &again.a), std::pair(&scene.b, &again.b)}) {
      CHECK(one->pose.matrix() == other->pose.matrix());
      CHECK(one->band.outward == other->band.outward);
      CHECK(one->band.inward == other->band.inward);
      if (const auto* shape = std::get_if<PrimitiveShape>(&one->shape)) {
        const auto& read = std::get<PrimitiveShape>(other->shape);
        CHECK((*shape)->getNodeType() == read->getNodeType());
        (*shape)->computeLocalAABB();
        read->computeLocalAABB();
        CHECK((*shape)->aabb_local.min_ == read->aabb_local.min_);
        CHECK((*shape)->aabb_local.max_ == read->aabb_local.max_);
      } else {
        const TriangleMesh was = std::get<MeshFile>(one->shape).read();
        const TriangleMesh is = std::get<MeshFile>(other->shape).read();
        REQUIRE(was.vertices == is.vertices);
        REQUIRE(was.triangles.size() == is.triangles.size());
        for (std::size_t t = 0; t < was.triangles.size(); ++t) {
          for (int k = 0; k < 3; ++k) CHECK(was.triangles[t][k] == is.triangles[t][k]);
        }
      }
    }
    CHECK(scene.displacement.mean() == again.displacement.mean());
    CHECK(scene.displacement.covariance().isApprox(again.displacement.covariance(), 1e-15));
    CHECK(scene.request.method == again.request.method);
    CHECK(scene.request.contact == again.request.contact);
    CHECK(scene.request.threshold == again.request.threshold);
    CHECK(scene.request.seed == again.request.seed);
    CHECK(scene.pose_error.has_value() == again.pose_error.has_value());
  };
  const std::string rest =
      R"("displacement": {"sigma": [0.1, 0.02, 0.3], "sigma_axes": [1, 0.2, 0.3, 0.4],
         "mean": [0.1, 0, 0.7]}, "request": {"method": "interval", "contact": "solid",
         "threshold": 0.01, "seed": 9}})";
  check(R"({"a": {"mesh": "tetrahedron.obj", "scale": 0.3, "pose": [1, 2, 3, 0.1, 0.2, 0.3]},
            "b": {"mesh": "tetrahedron.obj", "normalize": true, "band": [0.01, 0.02]}, )" +
        rest);
  for (const char* shape :
       {R"("box": [1, 0.1, 3])", R"("sphere": 0.3)", R"("ellipsoid": [1, 2, 0.3])",
        R"("capsule": {"radius": 0.1, "length": 2})", R"("cone": {"radius": 0.1, "length": 2})",
        R"("cylinder": {"radius": 0.1, "length": 2})"}) {
    check(std::string("{\"a\": {") + shape + "}, \"b\": {" + shape + "}, " + rest);
  }
  check(R"({"a": {"sphere": 1}, "b": {"halfspace": {"normal": [1, 2, 3], "offset": 0.1}},
            "pose_error": {"sigma": [0.1, 0.1, 0.1, 0.01, 0.01, 0.02], "convention": "body"}})");
  CHECK_THROWS_WITH(loadScene(folder.write("scene.json", R"({"a": {"mesh": {"vertices": [0, 0, 0],
                    "triangles": [0, 1, 2]}}, "b": {"sphere": 1}, )" +
                                                             rest)),
                    Catch::Contains("a: mesh") && Catch::Contains("triangles"));
}
