// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/interval_with_errors.h"

#include <algorithm>
#include <cmath>

#include "base/budget.h"
#include "base/decision.h"
#include "base/known.h"
#include "base/number_text.h"
#include "base/statistics.h"
#include "fcl_prob/combined_bounds.h"
#include "fcl_prob/normal_mass.h"
#include "query/groups_query.h"
#include "robot/body_bounds.h"
#include "robot/body_sweep.h"
#include "robot/moving_obstacle.h"
#include "robot/placed_query.h"
#include "robot/sum_above.h"

namespace fcl_prob::detail {
namespace {

/// Deviations within which all errors are, for bands: the more, the less is beyond and the wider
/// the bands. The narrowest answer counts, whichever gives it.
constexpr double kDeviations[] = {3.5, 5.0, 2.5};

/// Of a threshold, or of a probability that is small: what errors of the robot that half-spaces know
/// nothing of may have. Less of it is a larger error of what they do know.
constexpr double kShareBeyond = 0.01;
constexpr double kSmall = 0.01;

/// A band of so many of the obstacle's largest deviations is not asked for: it leaves nearly all
/// open, and its cells take seconds each.
constexpr double kWidest = 2.0;

// More than what a deviation, a mass, a length and a turn are rounded by.
constexpr double kErrorRounding = 1e-8;

/// What the errors are but for a chance.
struct Within {
  Eigen::VectorXd joints;  ///< |error| of each, radians or metres
  double shift = 0.0;      ///< of the base, metres
  double turn = 0.0;       ///< of the base, radians
  double chance = 0.0;     ///< that they are not: certainly no more
};

Within within(double deviations, const Eigen::MatrixXd& covariance,
              const std::optional<PoseError>& base) {
  const double most = deviations * (1.0 + kErrorRounding);
  Within result;
  result.joints = most * covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  Eigen::Index varying = (result.joints.array() > 0.0).count();
  if (base) {
    const PoseError::Vector6 of_base =
        most * base->covariance().diagonal().cwiseMax(0.0).cwiseSqrt();
    varying += (of_base.array() > 0.0).count();
    result.shift =
        (1.0 + kErrorRounding) * (base->mean().head<3>().norm() + of_base.head<3>().norm());
    result.turn =
        (1.0 + kErrorRounding) * (base->mean().tail<3>().norm() + of_base.tail<3>().norm());
  }
  const double tails = 2.0 * static_cast<double>(varying) * normalTailMass(deviations);
  result.chance = std::min(1.0, (1.0 + kErrorRounding) * tails);
  return result;
}

class IntervalWithErrors {
 public:
  IntervalWithErrors(const RobotAmongObstacles& among, const Eigen::VectorXd& values,
                     const std::optional<PoseError>& base)
      : among_(among),
        values_(values),
        poses_(among.robot().poses(values)),
        turns_about_origin_(base && base->convention() == PoseConvention::world_exponential) {
    const Robot& robot = among.robot();
    if (base) base_ = robot.linkPose(robot.links()[0].name, values).translation();
  }

  /// By no more than this are points of the bodies where they are not expected, metres, by body.
  std::vector<double> reaches(const Within& errors) const {
    const JointStep step{values_, Eigen::VectorXd::Zero(values_.size()), values_.cwiseAbs(),
                         errors.joints};
    std::vector<double> reaches;
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      const Ball& ball = among_.balls()[i];
      double reach = sweepOf(among_.robot(), i, poses_[i], ball, step).reach;
      const Ball around = ball.placed(poses_[i]);
      const Eigen::Vector3d centre = turns_about_origin_ ? Eigen::Vector3d::Zero().eval() : base_;
      const double lever = (around.centre - centre).norm() + around.radius + reach;
      reach += errors.shift + errors.turn * lever;
      reaches.push_back((1.0 + kErrorRounding) * reach);
    }
    return reaches;
  }

