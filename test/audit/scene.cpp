// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene.h"

#include <fcl/geometry/octree/octree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/plane.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/geometry/shape/triangle_p.h>

namespace fcl_prob_audit {
namespace {

Geometry meshOf(const Shape& shape) {
  switch (shape.tree) {
    case Tree::aabb:
      return fcl_prob::buildModel<fcl::AABBd>(shape.mesh);
    case Tree::obb:
      return fcl_prob::buildModel<fcl::OBBd>(shape.mesh);
    case Tree::rss:
      return fcl_prob::buildModel<fcl::RSSd>(shape.mesh);
    case Tree::obbrss:
      return fcl_prob::buildModel<fcl::OBBRSSd>(shape.mesh);
    case Tree::kios:
      return fcl_prob::buildModel<fcl::kIOSd>(shape.mesh);
    case Tree::kdop16:
      return fcl_prob::buildModel<fcl::KDOPd<16>>(shape.mesh);
    case Tree::kdop18:
      return fcl_prob::buildModel<fcl::KDOPd<18>>(shape.mesh);
    case Tree::kdop24:
      return fcl_prob::buildModel<fcl::KDOPd<24>>(shape.mesh);
  }
  return nullptr;
}

Geometry convexOf(const TriangleMesh& mesh) {
  auto faces = std::make_shared<std::vector<int>>();
  for (const fcl::Triangle& t : mesh.triangles) {
    faces->push_back(3);
    for (int k = 0; k < 3; ++k) faces->push_back(static_cast<int>(t[k]));
  }
  return std::make_shared<fcl::Convexd>(
      std::make_shared<const std::vector<Vector3d>>(mesh.vertices),
      static_cast<int>(mesh.triangles.size()), faces);
}

Geometry octreeOf(const Shape& shape) {
  const auto tree = std::make_shared<octomap::OcTree>(shape.resolution);
  constexpr int kMiddle = 32768;
  for (const Voxel& voxel : shape.voxels) {
    const auto key = [&](int axis) {
      return static_cast<octomap::key_type>(voxel.index[static_cast<std::size_t>(axis)] + kMiddle);
    };
    tree->updateNode(octomap::OcTreeKey(key(0), key(1), key(2)), voxel.occupied);
  }
  return std::make_shared<fcl::OcTreed>(std::shared_ptr<const octomap::OcTree>(tree));
}

Geometry newGeometry(const Shape& s) {
  const Vector3d& size = s.sizes;
  switch (s.kind) {
    case Kind::box:
      return std::make_shared<fcl::Boxd>(size);
    case Kind::sphere:
      return std::make_shared<fcl::Sphered>(size[0]);
    case Kind::ellipsoid:
      return std::make_shared<fcl::Ellipsoidd>(size);
    case Kind::capsule:
      return std::make_shared<fcl::Capsuled>(size[0], size[1]);
    case Kind::cone:
      return std::make_shared<fcl::Coned>(size[0], size[1]);
    case Kind::cylinder:
      return std::make_shared<fcl::Cylinderd>(size[0], size[1]);
    case Kind::convex:
      return convexOf(s.mesh);
    case Kind::triangle:
      return std::make_shared<fcl::TrianglePd>(s.mesh.vertices[0], s.mesh.vertices[1],
                                               s.mesh.vertices[2]);
    case Kind::halfspace:
      return std::make_shared<fcl::Halfspaced>(s.normal, s.offset);
    case Kind::plane:
      return std::make_shared<fcl::Planed>(s.normal, s.offset);
    case Kind::mesh:
      return meshOf(s);
    case Kind::octree:
      return octreeOf(s);
  }
  return nullptr;
}

}  // namespace

Geometry makeGeometry(const Shape& shape) {
  Geometry geometry = newGeometry(shape);
  geometry->cost_density = shape.cost_density;
  geometry->threshold_occupied = shape.threshold_occupied;
  geometry->threshold_free = shape.threshold_free;
  geometry->computeLocalAABB();
  return geometry;
}

fcl_prob::GaussianDisplacement makeDisplacement(const Displacement& displacement) {
  using fcl_prob::GaussianDisplacement;
  GaussianDisplacement result = GaussianDisplacement::fromStandardDeviations(
      displacement.sigma, displacement.axes, displacement.mean);
  if (displacement.by_matrix) {
    result = GaussianDisplacement(displacement.mean, result.covariance());
  }
  return displacement.rotated ? result.rotated(*displacement.rotated) : result;
}

double extentOf(const Shape& shape) {
  switch (shape.kind) {
    case Kind::box:
      return 0.5 * shape.sizes.norm();
    case Kind::sphere:
      return shape.sizes[0];
    case Kind::ellipsoid:
      return shape.sizes.maxCoeff();
    case Kind::capsule:
    case Kind::cone:
    case Kind::cylinder:
      return shape.sizes[0] + 0.5 * shape.sizes[1];
    case Kind::halfspace:
    case Kind::plane:
      return 0.0;
    default:
      break;
  }
  double most = 0.0;
  for (const Vector3d& v : shape.mesh.vertices) most = std::max(most, v.norm());
  for (const Voxel& voxel : shape.voxels) {
    const Vector3d centre(voxel.index[0] + 0.5, voxel.index[1] + 0.5, voxel.index[2] + 0.5);
    most = std::max(most, shape.resolution * (centre.norm() + 1.0));
  }
  return most;
}

}  // namespace fcl_prob_audit
