// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "planning/joint_space.h"

#include <ompl/base/MotionValidator.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/number_text.h"
#include "fcl_prob/exceptions.h"
#include "planning/moving_joints.h"
#include "robot/joint_indices.h"

namespace fcl_prob::detail {
namespace {

namespace ob = ompl::base;

constexpr double kHalfTurn = 3.14159265358979323846;

/// From 0 to a limit of a joint.
constexpr double kMostSteps = 1e12;

/// Draws in an ellipsoid until one is within the limits of the joints, before it takes any.
constexpr int kMostDraws = 1000;

/// Where paths from one point to another pass that are no longer than a length: an ellipsoid with
/// the two as foci. (OMPL's own, ProlateHyperspheroid, crashes in Debian's package.)
struct ShortPaths {
  Eigen::VectorXd middle;
  Eigen::VectorXd axis;  ///< unit
  double along;          ///< half the length of the ellipsoid
  double across;         ///< half its width
};

/// OMPL seeds the generators of a process one after the other; this one depends on its own seed.
class SeededSampler : public ob::RealVectorStateSampler {
 public:
  /// \param within  not set: all values within the limits are drawn from
  SeededSampler(const ob::StateSpace* space, std::uint64_t seed,
                std::optional<ShortPaths> within = std::nullopt)
      : ob::RealVectorStateSampler(space), within_(std::move(within)) {
    rng_.setLocalSeed(static_cast<std::uint_fast32_t>(seed));
  }

  void sampleUniform(ob::State* state) override {
    double* values = state->as<ob::RealVectorStateSpace::StateType>()->values;
    for (int draw = 0; within_ && draw < kMostDraws; ++draw) {
      const Eigen::VectorXd point = drawWithin(*within_);
      std::copy(point.begin(), point.end(), values);
      if (space_->satisfiesBounds(state)) return;
    }
    ob::RealVectorStateSampler::sampleUniform(state);
  }

 private:
  Eigen::VectorXd drawWithin(const ShortPaths& paths) {
    Eigen::VectorXd ball(paths.middle.size());
    for (double& x : ball) x = rng_.gaussian01();
    ball *= std::pow(rng_.uniform01(), 1.0 / static_cast<double>(ball.size())) / ball.norm();
    return paths.middle + paths.across * ball +
           (paths.along - paths.across) * paths.axis.dot(ball) * paths.axis;
  }

  std::optional<ShortPaths> within_;
};

class EdgeTest : public ob::MotionValidator {
 public:
  EdgeTest(const ob::SpaceInformationPtr& information, const JointSpace& space, PlanningRun& run)
      : ob::MotionValidator(information), space_(space), run_(run) {}

  bool checkMotion(const ob::State* from, const ob::State* to) const override {
    return run_.isMotionAllowed(space_.valuesOf(from), space_.valuesOf(to));
  }

  // How far an edge is allowed is asked by none of the planners used here.
  bool checkMotion(const ob::State* from, const ob::State* to,
                   std::pair<ob::State*, double>& last_valid) const override {
    const bool allowed = checkMotion(from, to);
    last_valid.second = allowed ? 1.0 : 0.0;
    if (last_valid.first != nullptr) si_->copyState(last_valid.first, allowed ? to : from);
    return allowed;
  }

