// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Continuous time where numbers are so large that sums of them round, and bodies that do not count.
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/sphere.h>

#include <cmath>

#include "arm_motions.h"
#include "fcl_prob/exceptions.h"
#include "temporary_folder.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

/// A ball of 0.1 m on a slider along x.
Robot slider(const std::string& joint = "<axis xyz=\"1 0 0\"/>") {
  const TemporaryFolder folder;
  RobotOptions options;
  options.allow_outside_limits = true;
  return Robot(
      folder.write(
          "slider.urdf",
          "<robot name=\"r\"><link name=\"root\"/><link name=\"ball\"><collision><geometry>"
          "<sphere radius=\"0.1\"/></geometry></collision></link><joint name=\"x\" "
          "type=\"prismatic\">"
          "<parent link=\"root\"/><child link=\"ball\"/>" +
              joint +
              "<limit lower=\"-1e300\" upper=\"1e300\" effort=\"1\" "
              "velocity=\"1\"/></joint></robot>"),
      options);
}

std::vector<Eigen::VectorXd> valuesOf(const std::vector<double>& values) {
  std::vector<Eigen::VectorXd> waypoints;
  for (const double value : values) waypoints.push_back(Eigen::VectorXd::Constant(1, value));
  return waypoints;
}

Obstacle ballAt(double x, double deviation) {
  return {"ball", std::make_shared<fcl::Sphered>(0.1), at(x, 0, 0),
          sigma(deviation, deviation, deviation)};
}

RobotResult sweptAnswer(const RobotQuery& query, const std::vector<Eigen::VectorXd>& waypoints) {
  ProbabilityRequest request = withTolerance(1e-3);
  // What rounding leaves open is not worth more of them.
  request.max_cells = 2'000;
  return query.motion(waypoints, ErrorsOverTime::persistent, request, BetweenWaypoints::swept);
}

}  // namespace

TEST_CASE("a slider that comes from afar passes through what is on its way") {
  const Robot robot = slider();
  for (const double far : {1e3, 1e8, 1e15, 1e17, 1e100}) {
    const RobotResult result =
        sweptAnswer(RobotQuery(robot, {ballAt(1.0, 0.01)}), valuesOf({-far, far}));
    CAPTURE(far, toString(result.status));
    CHECK(result.any.upper == 1.0);
    if (far <= 1e8) CHECK(result.any.lower > 0.99);
  }
}

TEST_CASE("a slider that comes from afar is at its last waypoint, too", "[slow]") {
  const Robot robot = slider();
  for (const double from : {-1e3, -1e8, -1e10, -1e16, 1e16}) {
    for (const double deviation : {1e-5, 1e-3, 0.1}) {
      const RobotQuery query(robot, {ballAt(0.2 + 3.0 * deviation, deviation)});
      const Bounds last = query.state(Eigen::VectorXd::Zero(1), withTolerance(1e-6)).any;
      const RobotResult result = sweptAnswer(query, valuesOf({from, 0.0}));
      CAPTURE(from, deviation, last.lower, result.any.upper);
      CHECK(last.lower > 1e-4);
      CHECK(result.any.upper >= last.lower);
    }
  }
}

TEST_CASE("an obstacle that comes from afar is where it is in between, too", "[slow]") {
  const Robot robot = slider();
  for (const double far : {1e3, 1e7, 1e12}) {
    for (const double deviation : {1e-6, 1e-3}) {
      Obstacle obstacle = ballAt(0.0, deviation);
      for (const double x : {0.5, far, 0.2 + 3.0 * deviation}) {
        obstacle.over_time.push_back({at(x, 0, 0), sigma(deviation, deviation, deviation)});
      }
      const RobotQuery last(robot, {ballAt(0.2 + 3.0 * deviation, deviation)});
      const Bounds known = last.state(Eigen::VectorXd::Zero(1), withTolerance(1e-6)).any;
      const RobotResult result =
          sweptAnswer(RobotQuery(robot, {obstacle}), valuesOf({0.0, 0.0, 0.0}));
      CAPTURE(far, deviation, known.lower, result.any.upper);
      CHECK(known.lower > 1e-4);
      CHECK(result.any.upper >= known.lower);
    }
  }
}

TEST_CASE("places that are not finite are refused, not free of contact") {
  CHECK_THROWS_AS(slider("<axis xyz=\"1e200 0 0\"/>"), FileError);
  CHECK_THROWS_AS(slider("<axis xyz=\"1e160 1e160 0\"/>"), FileError);
  const std::string other =
      "<limit lower=\"0\" upper=\"1\" effort=\"1\" velocity=\"1\"/></joint>"
      "<link name=\"end\"><collision><geometry><sphere radius=\"0.1\"/></geometry></collision>"
      "</link><joint name=\"y\" type=\"prismatic\"><parent link=\"ball\"/><child link=\"end\"/>"
      "<mimic joint=\"x\"/><axis xyz=\"1 0 0\"/>";
  const Robot robot = slider("<axis xyz=\"1 0 0\"/>" + other);
  const Eigen::VectorXd huge = Eigen::VectorXd::Constant(1, 1.5e308);
  CHECK_THROWS_AS(robot.poses(huge), InvalidPose);
  CHECK_THROWS_AS(robot.linkPose("end", huge), InvalidPose);
  CHECK_NOTHROW(robot.poses(Eigen::VectorXd::Zero(1)));
  const RobotQuery query(robot, {ballAt(0.0, 0.1)});
  CHECK_THROWS_AS(query.state(huge, {}), InvalidPose);
  CHECK_THROWS_AS(sweptAnswer(query, {huge, huge}), InvalidPose);
}

TEST_CASE("bodies that are not occupied count in no answer") {
  const Robot robot = slider();
  const auto free = std::make_shared<fcl::Sphered>(0.1);
  free->cost_density = 0.0;
  const Robot holding = robot.withAttached({"free", "ball", free, at(1.0, 0, 0), {}});
  const auto solid = std::make_shared<fcl::Sphered>(0.1);
  const Robot holding_solid = robot.withAttached({"solid", "ball", solid, at(1.0, 0, 0), {}});
  const std::vector<Obstacle> beside{ballAt(1.1, 0.02)};
  const auto waypoints = valuesOf({0.0, 0.05});
  for (const Robot* one : {&holding, &holding_solid}) {
    const RobotQuery query(*one, beside);
    const bool counts = one == &holding_solid;
    CAPTURE(counts);
    const auto is = [&](const Bounds& any) {
      CHECK((counts ? any.lower > 0.9 : any.upper < 1e-9));
    };
    is(query.state(waypoints[0], {}).any);
    is(query.motion(waypoints, ErrorsOverTime::persistent, {}).any);
    is(sweptAnswer(query, waypoints).any);
    const ProbableDecision decision = query.decideProbably(waypoints, 0.5, 1e-3, {}).decision;
    CHECK((decision == ProbableDecision::probably_above ||
           decision == ProbableDecision::certainly_above) == counts);
  }
}

TEST_CASE("what has no pieces is decided for certain") {
  const Robot holding =
      slider().withAttached({"wall",
                             "ball",
                             std::make_shared<fcl::Halfspaced>(Eigen::Vector3d(0, 0, 1), 0.0),
                             at(0, 0, -0.5),
                             {}});
  const RobotQuery query(holding, {ballAt(0.0, 0.01)});
  const ProbableResult result = query.decideProbably(valuesOf({5.0}), 0.5, 1e-3, {});
  CHECK(result.decision == ProbableDecision::certainly_below);
}
