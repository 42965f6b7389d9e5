// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Plans for the shipped arm, counted by displaced fcl::collide.
#include "fcl_prob/certified_planning.h"

#include <fcl/narrowphase/collision.h>

#include <random>

#include "catch.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/robot_scene.h"
#include "planning/motion_descent.h"
#include "robot/state_screen.h"
#include "temporary_folder.h"

using namespace fcl_prob;

namespace {

struct PlanScene {
  RobotScene scene = loadRobotScene(std::string(FCL_PROB_SOURCE_DIR) + "/data/arm_plan.json");
  RobotQuery query = loadRobotQuery(scene);
  SelfCollision self = loadSelfCollision(scene, query.robot());
  std::pair<Eigen::VectorXd, Eigen::VectorXd> ends = plannedEnds(scene, query.robot());
  Eigen::VectorXd start = ends.first;
  Eigen::VectorXd goal = ends.second;

  CertifiedPlanningRequest request(std::uint64_t seed) const {
    CertifiedPlanningRequest result;
    result.state = scene.request;
    result.planning.joints = scene.plan->joints;
    result.planning.largest_step = 0.1;  // half the scene's work
    result.planning.max_states = 2'000;
    result.planning.seed = seed;
    return result;
  }

  CertifiedPlan plan(const CertifiedPlanningRequest& asked) const {
    return planCertified(query, self, start, goal, asked);
  }
};

bool touchesDisplaced(const Robot& robot, const std::vector<fcl::Transform3d>& poses,
                      const Obstacle& obstacle, const Eigen::Vector3d& moved) {
  fcl::Transform3d pose = obstacle.pose;
  pose.translation() += moved;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    fcl::CollisionResultd result;
    if (fcl::collide(robot.bodies()[i].geometry.get(), poses[i], obstacle.geometry.get(), pose,
                     fcl::CollisionRequestd(), result) > 0) {
      return true;
    }
  }
  return false;
}

/// How often each state is hit, and how often any is, in so many draws of all obstacles' errors.
struct Counted {
  std::vector<int> by_state;
  int any = 0;
};

Counted countHits(const RobotQuery& query, const std::vector<Eigen::VectorXd>& states, int draws) {
  std::vector<std::vector<fcl::Transform3d>> poses;
  for (const Eigen::VectorXd& values : states) poses.push_back(query.robot().poses(values));
  std::mt19937_64 random(17);
  std::normal_distribution<double> normal;
  Counted counted{std::vector<int>(states.size(), 0)};
  for (int draw = 0; draw < draws; ++draw) {
    std::vector<bool> hit(states.size(), false);
    for (const Obstacle& obstacle : query.obstacles()) {
      const auto& displacement = std::get<GaussianDisplacement>(obstacle.displacement);
      Eigen::Vector3d y;
      for (int k = 0; k < 3; ++k) y[k] = normal(random) * displacement.standardDeviations()[k];
      const Eigen::Vector3d moved = displacement.mean() + displacement.axes() * y;
      for (std::size_t i = 0; i < states.size(); ++i) {
        if (!hit[i]) hit[i] = touchesDisplaced(query.robot(), poses[i], obstacle, moved);
      }
    }
    for (std::size_t i = 0; i < states.size(); ++i) counted.by_state[i] += hit[i];
    counted.any += std::find(hit.begin(), hit.end(), true) != hit.end();
  }
  return counted;
}

}  // namespace

