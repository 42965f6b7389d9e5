// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Obstacles that are elsewhere and less certain at every waypoint, against counting.
#include "arm_motions.h"
#include "fcl_prob/combined_bounds.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/robot_scene.h"
#include "temporary_folder.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

constexpr int kWaypoints = 9;
constexpr int kDraws = 500;

/// A ball that passes above the arm, known the less the later by `growth` at each waypoint.
Obstacle passingBall(double growth) {
  Obstacle ball = ballAndBox()[0];
  for (int k = 0; k < kWaypoints; ++k) {
    const double t = k / (kWaypoints - 1.0), wide = std::pow(growth, k);
    ball.over_time.push_back({at(0.5 + 0.1 * t, 0.45 - 0.6 * t, 0.38 + 0.04 * t),
                              sigma(0.02 * wide, 0.02 * wide, 0.03 * wide)});
  }
  return ball;
}

enum class Drawn { once, at_each };

/// How often any waypoint touches, an error being so many deviations of each, drawn once or anew.
double countedOverTime(const Robot& robot, const std::vector<Eigen::VectorXd>& waypoints,
                       const Obstacle& obstacle, Drawn drawn) {
  std::mt19937_64 random(41);
  std::normal_distribution<double> normal;
  int hits = 0;
  for (int i = 0; i < kDraws; ++i) {
    bool hit = false;
    Eigen::Vector3d z(normal(random), normal(random), normal(random));
    for (std::size_t k = 0; k < waypoints.size(); ++k) {
      if (drawn == Drawn::at_each) z = {normal(random), normal(random), normal(random)};
      const ObstacleState& state = obstacle.over_time[k];
      const auto& error = std::get<GaussianDisplacement>(state.displacement);
      fcl::Transform3d pose = state.pose;
      pose.translation() +=
          error.mean() + error.axes() * error.standardDeviations().cwiseProduct(z);
      if (!hit) hit = touchesAt(robot, robot.poses(waypoints[k]), *obstacle.geometry, pose);
    }
    hits += hit;
  }
  return static_cast<double>(hits) / kDraws;
}

RobotResult ask(const RobotQuery& query, const std::vector<Eigen::VectorXd>& waypoints,
                ErrorsOverTime errors, BetweenWaypoints between = BetweenWaypoints::ignored) {
  const RobotResult result = query.motion(waypoints, errors, withTolerance(0.05), between);
  CHECK(result.status == ProbabilityStatus::converged);
  return result;
}

}  // namespace

TEST_CASE("an obstacle that shifts with a persistent error holds what counting finds") {
  const RobotQuery query(shippedArm(), {passingBall(1.0)});
  const auto waypoints = sweep(query.robot(), kWaypoints);
  const Bounds any = ask(query, waypoints, ErrorsOverTime::persistent).any;
  CHECK(any.lower > 0.01);
  CHECK(any.upper < 0.9);
  const double counted =
      countedOverTime(query.robot(), waypoints, query.obstacles()[0], Drawn::once);
  checkCounted(any, counted, kDraws);

  // A mean that shifts is as good as a pose that does.
  Obstacle by_mean = passingBall(1.0);
  for (ObstacleState& state : by_mean.over_time) {
    const Eigen::Vector3d off = state.pose.translation() - by_mean.pose.translation();
    state.pose = by_mean.pose;
    state.displacement = std::get<GaussianDisplacement>(state.displacement).withMean(off);
  }
  const RobotQuery other(shippedArm(), {by_mean});
  CHECK(overlap(any, ask(other, waypoints, ErrorsOverTime::persistent).any));
}

