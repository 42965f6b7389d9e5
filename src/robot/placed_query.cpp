// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/placed_query.h"

#include <algorithm>
#include <utility>

#include "base/decision.h"
#include "base/rounded_sum.h"
#include "query/groups_query.h"
#include "robot/body_bounds.h"
#include "robot/reversed.h"

namespace fcl_prob::detail {
namespace {

/// What bodies that balls around them show to be far may add up to in a first bound.
constexpr double kClearlyFar = 1e-6;

ProbabilityResult allFar(double far, const ProbabilityRequest& request) {
  ProbabilityResult result;
  result.lower = 0.0;
  result.upper = far;
  result.decision = decisionOf({0.0, far}, request);
  const auto otherwise = far > 0.0 ? ProbabilityStatus::resolution_limit : ProbabilityStatus::exact;
  result.status = satisfied({0.0, far}, request).value_or(otherwise);
  if (request.method == ProbabilityMethod::estimate) {
    result.estimate = 0.5 * far;
    result.standard_error = 0.5 * far;
  }
  result.plan.push_back("all bodies are far from it: bounded by balls around them");
  return result;
}

ProbabilityResult ofGroup(const ObstacleAmongBodies& scene, const ObstacleState& state,
                          const std::vector<PlacedBody>& bodies,
                          const ProbabilityRequest& request) {
  PreparedGeometries geometries;
  std::vector<fcl::Transform3d> poses;
  for (const PlacedBody& body : bodies) {
    geometries.push_back(scene.robot.geometries[body.body]);
    poses.push_back(body.pose);
  }
  const GroupsQuery query(std::move(geometries), scene.obstacle.geometries(), "group A", "group B",
                          poses);
  return std::visit(
      [&](const auto& displacement) {
        return query.answer(poses, scene.obstacle.poses(state.pose), reversed(displacement),
                            request);
      },
      state.displacement);
}

/// Leaves out the bodies with the least bounds on their P; the others keep their order.
template <typename UpperOf>
double leaveOutLeast(double most, std::vector<PlacedBody>& bodies, const UpperOf& upperOf) {
  std::vector<std::pair<double, std::size_t>> ordered;
  for (std::size_t i = 0; i < bodies.size(); ++i) ordered.emplace_back(upperOf(bodies[i]), i);
  std::sort(ordered.begin(), ordered.end());
  double sum = 0.0;
  std::vector<bool> is_out(bodies.size());
  for (const auto& [upper, i] : ordered) {
    const double next = sumAbove(sum, upper);
    if (next > most) break;
    sum = next;
    is_out[i] = true;
  }
  std::vector<PlacedBody> near;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!is_out[i]) near.push_back(bodies[i]);
  }
  bodies.swap(near);
  return sum;
}

/// The request whose on_progress hears of all bodies, `far` being what is left out may add.
ProbabilityRequest tellingOfAll(ProbabilityRequest request, double far) {
  if (!request.on_progress) return request;
  request.on_progress = [far, told = std::move(request.on_progress)](ProbabilityProgress progress) {
    progress.interval.upper = std::min(1.0, sumAbove(progress.interval.upper, far));
    return told(progress);
  };
  return request;
}

/// Where bounds on single bodies and half-spaces that they have in common tell the threshold.
/// \param far  of bodies that are left out
std::optional<ProbabilityResult> decidedByBounds(const ObstacleAmongBodies& scene,
                                                 const ObstacleState& state,
                                                 const std::vector<PlacedBody>& bodies, double far,
                                                 const ProbabilityRequest& request) {
  const auto* gaussian = std::get_if<GaussianDisplacement>(&state.displacement);
  if (!asksForDecision(request) || !gaussian) return std::nullopt;
  const BodyBounds bounds(scene.robot, bodies, scene.obstacle, state.pose, gaussian->reversed());
  const Bounds known = boundsOfAny({bounds}, far, *request.threshold, request.contact);
  ProbabilityResult result;
  result.decision = decisionOf(known, request);
  if (!isDecided(result.decision)) return std::nullopt;
  result.lower = known.lower;
  result.upper = known.upper;
  result.status = ProbabilityStatus::decided;
  result.plan.emplace_back(result.decision == Decision::below
                               ? "below the threshold by half-spaces between the bodies and it"
                               : "above the threshold by a ball within one body or the obstacle");
  return result;
}

}  // namespace