TEST_CASE("a certified plan stays below its threshold, counted at every state") {
  const PlanScene scene;
  const CertifiedPlan plan = scene.plan(scene.request(1));
  REQUIRE(plan.path.status == PlanningStatus::solved);
  CHECK(plan.state_threshold == 0.05);
  CHECK(plan.path.length < plan.path.planned_length);
  CHECK(plan.largest.upper <= 0.05);
  CHECK(plan.motion.upper >= plan.largest.lower);
  const auto states = interpolated(plan.path.waypoints, scene.request(1).planning.largest_step);
  REQUIRE(plan.likeliest < states.size());
  constexpr int kDraws = 1'000;
  const Counted counted = countHits(scene.query, states, kDraws);
  const auto error = [](double p) { return 5.0 * std::sqrt(p / kDraws) + 5.0 / kDraws; };
  for (std::size_t i = 0; i < states.size(); ++i) {
    CHECK_FALSE(scene.self.collides(states[i]));
    const double share = counted.by_state[i] / static_cast<double>(kDraws);
    CHECK(share <= plan.largest.upper + error(plan.largest.upper));
  }
  const double of_likeliest = counted.by_state[plan.likeliest] / static_cast<double>(kDraws);
  CHECK(of_likeliest >= plan.largest.lower - error(plan.largest.upper));
  const double any = counted.any / static_cast<double>(kDraws);
  CHECK(any <= plan.motion.upper + error(plan.motion.upper));
  CHECK(any >= plan.motion.lower - error(plan.motion.upper));
  // Straight ahead the can would meet the pillar.
  CHECK(countHits(scene.query, interpolated({scene.start, scene.goal}, 0.1), 20).any == 20);
}

TEST_CASE("certified plans repeat for a seed") {
  const PlanScene scene;
  CertifiedPlanningRequest request = scene.request(2);
  request.planning.max_states = 700;  // ends amidst the shortening
  const CertifiedPlan plan = scene.plan(request), again = scene.plan(request);
  REQUIRE(plan.path.status == PlanningStatus::solved);
  CHECK(again.path.waypoints == plan.path.waypoints);
  CHECK(again.largest.upper == plan.largest.upper);
  CHECK(again.motion.lower == plan.motion.lower);
}

TEST_CASE("the screen of states tells none that is on the other side of the threshold") {
  const PlanScene scene;
  const detail::StateScreen screen(scene.query.among());
  const auto& joints = scene.query.robot().joints();
  std::mt19937_64 random(6);
  int passed = 0, refused = 0, above = 0;
  for (int i = 0; i < 300; ++i) {
    Eigen::VectorXd values = scene.start;
    for (std::size_t j = 0; j < joints.size(); ++j) {
      values[static_cast<Eigen::Index>(j)] = std::uniform_real_distribution<double>(
          std::max(joints[j].lower, -1.5), std::min(joints[j].upper, 1.5))(random);
    }
    ProbabilityRequest against;
    against.threshold = 0.05;
    const auto told = screen.isBelow(values, against);
    const bool below = told == true;
    passed += below;
    refused += !below;
    if (!below && refused > 20) continue;
    CAPTURE(values.transpose());
    const Decision decision = scene.query.state(values, scene.request(1).state).decision;
    if (below) CHECK(decision == Decision::below);
    ProbabilityRequest interval = scene.request(1).state;
    interval.threshold.reset();
    const Bounds any = scene.query.state(values, interval).any;
    if (below) CHECK(any.lower < 0.05);
    if (decision == Decision::below) CHECK(any.lower < 0.05);
    if (decision == Decision::above) CHECK(any.upper > 0.05);
    if (told == false) CHECK(decision == Decision::above);
    above += told == false;
    against.threshold = 0.0;
    CHECK_FALSE((below && screen.isBelow(values, against) == true));
  }
  CHECK(passed > 100);
  CHECK(refused > 10);
  CHECK(above > 5);
}

TEST_CASE("a whole motion stays below a threshold of its own, or there is no plan") {
  const PlanScene scene;
  CertifiedPlanningRequest request = scene.request(1);
  request.planning.shorten = false;
  request.planning.max_states = 4'000;
  const double without = scene.plan(request).motion.upper;
  request.motion_threshold = 0.8 * without;
  request.descend = false;
  const CertifiedPlan plan = scene.plan(request);
  REQUIRE(plan.path.status == PlanningStatus::solved);
  CHECK(plan.motion.upper < 0.8 * without);
  CHECK_FALSE(plan.descended);
  CHECK(plan.state_threshold < 0.05);
  CHECK(plan.largest.upper <= plan.state_threshold);
  request.motion_threshold = 1e-12;
  request.planning.max_states = 400;
  const CertifiedPlan none = scene.plan(request);
  CHECK(none.path.status != PlanningStatus::solved);
  CHECK(none.path.waypoints.empty());
}

