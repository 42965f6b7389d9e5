// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What a robot query tells when its limits are too tight for what was asked, and before that.
#include "arm_motions.h"
#include "robot/body_sweep.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

std::vector<Obstacle> nearAndFar() {
  std::vector<Obstacle> obstacles = ballAndBox();
  for (const double x : {0.95, 1.05}) {
    obstacles.push_back(
        {"far", std::make_shared<fcl::Sphered>(0.1), at(x, 0.1, 0.3), sigma(0.05, 0.06, 0.04)});
  }
  return obstacles;
}

std::size_t cellsOf(const RobotResult& result) {
  std::size_t cells = 0;
  for (const ProbabilityResult& part : result.parts) cells += part.statistics.cells;
  return cells;
}

Bounds boundsOf(const ProbabilityResult& part) {
  return {part.lower.value_or(0.0), part.upper.value_or(1.0)};
}

}  // namespace

TEST_CASE("obstacles in any order are all told about, within cells that are too few") {
  std::vector<Obstacle> obstacles = nearAndFar();
  const Robot arm = shippedArm();
  const Eigen::VectorXd values = arm.values({{"turn", 0.4}, {"shoulder", 0.1}, {"elbow", 0.35}});
  const ProbabilityRequest fine = withTolerance(1e-3);
  const RobotResult known = RobotQuery(arm, obstacles).state(values, fine);
  for (const std::size_t cells : {200, 1'000, 5'000}) {
    std::vector<double> widths;
    for (int turn = 0; turn < 4; ++turn) {
      ProbabilityRequest request = withTolerance(1e-5);
      request.max_cells = cells;
      const RobotResult result = RobotQuery(arm, obstacles).state(values, request);
      CAPTURE(cells, turn, result.any.lower, result.any.upper, toString(result.status));
      CHECK(result.status == ProbabilityStatus::cell_limit);
      CHECK(overlap(result.any, known.any));
      CHECK(cellsOf(result) <= 2 * cells);
      for (const ProbabilityResult& part : result.parts) CHECK(boundsOf(part).width() < 0.9);
      widths.push_back(result.any.width());
      std::rotate(obstacles.begin(), obstacles.begin() + 1, obstacles.end());
    }
    CHECK(*std::max_element(widths.begin(), widths.end()) <=
          2.0 * *std::min_element(widths.begin(), widths.end()));
  }
}

TEST_CASE("independent waypoints are all told about, within cells that are too few") {
  const RobotQuery query(shippedArm(), ballAndBox());
  const auto waypoints = sweep(query.robot(), 12);
  const RobotResult known =
      query.motion(waypoints, ErrorsOverTime::independent, withTolerance(0.02));
  for (const ErrorsOverTime errors :
       {ErrorsOverTime::independent, ErrorsOverTime::any_dependence}) {
    ProbabilityRequest request = withTolerance(1e-5);
    request.max_cells = 1'000;
    const RobotResult few = query.motion(waypoints, errors, request);
    // Where bodies touch one at a time their masses are known without cells.
    const bool is_known = few.any.width() <= 1e-5 * few.any.upper;
    CHECK(few.status == (is_known ? ProbabilityStatus::converged : ProbabilityStatus::cell_limit));
    REQUIRE(few.by_waypoint.size() == known.by_waypoint.size());
    for (std::size_t k = 0; k < waypoints.size(); ++k) {
      CAPTURE(k, few.by_waypoint[k].lower, few.by_waypoint[k].upper);
      CHECK(overlap(few.by_waypoint[k], known.by_waypoint[k]));
      CHECK(few.by_waypoint[k].width() < 0.9);
    }
  }
}

TEST_CASE("with several obstacles only a decision or a limit answers a threshold") {
  const RobotQuery query(shippedArm(), ballAndBox());
  const Eigen::VectorXd values =
      query.robot().values({{"turn", 0.1}, {"shoulder", 0.1}, {"elbow", 0.35}});
  const Bounds known = query.state(values, withTolerance(1e-4)).any;
  REQUIRE(known.lower > 1e-6);
  for (const double factor : {0.9, 0.99, 1.01, 1.1}) {
    ProbabilityRequest request = withTolerance(0.2);
    request.threshold = factor * known.middle();
    const RobotResult result = query.state(values, request);
    CAPTURE(factor, known.lower, known.upper, result.any.lower, result.any.upper);
    CHECK(result.status == ProbabilityStatus::decided);
    CHECK(result.decision == (factor < 1.0 ? Decision::above : Decision::below));
  }
}

TEST_CASE("progress of several obstacles is that of all, certified and never wider") {
  const RobotQuery query(shippedArm(), nearAndFar());
  const Eigen::VectorXd values =
      query.robot().values({{"turn", 0.4}, {"shoulder", 0.1}, {"elbow", 0.35}});
  const Bounds known = query.state(values, withTolerance(1e-3)).any;
  ProbabilityRequest request = withTolerance(0.01);
  std::vector<Bounds> told;
  request.on_progress = [&](const ProbabilityProgress& progress) {
    told.push_back(progress.interval);
    return true;
  };
  query.state(values, request);
  REQUIRE(told.size() > 3);
  for (const Bounds& now : told) CHECK(overlap(now, known));
  CHECK(told.back().width() < told.front().width());
  std::size_t calls = 0;
  request.on_progress = [&](const ProbabilityProgress&) { return ++calls < 3; };
  CHECK(query.state(values, request).status == ProbabilityStatus::cancelled);
  CHECK(calls == 3);
}

