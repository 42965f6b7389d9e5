// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

#include "cobstacle/nearest.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/prior_methods.h"
#include "gaussian/number_text.h"
#include "geometry/validation.h"
#include "narrowphase/sphere_methods.h"
#include "traversal/geometry_tree.h"

namespace fcl_prob {
namespace {

using namespace detail;

/// Of 1 - confidence: what the quantile and this test of distances may be off by, and more.
constexpr double kTailRelativeError = 1e-9;

/// The confidence ellipsoid is a ball around the mean of the whitened frame, so sweeping A by it
/// means asking whether the whitened C-obstacle comes that near to the mean.
class EnlargedTraversal {
 public:
  EnlargedTraversal(const BoundingTree& a, const BoundingTree& b, const PairFrame& frame,
                    double radius)
      : a_(a), b_(b), frame_(frame), radius_(radius) {}

  bool collides(int node_a, int node_b) {
    return reaches(distance(node_a, node_b)) && refinedCollides(node_a, node_b);
  }

  std::size_t pairsTested() const { return pairs_tested_; }

 private:
  struct Child {
    int a;
    int b;
    double distance;
  };

  bool reaches(double distance) const { return !(distance > radius_); }

  bool refinedCollides(int node_a, int node_b) {
    if (a_.isLeaf(node_a) && b_.isLeaf(node_b)) return reaches(pieceDistance(node_a, node_b));
    Child first;
    Child second;
    if (refinesA(node_a, node_b)) {
      const int left = a_.leftChild(node_a);
      first = {left, node_b, distance(left, node_b)};
      second = {left + 1, node_b, distance(left + 1, node_b)};
    } else {
      const int left = b_.leftChild(node_b);
      first = {node_a, left, distance(node_a, left)};
      second = {node_a, left + 1, distance(node_a, left + 1)};
    }
    if (second.distance < first.distance) std::swap(first, second);
    return (reaches(first.distance) && refinedCollides(first.a, first.b)) ||
           (reaches(second.distance) && refinedCollides(second.a, second.b));
  }

  bool refinesA(int node_a, int node_b) const {
    if (b_.isLeaf(node_b)) return true;
    return !a_.isLeaf(node_a) && a_.volume(node_a) >= b_.volume(node_b);
  }

  double distance(int node_a, int node_b) {
    return distance(*PairObstacle(frame_, a_.body(node_a), b_.body(node_b)));
  }
  double pieceDistance(int leaf_a, int leaf_b) {
    return distance(*PairObstacle(frame_, a_.piece(leaf_a), b_.piece(leaf_b)));
  }

  /// How far the C-obstacle is from the mean at least: by support values, so that it holds whatever
  /// the directions are worth that are tried.
  double distance(const CObstacle& obstacle) {
    ++pairs_tested_;
    obstacle.outerFaces(scratch_);
    const Separation separation = separationOf(scratch_.faces);
    double farthest =
        std::max(along(obstacle, separation.nearest), along(obstacle, separation.face));
    if (!obstacle.isPolytope()) {
      const auto ball = obstacle.ellipsoid();
      const Eigen::Vector3d nearest =
          ball ? ball->nearestPoint(frame_).stableNormalized() : gjkDirection(obstacle);
      farthest = std::max(farthest, along(obstacle, nearest));
    }
    return farthest;
  }

  static double along(const CObstacle& obstacle, const Eigen::Vector3d& direction) {
    return direction.squaredNorm() > 0.5 ? -obstacle.support(-direction) : 0.0;
  }

  const BoundingTree& a_;
  const BoundingTree& b_;
  const PairFrame& frame_;
  double radius_;
  std::size_t pairs_tested_ = 0;
  ObstacleScratch scratch_;
};

}  // namespace

EnlargedCollision enlargedCollision(const fcl::CollisionGeometryd& a,
                                    const fcl::Transform3d& pose_a,
                                    const fcl::CollisionGeometryd& b,
                                    const fcl::Transform3d& pose_b,
                                    const GaussianDisplacement& displacement, double confidence) {
  requireTree(a, "object A", "enlargement");
  requireTree(b, "object B", "enlargement");
  validatePose(pose_a, "pose of A");
  validatePose(pose_b, "pose of B");
  if (!(confidence > 0.0 && confidence < 1.0)) {
    throw InvalidRequest("confidence is " + numberText(confidence) + ", must be in (0, 1)");
  }
  requireDensity(displacement);
  const auto tree_a = makeTree(a);
  const auto tree_b = makeTree(b);
  PairFrame frame(displacement, pose_a, tree_a->size(), pose_b, tree_b->size());
  frame.error += tree_a->slack() + tree_b->slack();

  const boost::math::chi_squared_distribution<double> squared_radius(3.0);
  const double radius = std::sqrt(boost::math::quantile(squared_radius, confidence));
  EnlargedTraversal traversal(*tree_a, *tree_b, frame, radius);
  EnlargedCollision result;
  result.collides = traversal.collides(0, 0);
  result.pairs_tested = traversal.pairsTested();
  if (!result.collides) {
    result.upper = std::min(1.0, (1.0 - confidence) * (1.0 + kTailRelativeError));
  }
  return result;
}

}  // namespace fcl_prob
