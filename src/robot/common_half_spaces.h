// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A bound on P that any of many convex pairs meets, by a few half-spaces that hold them all.
#pragma once

#include <deque>
#include <vector>

#include "convex/pair_frame.h"
#include "fcl_prob/gaussian_displacement.h"
#include "robot/linear_errors.h"
#include "robot/node_hulls.h"

namespace fcl_prob::detail {

/// The C-obstacles of neighbouring parts lie behind much the same plane: the mass behind it counts
/// once, where the sum of their own masses counts it for each of them. Bodies are opened, node by
/// node, only where their hulls are not behind one of the half-spaces found so far.
///
/// Half-spaces are proposed by GJK; that one holds a pair is told by support values.
class CommonHalfSpaces {
 public:
  /// \param displacement  of the bodies a relative to the bodies b; of rank 3, or all bounds are 1
  explicit CommonHalfSpaces(GaussianDisplacement displacement)
      : displacement_(std::move(displacement)) {}

  /// \param errors  of the robot that the bodies a are of; must outlive this
  CommonHalfSpaces(GaussianDisplacement displacement, const LinearErrors& errors)
      : displacement_(std::move(displacement)), errors_(&errors) {}

  /// The hulls must outlive this. \param pose_a, pose_b  valid ones
  /// \param body  of the robot, that a is. \throws InvalidGeometry
  void add(const NodeHulls& a, const fcl::Transform3d& pose_a, const NodeHulls& b,
           const fcl::Transform3d& pose_b, std::size_t body);

  /// Certainly not below P that any of the pairs added meets; with errors of the robot, that this
  /// happens while they are within LinearErrors::within(). Stops when it is below `enough`, or when
  /// that is out of reach.
  double upper(double enough);

 private:
  /// One a and one b.
  struct Bodies {
    const NodeHulls& a;
    const NodeHulls& b;
    PairFrame frame;
    fcl::Transform3d pose_a;
    std::size_t body;
  };

  /// y and the errors z of the robot together: towards·y + along·z.
  struct Direction {
    Eigen::Vector3d towards = Eigen::Vector3d::Zero();  ///< unit, whitened frame
    Eigen::VectorXd along;                              ///< empty without errors
  };

  /// A node of each.
  struct Pair {
    std::size_t of;  ///< in bodies_
    int a;
    int b;
    Direction direction;            ///< as GJK proposes
    double own = 1.0;               ///< the mass of the half-space there
    std::vector<double> distances;  ///< by half-space: to where it would have to begin
    double cost = 1.0;              ///< the least mass that has to be added to hold it
    int cheapest = -1;              ///< the half-space that would be enlarged; -1: one of its own
  };

  /// { towards·y + along·z >= distance }, in deviations of that.
  struct HalfSpace {
    Direction direction;
    double distance;
    double mass;
  };

  double distanceAlong(const Pair& pair, const Direction& direction) const;
  struct Foremost {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< metres, world frame
    Eigen::VectorXd errors;
  };
  Foremost foremost(const Pair& pair, const Eigen::Vector3d& towards) const;
  Eigen::Vector3d farthestOf(const Pair& pair, const Eigen::Vector3d& m) const;
  double turnedBeyond(const Pair& pair, const Eigen::Vector3d& towards,
                      const Eigen::Vector3d& point) const;
  void open(Pair pair, double most);
  void appraise(Pair& pair) const;
  bool isLeaf(const Pair& pair) const;
  void divide(const Pair& pair);
  void hold(const Pair& pair);
  double held() const;

  GaussianDisplacement displacement_;
  const LinearErrors* errors_ = nullptr;  ///< null: the robot is exact
  bool can_tell_ = true;                  ///< all frames have rank 3, and numbers that stay finite
  std::deque<Bodies> bodies_;
  std::vector<Pair> pairs_;  ///< not held yet
  std::vector<HalfSpace> half_spaces_;
};

}  // namespace fcl_prob::detail
