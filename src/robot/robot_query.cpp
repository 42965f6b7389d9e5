// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/robot_query.h"

#include <algorithm>

#include "base/budget.h"
#include "base/random_words.h"
#include "base/refuse_band.h"
#include "base/until_no.h"
#include "fcl_prob/combined_bounds.h"
#include "fcl_prob/exceptions.h"
#include "io/import_notes.h"
#include "query/motion_gradient.h"
#include "robot/certified_motion.h"
#include "robot/gradient_parts.h"
#include "robot/many_states.h"
#include "robot/moving_obstacle.h"
#include "robot/obstacle_answer.h"
#include "robot/obstacle_gradient.h"
#include "robot/obstacle_motion.h"
#include "robot/placed_query.h"
#include "robot/probable_answer.h"
#include "robot/robot_among_obstacles.h"
#include "robot/robot_notes.h"
#include "robot/state_screen.h"
#include "robot/state_with_errors.h"

namespace fcl_prob {
namespace {

using detail::FarBodies;
using detail::PlacedBody;

// Fewer states are not worth finding out what bodies that stay in all of them may touch.
constexpr Eigen::Index kManyStates = 4;

// A body that is no likelier to touch an obstacle has no part in a gradient.
constexpr double kNoGradient = 1e-12;

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

/// Of events by waypoint, and for each by obstacle: the errors of an obstacle at one waypoint may
/// have anything to do with those at another, but nothing with those of other obstacles.
Bounds ofAnyDependence(const std::vector<Bounds>& events, std::size_t obstacles) {
  std::vector<Bounds> by_obstacle;
  for (std::size_t i = 0; i < obstacles; ++i) {
    std::vector<Bounds> of_one;
    for (std::size_t k = i; k < events.size(); k += obstacles) of_one.push_back(events[k]);
    by_obstacle.push_back(anyOf(of_one));
  }
  return anyOfIndependent(by_obstacle);
}

/// A certified answer as one that might have been probable.
ProbableResult certainly(const RobotResult& result) {
  ProbableResult same;
  if (result.decision == Decision::below) same.decision = ProbableDecision::certainly_below;
  if (result.decision == Decision::above) same.decision = ProbableDecision::certainly_above;
  same.certified = result.any;
  same.probable = result.any;
  same.status = result.status;
  for (const ProbabilityResult& part : result.parts) same.cells += part.statistics.cells;
  return same;
}

void addWaypoints(std::size_t obstacles, RobotResult& result) {
  std::vector<Bounds> events;
  for (const ProbabilityResult& part : result.parts) {
    events.push_back({part.lower.value_or(0.0), part.upper.value_or(1.0)});
  }
  for (auto first = events.begin(); first != events.end();) {
    const auto last = first + static_cast<std::ptrdiff_t>(obstacles);
    result.by_waypoint.push_back(anyOfIndependent({first, last}));
    first = last;
  }
  result.any_dependence = ofAnyDependence(events, obstacles);
}

}  // namespace

struct RobotQuery::Implementation {
  explicit Implementation(detail::RobotAmongObstacles of) : among(std::move(of)) {}

  void validate(const ProbabilityRequest& request) const {
    validateRequest(request);
    detail::refuseBand(request, "robots");
    if (request.gradient) {
      throw InvalidRequest("a gradient was asked for: robots have none");
    }
    // Open meshes are refused wherever they are.
    for (const auto& geometry : among.geometries()) geometry->solid(request.contact);
    for (std::size_t i = 0; i < obstacles().size(); ++i) {
      for (const auto& geometry : among.preparedObstacle(i).geometries()) {
        geometry->solid(request.contact);
      }
    }
  }

  void validate(const std::vector<Eigen::VectorXd>& waypoints,
                const ProbabilityRequest& request) const {
    validate(request);
    if (waypoints.empty()) throw InvalidRequest("a motion needs a waypoint");
    detail::requireWithinLimits(among.robot(), waypoints);
    for (const Obstacle& obstacle : obstacles()) detail::requireStates(obstacle, waypoints.size());
  }

  const std::vector<Obstacle>& obstacles() const { return among.obstacles(); }

  void addNotes(const ProbabilityRequest& request, RobotResult& result) const {
    result.plan = among.notes();
    const double tolerance = request.toleranceAt(result.estimate.value_or(result.any.upper));
    detail::addNotes(detail::precisionNotes(among.robot(), obstacles(), tolerance), result.plan);
  }

  /// What half-spaces say of an event, before any of `count` is asked. (A single one begins with
  /// them itself, and estimates are of what is likely.)
  Bounds cheapBounds(std::size_t obstacle, const ObstacleState& state,
                     std::vector<PlacedBody> bodies, std::size_t count,
                     const ProbabilityRequest& request) const {
    if (count == 1 || request.method == ProbabilityMethod::estimate) return {0.0, 1.0};
    return {0.0, detail::unlikelyUpper(among.sceneOf(obstacle), state, std::move(bodies))};
  }

