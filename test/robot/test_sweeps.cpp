// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Continuous time: what is said of all times against many times in between.
#include <fcl/geometry/shape/halfspace.h>

#include "arm_motions.h"
#include "fcl_prob/exceptions.h"
#include "robot/body_sweep.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

Eigen::VectorXd atTime(const std::vector<Eigen::VectorXd>& waypoints, double t) {
  const auto last = static_cast<double>(waypoints.size() - 1);
  const auto i = static_cast<std::size_t>(std::min(t * last, last - 1.0));
  return waypoints[i] + (t * last - static_cast<double>(i)) * (waypoints[i + 1] - waypoints[i]);
}

std::vector<Eigen::VectorXd> manyTimes(const std::vector<Eigen::VectorXd>& waypoints, int count) {
  std::vector<Eigen::VectorXd> states;
  for (int i = 0; i <= count; ++i) {
    states.push_back(atTime(waypoints, i / static_cast<double>(count)));
  }
  return states;
}

std::vector<Eigen::VectorXd> randomMotion(const Robot& arm, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<Eigen::VectorXd> waypoints;
  for (int i = 0; i < 3; ++i) {
    waypoints.push_back(arm.values({{"turn", 0.2 + 0.5 * uniform(random)},
                                    {"shoulder", 0.1 + 0.2 * uniform(random)},
                                    {"elbow", 0.4 + 0.3 * uniform(random)},
                                    {"roll", uniform(random)},
                                    {"bend", 0.5 * uniform(random)},
                                    {"grip", 0.02 + 0.02 * uniform(random)}}));
  }
  return waypoints;
}

RobotResult continuous(const RobotQuery& query, const std::vector<Eigen::VectorXd>& waypoints,
                       const ProbabilityRequest& request) {
  return query.motion(waypoints, ErrorsOverTime::persistent, request, BetweenWaypoints::swept);
}

std::vector<Obstacle> ballOnly() {
  std::vector<Obstacle> obstacles = ballAndBox();
  obstacles.pop_back();
  return obstacles;
}

