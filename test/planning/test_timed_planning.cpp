// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Plans in time: a ball that is carried in a plane, past one that is predicted; P in closed form.
#include "fcl_prob/timed_planning.h"

#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>

#include <cmath>

#include "catch.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/mesh_io.h"
#include "fcl_prob/normal_mass.h"
#include "fcl_prob/robot_scene.h"
#include "models.h"
#include "random_bodies.h"
#include "temporary_folder.h"

using namespace fcl_prob;

namespace {

constexpr double kBallRadius = 0.1;
constexpr double kVelocity = 0.5;
constexpr double kThreshold = 0.02;

const std::string kCart = R"(<robot name="cart"><link name="base"/>
  <joint name="x" type="prismatic"><parent link="base"/><child link="slide"/>
    <axis xyz="1 0 0"/><limit lower="-2" upper="2" effort="1" velocity="0.5"/></joint>
  <link name="slide"/>
  <joint name="y" type="prismatic"><parent link="slide"/><child link="ball"/>
    <axis xyz="0 1 0"/><limit lower="-0.3" upper="0.3" effort="1" velocity="0.5"/></joint>
  <link name="ball"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
</robot>)";

ObstacleState predicted(double time, double x, double y, double sigma) {
  ObstacleState state;
  state.pose.translation() = Eigen::Vector3d(x, y, 0.0);
  state.displacement =
      GaussianDisplacement::fromStandardDeviations(Eigen::Vector3d(sigma, sigma, sigma));
  state.time = time;
  return state;
}

/// A ball of 20 cm that comes towards the cart through its narrow lane, turns off at x = 0 after 4
/// seconds, and is known less and less well.
Obstacle comer() {
  Obstacle obstacle;
  obstacle.name = "comer";
  obstacle.geometry = std::make_shared<const fcl::Sphered>(2.0 * kBallRadius);
  obstacle.displacement = GaussianDisplacement();
  obstacle.over_time = {predicted(0.0, 1.5, 0.0, 0.01), predicted(4.0, 0.0, 0.0, 0.03),
                        predicted(7.0, 0.0, 1.5, 0.05), predicted(15.0, 0.0, 3.0, 0.08)};
  return obstacle;
}

struct Lane {
  explicit Lane(Obstacle obstacle = comer(), const std::string& urdf = kCart)
      : robot(folder.write("cart.urdf", urdf)), query(robot, {std::move(obstacle)}), self(robot) {}

  TimedPlanningRequest request(std::uint64_t seed = 1) const {
    TimedPlanningRequest result;
    result.state.threshold = kThreshold;
    result.planning.seed = seed;
    result.planning.max_states = 50'000;
    result.largest_time_step = 0.1;
    return result;
  }

  TimedPlan plan(const TimedPlanningRequest& asked) const {
    return planInTime(query, self, at(-1.0, 0.0), at(1.0, 0.0), asked);
  }

  static Eigen::VectorXd at(double x, double y) { return Eigen::Vector2d(x, y); }

  fcl_prob_test::TemporaryFolder folder;
  Robot robot;
  RobotQuery query;
  SelfCollision self;
};

/// By linear predictions, independently of the library's.
double truth(const TimedWaypoint& at) {
  const auto states = comer().over_time;
  std::size_t next = 1;
  while (next + 1 < states.size() && *states[next].time < at.time) ++next;
  const ObstacleState &a = states[next - 1], &b = states[next];
  const double part = (at.time - *a.time) / (*b.time - *a.time);
  const auto variance = [](const ObstacleState& state) {
    return std::get<GaussianDisplacement>(state.displacement).covariance()(0, 0);
  };
  const double sigma = std::sqrt((1.0 - part) * variance(a) + part * variance(b));
  const Eigen::Vector3d centre = (1.0 - part) * a.pose.translation() + part * b.pose.translation();
  const double distance = (Eigen::Vector3d(at.values[0], at.values[1], 0.0) - centre).norm();
  return normalBallMass(distance / sigma, 3.0 * kBallRadius / sigma).upper;
}

