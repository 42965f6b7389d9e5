// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// States that the joints of a robot cannot reach are refused by every query, by name.
#include <limits>

#include "arm_motions.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/robot_joints.h"
#include "fcl_prob/robot_scene.h"
#include "fcl_prob/self_collision.h"
#include "temporary_folder.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

Robot armWithoutLimits() {
  RobotOptions options;
  options.allow_outside_limits = true;
  return Robot(shippedFile("arm.urdf"), options);
}

/// What a call refuses; empty if it answers.
template <typename Ask>
std::string refusalOf(const Ask& ask) {
  try {
    ask();
    return "";
  } catch (const InvalidRequest& error) {
    return error.what();
  }
}

void tells(const std::string& message, const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    CAPTURE(message, word);
    CHECK(message.find(word) != std::string::npos);
  }
}

ProbabilityRequest cheap() {
  ProbabilityRequest request;
  request.relative_tolerance = 0.5;
  request.max_cells = 64;
  return request;
}

/// All that may be asked of the waypoints, by name.
std::vector<std::pair<std::string, std::string>> refusalsOf(
    const Robot& robot, const std::vector<Eigen::VectorXd>& waypoints) {
  const RobotQuery query(robot, ballAndBox());
  const SelfCollision self(robot);
  const Eigen::VectorXd& last = waypoints.back();
  MotionGradientRequest lines;
  lines.lines = 64;
  const Eigen::MatrixXd covariance = 1e-4 * Eigen::MatrixXd::Identity(last.size(), last.size());
  const auto motion = [&](ErrorsOverTime errors, BetweenWaypoints between) {
    return refusalOf([&] { query.motion(waypoints, errors, cheap(), between); });
  };
  return {{"state", refusalOf([&] { query.state(last, cheap()); })},
          {"persistent", motion(ErrorsOverTime::persistent, BetweenWaypoints::ignored)},
          {"independent", motion(ErrorsOverTime::independent, BetweenWaypoints::ignored)},
          {"any", motion(ErrorsOverTime::any_dependence, BetweenWaypoints::ignored)},
          {"swept", motion(ErrorsOverTime::persistent, BetweenWaypoints::swept)},
          {"probable", refusalOf([&] { query.decideProbably(waypoints, 0.5, 0.01, cheap()); })},
          {"gradient", refusalOf([&] { query.gradient(waypoints, lines); })},
          {"by body", refusalOf([&] { query.byBody(waypoints, cheap()); })},
          {"self", refusalOf([&] { self.collides(last); })},
          {"self pairs", refusalOf([&] { self.collisions(last); })},
          {"joint errors", refusalOf([&] { randomJoints(robot, last, covariance, {}, {}); })}};
}

/// One joint, and one that mimics it.
Robot mimicking(const std::string& leader, const std::string& mimic, bool allow = false) {
  const TemporaryFolder folder;
  const auto joint = [](const std::string& name, const std::string& parent,
                        const std::string& child, const std::string& inside) {
    return "<joint name=\"" + name + "\" type=\"revolute\"><parent link=\"" + parent +
           "\"/><child link=\"" + child + "\"/>" + inside + "</joint>";
  };
  RobotOptions options;
  options.allow_outside_limits = allow;
  return Robot(
      folder.write("r.urdf",
                   "<robot name=\"r\"><link name=\"a\"/><link name=\"b\"><collision><geometry>"
                   "<sphere radius=\"0.1\"/></geometry></collision></link><link name=\"c\"/>" +
                       joint("leader", "a", "b", leader) + joint("follower", "b", "c", mimic) +
                       "</robot>"),
      options);
}

}  // namespace

TEST_CASE("a state beyond the limits is refused by every query, with joint, value and limits") {
  const Robot arm = shippedArm(), free = armWithoutLimits();
  struct Case {
    std::string joint;
    double value;
    std::vector<std::string> told;
  };
  for (const Case& one :
       std::vector<Case>{{"elbow", 45.0, {"joint elbow", "45 rad", "-2.4 to 2.4 rad", "degrees"}},
                         {"elbow", -2.401, {"joint elbow", "-2.401 rad", "-2.4 to 2.4 rad"}},
                         {"shoulder", 1.5, {"joint shoulder", "1.5 rad", "-2 to 1.2 rad"}},
                         {"bend", 1.80001, {"joint bend", "1.80001 rad", "-1.8 to 1.8 rad"}},
                         {"grip", 0.05, {"joint grip", "0.05 m", "0 to 0.045 m"}},
                         {"grip", -45.0, {"joint grip", "-45 m", "0 to 0.045 m"}}}) {
    const Eigen::VectorXd inside = arm.values({}), outside = arm.values({{one.joint, one.value}});
    CHECK_FALSE(arm.isWithinLimits(outside));
    for (const auto& [query, refusal] : refusalsOf(arm, {inside, outside})) {
      CAPTURE(query);
      tells(refusal, one.told);
      CHECK((refusal.find("degrees") != std::string::npos) == (one.value == 45.0));
    }
    for (const auto& [query, refusal] : refusalsOf(free, {inside, outside})) {
      CAPTURE(query);
      CHECK(refusal.empty());
    }
  }
  // Of several waypoints the one that is outside.
  const Eigen::VectorXd inside = arm.values({}), outside = arm.values({{"elbow", 3.0}});
  tells(refusalOf([&] {
          RobotQuery(arm, ballAndBox())
              .motion({inside, inside, outside}, ErrorsOverTime::persistent, cheap());
        }),
        {"waypoint 2: joint elbow"});
}

