// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/robot_query.h"

#include <algorithm>
#include <deque>

#include "fcl_prob/exceptions.h"
#include "fcl_prob/group.h"
#include "geometry/validation.h"
#include "query/prepared_geometry.h"
#include "request/refuse_band.h"
#include "robot/body_balls.h"
#include "robot/obstacle_answer.h"
#include "robot/reversed.h"
#include "robot/swept_motion.h"

namespace fcl_prob {
namespace {

using detail::Ball;
using Poses = std::vector<fcl::Transform3d>;

/// Of the absolute tolerance: what all bodies that are left out may add up to.
constexpr double kShareOfFar = 0.05;

void ask(const GroupQuery& query, const Poses& bodies, const Poses& obstacle,
         const GaussianDisplacement& displacement, const ProbabilityRequest& request,
         ProbabilityResult& result) {
  query.collisionProbability(bodies, obstacle, displacement, request, result);
}

template <typename Other>
void ask(const GroupQuery& query, const Poses& bodies, const Poses& obstacle,
         const Other& displacement, const ProbabilityRequest& request, ProbabilityResult& result) {
  collisionProbability(query, bodies, obstacle, displacement, request, result);
}

/// A body of the robot at one of the waypoints.
struct PlacedBody {
  std::size_t body;
  fcl::Transform3d pose;
  double far_upper;  ///< bound on its own probability
};

/// What was left out of one query.
struct FarBodies {
  std::size_t count = 0;
  double upper = 0.0;
};

void addUp(const std::vector<FarBodies>& far, RobotResult& result) {
  for (const FarBodies& of_one : far) {
    result.far_bodies += of_one.count;
    result.far_upper += of_one.upper;
  }
}

void requireContinuous(ErrorsOverTime errors, const ProbabilityRequest& request) {
  if (errors != ErrorsOverTime::persistent) {
    throw InvalidRequest(
        "between waypoints only persistent errors have a probability: there is no end to how often "
        "others are drawn in a continuous time");
  }
  if (request.method != ProbabilityMethod::interval &&
      request.method != ProbabilityMethod::automatic) {
    throw InvalidRequest("method " + toString(request.method) +
                         " cannot answer for what is between waypoints, only interval and auto");
  }
}

}  // namespace

struct RobotQuery::Implementation {
  Implementation(const Robot& the_robot, std::vector<Obstacle> the_obstacles)
      : robot(the_robot), obstacles(std::move(the_obstacles)) {
    if (obstacles.empty()) throw InvalidRequest("a robot query needs an obstacle");
    for (const RobotBody& body : robot.bodies()) {
      geometries.emplace_back(body.geometry, "a body of link " + body.link);
      balls.push_back(detail::ballAround(geometries.back()));
    }
    for (const Obstacle& obstacle : obstacles) {
      detail::validatePose(obstacle.pose, "obstacle " + obstacle.name);
      obstacle_geometries.emplace_back(obstacle.geometry, "obstacle " + obstacle.name);
      obstacle_balls.push_back(
          detail::ballAround(obstacle_geometries.back()).placed(obstacle.pose));
    }
  }

  void validate(const std::vector<Eigen::VectorXd>& waypoints,
                const ProbabilityRequest& request) const {
    validateRequest(request);
    detail::refuseBand(request, "robots");
    if (waypoints.empty()) throw InvalidRequest("a motion needs a waypoint");
    for (const Eigen::VectorXd& values : waypoints) robot.validate(values);
  }

  std::vector<PlacedBody> placed(const std::vector<Eigen::VectorXd>& waypoints) const {
    std::vector<PlacedBody> result;
    for (const Eigen::VectorXd& values : waypoints) {
      const Poses poses = robot.poses(values);
      for (std::size_t i = 0; i < poses.size(); ++i) result.push_back({i, poses[i], 0.0});
    }
    return result;
  }

  /// Leaves out the bodies that are so far from an obstacle that together they hardly matter.
  /// \return  bound on P that any of them touches it
  double leaveOutFar(std::size_t obstacle, double most, std::vector<PlacedBody>& bodies) const {
    for (PlacedBody& body : bodies) {
      body.far_upper =
          detail::farContactUpper(balls[body.body].placed(body.pose), obstacle_balls[obstacle],
                                  obstacles[obstacle].displacement);
    }
    std::stable_sort(bodies.begin(), bodies.end(), [](const PlacedBody& x, const PlacedBody& y) {
      return x.far_upper > y.far_upper;
    });
    double sum = 0.0;
    while (!bodies.empty()) {
      const double next = (sum + bodies.back().far_upper) * (1.0 + 1e-15);
      if (next > most) break;
      sum = next;
      bodies.pop_back();
    }
    return sum;
  }

