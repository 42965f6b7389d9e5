// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <algorithm>
#include <array>
#include <cmath>

#include "base/number_text.h"
#include "base/quantiles.h"
#include "bounds/sphere_methods.h"
#include "convex/nearest.h"
#include "convex/pair_obstacle.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/prior_methods.h"
#include "geometry/validation.h"
#include "paper/geometry_tree.h"
#include "paper/node_pairs.h"

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
      : pairs_(a, b, frame), frame_(frame), radius_(radius) {}

  bool collides() {
    const NodePair roots{0, 0};
    return reaches(distance(roots)) && refinedCollides(roots);
  }

  std::size_t pairsTested() const { return pairs_tested_; }

 private:
  struct Child {
    NodePair pair;
    double distance;
  };

  bool reaches(double distance) const { return !(distance > radius_); }

  bool refinedCollides(const NodePair& pair) {
    if (pairs_.areLeaves(pair.a, pair.b)) return reaches(pieceDistance(pair));
    std::array<Child, 2> children;
    for (int i = 0; i < 2; ++i) {
      const NodePair child = pairs_.children(pair.a, pair.b)[i];
      children[i] = {child, distance(child)};
    }
    if (children[1].distance < children[0].distance) std::swap(children[0], children[1]);
    for (const Child& child : children) {
      if (reaches(child.distance) && refinedCollides(child.pair)) return true;
    }
    return false;
  }

  double distance(const NodePair& pair) {
    return distance(*PairObstacle(frame_, pairs_.a().body(pair.a), pairs_.b().body(pair.b)));
  }
  double pieceDistance(const NodePair& leaves) {
    return distance(*PairObstacle(frame_, pairs_.a().piece(leaves.a), pairs_.b().piece(leaves.b)));
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

  NodePairs pairs_;
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

  const double radius = std::sqrt(chiSquaredQuantile(3.0, confidence));
  EnlargedTraversal traversal(*tree_a, *tree_b, frame, radius);
  EnlargedCollision result;
  result.collides = traversal.collides();
  result.pairs_tested = traversal.pairsTested();
  if (!result.collides) {
    result.upper = std::min(1.0, (1.0 - confidence) * (1.0 + kTailRelativeError));
  }
  return result;
}

}  // namespace fcl_prob