  /// Of P that any body touches an obstacle, while no point is farther off than that.
  /// \param largest  the widest band of all that was asked for
  Bounds ofObstacle(std::size_t index, const std::vector<double>& reaches,
                    const ProbabilityRequest& request, double& largest,
                    ProbabilityStatistics& spent) const {
    const Obstacle& obstacle = among_.obstacles()[index];
    const PreparedObstacle& prepared = among_.preparedObstacle(index);
    const ObstacleState state = stateAt(obstacle, 0);
    std::vector<Ball> balls = among_.balls();
    for (std::size_t i = 0; i < balls.size(); ++i) balls[i].radius += reaches[i];
    std::vector<PlacedBody> bodies = among_.placed(index, poses_);
    const double far = leaveOutFar(balls, prepared.around(), state, mostFarOf(request), bodies);
    if (bodies.empty()) return {0.0, far};
    PreparedGeometries geometries;
    std::vector<fcl::Transform3d> poses;
    double width = 0.0;
    for (const PlacedBody& body : bodies) {
      geometries.push_back(among_.geometries()[body.body]);
      poses.push_back(body.pose);
      width = std::max(width, reaches[body.body]);
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
  const Eigen::VectorXd& values_;
  std::vector<fcl::Transform3d> poses_;
  Eigen::Vector3d base_ = Eigen::Vector3d::Zero();
  bool turns_about_origin_;
};

}  // namespace

double upperWithErrors(const RobotAmongObstacles& among, const Eigen::VectorXd& values,
                       const Eigen::MatrixXd& covariance, const std::optional<PoseError>& base,
                       double enough) {
  const double chance = kShareBeyond * std::min(enough, kSmall);
  const LinearErrors errors(among.robot(), among.balls(), values, covariance, base, chance);
  const std::vector<fcl::Transform3d> poses = among.robot().poses(values);
  std::vector<Ball> balls = among.balls();
  for (std::size_t i = 0; i < balls.size(); ++i) {
    balls[i].radius += errors.farthest(i, balls[i].radius);
  }
  double upper = errors.chance();
  for (std::size_t j = 0; j < among.obstacles().size() && upper < enough; ++j) {
    const PreparedObstacle& prepared = among.preparedObstacle(j);
    const ObstacleState state = stateAt(among.obstacles()[j], 0);
    std::vector<PlacedBody> bodies = among.placed(j, poses);
    upper = sumAbove(upper, leaveOutFar(balls, prepared.around(), state, chance, bodies));
    if (bodies.empty()) continue;
    const auto& displacement = std::get<GaussianDisplacement>(state.displacement);
    upper = sumAbove(upper, upperTogether(*among.prepared(), bodies, &errors, prepared, state.pose,
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
  const IntervalWithErrors parts(among, values, base);
  bool cancelled = false;
  const auto tell = [&](ProbabilityProgress progress) {
    progress.interval = known.interval();
    cancelled = cancelled || !request.on_progress(progress);
    return !cancelled;
  };
  std::size_t left = std::size(kDeviations) * among.obstacles().size();
  for (const double deviations : kDeviations) {
    if (result.status != ProbabilityStatus::resolution_limit) break;
    const Within errors = within(deviations, covariance, base);
    const std::vector<double> reaches = parts.reaches(errors);
    std::vector<Bounds> events;
    double width = 0.0;
    for (std::size_t i = 0; i < among.obstacles().size(); ++i, --left) {
      ProbabilityRequest part = request;
      part.threshold.reset();
      if (request.on_progress) part.on_progress = tell;
      budget.share(left, part);
      ProbabilityStatistics spent;
      events.push_back(parts.ofObstacle(i, reaches, part, width, spent));
      budget.spend(spent);
      addStatistics(spent, result.statistics);
    }
    // Given the errors of the robot the obstacles are independent events.
    const Bounds any = anyOfIndependent(events);
    known.narrow({any.lower * (1.0 - errors.chance) * (1.0 - kErrorRounding),
                  std::min(1.0, sumAbove(any.upper, errors.chance))});
    result.plan.push_back("errors of the robot within " + numberText(deviations) +
                          " deviations, but for a chance of " + numberText(errors.chance) +
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