TEST_CASE("continuous time is at least as likely as its waypoints, whatever the limits") {
  std::vector<Obstacle> obstacles = ballAndBox();
  obstacles.pop_back();
  const RobotQuery query(shippedArm(), obstacles);
  for (const int count : {2, 5}) {
    const auto waypoints = sweep(query.robot(), count);
    const RobotResult at_waypoints =
        query.motion(waypoints, ErrorsOverTime::persistent, withTolerance(0.02));
    for (const std::size_t memory : {std::size_t{50'000}, std::size_t{4'000'000}}) {
      ProbabilityRequest request = withTolerance(1e-3);
      request.max_memory = memory;
      request.max_cells = 20'000;
      const RobotResult all =
          query.motion(waypoints, ErrorsOverTime::persistent, request, BetweenWaypoints::swept);
      CAPTURE(count, memory, all.any.lower, all.any.upper, at_waypoints.any.lower);
      CHECK(all.any.upper >= at_waypoints.any.lower);
      // They are asked for to a tenth first.
      if (memory > 1'000'000) CHECK(all.any.lower >= 0.85 * at_waypoints.any.lower);
      CHECK((all.status == ProbabilityStatus::memory_limit ||
             all.status == ProbabilityStatus::cell_limit));
    }
  }
}

TEST_CASE("many waypoints have bounds long before each of them was looked at") {
  const RobotQuery query(shippedArm(), ballAndBox());
  const auto many = sweep(query.robot(), 401);
  std::vector<Eigen::VectorXd> some;
  for (std::size_t k = 0; k < many.size(); k += 20) some.push_back(many[k]);
  const RobotResult of_some = query.motion(some, ErrorsOverTime::persistent, withTolerance(0.02));
  for (const std::size_t cells : {3'000, 2'000'000}) {
    ProbabilityRequest request = withTolerance(0.05);
    request.max_cells = cells;
    const RobotResult all = query.motion(many, ErrorsOverTime::persistent, request);
    CAPTURE(cells, all.any.lower, all.any.upper, of_some.any.lower, of_some.any.upper,
            toString(all.status));
    CHECK(all.any.upper >= of_some.any.lower);
    CHECK(all.any.width() < 0.9);
    CHECK(!all.swept_band);
    if (cells < 10'000) continue;
    CHECK(all.status == ProbabilityStatus::converged);
    CHECK(all.any.width() <= 0.05 * all.any.upper);
    CHECK(all.any.upper >= of_some.any.lower);
    constexpr int kDraws = 200;
    checkCounted(all.any, counted(query, many, kDraws, 41), kDraws);
  }
}

TEST_CASE("no point of a body leaves what its sweep says of joints that are off the line") {
  const Robot arm = shippedArm();
  std::mt19937_64 random(23);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  double closest = 0.0;
  for (int i = 0; i < 300; ++i) {
    const double size = std::pow(10.0, -3.0 * std::fabs(uniform(random)));
    detail::JointStep step{
        randomValues(arm, random), Eigen::VectorXd::Zero(6), {}, Eigen::VectorXd::Zero(6)};
    for (int k = 0; k < 6; ++k) {
      step.half[k] = i % 5 == 0 ? 0.0 : size * uniform(random);
      step.off[k] = i % 3 == 0 ? 0.0 : size * std::fabs(uniform(random));
    }
    step.sizes = step.middle.cwiseAbs();
    const auto body = static_cast<std::size_t>(i) % arm.bodies().size();
    const detail::Ball ball{Eigen::Vector3d(0.01, -0.02, 0.03), 0.2};
    const fcl::Transform3d middle = arm.poses(step.middle)[body];
    const detail::BodySweep swept = detail::sweepOf(arm, body, middle, ball, step);
    for (int j = 0; j < 40; ++j) {
      const Eigen::Vector3d direction(uniform(random), uniform(random), uniform(random));
      const Eigen::Vector3d point = ball.centre + 0.2 * direction / std::max(1.0, direction.norm());
      const double s = j < 2 ? 2.0 * j - 1.0 : uniform(random);
      Eigen::VectorXd values = step.middle + s * step.half;
      for (int k = 0; k < 6; ++k) {
        values[k] += step.off[k] * (j % 2 == 0 ? uniform(random) : (random() % 2 ? 1.0 : -1.0));
      }
      const Eigen::Vector3d x = middle * point;
      const Eigen::Vector3d moved = arm.poses(values)[body] * point - x;
      if (swept.reach == 0.0) {
        CHECK(moved.norm() == 0.0);
        continue;
      }
      const Eigen::Vector3d linear =
          swept.motion.shifts[0] + swept.motion.turns[0].cross(x - swept.motion.centre);
      CHECK(moved.norm() <= swept.reach);
      CHECK((moved - s * linear).norm() <= swept.motion.ball);
      closest = std::max(closest, (moved - s * linear).norm() / swept.motion.ball);
    }
  }
  CHECK(closest > 0.3);
}
