// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What half-spaces between the hulls of bodies and an obstacle say of P, in microseconds a body.
#pragma once

#include <algorithm>
#include <vector>

#include "base/rounded_sum.h"
#include "fcl_prob/gaussian_displacement.h"
#include "robot/linear_errors.h"
#include "robot/prepared_obstacle.h"
#include "robot/prepared_robot.h"

namespace fcl_prob::detail {

/// Certainly not below P that any of the bodies touches the obstacle: by half-spaces that they have
/// in common. Stops when that is below `enough`, or when it is out of reach.
/// \param errors  of the robot, within which it touches; null: it is exact
double upperTogether(const PreparedRobot& robot, const std::vector<PlacedBody>& bodies,
                     const LinearErrors* errors, const PreparedObstacle& obstacle,
                     const fcl::Transform3d& pose, const GaussianDisplacement& of_bodies,
                     double enough);

/// The bodies of one query, each with a bound on P that it touches the obstacle. Their sum bounds P
/// that any of them does.
class BodyBounds {
 public:
  /// \param pose       of the obstacle, which must outlive this, as the robot must
  /// \param of_bodies  their displacement relative to it
  BodyBounds(const PreparedRobot& robot, const std::vector<PlacedBody>& bodies,
             const PreparedObstacle& obstacle, const fcl::Transform3d& pose,
             const GaussianDisplacement& of_bodies);

  /// Certainly not below P that any of them touches it.
  double sum() const;

  /// The same of those of which `counts`, a function of the body's index, says so.
  template <typename Counts>
  double sum(const Counts& counts) const {
    double sum = 0.0;
    for (const Bound& bound : bounds_) {
      if (counts(bound.body.body)) sum = sumAbove(sum, bound.upper);
    }
    return std::min(1.0, sum);
  }

  /// No more than sum(): by half-spaces that several bodies have in common, in some tenths of a
  /// millisecond. Stops when it is below `enough`, or when that is out of reach.
  double together(double enough) const;

  /// Certainly not above P that one of them touches it: see medial_balls.h. The first that is above
  /// `enough`, else 0.
  double lower(ContactMeaning contact, double enough) const;

  /// The bodies but for those that are least likely to touch it.
  /// \param most      what those left out may add up to
  /// \param left_out  what they do
  std::vector<PlacedBody> likelier(double most, double& left_out) const;

 private:
  struct Bound {
    PlacedBody body;
    double upper;  ///< certainly not below P that it touches the obstacle
  };

  /// \param poses  of the bodies of the obstacle
  double upperOf(const PlacedBody& body, const std::vector<fcl::Transform3d>& poses) const;

  const PreparedRobot& robot_;
  const PreparedObstacle& obstacle_;
  fcl::Transform3d pose_;  ///< of the obstacle
  GaussianDisplacement of_bodies_;
  std::vector<Bound> bounds_;  ///< the likeliest first
};

/// Bounds on P that any body touches any of several obstacles: the cheapest first, until they tell
/// it from a threshold. Wider than need be where they do not.
/// \param far  of bodies that were left out
Bounds boundsOfAny(const std::vector<BodyBounds>& of_obstacles, double far, double threshold,
                   ContactMeaning contact);

}  // namespace fcl_prob::detail