  ProbabilityResult askObstacle(std::size_t index, const ObstacleState& state,
                                std::vector<PlacedBody> bodies, const ProbabilityRequest& request,
                                FarBodies& left_out) const {
    return detail::placedProbability(among.sceneOf(index), state, std::move(bodies), request,
                                     left_out);
  }

  RobotResult ofUnion(const std::vector<Eigen::VectorXd>& waypoints, int body,
                      const ProbabilityRequest& request) const {
    const auto relative = among.relativeTo(waypoints, body);
    std::vector<FarBodies> far(obstacles().size());
    std::vector<Bounds> known;
    for (std::size_t i = 0; i < obstacles().size(); ++i) {
      known.push_back(cheapBounds(i, detail::stateAt(obstacles()[i], 0), relative[i],
                                  obstacles().size(), request));
    }
    RobotResult result = detail::anyOfAsked(
        std::move(known), request, [&](std::size_t i, const ProbabilityRequest& of_one) {
          const detail::ObstacleMotion motion(among, i, waypoints, body, relative[i]);
          return motion.atWaypoints(of_one, far[i]);
        });
    addUp(far, result);
    return result;
  }

  /// What a probable decision draws from; nothing where it has to be certain: an obstacle that
  /// cannot be sampled, a body without pieces, or nothing that could meet.
  std::vector<detail::ProbableScene> probableScenes(
      const std::vector<Eigen::VectorXd>& waypoints) const {
    const auto relative = among.relativeTo(waypoints, -1);
    std::vector<detail::ProbableScene> scenes;
    for (std::size_t i = 0; i < obstacles().size(); ++i) {
      const ObstacleState state = detail::stateAt(obstacles()[i], 0);
      if (!detail::canBeSampled(among.preparedObstacle(i), state)) return {};
      for (const PlacedBody& one : relative[i]) {
        if (!among.geometries()[one.body]->hasPieces()) return {};
      }
      if (relative[i].empty()) continue;
      scenes.push_back({&among.preparedObstacle(i), state, relative[i]});
    }
    return scenes;
  }

  ProbableResult ofUnionProbably(const std::vector<Eigen::VectorXd>& waypoints, double threshold,
                                 double chance, const ProbabilityRequest& request) const {
    const std::vector<detail::ProbableScene> scenes = probableScenes(waypoints);
    const auto prove = [&](ProbabilityRequest part) {
      part.threshold = threshold;
      return certainly(ofUnion(waypoints, -1, part));
    };
    if (scenes.empty()) return prove(request);
    return detail::probablyAny(scenes, among.prepared(), threshold, chance, prove, request);
  }

  JointGradient gradient(const std::vector<Eigen::VectorXd>& waypoints,
                         const MotionGradientRequest& request) const {
    const Eigen::Index joints = waypoints[0].size();
    const auto count = static_cast<Eigen::Index>(waypoints.size());
    const auto all = among.posesAt(waypoints);
    std::vector<MotionGradient> parts;
    detail::GradientParts progress(request, obstacles().size());
    for (std::size_t i = 0; i < obstacles().size(); ++i) {
      const auto near = among.nearBodies(i, all, kNoGradient);
      if (near.empty()) continue;
      MotionGradientRequest of_one = progress.requestOf(i);
      of_one.seed += i * detail::kSeedsApart;
      parts.push_back(detail::obstacleGradient(among.robot(), waypoints, near, among.sceneOf(i),
                                               detail::stateAt(obstacles()[i], 0), of_one));
    }
    return detail::anyOfGradients(parts, joints, count);
  }

  /// Errors that are not: each obstacle at each waypoint.
  RobotResult ofWaypoints(const std::vector<Eigen::VectorXd>& waypoints, ErrorsOverTime errors,
                          const ProbabilityRequest& request) const {
    const std::size_t count = obstacles().size();
    std::vector<FarBodies> far(waypoints.size() * count);
    const auto stateOf = [&](std::size_t i) {
      return detail::stateAt(obstacles()[i % count], i / count);
    };
    const auto ask = [&](std::size_t i, const ProbabilityRequest& of_one) {
      return askObstacle(i % count, stateOf(i),
                         among.placed(i % count, among.robot().poses(waypoints[i / count])), of_one,
                         far[i]);
    };
    std::vector<Bounds> known;
    for (std::size_t i = 0; i < far.size(); ++i) {
      known.push_back(cheapBounds(
          i % count, stateOf(i), among.placed(i % count, among.robot().poses(waypoints[i / count])),
          far.size(), request));
    }
    RobotResult result = errors == ErrorsOverTime::independent
                             ? detail::anyOfAsked(std::move(known), request, ask)
                             : detail::anyOfDependent(std::move(known), request, ask,
                                                      [count](const std::vector<Bounds>& events) {
                                                        return ofAnyDependence(events, count);
                                                      });
    addUp(far, result);
    addWaypoints(count, result);
    return result;
  }

