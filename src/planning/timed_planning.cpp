// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/timed_planning.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "base/number_text.h"
#include "base/refuse_band.h"
#include "base/stopwatch.h"
#include "base/until_no.h"
#include "fcl_prob/certified_planning.h"
#include "fcl_prob/exceptions.h"
#include "planning/joint_space.h"
#include "planning/moving_joints.h"
#include "planning/shorten_path.h"
#include "planning/state_decision.h"
#include "planning/timed_trees.h"
#include "robot/moving_obstacle.h"
#include "robot/waypoint_steps.h"

namespace fcl_prob {
namespace {

/// Times of arrival that trees grow back from: more of them cost a test of the goal each.
constexpr int kArrivals = 24;

/// For a sooner arrival so many times the states may be asked for that the first path took, and so
/// many more: it costs no more than the path does, about, for each of the halvings.
constexpr std::size_t kStatesForSooner = 2, kMoreForSooner = 500;

TimedPlanningRequest validated(TimedPlanningRequest request) {
  request.planning = detail::ofOneCall(request.planning);
  if (!(request.largest_time_step > 0.0)) {
    throw InvalidRequest("the largest time step must be > 0, is " +
                         detail::numberText(request.largest_time_step));
  }
  if (!std::isfinite(request.start_time)) throw InvalidRequest("the start time is not finite");
  if (!(request.hold >= 0.0 && std::isfinite(request.hold))) {
    throw InvalidRequest("hold must be >= 0 and finite, is " + detail::numberText(request.hold));
  }
  if (!(request.velocity_scale > 0.0 && request.velocity_scale <= 1.0)) {
    throw InvalidRequest("velocity_scale must be in (0, 1], is " +
                         detail::numberText(request.velocity_scale));
  }
  return request;
}

TimedPlanningRequest validatedWithState(TimedPlanningRequest request) {
  request.state = detail::ofOneCall(request.state);
  if (!request.state.threshold) throw InvalidRequest("a plan in time needs a threshold");
  validateRequest(request.state);
  detail::refuseBand(request.state, "robots");
  return validated(std::move(request));
}

/// Of all predictions; infinite where there is none.
double endOf(const RobotQuery& query) {
  double end = detail::kInfinity;
  for (const Obstacle& obstacle : query.obstacles()) {
    if (detail::isPredicted(obstacle.over_time))
      end = std::min(end, *obstacle.over_time.back().time);
  }
  return end;
}

void requireAfterStart(double latest, const TimedPlanningRequest& request) {
  if (latest > request.start_time && std::isfinite(latest)) return;
  throw InvalidRequest("the latest time of arrival, " + detail::numberText(latest) +
                       " s, is not after the start, " + detail::numberText(request.start_time) +
                       " s");
}

/// When the robot has to be at the goal.
double latestOf(const RobotQuery& query, const TimedPlanningRequest& request) {
  std::optional<double> latest = request.latest;
  for (const Obstacle& obstacle : query.obstacles()) {
    if (obstacle.over_time.empty()) continue;
    if (!detail::isPredicted(obstacle.over_time)) {
      throw InvalidRequest("obstacle " + obstacle.name +
                           " has states without times: a plan in time needs those of a prediction");
    }
    const double end = *obstacle.over_time.back().time - request.hold;
    if (request.latest && *request.latest > end)
      detail::predictedAt(obstacle, *request.latest + request.hold);
    detail::predictedAt(obstacle, request.start_time);
    latest = std::min(latest.value_or(end), end);
  }
  if (!latest) {
    throw InvalidRequest(
        "no obstacle is predicted over time: a plan in time needs the latest time "
        "of arrival, or planCertified()");
  }
  return *latest;
}

class TimedPlanner {
 public:
  /// \param request  a validated one, which must outlive this
  /// \param latest   time of arrival, seconds
  /// \param end      of all that is known, seconds
  TimedPlanner(const Robot& robot, const TimedStateTest& allowed,
               const TimedPlanningRequest& request, double latest, double end,
               const Eigen::VectorXd& start, const Eigen::VectorXd& goal)
      : robot_(robot),
        request_(request),
        latest_(latest),
        states_(robot, request_, end),
        run_(
            [this, &allowed](const auto& state) {
              return allowed(states_.timeOf(state), detail::TimedStates::valuesOf(state));
            },
            request_.planning,
            [this](const auto& from, const auto& to) { return states_.isForwardInTime(from, to); }),
        start_(states_.at(request_.start_time, start)),
        goal_(goal) {
    requireAfterStart(latest, request_);
  }

