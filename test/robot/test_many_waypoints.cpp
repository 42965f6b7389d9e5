// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Motions of hundreds of waypoints, errors the same all along: taken together, or as what bodies
// sweep where memory is short.
#include "arm_motions.h"
#include "robot/moving_obstacle.h"
#include "robot/robot_among_obstacles.h"
#include "robot/swept_motion.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

constexpr int kDraws = 4'000;

// So far that the motion touches one with 2 and the other one with 25 %.
std::vector<Obstacle> besideTheArm() {
  std::vector<Obstacle> obstacles = ballAndBox();
  obstacles[0].pose.translation().z() += 0.1;
  obstacles[1].pose.translation().y() -= 0.35;
  return obstacles;
}

bool holds(const Bounds& bounds, double share) {
  const double error = 5.0 * std::sqrt(share * (1.0 - share) / kDraws) + 5.0 / kDraws;
  return bounds.lower <= share + error && bounds.upper >= share - error;
}

}  // namespace

TEST_CASE("hundreds of waypoints hold what is counted, together or as what is swept") {
  const RobotQuery query(shippedArm(), besideTheArm());
  const auto waypoints = sweep(query.robot(), 150);
  const double share = counted(query, waypoints, kDraws, 3);
  REQUIRE(share > 0.01);
  REQUIRE(share < 0.9);
  const RobotResult together =
      query.motion(waypoints, ErrorsOverTime::persistent, withTolerance(0.05));
  CAPTURE(share, together.any.lower, together.any.upper, toString(together.status));
  CHECK(together.status == ProbabilityStatus::converged);
  CHECK(together.any.width() <= 0.05 * together.any.upper);
  CHECK(holds(together.any, share));
  const detail::RobotAmongObstacles among(query.robot(), besideTheArm(), {}, nullptr);
  const ProbabilityRequest request = withTolerance(0.05);
  for (std::size_t i = 0; i < 2; ++i) {
    const Obstacle& obstacle = among.obstacles()[i];
    const detail::SweptPath path(among.robot(), among.balls(), waypoints, among.bodiesOf(i),
                                 obstacle, BetweenWaypoints::ignored);
    const ProbabilityResult swept =
        detail::sweptMotion(path, among.sceneOf(i), detail::stateAt(obstacle, 0), 0.0, {0.0, 1.0},
                            request)
            .result;
    const ProbabilityResult& part = together.parts[i];
    CAPTURE(i, *swept.lower, *swept.upper, *part.lower, *part.upper, toString(swept.status));
    CHECK(overlap({*swept.lower, *swept.upper}, {*part.lower, *part.upper}));
    CHECK(swept.status == ProbabilityStatus::converged);
    CHECK(*swept.upper - *swept.lower <= 0.05 * *swept.upper);
  }
}

TEST_CASE("a threshold for hundreds of waypoints is decided as their probability says") {
  const RobotQuery query(shippedArm(), besideTheArm());
  const auto waypoints = sweep(query.robot(), 150);
  const Bounds known = query.motion(waypoints, ErrorsOverTime::persistent, withTolerance(0.02)).any;
  for (const double factor : {0.5, 0.9, 1.1, 2.0}) {
    ProbabilityRequest request;
    request.threshold = factor * 0.5 * (known.lower + known.upper);
    REQUIRE(*request.threshold < 1.0);
    const RobotResult result = query.motion(waypoints, ErrorsOverTime::persistent, request);
    CAPTURE(factor, known.lower, known.upper, result.any.lower, result.any.upper);
    CHECK(result.decision == (factor < 1.0 ? Decision::above : Decision::below));
  }
}

TEST_CASE("a body that stays is placed once, and what moves in the order of time") {
  const detail::RobotAmongObstacles among(shippedArm(), ballAndBox(), {}, nullptr);
  auto waypoints = sweep(among.robot(), 10);
  for (Eigen::VectorXd& values : waypoints) values = waypoints[0];
  waypoints.back() = sweep(among.robot(), 10).back();
  const auto relative = among.relativeTo(waypoints, -1);
  REQUIRE(relative.size() == 2);
  for (const auto& placed : relative) {
    std::size_t at = 0;
    for (const std::size_t body : among.bodiesOf(0)) {
      REQUIRE(at < placed.size());
      CHECK(placed[at].body == body);
      CHECK(placed[at++].pose.matrix() == among.robot().poses(waypoints[0])[body].matrix());
      const fcl::Transform3d last = among.robot().poses(waypoints.back())[body];
      if (last.matrix() == placed[at - 1].pose.matrix()) continue;
      REQUIRE(at < placed.size());
      CHECK(placed[at++].pose.matrix() == last.matrix());
    }
    CHECK(at == placed.size());
  }
}