TEST_CASE("an obstacle and a robot both move in continuous time", "[slow]") {
  const RobotQuery query(shippedArm(), {passingBall(1.0)});
  const auto waypoints = sweep(query.robot(), kWaypoints);
  const Bounds all = ask(query, waypoints, ErrorsOverTime::persistent, BetweenWaypoints::swept).any;
  Obstacle fine = passingBall(1.0);
  std::vector<ObstacleState> states;
  std::vector<Eigen::VectorXd> values;
  constexpr int kBetween = 12;
  for (int k = 0; k + 1 < kWaypoints; ++k) {
    for (int j = 0; j < kBetween; ++j) {
      const double t = j / static_cast<double>(kBetween);
      const auto i = static_cast<std::size_t>(k);
      values.push_back((1.0 - t) * waypoints[i] + t * waypoints[i + 1]);
      states.push_back(fine.over_time[i]);
      states.back().pose.translation() = (1.0 - t) * fine.over_time[i].pose.translation() +
                                         t * fine.over_time[i + 1].pose.translation();
    }
  }
  fine.over_time = states;
  const RobotQuery finely(shippedArm(), {fine});
  const Bounds many = ask(finely, values, ErrorsOverTime::persistent).any;
  CAPTURE(all.lower, all.upper, many.lower, many.upper);
  CHECK(many.lower <= all.upper);
  CHECK(all.lower <= 1.01 * many.upper);
  CHECK(ask(query, waypoints, ErrorsOverTime::persistent).any.lower <= all.upper);
  checkCounted({all.lower, all.upper},
               countedOverTime(query.robot(), values, finely.obstacles()[0], Drawn::once), kDraws);
}

TEST_CASE("with a growing covariance waypoints are asked by themselves") {
  const RobotQuery query(shippedArm(), {passingBall(1.15)});
  const Obstacle& ball = query.obstacles()[0];
  const auto waypoints = sweep(query.robot(), kWaypoints);
  const RobotResult fresh = ask(query, waypoints, ErrorsOverTime::independent);
  const double anew = countedOverTime(query.robot(), waypoints, ball, Drawn::at_each);
  checkCounted(fresh.any, anew, kDraws);
  REQUIRE(fresh.by_waypoint.size() == waypoints.size());
  REQUIRE(fresh.any_dependence);

  const RobotResult any = ask(query, waypoints, ErrorsOverTime::any_dependence);
  REQUIRE(any.any_dependence);
  CHECK(any.any.lower == any.any_dependence->lower);
  CHECK(any.any.upper == any.any_dependence->upper);
  CHECK(overlap(any.any, fresh.any));
  checkCounted(any.any, anew, kDraws);
  // One error for all times, so many deviations of each.
  checkCounted(any.any, countedOverTime(query.robot(), waypoints, ball, Drawn::once), kDraws);
  double worst = 0.0, sum = 0.0;
  for (std::size_t k = 0; k < waypoints.size(); ++k) {
    Obstacle still = ball;
    still.pose = ball.over_time[k].pose;
    still.displacement = ball.over_time[k].displacement;
    still.over_time.clear();
    const RobotQuery one(shippedArm(), {still});
    const Bounds state = one.state(waypoints[k], withTolerance(0.03)).any;
    CHECK(overlap(state, any.by_waypoint[k]));
    worst = std::max(worst, state.lower);
    sum += state.upper;
  }
  CHECK(any.any.upper >= worst);
  CHECK(any.any.lower <= sum);
  CHECK(any.any.lower >= 0.9 * worst);
  CHECK(any.any.upper <= 1.1 * sum);

  ProbabilityRequest request = withTolerance(0.03);
  request.threshold = 0.5 * any.any.lower;
  const RobotResult above = query.motion(waypoints, ErrorsOverTime::any_dependence, request);
  CHECK(above.decision == Decision::above);
  CHECK(above.status == ProbabilityStatus::decided);
  request.threshold = std::min(1.0, 1.2 * any.any.upper);
  const RobotResult below = query.motion(waypoints, ErrorsOverTime::any_dependence, request);
  CHECK(below.decision == Decision::below);
}

TEST_CASE("what an obstacle over time cannot mean is refused") {
  const Robot arm = shippedArm();
  const auto waypoints = sweep(arm, kWaypoints);
  const RobotQuery growing(arm, {passingBall(1.1)});
  CHECK_THROWS_AS(ask(growing, waypoints, ErrorsOverTime::persistent), InvalidRequest);
  CHECK_THROWS_AS(ask(growing, waypoints, ErrorsOverTime::persistent, BetweenWaypoints::swept),
                  InvalidRequest);
  CHECK_THROWS_AS(growing.state(waypoints[0], {}), InvalidRequest);
  ProbabilityRequest estimate;
  estimate.method = ProbabilityMethod::estimate;
  CHECK_THROWS_AS(growing.motion(waypoints, ErrorsOverTime::any_dependence, estimate),
                  InvalidRequest);
  Obstacle turning = passingBall(1.0);
  turning.over_time[3].pose.rotate(Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX()));
  const RobotQuery turns(arm, {turning});
  CHECK_THROWS_AS(ask(turns, waypoints, ErrorsOverTime::persistent), InvalidRequest);
  CHECK_NOTHROW(ask(turns, waypoints, ErrorsOverTime::independent));
  turning.over_time[3].pose.linear() *= 2.0;
  CHECK_THROWS_AS(RobotQuery(arm, {turning}), InvalidPose);
}

