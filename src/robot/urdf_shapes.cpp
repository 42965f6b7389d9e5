// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/urdf_shapes.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>

#include <algorithm>

#include "fcl_prob/exceptions.h"
#include "fcl_prob/mesh_io.h"
#include "io/import_notes.h"
#include "robot/mesh_names.h"

namespace fcl_prob::detail {
namespace {

struct Shape {
  std::shared_ptr<const fcl::CollisionGeometryd> geometry;
  double coordinate_error = 0.0;
};

class ShapeReader {
 public:
  ShapeReader(const std::string& folder, const RobotOptions& options,
              std::vector<std::string>& notes)
      : folder_(folder), options_(options), notes_(notes) {}

  Shape read(const UrdfCollision& collision) {
    where_ = &collision.where;
    return std::visit([this](const auto& shape) { return shapeOf(shape); }, collision.shape);
  }

 private:
  Shape shapeOf(const UrdfBox& box) { return {std::make_shared<fcl::Boxd>(box.size)}; }
  Shape shapeOf(const UrdfSphere& sphere) {
    return {std::make_shared<fcl::Sphered>(sphere.radius)};
  }
  Shape shapeOf(const UrdfCylinder& cylinder) {
    return {std::make_shared<fcl::Cylinderd>(cylinder.radius, cylinder.length)};
  }
  Shape shapeOf(const UrdfCapsule& capsule) {
    return {std::make_shared<fcl::Capsuled>(capsule.radius, capsule.length)};
  }

  Shape shapeOf(const UrdfMesh& mesh) {
    const std::string file = meshFile(mesh.file, folder_, options_.packages, *where_);
    for (const ReadMesh& known : meshes_) {
      if (known.file == file && known.scale == mesh.scale) return known.shape;
    }
    const TriangleMesh read = scaled(load(file), mesh.scale);
    addNotes(read.notes, notes_);
    meshes_.push_back({file, mesh.scale, {buildModel<fcl::OBBRSSd>(read), read.coordinate_error}});
    return meshes_.back().shape;
  }

  /// Messages about a mesh begin with the place that names it.
  TriangleMesh load(const std::string& file) const {
    try {
      return loadMeshIsolated(file);
    } catch (const InvalidGeometry& error) {
      throw InvalidGeometry(*where_ + ": " + error.what());
    } catch (const FileError& error) {
      throw FileError(*where_ + ": " + error.what());
    }
  }

  static TriangleMesh scaled(TriangleMesh mesh, const Eigen::Vector3d& scale) {
    for (fcl::Vector3d& vertex : mesh.vertices) vertex = vertex.cwiseProduct(scale).eval();
    mesh.coordinate_error *= scale.cwiseAbs().maxCoeff();
    // A mirror image is inside out.
    if (scale.prod() < 0.0) {
      for (fcl::Triangle& t : mesh.triangles) t.set(t[0], t[2], t[1]);
    }
    return mesh;
  }

  struct ReadMesh {
    std::string file;
    Eigen::Vector3d scale;
    Shape shape;
  };

  const std::string& folder_;
  const RobotOptions& options_;
  std::vector<std::string>& notes_;
  const std::string* where_ = nullptr;  ///< of what is being read
  std::vector<ReadMesh> meshes_;
};

bool isTaken(const std::string& link, const RobotOptions& options) {
  return options.links.empty() ||
         std::find(options.links.begin(), options.links.end(), link) != options.links.end();
}

}  // namespace

std::vector<RobotBody> bodiesOf(UrdfModel& model, const UrdfSource& source,
                                const RobotOptions& options) {
  for (const std::string& name : options.links) {
    if (model.links.count(name) == 0) throw FileError(source.name + ": has no link " + name);
  }
  ShapeReader reader(source.folder, options, model.notes);
  std::vector<RobotBody> bodies;
  for (const auto& [name, link] : model.links) {
    if (!isTaken(name, options)) continue;
    for (const UrdfCollision& collision : link.collisions) {
      const Shape shape = reader.read(collision);
      bodies.push_back({name, shape.geometry, collision.in_link, {}, shape.coordinate_error});
    }
  }
  if (bodies.empty()) throw FileError(source.name + ": no collision element in the links taken");
  return bodies;
}

}  // namespace fcl_prob::detail
