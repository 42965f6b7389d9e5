// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// fcl::collide for one pair of shapes, as a function of the displacement.
#pragma once

#include <fcl/geometry/collision_geometry.h>

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fcl_prob/probability_request.h"
#include "geometry/closed_mesh.h"

namespace fcl_prob::detail {

/// Answers whether A, displaced, collides with B. Const calls are safe on several threads. The
/// geometries must outlive it and are not written to.
class DisplacedCollider {
 public:
  /// \throws InvalidGeometry, InvalidPose, UnsupportedGeometry, OpenMesh
  DisplacedCollider(const fcl::CollisionGeometryd& a, const fcl::Transform3d& pose_a,
                    const fcl::CollisionGeometryd& b, const fcl::Transform3d& pose_b,
                    ContactMeaning contact);

  /// \param displacement  of A, metres, world frame
  bool collides(const Eigen::Vector3d& displacement) const;

  /// The same for other poses of both (rigid, metres, world frame).
  bool collidesAt(const fcl::Transform3d& pose_a, const fcl::Transform3d& pose_b) const;

  /// What was done to make FCL's answers quick, for ProbabilityResult::plan.
  const std::vector<std::string>& plan() const { return plan_; }

 private:
  /// One object: what FCL gets to see of it, and its solid if contained objects are to be found.
  struct Side {
    std::shared_ptr<const fcl::CollisionGeometryd> geometry;
    fcl::Transform3d pose;
    std::optional<ClosedMesh> solid;
    std::vector<Eigen::Vector3d> points;  // one of each connected part, frame of the geometry
  };

  Side makeSide(const fcl::CollisionGeometryd& geometry, const fcl::Transform3d& pose,
                const std::string& name, ContactMeaning contact);
  static bool contains(const Side& outer, const fcl::Transform3d& pose_of_outer, const Side& inner,
                       const fcl::Transform3d& pose_of_inner);

  std::vector<std::string> plan_;
  bool never_;  ///< fcl::collide leaves out one of the two; so does containment
  Side a_;
  Side b_;
};

}  // namespace fcl_prob::detail
