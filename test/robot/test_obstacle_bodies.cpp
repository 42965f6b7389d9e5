// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Obstacles of several bodies, contacts that are allowed, and obstacles that change.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/cone.h>

#include <sstream>

#include "arm_motions.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/group.h"
#include "fcl_prob/robot_scene.h"
#include "mesh_shapes.h"
#include "temporary_folder.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

/// A ball on a stick.
Obstacle lamp() {
  Obstacle lamp = ballAndBox()[0];
  lamp.name = "lamp";
  lamp.more.push_back({std::make_shared<fcl::Cylinderd>(0.03, 0.5), at(0.0, 0.0, -0.3)});
  return lamp;
}

Eigen::VectorXd beside(const Robot& arm, double turn) {
  return arm.values({{"turn", turn}, {"shoulder", 0.15}, {"elbow", 0.3}});
}

ProbabilityRequest below(double threshold) {
  ProbabilityRequest request;
  request.threshold = threshold;
  return request;
}

}  // namespace

// One that fcl::collide never touches makes no state unsafe, however deep the robot is in it. The
// hull of the ring is around the robot, so that half-spaces tell nothing.
TEST_CASE("a body of an obstacle that is not occupied tells nothing") {
  const Robot robot = Robot::fromText(
      R"(<robot name="ball"><link name="ball"><collision><geometry><sphere radius="0.05"/>)"
      R"(</geometry></collision></link></robot>)");
  Obstacle ring{"ring", makeModel<fcl::OBBRSSd>(torusMesh(0.5, 0.05, 24, 10)), at(0, 0, 0),
                sigma(0.02, 0.03, 0.02)};
  const auto around = std::make_shared<fcl::Boxd>(2.0, 2.0, 2.0);
  around->cost_density = 0.0;
  around->threshold_occupied = 1.0;
  ring.more.push_back({around, fcl::Transform3d::Identity()});
  const RobotQuery query(robot, {ring});
  const Eigen::VectorXd values = robot.values({});
  CHECK(query.decideStates(values, below(0.05))[0] == ProbableDecision::certainly_below);
  CHECK(query.state(values, below(0.05)).decision == Decision::below);
  around->cost_density = 1.0;
  const RobotQuery occupied(robot, {ring});
  CHECK(occupied.decideStates(values, below(0.05))[0] == ProbableDecision::certainly_above);
}

TEST_CASE("an obstacle of several bodies is displaced as one") {
  const RobotQuery query(shippedArm(), {lamp()});
  constexpr int kDraws = 2'000;
  for (const double turn : {0.7, 0.35, 0.2}) {
    const std::vector<Eigen::VectorXd> values{beside(query.robot(), turn)};
    const RobotResult state = query.state(values[0], withTolerance(0.02));
    checkCounted(state.any, counted(query, values, kDraws, 11), kDraws);
    const ProbableResult probable =
        query.decideProbably(values, 0.5 * state.any.lower + 1e-9, 1e-6, {});
    CHECK((probable.decision == ProbableDecision::probably_above ||
           probable.decision == ProbableDecision::certainly_above));
    const JointGradient gradient = query.gradient(values);
    CHECK(std::abs(gradient.probability - state.any.middle()) <=
          6.0 * gradient.standard_error + state.any.width());
  }
  const auto motion = sweep(query.robot(), 5);
  const RobotResult swept =
      query.motion(motion, ErrorsOverTime::persistent, withTolerance(0.1), BetweenWaypoints::swept);
  const double at_waypoints = counted(query, motion, kDraws, 12);
  CHECK(swept.any.upper >= at_waypoints - 5.0 * std::sqrt(0.25 / kDraws));
  const RobotResult ball =
      RobotQuery(shippedArm(), {ballAndBox()[0]})
          .motion(motion, ErrorsOverTime::persistent, withTolerance(0.1), BetweenWaypoints::swept);
  CHECK(swept.any.upper > ball.any.lower);
  CHECK(swept.any.width() <= 0.1 * swept.any.upper);
}

TEST_CASE("a robot in a state is an obstacle, all of it") {
  RobotOptions options;
  options.base = at(0.9, 0.1, 0.0);
  const Robot other(shippedFile("arm.urdf"), options);
  const Eigen::VectorXd pose = other.values({{"turn", 2.8}, {"shoulder", 0.4}});
  const Obstacle arm = obstacleOf("arm", other, pose, sigma(0.02, 0.03, 0.01));
  CHECK(arm.more.size() + 1 == other.bodies().size());
  const RobotQuery query(shippedArm(), {arm});
  const Eigen::VectorXd values = beside(query.robot(), 0.1);
  const RobotResult result = query.state(values, withTolerance(0.02));
  CHECK(result.any.lower > 0.01);
  CHECK(result.any.lower < 0.99);
  GroupQuery::Geometries a, b;
  for (const RobotBody& body : query.robot().bodies()) a.push_back(body.geometry);
  for (const RobotBody& body : other.bodies()) b.push_back(body.geometry);
  ProbabilityResult group;
  GroupQuery(a, b).collisionProbability(query.robot().poses(values), other.poses(pose),
                                        sigma(0.02, 0.03, 0.01), withTolerance(0.02), group);
  CHECK(overlap(result.any, {*group.lower, *group.upper}));
}