  /// At any time: what the bodies sweep between the waypoints, too.
  RobotResult ofAllTimes(const std::vector<Eigen::VectorXd>& waypoints,
                         const ProbabilityRequest& request) const {
    const auto relative = among.relativeTo(waypoints, -1);
    std::vector<detail::SweptAnswer> answers(obstacles().size());
    std::vector<std::optional<Bounds>> known(obstacles().size());
    RobotResult result = detail::anyOfAsked(
        std::vector<Bounds>(obstacles().size(), Bounds{0.0, 1.0}), request,
        [&](std::size_t i, const ProbabilityRequest& of_one) {
          const detail::ObstacleMotion motion(among, i, waypoints, -1, relative[i]);
          detail::Budget budget(of_one);
          ProbabilityStatistics statistics;
          if (!known[i]) {
            const ProbabilityResult soon = motion.soonAtWaypoints(budget, of_one);
            known[i] = {soon.lower.value_or(0.0), 1.0};
            statistics = soon.statistics;
            budget.spend(statistics);
          }
          ProbabilityRequest rest = of_one;
          budget.share(1, rest);
          answers[i] = motion.atAllTimes(*known[i], rest);
          ProbabilityResult& answer = answers[i].result;
          known[i] = {*answer.lower, *answer.upper};
          detail::addStatistics(statistics, answer.statistics);
          return answer;
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

  detail::RobotAmongObstacles among;
};

RobotQuery::RobotQuery(const Robot& robot, std::vector<Obstacle> obstacles,
                       std::vector<AllowedContact> allowed)
    : implementation_(std::make_unique<const Implementation>(
          detail::RobotAmongObstacles(robot, std::move(obstacles), std::move(allowed), nullptr))) {}
RobotQuery::RobotQuery(std::unique_ptr<const Implementation> implementation)
    : implementation_(std::move(implementation)) {}
RobotQuery::~RobotQuery() = default;
RobotQuery::RobotQuery(RobotQuery&&) noexcept = default;
RobotQuery& RobotQuery::operator=(RobotQuery&&) noexcept = default;

const Robot& RobotQuery::robot() const { return implementation_->among.robot(); }
const std::vector<Obstacle>& RobotQuery::obstacles() const { return implementation_->obstacles(); }
const std::vector<AllowedContact>& RobotQuery::allowed() const {
  return implementation_->among.allowed();
}

const detail::RobotAmongObstacles& RobotQuery::among() const { return implementation_->among; }

RobotQuery RobotQuery::withObstacles(std::vector<Obstacle> obstacles) const {
  const detail::RobotAmongObstacles& among = implementation_->among;
  return RobotQuery(std::make_unique<const Implementation>(
      detail::RobotAmongObstacles(among.robot(), std::move(obstacles), among.allowed(), &among)));
}

RobotQuery RobotQuery::at(double time) const {
  std::vector<Obstacle> obstacles = implementation_->among.obstacles();
  for (Obstacle& obstacle : obstacles) {
    if (!detail::isPredicted(obstacle.over_time)) continue;
    obstacle = detail::standing(obstacle, detail::predictedAt(obstacle, time));
  }
  return withObstacles(std::move(obstacles));
}

RobotResult RobotQuery::state(const Eigen::VectorXd& values,
                              const ProbabilityRequest& request) const {
  return motion({values}, ErrorsOverTime::persistent, request);
}

RobotResult RobotQuery::state(const Eigen::VectorXd& values, const RobotErrors& errors,
                              const ProbabilityRequest& request) const {
  return motion({values}, errors, request);
}

RobotResult RobotQuery::motion(const std::vector<Eigen::VectorXd>& waypoints,
                               const RobotErrors& errors, const ProbabilityRequest& of_user) const {
  if (errors.none()) return motion(waypoints, ErrorsOverTime::persistent, of_user);
  implementation_->validate(waypoints, of_user);
  const ProbabilityRequest request = detail::ofOneCall(of_user);
  const ProbabilityResult answer =
      detail::statesWithErrors(implementation_->among, waypoints, errors, request);
  RobotResult result;
  result.any = {answer.lower.value_or(0.0), answer.upper.value_or(1.0)};
  result.estimate = answer.estimate;
  result.standard_error = answer.standard_error;
  result.confidence_interval = answer.confidence_interval;
  result.decision = answer.decision;
  result.status = answer.status;
  result.plan = answer.plan;
  detail::addNotes(implementation_->among.notes(), result.plan);
  return result;
}

RobotResult RobotQuery::motion(const std::vector<Eigen::VectorXd>& waypoints, ErrorsOverTime errors,
                               const ProbabilityRequest& of_user, BetweenWaypoints between) const {
  implementation_->validate(waypoints, of_user);
  const ProbabilityRequest request = detail::ofOneCall(of_user);
  if (between == BetweenWaypoints::swept) requireContinuous(errors, request);
  if (errors == ErrorsOverTime::any_dependence && request.method == ProbabilityMethod::estimate) {
    throw InvalidRequest(
        "method estimate cannot answer for errors of any dependence: only bounds can");
  }
  RobotResult result = between == BetweenWaypoints::swept
                           ? implementation_->ofAllTimes(waypoints, request)
                       : errors == ErrorsOverTime::persistent
                           ? implementation_->ofUnion(waypoints, -1, request)
                           : implementation_->ofWaypoints(waypoints, errors, request);
  implementation_->addNotes(request, result);
  return result;
}

RobotResult RobotQuery::certified(const std::vector<Eigen::VectorXd>& waypoints,
                                  const ProbabilityRequest& request,
                                  std::ostream& certificate) const {
  implementation_->validate(waypoints, request);
  RobotResult result = detail::certifiedMotion(implementation_->among, waypoints,
                                               detail::ofOneCall(request), certificate);
  implementation_->addNotes(request, result);
  return result;
}

ProbableResult RobotQuery::decideProbably(const std::vector<Eigen::VectorXd>& waypoints,
                                          double threshold, double chance_of_error,
                                          const ProbabilityRequest& request) const {
  ProbabilityRequest against = request;
  against.threshold = threshold;
  implementation_->validate(waypoints, against);
  detail::requireChance(chance_of_error);
  if (request.method != ProbabilityMethod::automatic) {
    throw InvalidRequest("a probable decision has its own method, not " + toString(request.method));
  }
  return implementation_->ofUnionProbably(waypoints, threshold, chance_of_error,
                                          detail::ofOneCall(request));
}

std::vector<ProbableDecision> RobotQuery::decideStates(
    const Eigen::MatrixXd& states, const ProbabilityRequest& request,
    std::optional<double> chance_of_error) const {
  return decideStates(states, RobotErrors(), request, chance_of_error);
}

std::vector<ProbableDecision> RobotQuery::decideStates(
    const Eigen::MatrixXd& states, const RobotErrors& errors, const ProbabilityRequest& request,
    std::optional<double> chance_of_error) const {
  if (!request.threshold) throw InvalidRequest("states are decided against a threshold");
  implementation_->validate(request);
  for (Eigen::Index i = 0; i < states.cols(); ++i) robot().requireWithinLimits(states.col(i));
  for (const Obstacle& obstacle : obstacles()) detail::requireStates(obstacle, 1);
  if (chance_of_error) detail::requireChance(*chance_of_error);
  if (!errors.none()) {
    return detail::decideWithErrors(*this, states, errors, request, chance_of_error);
  }
  const detail::RobotAmongObstacles& among = implementation_->among;
  const detail::StateScreen screen =
      states.cols() < kManyStates
          ? detail::StateScreen(among)
          : detail::StateScreen(among, states.col(0), detail::movingRows(states));
  const auto decide = [&](const Eigen::VectorXd& values, const ProbabilityRequest& of_one) {
    const detail::Budget budget(of_one);
    if (!chance_of_error) return detail::certain(screen.decision(values, of_one));
    if (const auto told = screen.isBelow(values, of_one)) {
      return detail::certain(*told ? Decision::below : Decision::above);
    }
    ProbabilityRequest rest = budget.withTimeLeft();
    rest.threshold.reset();
    return implementation_->ofUnionProbably({values}, *request.threshold, *chance_of_error, rest)
        .decision;
  };
  return detail::manyStates(states, detail::ofOneCall(request), decide);
}

JointGradient RobotQuery::gradient(const std::vector<Eigen::VectorXd>& waypoints,
                                   const MotionGradientRequest& request) const {
  implementation_->validate(waypoints, ProbabilityRequest());
  detail::validateGradient(request);
  return implementation_->gradient(waypoints, detail::ofOneCall(request));
}

std::vector<RobotResult> RobotQuery::byBody(const std::vector<Eigen::VectorXd>& waypoints,
                                            const ProbabilityRequest& request) const {
  implementation_->validate(waypoints, request);
  const ProbabilityRequest of_call = detail::ofOneCall(request);
  std::vector<RobotResult> results;
  for (std::size_t i = 0; i < robot().bodies().size(); ++i) {
    results.push_back(implementation_->ofUnion(waypoints, static_cast<int>(i), of_call));
  }
  return results;
}

}  // namespace fcl_prob
