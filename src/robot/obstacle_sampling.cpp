// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/obstacle_sampling.h"

#include <algorithm>

#include "base/known.h"
#include "base/rounded_sum.h"
#include "robot/body_bounds.h"

namespace fcl_prob::detail {
namespace {

GaussianDisplacement displacementOfBodies(const ProbableScene& scene) {
  return std::get<GaussianDisplacement>(scene.state.displacement).reversed();
}

}  // namespace

ObstacleSampling::ObstacleSampling(const ProbableScene& scene, const PreparedRobot& robot,
                                   double most_far)
    : scene_(scene), robot_(robot), displacement_(displacementOfBodies(scene)) {
  far_ = leaveOutFar(robot.balls, scene.obstacle->around(), scene.state, most_far, scene_.bodies);
  certified_ = {0.0, scene_.bodies.empty() ? far_ : 1.0};
  probable_ = certified_;
}

void ObstacleSampling::boundByHalfSpaces(double most_left_out, double enough) {
  if (scene_.bodies.empty()) return;
  const BodyBounds bounds(robot_, scene_.bodies, *scene_.obstacle, scene_.state.pose,
                          displacement_);
  double left_out = 0.0;
  scene_.bodies = bounds.likelier(most_left_out, left_out);
  certified_.upper = std::min(certified_.upper, sumAbove(bounds.together(enough - far_), far_));
  probable_.upper = std::min(probable_.upper, certified_.upper);
  far_ = sumAbove(far_, left_out);
}

bool ObstacleSampling::beginLines(const ProbabilityRequest& request, double chance) {
  place(request);
  lines_ = LineBets::of(bodies_, obstacle_, displacement_, request, chance);
  if (!lines_) return false;
  certified_ = within(lines_->certified(), certified_);
  probable_ = within(lines_->probable(), probable_);
  return true;
}

double ObstacleSampling::likely() const {
  if (!lines_) return 0.5 * (probable_.lower + probable_.upper);
  return std::clamp(lines_->likely(), probable_.lower, probable_.upper);
}

bool ObstacleSampling::improveByLines(bool above, double target) {
  const bool goes_on = lines_->improve(above, above ? target : std::max(0.0, target - far_));
  certified_ = within(lines_->certified(), certified_);
  probable_ = within(lines_->probable(), probable_);
  return goes_on;
}

void ObstacleSampling::place(const ProbabilityRequest& request) {
  if (tree_) return;
  std::vector<const PieceTree*> trees;
  for (const PlacedBody& body : scene_.bodies) {
    const PreparedGeometry& geometry = *robot_.geometries[body.body];
    trees.push_back(&geometry.pieces());
    bodies_.parts.push_back({body.pose, geometry.solid(request.contact)});
  }
  tree_ = joinPieceTrees(trees);
  bodies_.tree = tree_.get();
  const PreparedObstacle& obstacle = *scene_.obstacle;
  obstacle_ = obstacle.group().placed(obstacle.poses(scene_.state.pose), request.contact);
}

/// What is far is besides.
Bounds ObstacleSampling::within(const Bounds& of_near, const Bounds& known) const {
  return agreed(known, {of_near.lower, sumAbove(of_near.upper, far_)});
}

}  // namespace fcl_prob::detail