TEST_CASE("allowed contacts count for nothing") {
  const Obstacle floor{"floor", std::make_shared<fcl::Halfspaced>(fcl::Vector3d::UnitZ(), 0.0),
                       at(0.0, 0.0, 0.0), sigma(0.0, 0.0, 0.005)};
  const Robot arm = shippedArm();
  const Eigen::VectorXd values = beside(arm, 0.35);
  const RobotResult standing = RobotQuery(arm, {floor}).state(values, withTolerance(0.01));
  CHECK(standing.any.lower > 0.3);
  const std::string base = arm.bodies()[0].name();
  const RobotResult allowed =
      RobotQuery(arm, {floor}, {{base, "fl*"}}).state(values, withTolerance(0.01));
  CHECK(allowed.any.upper < 1e-3);
  const RobotResult all =
      RobotQuery(arm, {floor}, {{"*", "floor"}}).state(values, withTolerance(0.01));
  CHECK(all.any.upper == 0.0);
  CHECK_THROWS_AS(RobotQuery(arm, {floor}, {{"bsae", "floor"}}), InvalidRequest);
  CHECK_THROWS_AS(RobotQuery(arm, {floor}, {{base, "flor"}}), InvalidRequest);
}

TEST_CASE("obstacles that move or come are as if they had always been there") {
  const Robot arm = shippedArm();
  std::vector<Obstacle> obstacles = ballAndBox();
  const RobotQuery first(arm, obstacles);
  obstacles[0].pose.translation().y() += 0.05;
  obstacles.push_back(lamp());
  const RobotQuery changed = first.withObstacles(obstacles);
  const RobotQuery anew(arm, obstacles);
  const Eigen::VectorXd values = beside(arm, 0.4);
  const RobotResult x = changed.state(values, withTolerance(0.05));
  const RobotResult y = anew.state(values, withTolerance(0.05));
  CHECK(x.any.lower == y.any.lower);
  CHECK(x.any.upper == y.any.upper);
  CHECK(first.obstacles().size() == 2);
}

TEST_CASE("many states are decided as one by one, on any number of threads") {
  const RobotQuery query(shippedArm(), ballAndBox());
  std::mt19937_64 random(5);
  Eigen::MatrixXd states(query.robot().joints().size(), 100);
  for (Eigen::Index i = 0; i < states.cols(); ++i) {
    states.col(i) = randomValues(query.robot(), random);
  }
  const auto decided = query.decideStates(states, below(0.05));
  REQUIRE(decided.size() == 100);
  int above = 0;
  for (Eigen::Index i = 0; i < states.cols(); ++i) {
    const Bounds any = query.state(states.col(i), withTolerance(0.01)).any;
    CAPTURE(i, any.lower, any.upper);
    if (any.upper < 0.049) CHECK(decided[i] == ProbableDecision::certainly_below);
    if (any.lower > 0.051) CHECK(decided[i] == ProbableDecision::certainly_above);
    above += decided[i] == ProbableDecision::certainly_above;
  }
  CHECK(above > 1);
  CHECK(above < 97);
  ProbabilityRequest on_two = below(0.05);
  on_two.threads = 2;
  CHECK(query.decideStates(states, on_two) == decided);
  const auto probable = query.decideStates(states, below(0.05), 1e-9);
  for (std::size_t i = 0; i < decided.size(); ++i) {
    const bool says_below = probable[i] == ProbableDecision::certainly_below ||
                            probable[i] == ProbableDecision::probably_below;
    CHECK(says_below == (decided[i] == ProbableDecision::certainly_below));
  }
  CHECK_THROWS_AS(query.decideStates(states, {}), InvalidRequest);
  CHECK_THROWS_AS(query.decideStates(states.topRows(2), below(0.05)), InvalidRequest);
  states(0, 99) = 100.0;
  CHECK_THROWS_AS(query.decideStates(states, below(0.05)), InvalidRequest);
}