  TimedPlan plan() {
    TimedPlan plan;
    plan.status = solve(plan);
    plan.states = run_.states();
    return plan;
  }

  /// All that were asked for on the way that was found.
  std::vector<TimedWaypoint> statesOfPath() const {
    return timed(interpolated(path_, request_.planning.largest_step));
  }

 private:
  PlanningStatus solve(TimedPlan& plan) {
    if (!run_.isAllowed(start_)) return run_.stopped().value_or(PlanningStatus::start_refused);
    const std::vector<Eigen::VectorXd> goals = allowedGoals();
    if (goals.empty()) return run_.stopped().value_or(PlanningStatus::goal_refused);
    connect(goals);
    if (path_.empty()) return run_.stopped().value_or(PlanningStatus::state_limit);
    if (request_.planning.shorten) path_ = detail::shortened(std::move(path_), run_);
    plan.shortened = request_.planning.shorten && !run_.isStopped();
    if (request_.hold > 0.0) path_.push_back(heldFrom(path_.back()));
    plan.waypoints = timed(path_);
    std::vector<Eigen::VectorXd> values_of;
    for (const TimedWaypoint& waypoint : plan.waypoints) values_of.push_back(waypoint.values);
    plan.length = jointLength(values_of);
    plan.arrival = plan.waypoints.back().time - request_.hold;
    return PlanningStatus::solved;
  }

  Eigen::VectorXd heldFrom(const Eigen::VectorXd& goal) const {
    return states_.at(states_.timeOf(goal) + request_.hold, detail::TimedStates::valuesOf(goal));
  }

  /// Whether the robot may be at the goal from then on, as long as it is held.
  bool isGoalAllowed(const Eigen::VectorXd& goal) {
    if (!run_.isAllowed(goal)) return false;
    return request_.hold == 0.0 || run_.isMotionAllowed(goal, heldFrom(goal));
  }

  /// The goal at several times, the soonest first.
  std::vector<Eigen::VectorXd> allowedGoals() {
    const double soonest = request_.start_time + states_.soonest(start_, states_.at(0.0, goal_));
    std::vector<Eigen::VectorXd> goals;
    for (int i = 1; i <= kArrivals && soonest <= latest_; ++i) {
      const double part = static_cast<double>(i) / kArrivals;
      const Eigen::VectorXd goal = states_.at(soonest + part * (latest_ - soonest), goal_);
      if (isGoalAllowed(goal)) goals.push_back(goal);
    }
    return goals;
  }

  /// By halving the times of arrival; what is not found soon may yet exist.
  void connect(const std::vector<Eigen::VectorXd>& goals) {
    const auto towards = [&](std::size_t count, std::size_t most_states) {
      const std::vector<Eigen::VectorXd> first(goals.begin(), goals.begin() + count);
      return detail::TimedTrees(robot_, states_, run_, start_, first).connect(most_states);
    };
    const std::size_t before = run_.states();
    path_ = towards(goals.size(), request_.planning.max_states);
    const std::size_t most = kStatesForSooner * (run_.states() - before) + kMoreForSooner;
    std::size_t none = 0, some = path_.empty() ? 0 : goals.size();
    while (some - none > 1 && !run_.isStopped()) {
      const std::size_t middle = (none + some) / 2;
      std::vector<Eigen::VectorXd> sooner = towards(middle, most);
      (sooner.empty() ? none : some) = middle;
      if (!sooner.empty()) path_ = std::move(sooner);
    }
  }

  std::vector<TimedWaypoint> timed(const std::vector<Eigen::VectorXd>& states) const {
    std::vector<TimedWaypoint> waypoints;
    for (const Eigen::VectorXd& state : states) {
      waypoints.push_back({states_.timeOf(state), detail::TimedStates::valuesOf(state)});
    }
    return waypoints;
  }