/// The largest P of a state; none is at or above the threshold, and joints are slow enough.
double checkStates(const TimedPlan& plan, const TimedPlanningRequest& request) {
  REQUIRE(plan.status == PlanningStatus::solved);
  CHECK(plan.waypoints.front().time == Approx(request.start_time).margin(1e-12));
  CHECK(plan.waypoints.front().values == Lane::at(-1.0, 0.0));
  CHECK(plan.waypoints.back().values == Lane::at(1.0, 0.0));
  CHECK(plan.waypoints.back().time == Approx(plan.arrival + request.hold));
  double largest = 0.0;
  const auto states =
      interpolated(plan.waypoints, request.planning.largest_step, request.largest_time_step);
  for (std::size_t i = 0; i < states.size(); ++i) {
    largest = std::max(largest, truth(states[i]));
    if (i == 0) continue;
    const double passed = states[i].time - states[i - 1].time;
    CHECK(passed > 0.0);
    CHECK(passed <= request.largest_time_step * (1.0 + 1e-9));
    const double most = request.velocity_scale * kVelocity * passed;
    CHECK((states[i].values - states[i - 1].values).cwiseAbs().maxCoeff() <= most * (1.0 + 1e-6));
  }
  CHECK(largest < kThreshold);
  return largest;
}

void checkPlan(const TimedPlan& plan, const TimedPlanningRequest& request) {
  const double largest = checkStates(plan, request);
  CHECK(plan.largest.upper <= kThreshold);
  CHECK(largest >= plan.largest.lower - 1e-9);
  CHECK(largest <= plan.largest.upper + 1e-9);
}

}  // namespace

TEST_CASE("a plan in time lets what comes pass, every state below the threshold at its time") {
  const Lane lane;
  // Straight ahead, as fast as can be, is into it.
  CHECK(truth({1.7, Lane::at(-0.15, 0.0)}) < 0.9);
  CHECK(truth({2.8, Lane::at(0.4, 0.0)}) > 0.9);
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U}) {
    const TimedPlanningRequest request = lane.request(seed);
    const TimedPlan plan = lane.plan(request);
    INFO("seed " << seed);
    checkPlan(plan, request);
    // The lane is not as wide as both: the cart cannot be there in the 4 s that its way takes.
    CHECK(plan.arrival > 5.0);
    CHECK(plan.arrival < 12.0);
    CHECK(plan.length < 4.0);
  }
  const TimedPlan again = lane.plan(lane.request(3)), same = lane.plan(lane.request(3));
  CHECK(again.arrival == same.arrival);
  CHECK(again.states == same.states);
}

TEST_CASE("a plan in time goes through states that a test of one's own allows at their times") {
  const Lane lane;
  TimedPlanningRequest request = lane.request();
  request.state.threshold.reset();
  std::size_t asked = 0;
  const TimedStateTest allowed = [&asked](double time, const Eigen::VectorXd& values) {
    ++asked;
    return truth({time, values}) < kThreshold;
  };
  const auto plan = [&] {
    return planInTime(lane.robot, allowed, Lane::at(-1.0, 0.0), Lane::at(1.0, 0.0), request);
  };
  CHECK_THROWS_AS(plan(), InvalidRequest);  // nothing says how late it may be
  for (const double latest : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    request.latest = latest;
    CHECK_THROWS_AS(plan(), InvalidRequest);
  }
  request.latest = 12.0;
  request.hold = 1.0;
  const TimedPlan found = plan();
  checkStates(found, request);
  CHECK(found.states == asked);
  CHECK(found.arrival > 5.0);
  CHECK(found.largest.upper == 1.0);
  request.latest = 5.0;  // the lane is not free by then
  request.planning.max_states = 2'000;
  CHECK(plan().status != PlanningStatus::solved);
}

TEST_CASE("a plan in time keeps slower velocities and rests at the goal") {
  const Lane lane;
  TimedPlanningRequest request = lane.request();
  request.velocity_scale = 0.5;
  request.hold = 3.0;
  const TimedPlan plan = lane.plan(request);
  checkPlan(plan, request);
  CHECK(plan.arrival >= 8.0);
  CHECK(plan.arrival <= 12.0);
}

