// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Bodies that stay where they are from state to state, and what that tells of the states.
#include "robot/fixed_bodies.h"

#include <fcl/geometry/shape/sphere.h>

#include <cmath>

#include "arm_cases.h"
#include "catch.h"
#include "fcl_prob/robot_query.h"
#include "robot/joint_indices.h"
#include "robot/state_screen.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

constexpr double kThreshold = 0.05;

ProbabilityRequest against(double threshold) {
  ProbabilityRequest request;
  request.threshold = threshold;
  return request;
}

ProbabilityRequest closely() {
  ProbabilityRequest request;
  request.method = ProbabilityMethod::interval;
  request.relative_tolerance = 0.01;
  request.absolute_tolerance = 1e-5;
  return request;
}

/// Balls beside the base of the arm, which has a radius of 0.12 m.
std::vector<Obstacle> ballsBeside(std::mt19937_64& random, int count) {
  const auto between = [&](double lo, double hi) {
    return std::uniform_real_distribution<double>(lo, hi)(random);
  };
  std::vector<Obstacle> balls;
  for (int i = 0; i < count; ++i) {
    const double radius = between(0.04, 0.1), sigma = between(0.01, 0.05);
    const double away = 0.12 + radius + between(1.0, 3.0) * sigma, turned = between(-3.0, 3.0);
    fcl::Transform3d pose = fcl::Transform3d::Identity();
    pose.translation() << away * std::cos(turned), away * std::sin(turned), between(0.0, 0.3);
    balls.push_back({"ball " + std::to_string(i), std::make_shared<fcl::Sphered>(radius), pose,
                     GaussianDisplacement::fromStandardDeviations({sigma, 0.7 * sigma, sigma})});
  }
  return balls;
}

/// All joints but those of turret and shoulder.
std::vector<Eigen::Index> movingJoints(const Robot& robot) {
  std::vector<Eigen::Index> moving;
  for (std::size_t i = 0; i < robot.joints().size(); ++i) {
    const std::string& name = robot.joints()[i].name;
    if (name != "turn" && name != "shoulder") moving.push_back(static_cast<Eigen::Index>(i));
  }
  return moving;
}

/// A state a column, of which only those differ.
Eigen::MatrixXd statesOf(const Robot& robot, std::mt19937_64& random, int count) {
  const Eigen::VectorXd first = randomValues(robot, random);
  Eigen::MatrixXd states = first.replicate(1, count);
  for (int k = 0; k < count; ++k) {
    const Eigen::VectorXd other = randomValues(robot, random);
    for (const Eigen::Index joint : movingJoints(robot)) states(joint, k) = other[joint];
  }
  return states;
}

}  // namespace

TEST_CASE("states are decided rightly by what is known of bodies that stay", "[robot]") {
  const Robot robot = shippedArm();
  std::mt19937_64 random(31);
  int told = 0, below = 0, above = 0;
  for (int i = 0; i < 12; ++i) {
    const std::vector<Obstacle> balls = ballsBeside(random, 1 + i % 3);
    const Eigen::MatrixXd states = statesOf(robot, random, 5);
    const RobotQuery query(robot, balls);
    const auto decided = query.decideStates(states, against(kThreshold));
    ProbabilityRequest on_two = against(kThreshold);
    on_two.threads = 2;
    CHECK(RobotQuery(robot, balls).decideStates(states, on_two) == decided);
    const detail::StateScreen alone(query.among());
    const detail::StateScreen many(query.among(), states.col(0), movingJoints(robot));
    for (Eigen::Index k = 0; k < states.cols(); ++k) {
      const Bounds any = RobotQuery(robot, balls).state(states.col(k), closely()).any;
      const auto decision = decided[static_cast<std::size_t>(k)];
      CAPTURE(i, k, any.lower, any.upper, toString(decision));
      if (any.upper < kThreshold) CHECK(decision == ProbableDecision::certainly_below);
      if (any.lower > kThreshold) CHECK(decision == ProbableDecision::certainly_above);
      CHECK(query.decideStates(states.col(k), against(kThreshold))[0] == decision);
      below += any.upper < kThreshold;
      above += any.lower > kThreshold;
      const auto by_all = many.isBelow(states.col(k), against(kThreshold));
      if (by_all == true) CHECK(any.lower < kThreshold);
      if (by_all == false) CHECK(any.upper > kThreshold);
      told += by_all && !alone.isBelow(states.col(k), against(kThreshold));
    }
  }
  CHECK(told > 8);
  CHECK(below > 8);
  CHECK(above > 8);
}

TEST_CASE("what bodies that stay touch is what they touch by themselves", "[robot]") {
  const Robot robot = shippedArm(), base = shippedArm({"base"});
  std::mt19937_64 random(32);
  for (int i = 0; i < 5; ++i) {
    const std::vector<Obstacle> balls = ballsBeside(random, 2);
    const RobotQuery query(robot, balls), of_base(base, balls);
    const detail::FixedBodies fixed(query.among(), robot.values({}), detail::allJoints(robot));
    CHECK(fixed.areAmong(robot.poses(randomValues(robot, random))));
    const auto known = fixed.bounds(against(kThreshold));
    REQUIRE(known);
    const RobotResult truth = of_base.state(base.values({}), closely());
    for (std::size_t k = 0; k < balls.size(); ++k) {
      CAPTURE(i, k, (*known)[k].lower, (*known)[k].upper, *truth.parts[k].lower);
      CHECK((*known)[k].lower <= *truth.parts[k].upper);
      CHECK((*known)[k].upper >= *truth.parts[k].lower);
      CHECK((*known)[k].width() <= 0.05 * std::max(kThreshold, (*known)[k].upper));
    }
  }
}

TEST_CASE("bodies that moved are not taken for such that stay", "[robot]") {
  const Robot robot = shippedArm();
  std::mt19937_64 random(33);
  const RobotQuery query(robot, ballsBeside(random, 1));
  const Eigen::MatrixXd states = statesOf(robot, random, 2);
  const detail::FixedBodies fixed(query.among(), states.col(0), movingJoints(robot));
  CHECK(fixed.areAmong(robot.poses(states.col(1))));
  CHECK_FALSE(fixed.areAmong(robot.poses(randomValues(robot, random))));
  ProbabilityRequest at_once = against(kThreshold);
  at_once.time_limit = 1e-9;
  CHECK_FALSE(fixed.bounds(at_once).has_value());
  CHECK(fixed.bounds(against(kThreshold)).has_value());
}

TEST_CASE("what is told while bodies that stay are asked bounds the whole state", "[robot]") {
  const Robot robot = shippedArm();
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.translation() << 0.24, 0.0, 0.05;
  const auto error = GaussianDisplacement::fromStandardDeviations({0.03, 0.02, 0.03});
  const RobotQuery query(robot, {{"ball", std::make_shared<fcl::Sphered>(0.08), pose, error},
                                 {"other", std::make_shared<fcl::Sphered>(0.07), pose, error}});
  const detail::FixedBodies fixed(query.among(), robot.values({}), detail::allJoints(robot));
  ProbabilityRequest request = against(kThreshold);
  int told = 0;
  request.on_progress = [&](const ProbabilityProgress& progress) {
    ++told;
    CHECK(progress.interval.upper == 1.0);
    return true;
  };
  CHECK(fixed.bounds(request).has_value());
  CHECK(told > 0);
}