 private:
  const JointSpace& space_;
  PlanningRun& run_;
};

void requireWithinLimits(const Robot& robot, const Eigen::VectorXd& values,
                         const std::string& what) {
  if (robot.isWithinLimits(values)) return;
  for (std::size_t i = 0; i < robot.joints().size(); ++i) {
    const RobotJoint& joint = robot.joints()[i];
    const double value = values[static_cast<Eigen::Index>(i)];
    if (value >= joint.lower && value <= joint.upper) continue;
    const std::string unit = joint.turns ? " rad" : " m";
    throw InvalidRequest(what + ": joint " + joint.name + " is " + numberText(value) + unit +
                         ", beyond its limits " + numberText(joint.lower) + " to " +
                         numberText(joint.upper) + unit);
  }
}

/// Doubles have to tell the states of an edge apart, and the square of its length has to be one.
void requireSteps(const RobotJoint& joint, double low, double high, double step) {
  const double largest = std::max(std::abs(low), std::abs(high));
  if (largest < kMostSteps * step) return;
  throw InvalidRequest("joint " + joint.name + ": values between " + numberText(low) + " and " +
                       numberText(high) + " are too far from 0 for steps of " + numberText(step));
}

}  // namespace

std::pair<double, double> sampledRange(const RobotJoint& joint, double start, double goal,
                                       double largest_step) {
  const auto [low, high] = std::minmax(start, goal);
  const std::pair<double, double> range{
      std::isfinite(joint.lower) ? joint.lower : low - kHalfTurn,
      std::isfinite(joint.upper) ? joint.upper : high + kHalfTurn};
  requireSteps(joint, range.first, range.second, largest_step);
  return range;
}

void requireReachable(const Robot& robot, const Eigen::VectorXd& start, const Eigen::VectorXd& goal,
                      const std::vector<std::string>& names) {
  requireWithinLimits(robot, start, "start");
  requireWithinLimits(robot, goal, "goal");
  const auto& joints = robot.joints();
  for (const std::string& name : names) jointIndex(robot, name);
  const std::vector<Eigen::Index> moving = movingJoints(robot, names);
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const auto index = static_cast<Eigen::Index>(i);
    const bool moves = std::binary_search(moving.begin(), moving.end(), index);
    if (!moves && start[index] != goal[index]) {
      throw InvalidRequest("joint " + joints[i].name + " may not move, but is " +
                           numberText(start[index]) + " at the start and " +
                           numberText(goal[index]) + " at the goal");
    }
  }
}

JointSpace::JointSpace(const Robot& robot, const Eigen::VectorXd& start,
                       const Eigen::VectorXd& goal, PlanningRun& run)
    : request_(run.request()), start_(start), goal_(goal) {
  requireReachable(robot, start, goal, request_.joints);
  indices_ = movingJoints(robot, request_.joints);
  const ob::StateSpacePtr space = makeSpace(robot);
  information_ = std::make_shared<ob::SpaceInformation>(space);
  information_->setStateValidityChecker(
      [this, &run](const ob::State* state) { return run.isAllowed(valuesOf(state)); });
  information_->setMotionValidator(std::make_shared<EdgeTest>(information_, *this, run));
  information_->setup();
}

ob::StateSpacePtr JointSpace::makeSpace(const Robot& robot) const {
  ob::RealVectorBounds bounds(static_cast<unsigned>(dimension()));
  for (std::size_t i = 0; i < dimension(); ++i) {
    const Eigen::Index index = indices_[i];
    const RobotJoint& joint = robot.joints()[static_cast<std::size_t>(index)];
    const auto at = static_cast<unsigned>(i);
    const auto [low, high] =
        sampledRange(joint, start_[index], goal_[index], request_.largest_step);
    bounds.setLow(at, low);
    bounds.setHigh(at, high);
  }
  auto space = std::make_shared<ob::RealVectorStateSpace>(static_cast<unsigned>(dimension()));
  space->setBounds(bounds);
  space->setStateSamplerAllocator([seed = request_.seed](const ob::StateSpace* of) {
    return std::make_shared<SeededSampler>(of, seed);
  });
  return space;
}

void JointSpace::drawWithin(double longest, std::uint64_t seed) {
  const Eigen::VectorXd from = moving(start_), to = moving(goal_);
  const double straight = (to - from).norm();
  const double across = std::sqrt(std::max(0.0, longest * longest - straight * straight));
  const ShortPaths paths{0.5 * (from + to), (to - from) / straight, 0.5 * longest, 0.5 * across};
  information_->getStateSpace()->setStateSamplerAllocator([seed, paths](const ob::StateSpace* of) {
    return std::make_shared<SeededSampler>(of, seed, paths);
  });
}

Eigen::VectorXd JointSpace::valuesOf(const ob::State* state) const {
  const double* numbers = state->as<ob::RealVectorStateSpace::StateType>()->values;
  Eigen::VectorXd values = start_;
  for (std::size_t i = 0; i < dimension(); ++i) values[indices_[i]] = numbers[i];
  return values;
}

void JointSpace::write(const Eigen::VectorXd& values, ob::State* state) const {
  double* numbers = state->as<ob::RealVectorStateSpace::StateType>()->values;
  for (std::size_t i = 0; i < dimension(); ++i) numbers[i] = values[indices_[i]];
}

std::vector<Eigen::VectorXd> JointSpace::waypointsOf(
    const ompl::geometric::PathGeometric& path) const {
  std::vector<Eigen::VectorXd> waypoints;
  for (std::size_t i = 0; i < path.getStateCount(); ++i) {
    waypoints.push_back(valuesOf(path.getState(static_cast<unsigned>(i))));
  }
  return waypoints;
}

}  // namespace fcl_prob::detail
