// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Paths in joint space around a disc, of which the shortest is known in closed form.
#include "fcl_prob/motion_planning.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <thread>

#include "catch.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/robot_query.h"

using namespace fcl_prob;

namespace {

using Waypoints = std::vector<Eigen::VectorXd>;

constexpr double kRadius = 0.8;
constexpr double kPi = 3.14159265358979323846;

Robot arm() { return Robot(std::string(FCL_PROB_SOURCE_DIR) + "/data/arm.urdf"); }

/// The joints turn and elbow are to go around a disc, the others stay.
PlanningRequest discRequest(std::uint64_t seed) {
  PlanningRequest request;
  request.joints = {"turn", "elbow"};
  request.seed = seed;
  return request;
}

Eigen::VectorXd at(const Robot& robot, double turn, double elbow) {
  return robot.values({{"turn", turn}, {"elbow", elbow}, {"bend", 0.3}});
}

class DiscTest {
 public:
  explicit DiscTest(const Robot& robot) {
    for (std::size_t i = 0; i < robot.joints().size(); ++i) {
      if (robot.joints()[i].name == "turn") turn_ = static_cast<Eigen::Index>(i);
      if (robot.joints()[i].name == "elbow") elbow_ = static_cast<Eigen::Index>(i);
    }
  }

  bool isOutside(const Eigen::VectorXd& values) const {
    return std::hypot(values[turn_], values[elbow_]) > kRadius;
  }

  double elbow(const Eigen::VectorXd& values) const { return values[elbow_]; }

 private:
  Eigen::Index turn_ = -1;
  Eigen::Index elbow_ = -1;
};

std::vector<double> numbersOf(const Eigen::VectorXd& values) {
  return {values.data(), values.data() + values.size()};
}

/// From one point to another, both `d` from the middle: two tangents and the arc between them.
/// \param angle  between the points, seen from the middle, on the side of the path
double shortestAround(double d, double angle = kPi) {
  const double tangent = std::sqrt(d * d - kRadius * kRadius);
  const double arc = kRadius * (angle - 2.0 * std::acos(kRadius / d));
  return 2.0 * tangent + arc;
}

}  // namespace

TEST_CASE("every state of a path has been asked for and is allowed") {
  const Robot robot = arm();
  const DiscTest disc(robot);
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u, 5u}) {
    for (const bool shorten : {false, true}) {
      std::set<std::vector<double>> allowed;
      PlanningRequest request = discRequest(seed);
      request.shorten = shorten;
      const auto test = [&](const Eigen::VectorXd& values) {
        if (!disc.isOutside(values)) return false;
        allowed.insert(numbersOf(values));
        return true;
      };
      const Eigen::VectorXd start = at(robot, -1.2, 0.0), goal = at(robot, 1.2, 0.1);
      const PlanningResult result = planMotion(robot, test, start, goal, request);
      REQUIRE(result.status == PlanningStatus::solved);
      CHECK(result.waypoints.front() == start);
      CHECK(result.waypoints.back() == goal);
      CHECK(result.shortened == shorten);
      CHECK(result.states >= allowed.size());
      for (const auto& values : interpolated(result.waypoints, request.largest_step)) {
        CHECK(allowed.count(numbersOf(values)) == 1);
        CHECK(robot.isWithinLimits(values));
        CHECK((values - start).cwiseAbs().minCoeff() == 0.0);  // those that may not move
      }
    }
  }
}

TEST_CASE("a path is shortened to hardly more than the shortest") {
  const Robot robot = arm();
  const DiscTest disc(robot);
  const auto test = [&](const Eigen::VectorXd& values) { return disc.isOutside(values); };
  const Eigen::VectorXd start = at(robot, -1.2, 0.0), goal = at(robot, 1.2, 0.0);
  for (const std::uint64_t seed : {11u, 12u, 13u, 14u}) {
    const PlanningResult result = planMotion(robot, test, start, goal, discRequest(seed));
    REQUIRE(result.status == PlanningStatus::solved);
    CAPTURE(seed, result.planned_length);
    CHECK(result.length == jointLength(result.waypoints));
    CHECK(result.length <= result.planned_length);
    // States are 0.05 apart, so that corners of the disc between them may be cut.
    CHECK(result.length > 0.995 * shortestAround(1.2));
    CHECK(result.length < 1.05 * shortestAround(1.2));
  }
}

TEST_CASE("a straight line is taken where it is allowed") {
  const Robot robot = arm();
  const Eigen::VectorXd start = at(robot, -1.0, -0.5), goal = at(robot, 1.0, 0.5);
  const auto all = [](const Eigen::VectorXd&) { return true; };
  const PlanningResult result = planMotion(robot, all, start, goal);
  REQUIRE(result.status == PlanningStatus::solved);
  CHECK(result.length == Approx((goal - start).norm()).epsilon(1e-12));
  const PlanningResult stays = planMotion(robot, all, start, start);
  CHECK(stays.status == PlanningStatus::solved);
  CHECK(stays.length == 0.0);
  CHECK(stays.waypoints.size() == 2);
}