TEST_CASE("rounding of times never leaves a prediction") {
  fcl_prob_test::RandomBodies random(5);
  for (int i = 0; i < 60; ++i) {
    Obstacle away = comer();
    const double start = random.uniform(0.0, 3.0), end = start + random.uniform(5.0, 9.0);
    away.over_time = {predicted(start, 5.0, 0.0, 0.01), predicted(end, 5.0, 3.0, 0.02)};
    const Lane lane(away);
    TimedPlanningRequest request = lane.request();
    request.start_time = start;
    request.hold = i % 2 ? random.uniform(0.0, 1.0) : 0.0;
    request.planning.largest_step = random.uniform(0.03, 0.1);
    request.planning.shorten = false;
    request.largest_time_step = random.uniform(0.03, 0.2);
    const TimedPlan plan = lane.plan(request);
    REQUIRE(plan.status == PlanningStatus::solved);
    for (const TimedWaypoint& at : interpolated(plan.waypoints, 0.1, request.largest_time_step)) {
      CHECK_NOTHROW(lane.query.at(at.time));
    }
    CHECK(interpolated(plan.waypoints, 0.1, 0.1).back().time == plan.waypoints.back().time);
  }
}

TEST_CASE("a plan in time says when there is none") {
  const Lane lane;
  TimedPlanningRequest request = lane.request();
  request.planning.max_states = 3'000;
  SECTION("in the time that is left") {
    request.latest = 4.5;
    const TimedPlan plan = lane.plan(request);
    CHECK(plan.status == PlanningStatus::state_limit);
    CHECK(plan.waypoints.empty());
    CHECK(plan.largest.upper == 1.0);
  }
  SECTION("sooner than joints move") {
    request.latest = 3.9;
    CHECK(lane.plan(request).status == PlanningStatus::goal_refused);
  }
  SECTION("from a start that is hit") {
    request.start_time = 1.0;
    const TimedPlan plan =
        planInTime(lane.query, lane.self, Lane::at(1.0, 0.0), Lane::at(-1.0, 0.0), request);
    CHECK(plan.status == PlanningStatus::start_refused);
  }
  SECTION("before a limit") {
    request.planning.time_limit = 1e-6;
    CHECK(lane.plan(request).status == PlanningStatus::time_limit);
    request.planning.time_limit.reset();
    request.planning.on_progress = [](const PlanningProgress&) { return false; };
    CHECK(lane.plan(request).status == PlanningStatus::cancelled);
  }
}

TEST_CASE("plans in time refuse what has no meaning") {
  const Lane lane;
  TimedPlanningRequest request = lane.request();
  SECTION("no threshold") { request.state.threshold.reset(); }
  SECTION("a prediction that is too short") { request.latest = 14.0, request.hold = 1.5; }
  SECTION("a start before it") { request.start_time = -1.0; }
  SECTION("no time") { request.start_time = 15.0; }
  SECTION("steps") { request.largest_time_step = 0.0; }
  SECTION("hold") { request.hold = std::nan(""); }
  SECTION("velocities") { request.velocities["x"] = 0.0; }
  SECTION("names") { request.velocities["z"] = 1.0; }
  SECTION("scale") { request.velocity_scale = 1.5; }
  CHECK_THROWS_AS(lane.plan(request), InvalidRequest);
}

TEST_CASE("predictions are refused out of order, and joints without a velocity are named") {
  Obstacle wrong = comer();
  std::swap(wrong.over_time[1], wrong.over_time[2]);
  CHECK_THROWS_WITH(Lane(wrong),
                    "obstacle comer: over_time: state 2 is at 4 s, the one before at 7 "
                    "s: times have to increase");
  wrong = comer();
  wrong.over_time[2].time.reset();
  CHECK_THROWS_WITH(Lane(wrong), "obstacle comer: over_time: state 2 has no time");

  std::string slow = kCart;
  slow.replace(slow.find(" velocity=\"0.5\""), 15, "");
  const Lane lane(comer(), slow);
  CHECK_THROWS_WITH(lane.plan(lane.request()),
                    "joint x has no velocity in its URDF: a plan in time needs one");
  TimedPlanningRequest request = lane.request();
  request.velocities["x"] = kVelocity;
  checkPlan(lane.plan(request), request);
}