void checkMotions(int motions, unsigned seed) {
  const RobotQuery query(shippedArm(), ballOnly());
  std::mt19937_64 random(seed);
  int seen = 0;
  for (int i = 0; i < motions; ++i) {
    const auto waypoints = randomMotion(query.robot(), random);
    const RobotResult result = continuous(query, waypoints, withTolerance(0.05));
    CAPTURE(i, toString(result.status));
    CHECK(result.status == ProbabilityStatus::converged);
    const bool tells = result.any.upper > 0.01 && result.any.lower < 0.99;
    if (!tells) continue;
    ++seen;
    constexpr int kDraws = 100;
    checkCounted(result.any, counted(query, manyTimes(waypoints, 2'000), kDraws, 32), kDraws);
  }
  CHECK(4 * seen >= motions);
}

}  // namespace

TEST_CASE("no point of a body leaves what its sweep says") {
  const Robot arm = shippedArm();
  std::mt19937_64 random(21);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  double closest_reach = 0.0, closest_ball = 0.0;
  for (int i = 0; i < 300; ++i) {
    detail::JointStep step{
        randomValues(arm, random), Eigen::VectorXd::Zero(6), {}, Eigen::VectorXd::Zero(6)};
    const double size = std::pow(10.0, -3.0 * std::fabs(uniform(random)));
    for (int k = 0; k < 6; ++k) step.half[k] = size * uniform(random);
    step.sizes = step.middle.cwiseAbs();
    const auto body = static_cast<std::size_t>(i) % arm.bodies().size();
    const detail::Ball ball{Eigen::Vector3d(0.01, -0.02, 0.03), 0.2};
    const fcl::Transform3d middle = arm.poses(step.middle)[body];
    const detail::BodySweep sweep = detail::sweepOf(arm, body, middle, ball, step);
    for (int j = 0; j < 40; ++j) {
      const Eigen::Vector3d off(uniform(random), uniform(random), uniform(random));
      const Eigen::Vector3d point = ball.centre + 0.2 * off / std::max(1.0, off.norm());
      const double s = j < 2 ? 2.0 * j - 1.0 : uniform(random);
      const Eigen::Vector3d x = middle * point;
      const Eigen::Vector3d moved = arm.poses(step.middle + s * step.half)[body] * point - x;
      if (sweep.reach == 0.0) {
        CHECK(moved.norm() == 0.0);
        continue;
      }
      const Eigen::Vector3d linear =
          sweep.motion.shifts[0] + sweep.motion.turns[0].cross(x - sweep.motion.centre);
      CHECK(moved.norm() <= sweep.reach);
      CHECK((moved - s * linear).norm() <= sweep.motion.ball);
      CHECK((middle * ball.centre + moved - sweep.around.centre).norm() <= sweep.around.radius);
      closest_reach = std::max(closest_reach, moved.norm() / sweep.reach);
      closest_ball = std::max(closest_ball, (moved - s * linear).norm() / sweep.motion.ball);
    }
  }
  CHECK(closest_reach > 0.5);
  CHECK(closest_ball > 0.2);
}

TEST_CASE("continuous time is above ten times as many waypoints, and within the tolerance") {
  const RobotQuery query(shippedArm(), ballAndBox());
  for (const int count : {2, 5}) {
    const auto waypoints = sweep(query.robot(), count);
    const RobotResult result = continuous(query, waypoints, withTolerance(0.03));
    CHECK(result.status == ProbabilityStatus::converged);
    CHECK(result.any.width() <= 0.03 * result.any.upper);
    REQUIRE(result.swept_band);
    CHECK(*result.swept_band > 0.0);
    CHECK(result.swept_steps > 20);
    // As many states as continuous time has looked at are ten times coarser than these.
    const RobotResult fine =
        query.motion(manyTimes(waypoints, 300), ErrorsOverTime::persistent, withTolerance(0.01));
    CAPTURE(count, result.any.lower, result.any.upper, fine.any.lower, fine.any.upper);
    CHECK(fine.any.lower <= result.any.upper);
    CHECK(result.any.lower <= fine.any.upper * 1.01);
    const RobotResult coarse =
        query.motion(waypoints, ErrorsOverTime::persistent, withTolerance(0.01));
    CHECK(coarse.any.lower <= result.any.upper);
  }
}

TEST_CASE("continuous time holds what counting finds at 2,000 interpolated states", "[slow]") {
  checkMotions(8, 31);
}

TEST_CASE("continuous time holds what counting finds, on 40 motions", "[long]") {
  checkMotions(40, 32);
}

TEST_CASE("a threshold in continuous time is decided as the probability says, with less work") {
  std::vector<Obstacle> obstacles = ballAndBox();
  obstacles[0].pose.translation().z() += 0.05;
  obstacles[1].pose.translation().x() += 0.55;
  const RobotQuery query(shippedArm(), obstacles);
  const auto waypoints = sweep(query.robot(), 3);
  const RobotResult known = continuous(query, waypoints, withTolerance(0.03));
  CAPTURE(known.any.lower, known.any.upper);
  CHECK(known.any.upper < 0.5);
  std::size_t all_cells = 0;
  for (const auto& part : known.parts) all_cells += part.statistics.cells;
  for (const double factor : {0.3, 2.0}) {
    ProbabilityRequest request = withTolerance(0.03);
    request.threshold = factor * known.any.upper;
    const RobotResult decided = continuous(query, waypoints, request);
    CHECK(decided.status == ProbabilityStatus::decided);
    CHECK(decided.decision == (factor < 1.0 ? Decision::above : Decision::below));
    std::size_t cells = 0;
    for (const auto& part : decided.parts) cells += part.statistics.cells;
    CHECK(cells < all_cells);
  }
}

TEST_CASE("limits stop continuous time with an interval that holds") {
  const RobotQuery query(shippedArm(), ballOnly());
  const auto waypoints = sweep(query.robot(), 3);
  const RobotResult known = continuous(query, waypoints, withTolerance(0.05));
  ProbabilityRequest request = withTolerance(0.001);
  request.max_cells = 2'000;
  const RobotResult few = continuous(query, waypoints, request);
  CHECK(few.status == ProbabilityStatus::cell_limit);
  CHECK(overlap(few.any, known.any));
  request = withTolerance(0.001);
  request.max_memory = 100'000;
  const RobotResult small = continuous(query, waypoints, request);
  CHECK(small.status == ProbabilityStatus::memory_limit);
  CHECK(overlap(small.any, known.any));
  request = withTolerance(0.001);
  request.on_progress = [](const ProbabilityProgress&) { return false; };
  const RobotResult cancelled = continuous(query, waypoints, request);
  CHECK(cancelled.status == ProbabilityStatus::cancelled);
  CHECK(overlap(cancelled.any, known.any));
}

TEST_CASE("a motion that stands still is a state, and one without errors is certain") {
  std::vector<Obstacle> obstacles = ballOnly();
  const Robot arm = shippedArm();
  const Eigen::VectorXd values = arm.values({{"turn", 0.4}, {"shoulder", 0.15}, {"elbow", 0.3}});
  const RobotQuery query(arm, obstacles);
  const Bounds state = query.state(values, withTolerance(0.02)).any;
  for (const auto& waypoints : {std::vector{values}, std::vector{values, values, values}}) {
    const RobotResult still = continuous(query, waypoints, withTolerance(0.02));
    CHECK(overlap(still.any, state));
    CHECK(*still.swept_band == 0.0);
    CHECK(still.any.width() <= 0.02 * still.any.upper);
  }
  // Without errors: the hand passes through the ball, or above it.
  obstacles[0].displacement = GaussianDisplacement();
  const auto past = sweep(arm, 2);
  const Eigen::VectorXd between = 0.5 * (past[0] + past[1]);
  obstacles[0].pose.translation() = arm.linkPose("hand", between).translation();
  const RobotResult hit = continuous(RobotQuery(arm, obstacles), past, withTolerance(0.02));
  CHECK(hit.any.lower > 1.0 - 1e-12);
  obstacles[0].pose.translation().z() += 0.4;
  const RobotResult free = continuous(RobotQuery(arm, obstacles), past, withTolerance(0.02));
  CHECK(free.any.upper < 1e-12);
}

TEST_CASE("a half-space, a mixture and a truncated error know continuous time") {
  const Robot arm = shippedArm();
  const std::vector<Eigen::VectorXd> waypoints{
      arm.values({{"shoulder", -0.1}, {"elbow", 0.3}}),
      arm.values({{"shoulder", 0.25}, {"elbow", 0.2}, {"turn", 0.4}})};
  const auto floor = std::make_shared<fcl::Halfspaced>(Eigen::Vector3d(0, 0, 1), 0.0);
  const GaussianDisplacement gaussian = sigma(0.02, 0.02, 0.04);
  const auto answer = [&](const Displacement& displacement) {
    RobotQuery query(shippedArm({"hand", "wrist", "left_finger"}),
                     {{"floor", floor, at(0, 0, 0.01), displacement}});
    const RobotResult result = continuous(query, waypoints, withTolerance(0.02));
    CHECK(result.status == ProbabilityStatus::converged);
    const RobotResult fine =
        query.motion(manyTimes(waypoints, 60), ErrorsOverTime::persistent, withTolerance(0.02));
    CHECK(overlap(result.any, fine.any));
    return result.any;
  };
  const Bounds plain = answer(gaussian);
  CHECK(plain.lower > 1e-3);
  CHECK(plain.upper < 0.99);
  CHECK(overlap(plain, answer(GaussianMixture({{0.25, gaussian}, {0.75, gaussian}}))));
  CHECK(overlap(plain, answer(TruncatedGaussian(gaussian, 9.0))));
}

TEST_CASE("what continuous time cannot mean is refused") {
  const RobotQuery query(shippedArm(), ballAndBox());
  const auto waypoints = sweep(query.robot(), 2);
  CHECK_THROWS_AS(query.motion(waypoints, ErrorsOverTime::independent, {}, BetweenWaypoints::swept),
                  InvalidRequest);
  ProbabilityRequest estimate;
  estimate.method = ProbabilityMethod::estimate;
  CHECK_THROWS_AS(continuous(query, waypoints, estimate), InvalidRequest);
  CHECK_THROWS_AS(continuous(query, {}, {}), InvalidRequest);
  CHECK_THROWS_AS(continuous(query, {waypoints[0], Eigen::VectorXd::Zero(2)}, {}), InvalidRequest);
}