TEST_CASE("the same seed gives the same path, also beside other plans") {
  const Robot robot = arm();
  const DiscTest disc(robot);
  const auto plan = [&](std::uint64_t seed) {
    return planMotion(
               robot, [&](const Eigen::VectorXd& values) { return disc.isOutside(values); },
               at(robot, -1.2, 0.0), at(robot, 1.2, 0.1), discRequest(seed))
        .waypoints;
  };
  const Waypoints first = plan(7), other = plan(8);
  CHECK(first != other);
  std::vector<Waypoints> again(4);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < again.size(); ++i) {
    threads.emplace_back([&, i] { again[i] = plan(7 + i % 2); });
  }
  for (std::thread& thread : threads) thread.join();
  CHECK(again[0] == first);
  CHECK(again[1] == other);
  CHECK(again[2] == first);
  CHECK(again[3] == other);
}

TEST_CASE("a path passes on the side that is shorter, wherever the first tree went") {
  const Robot robot = arm();
  const DiscTest disc(robot);
  const auto test = [&](const Eigen::VectorXd& values) { return disc.isOutside(values); };
  const double above = 0.4, far = 1.2;
  const double turn = far * std::cos(above), elbow = far * std::sin(above);
  const Eigen::VectorXd start = at(robot, -turn, elbow), goal = at(robot, turn, elbow);
  const double shortest = shortestAround(far, kPi - 2.0 * above);
  int went_far = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    PlanningRequest request = discRequest(seed);
    CHECK(planMotion(robot, test, start, goal, request).length < 1.1 * shortest);
    request.shorten = false;  // the first tree alone
    const Waypoints first = planMotion(robot, test, start, goal, request).waypoints;
    went_far += std::any_of(first.begin(), first.end(),
                            [&](const auto& values) { return disc.elbow(values) < -kRadius; });
  }
  CHECK(went_far > 0);
}

TEST_CASE("a plan ends at its limits, and gives no half of a path") {
  const Robot robot = arm();
  const DiscTest disc(robot);
  const Eigen::VectorXd start = at(robot, -1.2, 0.0), goal = at(robot, 1.2, 0.1);
  std::size_t asked = 0;
  const auto test = [&](const Eigen::VectorXd& values) {
    ++asked;
    return disc.isOutside(values);
  };
  PlanningRequest request = discRequest(1);
  const std::size_t all = planMotion(robot, test, start, goal, request).states;
  request.shorten = false;
  const std::size_t without = planMotion(robot, test, start, goal, request).states;
  REQUIRE(without < all);

  request = discRequest(1);
  request.max_states = without - 1;
  asked = 0;
  PlanningResult result = planMotion(robot, test, start, goal, request);
  CHECK(result.status == PlanningStatus::state_limit);
  CHECK(result.waypoints.empty());
  CHECK(asked == request.max_states);
  CHECK(result.states == asked);

  request.max_states = without + 10;  // ends amidst the first short cuts
  result = planMotion(robot, test, start, goal, request);
  CHECK(result.status == PlanningStatus::solved);
  CHECK_FALSE(result.shortened);
  for (const auto& values : interpolated(result.waypoints, request.largest_step)) {
    CHECK(disc.isOutside(values));
  }

  request = discRequest(1);
  std::vector<PlanningProgress> told;
  request.on_progress = [&](const PlanningProgress& progress) {
    told.push_back(progress);
    return told.size() < 3;
  };
  result = planMotion(robot, test, start, goal, request);
  CHECK(result.status == PlanningStatus::cancelled);
  CHECK(told.size() == 3);
  CHECK(told[1].states > told[0].states);
  request.on_progress = nullptr;
  request.time_limit = 1e-9;
  CHECK(planMotion(robot, test, start, goal, request).status == PlanningStatus::time_limit);
}

TEST_CASE("a plan tells of a start or goal that is not allowed") {
  const Robot robot = arm();
  const DiscTest disc(robot);
  const auto test = [&](const Eigen::VectorXd& values) { return disc.isOutside(values); };
  const Eigen::VectorXd inside = at(robot, 0.1, 0.0), outside = at(robot, 1.2, 0.0);
  CHECK(planMotion(robot, test, inside, outside).status == PlanningStatus::start_refused);
  CHECK(planMotion(robot, test, outside, inside).status == PlanningStatus::goal_refused);
}

TEST_CASE("a planning request is checked") {
  const Robot robot = arm();
  const auto all = [](const Eigen::VectorXd&) { return true; };
  const Eigen::VectorXd start = at(robot, -1.2, 0.0), goal = at(robot, 1.2, 0.1);
  const auto refused = [&](auto change) {
    PlanningRequest request;
    change(request);
    CHECK_THROWS_AS(planMotion(robot, all, start, goal, request), InvalidRequest);
  };
  refused([](PlanningRequest& request) { request.joints = {"knee"}; });
  refused([](PlanningRequest& request) { request.joints = {"turn"}; });
  refused([](PlanningRequest& request) { request.largest_step = 0.0; });
  refused([](PlanningRequest& request) { request.max_states = 0; });
  refused([](PlanningRequest& request) { request.time_limit = -1.0; });
  refused([](PlanningRequest& request) { request.largest_step = 1e-13; });
  CHECK_THROWS_AS(planMotion(robot, all, start, at(robot, 0.0, 2.5)), InvalidRequest);
  CHECK_THROWS_AS(planMotion(robot, all, Eigen::VectorXd::Zero(5), goal), InvalidRequest);
}