TEST_CASE("a path is moved along the gradient until its motion is below the threshold", "[slow]") {
  const PlanScene scene;
  CertifiedPlanningRequest request = scene.request(1);
  const CertifiedPlan before = scene.plan(request);
  REQUIRE(before.path.status == PlanningStatus::solved);
  request.motion_threshold = 0.5 * before.motion.lower;
  const CertifiedPlan plan = scene.plan(request);
  REQUIRE(plan.path.status == PlanningStatus::solved);
  CAPTURE(before.motion.lower, plan.motion.upper, before.path.length, plan.path.length);
  CHECK(plan.descended);
  CHECK(plan.state_threshold == 0.05);
  CHECK(plan.motion.upper < *request.motion_threshold);
  CHECK(plan.largest.upper < 0.05);
  CHECK(plan.path.waypoints.front() == scene.start);
  CHECK(plan.path.waypoints.back() == scene.goal);
  CHECK(plan.path.length == jointLength(plan.path.waypoints));
  // Not far round: the same path, a little farther out.
  CHECK(plan.path.length < 1.2 * before.path.length);
  for (const Eigen::VectorXd& values : plan.path.waypoints) {
    CHECK(scene.query.robot().isWithinLimits(values));
  }
  const auto states = interpolated(plan.path.waypoints, request.planning.largest_step);
  const Counted counted = countHits(scene.query, states, 2'000);
  const double p = plan.motion.middle();
  CHECK(std::fabs(counted.any / 2'000.0 - p) < 5.0 * std::sqrt(p / 2'000.0) + plan.motion.width());
}

TEST_CASE("a path that is moved along the gradient can be cancelled within a step") {
  const PlanScene scene;
  detail::DescentRequest request;
  request.largest_step = 0.1;
  request.moving = {0, 1, 2};
  int calls = 0;
  int last = 1'000'000;
  request.go_on = [&] { return ++calls < last; };
  const auto descend = [&] {
    return detail::descended(scene.query, {scene.start, scene.goal}, request);
  };
  REQUIRE(descend());  // at once: every path is below 1
  // Once before each step is not all.
  last = 2;
  calls = 0;
  CHECK(!descend());
  CHECK(calls == 2);
}

TEST_CASE("certified plans refuse what makes no sense") {
  const PlanScene scene;
  CertifiedPlanningRequest request = scene.request(1);
  request.state.threshold.reset();
  CHECK_THROWS_AS(scene.plan(request), InvalidRequest);
  request = scene.request(1);
  request.motion_threshold = 0.0;
  CHECK_THROWS_AS(scene.plan(request), InvalidRequest);
  request = scene.request(1);
  const fcl_prob_test::TemporaryFolder folder;
  const SelfCollision other(
      Robot(folder.write("ball.urdf",
                         "<robot name=\"ball\"><link name=\"a\"><collision><geometry><sphere "
                         "radius=\"1\"/></geometry></collision></link></robot>")));
  CHECK_THROWS_AS(planCertified(scene.query, other, scene.start, scene.goal, request),
                  InvalidRequest);
  Obstacle moving = scene.query.obstacles()[0];
  moving.over_time.push_back({moving.pose, moving.displacement});
  CHECK_THROWS_AS(planCertified(RobotQuery(scene.query.robot(), {moving}), scene.self, scene.start,
                                scene.goal, request),
                  InvalidRequest);
  // A start that collides with itself: closed fingers may, a hand through the base may not.
  const Eigen::VectorXd folded =
      scene.query.robot().values({{"shoulder", 1.2}, {"elbow", 2.4}, {"grip", 0.035}});
  REQUIRE(scene.self.collides(folded));
  CHECK(planCertified(scene.query, scene.self, folded, scene.goal, request).path.status ==
        PlanningStatus::start_refused);
}

TEST_CASE("a plan with errors of the joints stays below its threshold, counted with them") {
  const PlanScene scene;
  CertifiedPlanningRequest request = scene.request(1);
  const double deviation = 0.008;
  request.errors.joints =
      jointCovariance(scene.query.robot(), {{"turn", deviation}, {"shoulder", deviation}});
  const CertifiedPlan plan = scene.plan(request);
  REQUIRE(plan.path.status == PlanningStatus::solved);
  CHECK(plan.largest.upper <= 0.05);
  CHECK(plan.motion.upper == 1.0);
  constexpr int kDraws = 300;
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  const Robot& robot = scene.query.robot();
  for (const Eigen::VectorXd& values : interpolated(plan.path.waypoints, 0.2)) {
    int hits = 0;
    for (int i = 0; i < kDraws; ++i) {
      Eigen::VectorXd drawn = values;
      for (const char* name : {"turn", "shoulder"}) {
        for (std::size_t k = 0; k < robot.joints().size(); ++k) {
          if (robot.joints()[k].name == name)
            drawn[static_cast<Eigen::Index>(k)] += deviation * normal(random);
        }
      }
      const auto poses = robot.poses(drawn);
      bool hit = false;
      for (const Obstacle& obstacle : scene.query.obstacles()) {
        const auto& error = std::get<GaussianDisplacement>(obstacle.displacement);
        Eigen::Vector3d y;
        for (int k = 0; k < 3; ++k) y[k] = normal(random) * error.standardDeviations()[k];
        hit = hit || touchesDisplaced(robot, poses, obstacle, error.mean() + error.axes() * y);
      }
      hits += hit;
    }
    CHECK(hits / static_cast<double>(kDraws) <= 0.05 + 5.0 * std::sqrt(0.05 / kDraws));
  }
  request.motion_threshold = 0.1;
  CHECK_THROWS_AS(scene.plan(request), InvalidRequest);
}

TEST_CASE("what a plan certifies keeps to its limits, too") {
  const PlanScene scene;
  CertifiedPlanningRequest request = scene.request(1);
  request.planning.shorten = false;
  const Bounds known = scene.plan(request).motion;
  // Without a limit this would take hours.
  request.state.relative_tolerance = 1e-9;
  request.state.absolute_tolerance = 0.0;
  request.state.max_cells = 1'000'000'000;
  bool cancelled = false;
  std::size_t states = 0;
  request.planning.on_progress = [&](const PlanningProgress& progress) {
    // The path is found: the states are asked for no more, and the motion is.
    cancelled = cancelled || (progress.shortening && progress.states == states);
    states = progress.states;
    return !cancelled;
  };
  const CertifiedPlan plan = scene.plan(request);
  CHECK(cancelled);
  REQUIRE(plan.path.status == PlanningStatus::solved);
  CHECK(plan.motion.lower <= known.upper);
  CHECK(plan.motion.upper >= known.lower);
  CHECK(plan.largest.upper <= plan.state_threshold);
  CHECK(plan.largest.lower <= plan.largest.upper);

  request.planning.on_progress = nullptr;
  request.planning.time_limit = 3.0;
  const CertifiedPlan timed = scene.plan(request);
  if (timed.path.status == PlanningStatus::solved) {
    CHECK(timed.motion.lower <= known.upper);
    CHECK(timed.motion.upper >= known.lower);
  } else {
    CHECK(timed.path.status == PlanningStatus::time_limit);
  }
}

TEST_CASE("who cancels a plan is not asked again, in whatever part of it") {
  const PlanScene scene;
  CertifiedPlanningRequest request = scene.request(1);
  request.planning.shorten = false;
  request.planning.max_states = 300;
  int calls = 0, last = 1'000'000'000, after = 0;
  request.planning.on_progress = [&](const PlanningProgress&) {
    after += calls >= last;
    return ++calls < last;
  };
  scene.plan(request);
  const int all = calls;
  REQUIRE(all > 10);
  for (const int of_ten : {0, 3, 6, 9}) {
    last = std::max(1, all * of_ten / 10);
    calls = after = 0;
    scene.plan(request);
    CAPTURE(all, last);
    CHECK(calls == last);
    CHECK(after == 0);
  }
}
