// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/placed_query.h"

#include <algorithm>
#include <utility>

#include "fcl_prob/group.h"
#include "robot/reversed.h"
#include "robot/sum_above.h"

namespace fcl_prob::detail {
namespace {

using Poses = std::vector<fcl::Transform3d>;

void ask(const GroupQuery& query, const Poses& bodies, const Poses& obstacle,
         const GaussianDisplacement& displacement, const ProbabilityRequest& request,
         ProbabilityResult& result) {
  query.collisionProbability(bodies, obstacle, displacement, request, result);
}

template <typename Other>
void ask(const GroupQuery& query, const Poses& bodies, const Poses& obstacle,
         const Other& displacement, const ProbabilityRequest& request, ProbabilityResult& result) {
  collisionProbability(query, bodies, obstacle, displacement, request, result);
}

ProbabilityResult allFar(double far, const ProbabilityRequest& request) {
  ProbabilityResult result;
  result.lower = 0.0;
  result.upper = far;
  if (request.method == ProbabilityMethod::estimate) {
    result.estimate = 0.5 * far;
    result.standard_error = 0.5 * far;
  }
  result.plan.push_back("all bodies are far from it: bounded by balls around them");
  return result;
}

}  // namespace

double leaveOutFar(const std::vector<Ball>& balls, const Ball& around, const ObstacleState& state,
                   double most, std::vector<PlacedBody>& bodies) {
  const Ball obstacle = around.placed(state.pose);
  std::vector<std::pair<double, PlacedBody>> ordered;
  for (const PlacedBody& body : bodies) {
    const Ball ball = balls[body.body].placed(body.pose);
    ordered.emplace_back(farContactUpper(ball, obstacle, state.displacement), body);
  }
  std::stable_sort(ordered.begin(), ordered.end(),
                   [](const auto& x, const auto& y) { return x.first > y.first; });
  double sum = 0.0;
  while (!ordered.empty()) {
    const double next = sumAbove(sum, ordered.back().first);
    if (next > most) break;
    sum = next;
    ordered.pop_back();
  }
  bodies.clear();
  for (const auto& [unused, body] : ordered) bodies.push_back(body);
  return sum;
}

ProbabilityResult placedProbability(const ObstacleAmongBodies& scene, const ObstacleState& state,
                                    std::vector<PlacedBody> bodies,
                                    const ProbabilityRequest& request, FarBodies& left_out) {
  const std::size_t all = bodies.size();
  const double far = leaveOutFar(scene.balls, scene.around, state,
                                 kShareOfFar * request.absolute_tolerance, bodies);
  left_out = {all - bodies.size(), far};
  if (bodies.empty()) return allFar(far, request);
  GroupQuery::Geometries geometries;
  Poses poses;
  for (const PlacedBody& body : bodies) {
    geometries.push_back(scene.robot.bodies()[body.body].geometry);
    poses.push_back(body.pose);
  }
  // What is left out widens the interval, too.
  ProbabilityRequest of_near = request;
  if (far > 0.0) {
    of_near.absolute_tolerance *= 1.0 - kShareOfFar;
    of_near.relative_tolerance *= 1.0 - kShareOfFar;
  }
  const GroupQuery query(std::move(geometries), {scene.obstacle});
  ProbabilityResult result;
  std::visit(
      [&](const auto& displacement) {
        ask(query, poses, {state.pose}, reversed(displacement), of_near, result);
      },
      state.displacement);
  if (far > 0.0 && result.upper) {
    result.upper = std::min(1.0, sumAbove(*result.upper, far));
  }
  return result;
}

}  // namespace fcl_prob::detail