TEST_CASE("a query at a time is one of obstacles as they are predicted") {
  const Lane lane;
  ProbabilityRequest request;
  for (const double time : {0.0, 1.3, 4.0, 5.5, 15.0}) {
    for (const double x : {-0.2, 0.1, 0.8}) {
      const Eigen::VectorXd values = Lane::at(x, 0.1);
      const Bounds any = lane.query.at(time).state(values, request).any;
      const double p = truth({time, values});
      CHECK(any.lower <= p * (1.0 + 1e-9) + 1e-300);
      CHECK(any.upper >= p * (1.0 - 1e-9) - 1e-300);
    }
  }
  CHECK_THROWS_AS(lane.query.at(15.1), InvalidRequest);
  CHECK_THROWS_AS(lane.query.at(-0.1), InvalidRequest);
  CHECK_THROWS_AS(lane.query.at(std::nan("")), InvalidRequest);
  CHECK_THROWS_AS(lane.query.state(Lane::at(0.0, 0.0), request), InvalidRequest);
}

TEST_CASE("scenes of plans in time, and the motions that come of them") {
  const Lane lane;
  const std::string obstacle =
      R"({"name": "comer", "sphere": 0.2,
          "displacement": {"sigma": [0.01, 0.01, 0.01]}, "over_time": [
          {"time": 0, "pose": [1.5, 0, 0]}, {"time": 4, "pose": [0, 0, 0]},
          {"time": 7, "pose": [0, 1.5, 0], "displacement": {"sigma": [0.05, 0.05, 0.05]}}]})";
  const std::string head = R"({"robot": {"urdf": "cart.urdf"}, "obstacles": [)" + obstacle + "], ";
  const std::string plan =
      lane.folder.write("plan.json", head + R"("plan": {"start": {"x": -1}, "goal": {"x": 1},
        "hold": 0.5, "latest": 6, "velocity_scale": 0.9, "velocities": {"y": 0.3},
        "largest_time_step": 0.2, "start_time": 0.5}, "request": {"threshold": 0.02}})");
  const RobotScene scene = loadRobotScene(plan);
  CHECK(isPredicted(scene));
  CHECK(scene.plan->hold == 0.5);
  CHECK(scene.plan->latest == 6.0);
  CHECK(scene.plan->velocity_scale == 0.9);
  CHECK(scene.plan->velocities.at("y") == 0.3);
  CHECK(scene.plan->largest_time_step == 0.2);
  CHECK(scene.plan->start_time == 0.5);
  CHECK(loadRobotQuery(scene).obstacles()[0].over_time.size() == 3);

  // What was planned is a motion of the same scene.
  RobotScene planned = scene;
  planned.waypoints = {{{"time", 0.5}, {"x", -1.0}}, {{"time", 5.5}, {"x", -0.5}}};
  CHECK(loadRobotQuery(planned).obstacles()[0].over_time.size() == 2);

  const std::string motion =
      lane.folder.write("motion.json", head + R"("errors": "independent", "largest_step": 0.5,
        "waypoints": [{"time": 1, "x": -1}, {"time": 3, "x": 0}, {"time": 5, "x": 0.2}]})");
  const RobotQuery query = loadRobotQuery(loadRobotScene(motion));
  const auto& states = query.obstacles()[0].over_time;
  REQUIRE(states.size() == 4);
  CHECK(*states[1].time == Approx(2.0));
  CHECK(states[1].pose.translation().x() == Approx(0.75));
  CHECK(states[3].pose.translation().y() == Approx(0.5));
  for (const char* wrong :
       {R"({"time": 1, "x": -1}, {"x": 0})", R"({"time": 1, "x": -1}, {"time": 1, "x": 0})",
        R"({"time": 1, "x": -1}, {"time": 8, "x": 0})"}) {
    const RobotScene refused =
        loadRobotScene(lane.folder.write("wrong.json", head + R"("waypoints": [)" + wrong + "]}"));
    CHECK_THROWS_AS(loadRobotQuery(refused), InvalidRequest);
  }
}

