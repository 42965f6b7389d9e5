// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/interval_with_errors.h"

#include <algorithm>

#include "base/budget.h"
#include "base/decision.h"
#include "base/known.h"
#include "base/number_text.h"
#include "base/rounded_sum.h"
#include "base/statistics.h"
#include "fcl_prob/combined_bounds.h"
#include "query/groups_query.h"
#include "robot/body_bounds.h"
#include "robot/moving_obstacle.h"
#include "robot/placed_query.h"

namespace fcl_prob::detail {
namespace {

/// Chances that errors are larger than bands allow for: the less, the wider the bands. The
/// narrowest answer counts, whichever gives it.
constexpr double kBeyondBands[] = {1e-3, 1e-5, 0.02};

/// Of a threshold, or of a probability that is small: what errors of the robot that half-spaces
/// know nothing of may have. Less of it is a larger error of what they do know.
constexpr double kShareBeyond = 0.01;
constexpr double kSmall = 0.01;

/// What is to be below this is asked for what half-spaces tell best.
constexpr double kTiny = 1e-12;

/// A band of so many of the obstacle's largest deviations is not asked for: it leaves nearly all
/// open, and its cells take seconds each.
constexpr double kWidest = 2.0;

/// Of what is multiplied by the chance that errors are as expected.
constexpr double kRoundedChance = 1e-8;

/// Around the bodies, each in its own frame, wherever errors put them.
std::vector<Ball> ballsWith(const LinearErrors& errors, std::vector<Ball> balls) {
  for (std::size_t i = 0; i < balls.size(); ++i) {
    balls[i].radius += errors.farthest(i, balls[i].radius);
  }
  return balls;
}

class IntervalWithErrors {
 public:
  IntervalWithErrors(const RobotAmongObstacles& among, const Eigen::VectorXd& values)
      : among_(among), poses_(among.robot().poses(values)) {}

  /// Of P that any body touches an obstacle, while errors are within what is told of them.
  /// \param largest  the widest band of all that was asked for
  Bounds ofObstacle(std::size_t index, const LinearErrors& errors,
                    const ProbabilityRequest& request, double& largest,
                    ProbabilityStatistics& spent) const {
    const Obstacle& obstacle = among_.obstacles()[index];
    const PreparedObstacle& prepared = among_.preparedObstacle(index);
    const ObstacleState state = stateAt(obstacle, 0);
    std::vector<PlacedBody> bodies = among_.placed(index, poses_);
    const double far = leaveOutFar(ballsWith(errors, among_.balls()), prepared.around(), state,
                                   mostFarOf(request), bodies);
    if (bodies.empty()) return {0.0, far};
    PreparedGeometries geometries;
    std::vector<fcl::Transform3d> poses;
    double width = 0.0;
    for (const PlacedBody& body : bodies) {
      geometries.push_back(among_.geometries()[body.body]);
      poses.push_back(body.pose);
      width = std::max(width, errors.farthest(body.body, among_.balls()[body.body].radius));
    }
    largest = std::max(largest, width);
    const auto& displacement = std::get<GaussianDisplacement>(state.displacement);
    if (width > kWidest * displacement.standardDeviations().maxCoeff()) return {0.0, 1.0};
    ProbabilityRequest banded = request;
    banded.band_a = Band::within(width);
    const GroupsQuery query(std::move(geometries), prepared.geometries());
    const ProbabilityResult result =
        query.answer(poses, prepared.poses(state.pose), displacement.reversed(), banded);
    addStatistics(result.statistics, spent);
    return {result.lower.value_or(0.0), std::min(1.0, sumAbove(result.upper.value_or(1.0), far))};
  }

 private:
  const RobotAmongObstacles& among_;
  std::vector<fcl::Transform3d> poses_;
};

}  // namespace

double upperWithErrors(const RobotAmongObstacles& among, const Eigen::VectorXd& values,
                       const Eigen::MatrixXd& covariance, const std::optional<PoseError>& base,
                       double enough) {
  const double chance = kShareBeyond * (enough > kTiny ? std::min(enough, kSmall) : kSmall);
  const LinearErrors errors(among.robot(), among.balls(), values, covariance, base, chance);
  const std::vector<fcl::Transform3d> poses = among.robot().poses(values);
  const std::vector<Ball> balls = ballsWith(errors, among.balls());
  double upper = errors.chance();
  for (std::size_t j = 0; j < among.obstacles().size() && upper < enough; ++j) {
    const PreparedObstacle& prepared = among.preparedObstacle(j);
    const ObstacleState state = stateAt(among.obstacles()[j], 0);
    std::vector<PlacedBody> bodies = among.placed(j, poses);
    upper = sumAbove(upper, leaveOutFar(balls, prepared.around(), state, chance, bodies));
    if (bodies.empty()) continue;
    const auto& displacement = std::get<GaussianDisplacement>(state.displacement);
    upper = sumAbove(upper, upperTogether(among.prepared(), bodies, &errors, prepared, state.pose,
                                          displacement.reversed(), enough - upper));
  }
  return std::min(1.0, upper);
}

ProbabilityResult intervalWithErrors(const RobotAmongObstacles& among,
                                     const Eigen::VectorXd& values,
                                     const Eigen::MatrixXd& covariance,
                                     const std::optional<PoseError>& base,
                                     const ProbabilityRequest& request) {
  Budget budget(request);
  Known known(request);
  const double enough = request.threshold.value_or(kSmall);
  const double upper = upperWithErrors(among, values, covariance, base, enough);
  known.narrow({0.0, upper});
  ProbabilityResult result;
  result.plan.push_back("half-spaces for bodies and errors of the robot together: P is at most " +
                        numberText(upper));
  result.status = known.satisfied().value_or(ProbabilityStatus::resolution_limit);
  const IntervalWithErrors parts(among, values);
  bool cancelled = false;
  const auto tell = [&](ProbabilityProgress progress) {
    progress.interval = known.interval();
    cancelled = cancelled || !request.on_progress(progress);
    return !cancelled;
  };
  std::size_t left = std::size(kBeyondBands) * among.obstacles().size();
  for (const double chance : kBeyondBands) {
    if (result.status != ProbabilityStatus::resolution_limit) break;
    const LinearErrors errors(among.robot(), among.balls(), values, covariance, base, chance);
    std::vector<Bounds> events;
    double width = 0.0;
    for (std::size_t i = 0; i < among.obstacles().size(); ++i, --left) {
      ProbabilityRequest part = request;
      part.threshold.reset();
      if (request.on_progress) part.on_progress = tell;
      budget.share(left, part);
      ProbabilityStatistics spent;
      events.push_back(parts.ofObstacle(i, errors, part, width, spent));
      budget.spend(spent);
      addStatistics(spent, result.statistics);
    }
    // Given the errors of the robot the obstacles are independent events.
    const Bounds any = anyOfIndependent(events);
    known.narrow({any.lower * (1.0 - errors.chance()) * (1.0 - kRoundedChance),
                  std::min(1.0, sumAbove(any.upper, errors.chance()))});
    result.plan.push_back("errors of the robot but for a chance of " + numberText(errors.chance()) +
                          ": bodies within " + numberText(width) + " m of where they are expected");
    const auto stopped = cancelled
                             ? ProbabilityStatus::cancelled
                             : budget.exhausted().value_or(ProbabilityStatus::resolution_limit);
    result.status = known.satisfied().value_or(stopped);
  }
  known.tell(result);
  return result;
}

}  // namespace fcl_prob::detail
