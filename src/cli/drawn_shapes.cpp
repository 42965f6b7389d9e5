// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/drawn_shapes.h"

#include <fcl/geometry/geometric_shape_to_BVH_model.h>
#include <fcl/geometry/octree/octree.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/narrowphase/distance.h>

namespace fcl_prob::cli {
namespace {

using Model = fcl::BVHModel<fcl::OBBRSSd>;

constexpr unsigned kSegments = 32;
constexpr unsigned kRings = 24;

TriangleMesh meshOf(const Model& model) {
  return {{model.vertices, model.vertices + model.num_vertices},
          {model.tri_indices, model.tri_indices + model.num_tris}};
}

/// A sphere whose upper half is lifted: FCL has no tessellation of capsules.
TriangleMesh capsuleMesh(const fcl::Capsuled& capsule) {
  Model model;
  fcl::generateBVHModel(model, fcl::Sphered(capsule.radius), fcl::Transform3d::Identity(),
                        kSegments, kRings);
  TriangleMesh mesh = meshOf(model);
  for (fcl::Vector3d& vertex : mesh.vertices) {
    vertex.z() += (vertex.z() > 0.0 ? 0.5 : -0.5) * capsule.lz;
  }
  return mesh;
}

/// The cubes of the occupied cells.
TriangleMesh octreeMesh(const fcl::OcTreed& octree) {
  TriangleMesh cubes;
  for (const auto& [x, y, z, size, cost, threshold] : octree.toBoxes()) {
    Model cube;
    fcl::generateBVHModel(cube, fcl::Boxd(size, size, size), fcl::Transform3d::Identity());
    append(meshOf(cube), fcl::Transform3d(Eigen::Translation3d(x, y, z)), cubes);
  }
  return cubes;
}

TriangleMesh primitiveMesh(const fcl::CollisionGeometryd& geometry) {
  const fcl::Transform3d identity = fcl::Transform3d::Identity();
  Model model;
  if (const auto* box = dynamic_cast<const fcl::Boxd*>(&geometry)) {
    fcl::generateBVHModel(model, *box, identity);
  } else if (const auto* sphere = dynamic_cast<const fcl::Sphered*>(&geometry)) {
    fcl::generateBVHModel(model, *sphere, identity, kSegments, kRings);
  } else if (const auto* ellipsoid = dynamic_cast<const fcl::Ellipsoidd*>(&geometry)) {
    fcl::generateBVHModel(model, *ellipsoid, identity, kSegments, kRings);
  } else if (const auto* cylinder = dynamic_cast<const fcl::Cylinderd*>(&geometry)) {
    fcl::generateBVHModel(model, *cylinder, identity, kSegments, kRings);
  } else if (const auto* cone = dynamic_cast<const fcl::Coned*>(&geometry)) {
    fcl::generateBVHModel(model, *cone, identity, kSegments, kRings);
  } else if (const auto* capsule = dynamic_cast<const fcl::Capsuled*>(&geometry)) {
    return capsuleMesh(*capsule);
  } else if (const auto* octree = dynamic_cast<const fcl::OcTreed*>(&geometry)) {
    return octreeMesh(*octree);
  } else {
    throw UnsupportedGeometry("an unbounded shape cannot be drawn");
  }
  return meshOf(model);
}

}  // namespace

TriangleMesh moved(TriangleMesh mesh, const fcl::Transform3d& pose) {
  for (fcl::Vector3d& vertex : mesh.vertices) vertex = pose * vertex;
  return mesh;
}

void append(const TriangleMesh& mesh, const fcl::Transform3d& pose, TriangleMesh& all) {
  const std::size_t first = all.vertices.size();
  for (const fcl::Vector3d& vertex : mesh.vertices) all.vertices.push_back(pose * vertex);
  for (const fcl::Triangle& t : mesh.triangles) {
    all.triangles.emplace_back(first + t[0], first + t[1], first + t[2]);
  }
}

TriangleMesh drawnGeometry(const fcl::CollisionGeometryd& geometry) {
  if (const auto* model = dynamic_cast<const Model*>(&geometry)) return meshOf(*model);
  return primitiveMesh(geometry);
}

TriangleMesh drawnMesh(const LoadedObject& object) {
  if (const auto* mesh = std::get_if<TriangleMesh>(&object.shape)) return moved(*mesh, object.pose);
  return moved(primitiveMesh(*std::get<PrimitiveShape>(object.shape)), object.pose);
}

TriangleMesh drawnEllipsoid(const GaussianDisplacement& displacement, double deviations,
                            const Eigen::Vector3d& centre) {
  Model model;
  fcl::generateBVHModel(model, fcl::Sphered(1.0), fcl::Transform3d::Identity(), kSegments, kRings);
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.linear() =
      displacement.axes() * (deviations * displacement.standardDeviations()).asDiagonal();
  pose.translation() = centre;
  return moved(meshOf(model), pose);
}

Eigen::Vector3d nearestPoint(const TriangleMesh& a, const TriangleMesh& b) {
  const fcl::Transform3d identity = fcl::Transform3d::Identity();
  const auto model_a = buildModel<fcl::OBBRSSd>(a);
  const auto model_b = buildModel<fcl::OBBRSSd>(b);
  fcl::DistanceResultd result;
  fcl::distance(model_a.get(), identity, model_b.get(), identity, fcl::DistanceRequestd(true),
                result);
  return result.min_distance > 0.0 ? result.nearest_points[0] : model_a->aabb_local.center();
}

}  // namespace fcl_prob::cli
