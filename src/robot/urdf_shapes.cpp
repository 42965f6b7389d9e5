// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/urdf_shapes.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>

#include <algorithm>
#include <filesystem>

#include "fcl_prob/exceptions.h"
#include "fcl_prob/mesh_io.h"
#include "robot/urdf_values.h"

namespace fcl_prob::detail {
namespace {

using GeometryPointer = std::shared_ptr<const fcl::CollisionGeometryd>;

const std::string kPackage = "package://";
const std::string kFile = "file://";

bool startsWith(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

class ShapeReader {
 public:
  ShapeReader(const std::string& path, const RobotOptions& options)
      : folder_(std::filesystem::path(path).parent_path()), options_(options) {}

  GeometryPointer read(const urdf::Geometry& geometry, const std::string& where) {
    switch (geometry.type) {
      case urdf::Geometry::SPHERE: {
        const auto& sphere = static_cast<const urdf::Sphere&>(geometry);
        return std::make_shared<fcl::Sphered>(positive(sphere.radius, where + ": radius"));
      }
      case urdf::Geometry::BOX: {
        const Eigen::Vector3d size =
            vectorOf(static_cast<const urdf::Box&>(geometry).dim, where + ": size");
        return std::make_shared<fcl::Boxd>(positive(size.x(), where + ": size"),
                                           positive(size.y(), where + ": size"),
                                           positive(size.z(), where + ": size"));
      }
      case urdf::Geometry::CYLINDER: {
        const auto& cylinder = static_cast<const urdf::Cylinder&>(geometry);
        return std::make_shared<fcl::Cylinderd>(positive(cylinder.radius, where + ": radius"),
                                                positive(cylinder.length, where + ": length"));
      }
      case urdf::Geometry::MESH:
        return mesh(static_cast<const urdf::Mesh&>(geometry), where);
    }
    throw FileError(where + ": a geometry that is none of box, cylinder, sphere and mesh");
  }

 private:
  GeometryPointer mesh(const urdf::Mesh& mesh, const std::string& where) {
    const Eigen::Vector3d scale = vectorOf(mesh.scale, where + ": scale");
    if ((scale.array() == 0.0).any()) throw FileError(where + ": scale must not be 0");
    const std::string file = fileOf(mesh.filename, where);
    for (const ReadMesh& known : meshes_) {
      if (known.file == file && known.scale == scale) return known.geometry;
    }
    TriangleMesh triangles = loadMeshIsolated(file);
    for (fcl::Vector3d& vertex : triangles.vertices) vertex = vertex.cwiseProduct(scale).eval();
    triangles.coordinate_error *= scale.cwiseAbs().maxCoeff();
    // A mirror image is inside out.
    if (scale.prod() < 0.0) {
      for (fcl::Triangle& t : triangles.triangles) t.set(t[0], t[2], t[1]);
    }
    meshes_.push_back({file, scale, buildModel<fcl::OBBRSSd>(triangles)});
    return meshes_.back().geometry;
  }

  std::string fileOf(const std::string& name, const std::string& where) const {
    if (startsWith(name, kFile)) return name.substr(kFile.size());
    if (!startsWith(name, kPackage)) return (folder_ / name).lexically_normal().string();
    const std::size_t end = name.find('/', kPackage.size());
    const std::string package = name.substr(kPackage.size(), end - kPackage.size());
    const auto found = options_.packages.find(package);
    if (found == options_.packages.end() || end == std::string::npos) {
      throw FileError(where + ": " + name + ": no folder is known for the package " + package);
    }
    const std::filesystem::path rest = name.substr(end + 1);
    return (std::filesystem::path(found->second) / rest).lexically_normal().string();
  }

  struct ReadMesh {
    std::string file;
    Eigen::Vector3d scale;
    GeometryPointer geometry;
  };

  std::filesystem::path folder_;
  const RobotOptions& options_;
  std::vector<ReadMesh> meshes_;
};

bool isTaken(const std::string& link, const RobotOptions& options) {
  return options.links.empty() ||
         std::find(options.links.begin(), options.links.end(), link) != options.links.end();
}

}  // namespace

std::vector<RobotBody> bodiesOf(const urdf::ModelInterface& model, const std::string& path,
                                const RobotOptions& options) {
  for (const std::string& name : options.links) {
    if (model.links_.count(name) == 0) throw FileError(path + ": has no link " + name);
  }
  ShapeReader reader(path, options);
  std::vector<RobotBody> bodies;
  for (const auto& [name, link] : model.links_) {
    if (!isTaken(name, options)) continue;
    for (std::size_t i = 0; i < link->collision_array.size(); ++i) {
      const urdf::Collision& element = *link->collision_array[i];
      const std::string where = path + ": link " + name + ": collision " + std::to_string(i);
      if (!element.geometry) throw FileError(where + ": has no geometry");
      bodies.push_back(
          {name, reader.read(*element.geometry, where), poseOf(element.origin, where)});
    }
  }
  if (bodies.empty()) throw FileError(path + ": no collision element in the links taken");
  return bodies;
}

}  // namespace fcl_prob::detail