double leaveOutFar(const std::vector<Ball>& balls, const Ball& around, const ObstacleState& state,
                   double most, std::vector<PlacedBody>& bodies) {
  const Ball obstacle = around.placed(state.pose);
  return leaveOutLeast(most, bodies, [&](const PlacedBody& body) {
    return farContactUpper(balls[body.body].placed(body.pose), obstacle, state.displacement);
  });
}

double leaveOutUnlikely(const ObstacleAmongBodies& scene, const ObstacleState& state, double most,
                        std::vector<PlacedBody>& bodies) {
  const auto* gaussian = std::get_if<GaussianDisplacement>(&state.displacement);
  if (!gaussian) {
    return leaveOutFar(scene.robot.balls, scene.obstacle.around(), state, most, bodies);
  }
  const GaussianDisplacement of_bodies = gaussian->reversed();
  return leaveOutLeast(most, bodies, [&](const PlacedBody& body) {
    return BodyBounds(scene.robot, {body}, scene.obstacle, state.pose, of_bodies).sum();
  });
}

double unlikelyUpper(const ObstacleAmongBodies& scene, const ObstacleState& state,
                     std::vector<PlacedBody> bodies) {
  const auto* gaussian = std::get_if<GaussianDisplacement>(&state.displacement);
  if (!gaussian) return 1.0;
  const double far =
      leaveOutFar(scene.robot.balls, scene.obstacle.around(), state, kClearlyFar, bodies);
  const BodyBounds bounds(scene.robot, bodies, scene.obstacle, state.pose, gaussian->reversed());
  return std::min(1.0, sumAbove(bounds.sum(), far));
}

double mostFarOf(const ProbabilityRequest& request, double least) {
  return asksForDecision(request) ? kFarOfDecision * *request.threshold
                                  : kShareOfFar * request.toleranceAt(least);
}

ProbabilityResult besidesFar(
    double far, const ProbabilityRequest& request,
    const std::function<ProbabilityResult(const ProbabilityRequest&)>& ask) {
  if (!(far > 0.0)) return ask(request);
  // What is left out widens the interval, too.
  ProbabilityRequest of_near = tellingOfAll(request, far);
  of_near.absolute_tolerance *= 1.0 - kShareOfFar;
  of_near.relative_tolerance *= 1.0 - kShareOfFar;
  ProbabilityResult result = ask(of_near);
  if (!result.upper) return result;
  result.upper = std::min(1.0, sumAbove(*result.upper, far));
  result.decision = decisionOf({result.lower.value_or(0.0), *result.upper}, request);
  if (result.decision == Decision::undecided && result.status == ProbabilityStatus::decided) {
    result.status = ProbabilityStatus::resolution_limit;
  }
  return result;
}

ProbabilityResult placedProbability(const ObstacleAmongBodies& scene, const ObstacleState& state,
                                    std::vector<PlacedBody> bodies,
                                    const ProbabilityRequest& request, FarBodies& left_out) {
  const std::size_t all = bodies.size();
  const double far =
      leaveOutFar(scene.robot.balls, scene.obstacle.around(), state, mostFarOf(request), bodies);
  left_out = {all - bodies.size(), far};
  if (bodies.empty()) return allFar(far, request);
  if (auto decided = decidedByBounds(scene, state, bodies, far, request)) return *decided;
  return besidesFar(far, request, [&](const ProbabilityRequest& of_near) {
    return ofGroup(scene, state, bodies, of_near);
  });
}

}  // namespace fcl_prob::detail
