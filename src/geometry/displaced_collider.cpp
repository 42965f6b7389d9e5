// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "geometry/displaced_collider.h"

#include <fcl/geometry/octree/octree.h>
#include <fcl/narrowphase/collision.h>

#include <Eigen/LU>

#include "fcl_prob/exceptions.h"
#include "fcl_prob/monte_carlo.h"
#include "fcl_prob/triangle_mesh.h"
#include "geometry/convex_vertices.h"
#include "geometry/mesh_visitor.h"
#include "geometry/occupancy.h"
#include "geometry/validation.h"

namespace fcl_prob {

// The entries of fcl/narrowphase/detail/collision_func_matrix-inl.h: every basic shape but
// TriangleP with every basic shape, mesh and octree; meshes with meshes of the same bounding volume
// and with octrees. The matrix itself is a template that takes half a minute to instantiate; a test
// compares with FCL. The entry for Convex and Plane calls a null function.
bool fclSupportsPair(const fcl::CollisionGeometryd& a, const fcl::CollisionGeometryd& b) {
  using detail::GeometryKind;
  const auto known = [](const fcl::CollisionGeometryd& geometry) {
    return detail::kindOf(geometry) != GeometryKind::unsupported &&
           geometry.getNodeType() != fcl::GEOM_TRIANGLE;
  };
  const auto are = [&](fcl::NODE_TYPE first, fcl::NODE_TYPE second) {
    return a.getNodeType() == first && b.getNodeType() == second;
  };
  if (!known(a) || !known(b)) return false;
  if (are(fcl::GEOM_CONVEX, fcl::GEOM_PLANE) || are(fcl::GEOM_PLANE, fcl::GEOM_CONVEX)) {
    return false;
  }
  const bool both_meshes =
      detail::kindOf(a) == GeometryKind::mesh && detail::kindOf(b) == GeometryKind::mesh;
  return !both_meshes || a.getNodeType() == b.getNodeType();
}

namespace detail {
namespace {

/// FCL copies these models and rebuilds their trees in every call whose pose is not the identity.
/// (With a Halfspace or Plane it also calls a null function, except for RSS.)
bool rebuiltInEveryCall(fcl::NODE_TYPE type) {
  return type == fcl::BV_AABB || type == fcl::BV_RSS || type == fcl::BV_KDOP16 ||
         type == fcl::BV_KDOP18 || type == fcl::BV_KDOP24;
}

std::shared_ptr<const fcl::CollisionGeometryd> withOrientedTree(
    const fcl::CollisionGeometryd& geometry) {
  const auto model = buildModel<fcl::OBBRSSd>(triangleMesh(meshView(geometry)));
  copyOccupancy(geometry, *model);
  return model;
}

std::shared_ptr<const fcl::CollisionGeometryd> unowned(const fcl::CollisionGeometryd& geometry) {
  return {std::shared_ptr<const void>(), &geometry};
}

/// Points of which at least one lies in every connected part of a solid shape.
std::vector<Eigen::Vector3d> pointsOfParts(const fcl::CollisionGeometryd& geometry) {
  std::vector<Eigen::Vector3d> points;
  if (kindOf(geometry) == GeometryKind::octree) {
    for (const auto& box : static_cast<const fcl::OcTreed&>(geometry).toBoxes()) {
      points.emplace_back(box[0], box[1], box[2]);
    }
  } else if (const auto vertices = polytopeVertices(geometry)) {
    points.push_back(vertices->front());
  } else if (kindOf(geometry) == GeometryKind::convex) {
    points.emplace_back(Eigen::Vector3d::Zero());  // FCL centres its round shapes at their origin
  }
  return points;
}

}  // namespace

DisplacedCollider::DisplacedCollider(const fcl::CollisionGeometryd& a,
                                     const fcl::Transform3d& pose_a,
                                     const fcl::CollisionGeometryd& b,
                                     const fcl::Transform3d& pose_b, ContactMeaning contact) {
  validateGeometry(&a, "object A");
  validateGeometry(&b, "object B");
  validatePose(pose_a, "object A");
  validatePose(pose_b, "object B");
  if (!fclSupportsPair(a, b)) {
    throw UnsupportedGeometry(
        "fcl::collide does not support the pair " + nodeTypeName(a.getNodeType()) + " and " +
        nodeTypeName(b.getNodeType()) + " (it would answer \"no collision\", or crash)");
  }
  never_ = whyNeverInContact(a, b).has_value();
  a_ = makeSide(a, pose_a, "object A", contact);
  b_ = makeSide(b, pose_b, "object B", contact);
  // Both meshes are rebuilt or none, since both have the same bounding volume; an octree's
  // traversal takes every mesh as it is.
  const bool with_octree = kindOf(a) == GeometryKind::octree || kindOf(b) == GeometryKind::octree;
  for (Side* side : {&a_, &b_}) {
    if (with_octree || !rebuiltInEveryCall(side->geometry->getNodeType())) continue;
    const std::string name = nodeTypeName(side->geometry->getNodeType());
    side->geometry = withOrientedTree(*side->geometry);
    plan_.push_back(name +
                    " rebuilt once as BVHModel<OBBRSS> over the same triangles, since "
                    "fcl::collide would copy and rebuild it at every sample");
  }
}

DisplacedCollider::Side DisplacedCollider::makeSide(const fcl::CollisionGeometryd& geometry,
                                                    const fcl::Transform3d& pose,
                                                    const std::string& name,
                                                    ContactMeaning contact) {
  Side side;
  side.geometry = unowned(geometry);
  side.pose = pose;
  if (contact == ContactMeaning::fcl) return side;
  if (kindOf(geometry) == GeometryKind::mesh) {
    side.solid.emplace(meshView(geometry), name);
    side.points = side.solid->partPoints();
  } else {
    side.points = pointsOfParts(geometry);
  }
  return side;
}

/// For surfaces that do not meet. A point within rounding of the surface counts as contained: it
/// touches.
bool DisplacedCollider::contains(const Side& outer, const fcl::Transform3d& pose_of_outer,
                                 const Side& inner, const fcl::Transform3d& pose_of_inner) {
  if (!outer.solid) return false;
  // Not the transpose: poses are rotations to 1e-9 only.
  const Eigen::Matrix3d to_outer = pose_of_outer.linear().inverse();
  const Eigen::Vector3d offset = pose_of_inner.translation() - pose_of_outer.translation();
  for (const Eigen::Vector3d& point : inner.points) {
    const Eigen::Vector3d seen = to_outer * (pose_of_inner.linear() * point + offset);
    if (outer.solid->contains(seen) != Containment::outside) return true;
  }
  return false;
}

bool DisplacedCollider::collides(const Eigen::Vector3d& displacement) const {
  if (never_) return false;
  fcl::Transform3d displaced = a_.pose;
  displaced.translation() += displacement;
  return collidesAt(displaced, b_.pose);
}

bool DisplacedCollider::collidesAt(const fcl::Transform3d& pose_a,
                                   const fcl::Transform3d& pose_b) const {
  const fcl::CollisionRequestd request;
  fcl::CollisionResultd result;
  fcl::collide(a_.geometry.get(), pose_a, b_.geometry.get(), pose_b, request, result);
  if (result.isCollision()) return true;
  return contains(b_, pose_b, a_, pose_a) || contains(a_, pose_a, b_, pose_b);
}

}  // namespace detail
}  // namespace fcl_prob