  /// P that any of the placed bodies touches one obstacle.
  void askObstacle(std::size_t index, std::vector<PlacedBody> bodies,
                   const ProbabilityRequest& request, FarBodies& left_out,
                   ProbabilityResult& result) const {
    const std::size_t all = bodies.size();
    const double far = leaveOutFar(index, kShareOfFar * request.absolute_tolerance, bodies);
    left_out = {all - bodies.size(), far};
    const Obstacle& obstacle = obstacles[index];
    if (bodies.empty()) {
      result.lower = 0.0;
      result.upper = far;
      if (request.method == ProbabilityMethod::estimate) {
        result.estimate = 0.5 * far;
        result.standard_error = 0.5 * far;
      }
      result.plan.push_back("all bodies are far from it: bounded by balls around them");
      return;
    }
    GroupQuery::Geometries geometries;
    Poses poses;
    for (const PlacedBody& body : bodies) {
      geometries.push_back(robot.bodies()[body.body].geometry);
      poses.push_back(body.pose);
    }
    const GroupQuery query(std::move(geometries), {obstacle.geometry});
    std::visit(
        [&](const auto& displacement) {
          ask(query, poses, {obstacle.pose}, detail::reversed(displacement), request, result);
        },
        obstacle.displacement);
    if (far > 0.0 && result.upper) {
      result.upper = std::min(1.0, (*result.upper + far) * (1.0 + 1e-15));
    }
  }

  RobotResult ofAll(const std::vector<PlacedBody>& bodies,
                    const ProbabilityRequest& request) const {
    std::vector<FarBodies> far(obstacles.size());
    RobotResult result = detail::anyOfAsked(
        obstacles.size(), request,
        [&](std::size_t i, const ProbabilityRequest& of_one, ProbabilityResult& answer) {
          askObstacle(i, bodies, of_one, far[i], answer);
        });
    addUp(far, result);
    return result;
  }

  /// At any time: what the bodies sweep between the waypoints, too.
  RobotResult ofAllTimes(const std::vector<Eigen::VectorXd>& waypoints,
                         const ProbabilityRequest& request) const {
    const detail::SweptPath path(robot, balls, waypoints);
    std::vector<detail::SweptAnswer> answers(obstacles.size());
    RobotResult result = detail::anyOfAsked(
        obstacles.size(), request,
        [&](std::size_t i, const ProbabilityRequest& of_one, ProbabilityResult& answer) {
          const Obstacle& obstacle = obstacles[i];
          answers[i] = detail::sweptMotion(
              path, geometries, {obstacle_geometries[i], obstacle.pose, obstacle.displacement},
              obstacle_balls[i], kShareOfFar * of_one.absolute_tolerance, of_one);
          answer = answers[i].result;
        });
    result.swept_band = 0.0;
    for (const detail::SweptAnswer& answer : answers) {
      result.swept_band = std::max(*result.swept_band, answer.reach);
      result.swept_steps += answer.steps;
      result.far_bodies += answer.far;
      result.far_upper += answer.far_upper;
    }
    return result;
  }

  Robot robot;
  std::vector<Obstacle> obstacles;
  std::deque<detail::PreparedGeometry> geometries;  ///< of the robot's bodies
  std::deque<detail::PreparedGeometry> obstacle_geometries;
  std::vector<Ball> balls;           ///< of the robot's bodies, in their frames
  std::vector<Ball> obstacle_balls;  ///< world frame
};

RobotQuery::RobotQuery(const Robot& robot, std::vector<Obstacle> obstacles)
    : implementation_(std::make_unique<const Implementation>(robot, std::move(obstacles))) {}
RobotQuery::~RobotQuery() = default;
RobotQuery::RobotQuery(RobotQuery&&) noexcept = default;
RobotQuery& RobotQuery::operator=(RobotQuery&&) noexcept = default;

const Robot& RobotQuery::robot() const { return implementation_->robot; }
const std::vector<Obstacle>& RobotQuery::obstacles() const { return implementation_->obstacles; }

RobotResult RobotQuery::state(const Eigen::VectorXd& values,
                              const ProbabilityRequest& request) const {
  return motion({values}, ErrorsOverTime::persistent, request);
}

RobotResult RobotQuery::motion(const std::vector<Eigen::VectorXd>& waypoints, ErrorsOverTime errors,
                               const ProbabilityRequest& request, BetweenWaypoints between) const {
  implementation_->validate(waypoints, request);
  if (between == BetweenWaypoints::swept) {
    requireContinuous(errors, request);
    return implementation_->ofAllTimes(waypoints, request);
  }
  if (errors == ErrorsOverTime::persistent)
    return implementation_->ofAll(implementation_->placed(waypoints), request);
  const std::size_t obstacles = implementation_->obstacles.size();
  std::vector<FarBodies> far(waypoints.size() * obstacles);
  RobotResult result = detail::anyOfAsked(
      far.size(), request,
      [&](std::size_t i, const ProbabilityRequest& of_one, ProbabilityResult& answer) {
        const auto bodies = implementation_->placed({waypoints[i / obstacles]});
        implementation_->askObstacle(i % obstacles, bodies, of_one, far[i], answer);
      });
  addUp(far, result);
  return result;
}

std::vector<RobotResult> RobotQuery::byBody(const std::vector<Eigen::VectorXd>& waypoints,
                                            const ProbabilityRequest& request) const {
  implementation_->validate(waypoints, request);
  std::vector<std::vector<PlacedBody>> by_body(robot().bodies().size());
  for (PlacedBody& body : implementation_->placed(waypoints)) by_body[body.body].push_back(body);
  std::vector<RobotResult> results;
  for (const auto& bodies : by_body) results.push_back(implementation_->ofAll(bodies, request));
  return results;
}

}  // namespace fcl_prob