TEST_CASE("scenes have obstacles over time, and states between their waypoints") {
  const TemporaryFolder folder;
  const std::string good =
      R"({"robot": {"urdf": ")" + shippedFile("arm.urdf") +
      R"("}, "waypoints": [{"turn": 0}, {"turn": 0.5}], "largest_step": 0.2,)"
      R"( "errors": "any-dependence", "obstacles": [{"name": "o", "sphere": 0.1,)"
      R"( "pose": [0.5, 0.2, 0.3], "displacement": {"sigma": [0.1, 0.1, 0.1]},)"
      R"( "over_time": [{}, {"pose": [0.5, 0.5, 0.3],)"
      R"( "displacement": {"sigma": [0.3, 0.1, 0.1]}}]}]})";
  const RobotScene scene = loadRobotScene(folder.write("good.json", good));
  CHECK(scene.errors == ErrorsOverTime::any_dependence);
  const RobotQuery query = loadRobotQuery(scene);
  CHECK(waypointsOf(scene, query.robot()).size() == 4);
  const auto& states = query.obstacles()[0].over_time;
  REQUIRE(states.size() == 4);
  CHECK(states[0].pose.translation().isApprox(Eigen::Vector3d(0.5, 0.2, 0.3)));
  CHECK(states[1].pose.translation().isApprox(Eigen::Vector3d(0.5, 0.3, 0.3)));
  CHECK(states[3].pose.translation().isApprox(Eigen::Vector3d(0.5, 0.5, 0.3)));
  const auto& error = std::get<GaussianDisplacement>(states[2].displacement);
  CHECK(error.covariance()(0, 0) == Approx(0.01 + 2.0 / 3.0 * 0.08));
  CHECK(error.covariance()(1, 1) == Approx(0.01));
  RobotScene other = scene;  // as with another motion in place of its own
  other.waypoints.resize(7, scene.waypoints[0]);
  CHECK_THROWS_AS(loadRobotQuery(other), InvalidRequest);
  other.waypoints.resize(1);
  CHECK_THROWS_AS(loadRobotQuery(other), InvalidRequest);
  const auto refused = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    CAPTURE(text);
    CHECK_THROWS_AS(loadRobotScene(folder.write("bad.json", text)), FileError);
  };
  refused("[{}, {\"pose\"", "[{\"pose\"");
  refused("{}, {\"pose\": [0.5, 0.5, 0.3]", "{}, {\"pose\": [0.5, 0.5]");
  refused("{}, {\"pose\"", "{}, {\"place\"");
  refused("any-dependence", "any");
}

TEST_CASE("an error stays the same between waypoints, and is persistent there, too") {
  const TemporaryFolder folder;
  const std::string text =
      R"({"robot": {"urdf": ")" + shippedFile("arm.urdf") +
      R"("}, "waypoints": [{"turn": 0}, {"turn": 0.5}], "largest_step": 0.17,)"
      R"( "obstacles": [{"name": "o", "sphere": 0.1, "pose": [0.5, 0.2, 0.3, 0.8, 0.1, 0.2, 0.5],)"
      R"( "displacement": {"sigma": [0.02, 0.03, 0.07]},)"
      R"( "over_time": [{}, {"pose": [0.5, 0.5, 0.3, 0.8, 0.1, 0.2, 0.5]}]}]})";
  const RobotScene scene = loadRobotScene(folder.write("scene.json", text));
  const RobotQuery query = loadRobotQuery(scene);
  const auto waypoints = waypointsOf(scene, query.robot());
  CHECK(waypoints.size() == 4);
  CHECK_NOTHROW(ask(query, waypoints, ErrorsOverTime::persistent));
}