  const Robot& robot_;
  const TimedPlanningRequest& request_;
  const double latest_;
  const detail::TimedStates states_;
  detail::PlanningRun run_;
  const Eigen::VectorXd start_;
  const Eigen::VectorXd goal_;
  std::vector<Eigen::VectorXd> path_;
};

/// What is certain of states among the obstacles as they are predicted.
class AmongPredictions {
 public:
  /// \param request  a validated one
  ///
  /// Keeps references.
  AmongPredictions(const RobotQuery& query, const SelfCollision& self,
                   const TimedPlanningRequest& request)
      : query_(query), self_(self), request_(request) {}

  bool allows(double time, const Eigen::VectorXd& values) const {
    if (self_.collides(values)) return false;
    const RobotQuery then = query_.at(time);
    return detail::StateDecision(then, request_.errors).isBelow(values, withinLimits());
  }

  void tellLargest(const std::vector<TimedWaypoint>& states, TimedPlan& plan) const {
    detail::LargestOfStates largest;
    for (const TimedWaypoint& state : states) {
      const RobotQuery then = query_.at(state.time);
      const detail::StateDecision decision(then, request_.errors);
      const double least = largest.probability.lower;
      if (largest.add(decision.above(state.values, least, withinLimits()))) {
        plan.likeliest_time = state.time;
      }
    }
    plan.largest = largest.probability;
    // By the decisions, which may have been closer to the threshold than the tolerance.
    plan.largest.upper = std::min(plan.largest.upper, *request_.state.threshold);
  }

 private:
  ProbabilityRequest withinLimits() const {
    return detail::withinTime(request_.state, request_.planning, watch_);
  }

  const RobotQuery& query_;
  const SelfCollision& self_;
  const TimedPlanningRequest& request_;
  const detail::Stopwatch watch_;
};

}  // namespace

std::vector<TimedWaypoint> interpolated(const std::vector<TimedWaypoint>& waypoints,
                                        double largest_step, double largest_time_step) {
  std::vector<Eigen::VectorXd> states;
  std::vector<double> times;
  const double unit = largest_step / largest_time_step;
  for (const TimedWaypoint& waypoint : waypoints) {
    states.emplace_back(waypoint.values.size() + 1);
    states.back() << waypoint.values, waypoint.time * unit;
    times.push_back(waypoint.time);
  }
  const auto steps = detail::stepsBetween(states, largest_step);
  states = interpolated(states, largest_step);
  std::vector<TimedWaypoint> result;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    result.push_back({detail::timeOf(steps[i], times), detail::TimedStates::valuesOf(states[i])});
  }
  return result;
}

TimedPlan planInTime(const Robot& robot, const TimedStateTest& allowed,
                     const Eigen::VectorXd& start, const Eigen::VectorXd& goal,
                     const TimedPlanningRequest& request) {
  robot.validate(start);
  robot.validate(goal);
  detail::requireReachable(robot, start, goal, request.planning.joints);
  const TimedPlanningRequest valid = validated(request);
  if (!valid.latest) throw InvalidRequest("a plan in time needs the latest time of arrival");
  const double end = *valid.latest + valid.hold;
  return TimedPlanner(robot, allowed, valid, *valid.latest, end, start, goal).plan();
}

TimedPlan planInTime(const RobotQuery& query, const SelfCollision& self,
                     const Eigen::VectorXd& start, const Eigen::VectorXd& goal,
                     const TimedPlanningRequest& request) {
  query.robot().validate(start);
  query.robot().validate(goal);
  detail::requireReachable(query.robot(), start, goal, request.planning.joints);
  detail::requireSameJoints(self.robot(), query.robot());
  const TimedPlanningRequest valid = validatedWithState(request);
  const AmongPredictions among(query, self, valid);
  const TimedStateTest allowed = [&](double time, const Eigen::VectorXd& values) {
    return among.allows(time, values);
  };
  TimedPlanner planner(query.robot(), allowed, valid, latestOf(query, valid), endOf(query), start,
                       goal);
  TimedPlan plan = planner.plan();
  if (plan.status == PlanningStatus::solved) among.tellLargest(planner.statesOfPath(), plan);
  return plan;
}

}  // namespace fcl_prob