TEST_CASE("scenes have obstacles of several bodies, robots as obstacles, and allowed contacts") {
  const TemporaryFolder folder;
  const auto sceneWith = [&](const std::string& obstacle, const std::string& allowed) {
    return loadRobotScene(folder.write(
        "scene.json",
        R"({"robot": {"urdf": ")" + shippedFile("arm.urdf") + R"("}, "joints": {}, "allowed": [)" +
            allowed + R"(], "obstacles": [{"name": "o", "displacement": {"sigma": [1, 1, 1]},)" +
            obstacle + "}]}"));
  };
  const RobotQuery lamp = loadRobotQuery(
      sceneWith(R"("pose": [1, 0, 0], "bodies": [{"sphere": 0.1, "pose": [0, 2, 0]},)"
                R"( {"box": [1, 2, 3], "pose": [0, 5, 0]}])",
                R"({"body": "*", "obstacle": "o"})"));
  const Obstacle& obstacle = lamp.obstacles()[0];
  CHECK(obstacle.pose.translation() == Eigen::Vector3d(1, 2, 0));
  REQUIRE(obstacle.more.size() == 1);
  CHECK(obstacle.more[0].in_obstacle.translation() == Eigen::Vector3d(0, 3, 0));
  CHECK(lamp.allowed().size() == 1);
  const RobotQuery arms =
      loadRobotQuery(sceneWith(R"("pose": [2, 0, 0], "robot": {"urdf": ")" +
                                   shippedFile("arm.urdf") + R"(", "joints": {"turn": 0.5}})",
                               ""));
  CHECK(arms.obstacles()[0].more.size() + 1 == arms.robot().bodies().size());
  CHECK_THROWS_AS(sceneWith(R"("bodies": [], "pose": [1, 0, 0])", ""), FileError);
  CHECK_THROWS_AS(sceneWith(R"("sphere": 1, "bodies": [{"sphere": 1}])", ""), FileError);
  CHECK_THROWS_AS(sceneWith(R"("sphere": 1)", R"({"body": "*"})"), FileError);
}

TEST_CASE("certificates of a state and a motion: one an obstacle, the same intervals") {
  const TemporaryFolder folder;
  const std::string box = R"(<collision><origin xyz="0.2 0 0"/><geometry><box size="0.4 0.1 0.1"/>)"
                          R"(</geometry></collision>)";
  folder.write("arm.urdf",
               R"(<robot name="two"><link name="base"/><link name="upper">)" + box +
                   R"(</link><link name="lower">)" + box +
                   R"(</link><joint name="one" type="continuous"><parent link="base"/>)"
                   R"(<child link="upper"/><axis xyz="0 0 1"/></joint>)"
                   R"(<joint name="two" type="continuous"><parent link="upper"/>)"
                   R"(<child link="lower"/><origin xyz="0.4 0 0"/><axis xyz="0 0 1"/></joint>)"
                   R"(</robot>)");
  const auto crate = [](const char* name, const fcl::Transform3d& pose) {
    return Obstacle{name, std::make_shared<fcl::Boxd>(0.1, 0.1, 0.1), pose,
                    sigma(0.03, 0.05, 0.02)};
  };
  const Robot robot(folder.path("arm.urdf"));
  const RobotQuery query(robot, {crate("near", at(0.5, 0.2, 0)), crate("far", at(-0.3, 0.1, 0))},
                         {{"*", "far"}});
  std::ostringstream state, motion;
  const Eigen::VectorXd values = Eigen::Vector2d(0.1, 0.2);
  const RobotResult one = query.certified({values}, withTolerance(0.02), state);
  const RobotResult same = query.state(values, withTolerance(0.02));
  CHECK(one.any.lower <= same.any.upper);
  CHECK(one.any.upper >= same.any.lower);
  CHECK(one.any.width() <= 0.02 * one.any.upper);
  CHECK(one.parts.size() == 2);
  CHECK(*one.parts[1].upper == 0.0);
  CHECK(state.str().find("\"obstacle near and the robot\"") != std::string::npos);
  CHECK(state.str().find("obstacle far") == std::string::npos);
  const RobotResult three =
      query.certified({values, 1.5 * values, 2.0 * values}, withTolerance(0.05), motion);
  CHECK(three.any.upper >= one.any.lower);
  std::ostringstream of_ball, unused;
  CHECK(RobotQuery(robot, ballAndBox()).certified({values}, {}, of_ball).any.upper > 0.0);
  CHECK(of_ball.str().find("\"radius\":") != std::string::npos);
  std::vector<Obstacle> cone = ballAndBox();
  cone[0].geometry = std::make_shared<fcl::Coned>(0.1, 0.2);
  const RobotQuery beside(robot, cone);
  CHECK_THROWS_AS(beside.certified({values}, {}, unused), UnsupportedGeometry);
}