namespace {

/// A person who walks past at 2 m/s along a line, known less and less well: 10 to 80 mm.
Obstacle walker(const std::string& mesh, double x) {
  Obstacle person;
  person.name = "person";
  person.geometry = buildModel<fcl::OBBRSSd>(loadMesh(mesh));
  person.displacement = GaussianDisplacement();
  for (const double time : {0.0, 1.5, 3.0, 4.5, 6.0}) {
    const double sigma = 0.01 + 0.07 * time / 6.0;
    ObstacleState state = predicted(time, x, -2.0 + 2.0 * time, sigma);
    state.pose.linear() = Eigen::AngleAxisd(0.5 * M_PI, Eigen::Vector3d::UnitX()).matrix();
    person.over_time.push_back(state);
  }
  return person;
}

double shareOfHits(const RobotQuery& query, const TimedWaypoint& at, int draws) {
  const RobotQuery then = query.at(at.time);
  const Obstacle& obstacle = then.obstacles()[0];
  const auto poses = query.robot().poses(at.values);
  const auto& error = std::get<GaussianDisplacement>(obstacle.displacement);
  fcl_prob_test::RandomBodies random(7);
  int hits = 0;
  for (int i = 0; i < draws; ++i) {
    fcl::Transform3d pose = obstacle.pose;
    pose.translation() +=
        error.axes() * error.standardDeviations().asDiagonal() * random.normalVector();
    bool hit = false;
    for (std::size_t k = 0; k < poses.size() && !hit; ++k) {
      fcl::CollisionResultd result;
      hit = fcl::collide(query.robot().bodies()[k].geometry.get(), poses[k],
                         obstacle.geometry.get(), pose, fcl::CollisionRequestd(), result) > 0;
    }
    hits += hit;
  }
  return static_cast<double>(hits) / draws;
}

/// Half a turn about the first axis past the walker, who is in the way of the straight motion.
void checkPassing(const std::string& urdf, const std::string& srdf,
                  const std::vector<std::string>& joints,
                  const std::map<std::string, double>& start, double x, double scale, int seeds) {
  const auto path = fcl_prob_test::modelOrSkip(urdf);
  const auto mesh = fcl_prob_test::modelOrSkip("human/human_man_4980.obj");
  if (!path || !mesh) return;
  const Robot robot(*path);
  const RobotQuery query(robot, {walker(*mesh, x)});
  const SelfCollision self =
      srdf.empty()
          ? SelfCollision(robot)
          : SelfCollision(robot, loadAllowedPairs(*fcl_prob_test::modelOrSkip(srdf), robot));
  TimedPlanningRequest request;
  request.state.threshold = 0.05;
  request.state.max_cells = 2'000;
  request.planning.joints = joints;
  request.velocity_scale = scale;
  std::map<std::string, double> goal = start;
  goal[joints[0]] = -start.at(joints[0]);
  for (int seed = 1; seed <= seeds; ++seed) {
    INFO("seed " << seed);
    request.planning.seed = static_cast<std::uint64_t>(seed);
    const TimedPlan plan =
        planInTime(query, self, robot.values(start), robot.values(goal), request);
    REQUIRE(plan.status == PlanningStatus::solved);
    CHECK(plan.length > 2.45);  // not straight
    for (const TimedWaypoint& at : interpolated(plan.waypoints, 0.1, 0.1)) {
      CHECK(shareOfHits(query, at, 200) <= 0.05 + 5.0 * std::sqrt(0.05 / 200));
    }
  }
}

void checkPassingBoth(int seeds) {
  checkPassing("kuka_iiwa/model.urdf", "",
               {"lbr_iiwa_joint_1", "lbr_iiwa_joint_2", "lbr_iiwa_joint_3", "lbr_iiwa_joint_4",
                "lbr_iiwa_joint_5", "lbr_iiwa_joint_6", "lbr_iiwa_joint_7"},
               {{"lbr_iiwa_joint_1", -1.2}, {"lbr_iiwa_joint_2", 1.0}, {"lbr_iiwa_joint_4", -0.6}},
               0.75, 0.15, seeds);
  checkPassing("fetch_robot/fetch_description/robots/fetch.urdf", "fetch_robot/fetch.srdf",
               {"shoulder_pan_joint", "shoulder_lift_joint", "upperarm_roll_joint",
                "elbow_flex_joint", "forearm_roll_joint", "wrist_flex_joint", "wrist_roll_joint"},
               {{"shoulder_pan_joint", -1.2}, {"shoulder_lift_joint", 0.2}}, 0.9, 1.0, seeds);
}

}  // namespace

TEST_CASE("robots pass a person who walks by, counted at every state") { checkPassingBoth(1); }

TEST_CASE("robots pass a person who walks by, with five seeds", "[long]") { checkPassingBoth(5); }