TEST_CASE("limits are inside, continuous joints have none, and six decimals are enough") {
  const Robot arm = shippedArm();
  for (const auto& [joint, value] :
       std::vector<std::pair<std::string, double>>{{"elbow", 2.4},
                                                   {"elbow", -2.4},
                                                   {"elbow", 2.4000004},
                                                   {"shoulder", 1.2},
                                                   {"grip", 0.045},
                                                   {"grip", -4e-7},
                                                   {"turn", 1e4},
                                                   {"roll", -45.0}}) {
    CAPTURE(joint, value);
    CHECK(refusalOf([&, name = joint, at = value] {
            arm.requireWithinLimits(arm.values({{name, at}}));
          }).empty());
  }
  std::mt19937_64 random(3);
  for (int i = 0; i < 200; ++i) {
    const Eigen::VectorXd from = randomValues(arm, random), to = randomValues(arm, random);
    for (const Eigen::VectorXd& values : interpolated({from, to}, 0.01)) {
      arm.requireWithinLimits(values);
    }
  }
  CHECK_THROWS_AS(arm.requireWithinLimits(Eigen::VectorXd::Zero(5)), InvalidRequest);
  CHECK_THROWS_AS(armWithoutLimits().requireWithinLimits(arm.values({}) * std::nan("")),
                  InvalidRequest);
}

TEST_CASE("a joint goes no further than those that mimic it can") {
  const std::string leader = "<limit lower=\"-1\" upper=\"2\"/>";
  const auto limitsOf = [&](const std::string& mimic) {
    const RobotJoint joint = mimicking(leader, mimic).joints()[0];
    return std::make_pair(joint.lower, joint.upper);
  };
  using Limits = std::pair<double, double>;
  const std::string own = "<limit lower=\"-0.5\" upper=\"3\"/>";
  CHECK(limitsOf(own + "<mimic joint=\"leader\"/>") == Limits(-0.5, 2.0));
  CHECK(limitsOf(own + "<mimic joint=\"leader\" multiplier=\"2\"/>") == Limits(-0.25, 1.5));
  CHECK(limitsOf(own + "<mimic joint=\"leader\" multiplier=\"-1\"/>") == Limits(-1.0, 0.5));
  CHECK(limitsOf(own + "<mimic joint=\"leader\" offset=\"2\"/>") == Limits(-1.0, 1.0));
  CHECK(limitsOf(own + "<mimic joint=\"leader\" multiplier=\"0\" offset=\"9\"/>") ==
        Limits(-1.0, 2.0));
  // Limits that nobody has given are none.
  CHECK(limitsOf("<limit effort=\"1\" velocity=\"1\"/><mimic joint=\"leader\"/>") ==
        Limits(-1.0, 2.0));
  const std::string never = "<limit lower=\"5\" upper=\"6\"/><mimic joint=\"leader\"/>";
  CHECK_THROWS_AS(mimicking(leader, never), FileError);
  CHECK(mimicking(leader, never, true).joints()[0].upper == 2.0);

  const Robot robot = mimicking(leader, own + "<mimic joint=\"leader\" multiplier=\"2\"/>");
  const Eigen::VectorXd values = Eigen::VectorXd::Constant(1, 1.75);
  tells(refusalOf([&] { robot.requireWithinLimits(values); }),
        {"joint leader", "1.75 rad", "-0.25 to 1.5 rad", "joint follower", "-0.5 to 3"});
}

TEST_CASE("scenes refuse states beyond the limits unless they allow them") {
  const TemporaryFolder folder;
  const auto sceneWith = [&](const std::string& robot, const std::string& states) {
    return loadRobotScene(folder.write(
        "scene.json",
        R"({"robot": {"urdf": ")" + shippedFile("arm.urdf") + "\"" + robot +
            R"(}, "obstacles": [{"name": "ball", "sphere": 0.1,)"
            R"( "pose": [1, 1, 1], "displacement": {"sigma": [0.01, 0.01, 0.01]}}], )" +
            states + "}"));
  };
  const std::string allowed = ", \"allow_outside_limits\": true";
  for (const std::string states :
       {R"("joints": {"elbow": 3})", R"("waypoints": [{}, {"elbow": 3}])",
        R"("waypoints": [{}, {"elbow": 3}], "largest_step": 0.1)"}) {
    const RobotScene refused = sceneWith("", states);
    tells(refusalOf([&] { waypointsOf(refused, loadRobot(refused)); }),
          {"joint elbow", "3 rad", "-2.4 to 2.4 rad"});
    const RobotScene scene = sceneWith(allowed, states);
    const RobotQuery query = loadRobotQuery(scene);
    CHECK(query.motion(waypointsOf(scene, query.robot()), ErrorsOverTime::persistent, cheap())
              .any.upper < 1.0);
  }
  CHECK_THROWS_AS(sceneWith(", \"allow_outside_limits\": 1", "\"joints\": {}"), FileError);
}

TEST_CASE("answers tell the links without a body") {
  const Robot arm = shippedArm();
  CHECK(arm.linksWithoutBody() == std::vector<std::string>{"tool"});
  const RobotQuery query(arm, ballAndBox());
  for (const auto errors : {ErrorsOverTime::persistent, ErrorsOverTime::independent}) {
    const RobotResult result = query.motion({arm.values({})}, errors, cheap());
    REQUIRE(result.plan.size() == 1);
    tells(result.plan[0], {"without a body", "tool"});
  }
}
