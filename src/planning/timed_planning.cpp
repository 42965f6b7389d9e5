// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/timed_planning.h"

#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "base/refuse_band.h"
#include "base/stopwatch.h"
#include "base/until_no.h"
#include "fcl_prob/certified_planning.h"
#include "fcl_prob/exceptions.h"
#include "planning/joint_space.h"
#include "planning/moving_joints.h"
#include "planning/rrt_connect.h"
#include "planning/shorten_path.h"
#include "robot/joint_indices.h"
#include "robot/moving_obstacle.h"
#include "robot/state_screen.h"

namespace fcl_prob {
namespace {

/// Times of arrival that trees grow back from: more of them cost a test of the goal each.
constexpr int kArrivals = 24;

/// Times of arrival that a path is hurried to, the soonest first.
constexpr int kHurries = 8;

/// Of a velocity, next to which steps are rounded.
constexpr double kVelocityRounding = 1e-9;

/// States with their time as one more value, in a unit such that the largest step of a joint and
/// that of time are the same.
class TimedStates {
 public:
  TimedStates(const Robot& robot, const TimedPlanningRequest& request)
      : unit_(request.planning.largest_step / request.largest_time_step),
        start_time_(request.start_time),
        velocities_(velocitiesOf(robot, request)) {}

  Eigen::VectorXd at(double time, const Eigen::VectorXd& values) const {
    Eigen::VectorXd state(values.size() + 1);
    state << values, (time - start_time_) * unit_;
    return state;
  }
  static Eigen::VectorXd valuesOf(const Eigen::VectorXd& state) {
    return state.head(state.size() - 1);
  }
  double timeOf(const Eigen::VectorXd& state) const {
    return start_time_ + state[state.size() - 1] / unit_;
  }

  /// Seconds that the way from one to the other takes.
  double soonest(const Eigen::VectorXd& from, const Eigen::VectorXd& to) const {
    double seconds = 0.0;
    for (Eigen::Index i = 0; i < velocities_.size(); ++i) {
      const double way = std::abs(to[i] - from[i]);
      if (way > 0.0) seconds = std::max(seconds, way / velocities_[i]);
    }
    return seconds;
  }

  bool isForwardInTime(const Eigen::VectorXd& from, const Eigen::VectorXd& to) const {
    const double seconds = (to[to.size() - 1] - from[from.size() - 1]) / unit_;
    return seconds > 0.0 && soonest(from, to) <= seconds * (1.0 + kVelocityRounding);
  }

 private:
  static Eigen::VectorXd velocitiesOf(const Robot& robot, const TimedPlanningRequest& request) {
    Eigen::VectorXd velocities(static_cast<Eigen::Index>(robot.joints().size()));
    for (const auto& [name, velocity] : request.velocities) {
      detail::jointIndex(robot, name);
      if (velocity > 0.0 && std::isfinite(velocity)) continue;
      throw InvalidRequest("the velocity of joint " + name + " must be > 0 and finite, is " +
                           detail::numberText(velocity));
    }
    for (std::size_t i = 0; i < robot.joints().size(); ++i) {
      const RobotJoint& joint = robot.joints()[i];
      const auto given = request.velocities.find(joint.name);
      const double velocity = given == request.velocities.end() ? joint.velocity : given->second;
      velocities[static_cast<Eigen::Index>(i)] = request.velocity_scale * velocity;
    }
    for (const Eigen::Index i : detail::movingJoints(robot, request.planning.joints)) {
      if (velocities[i] > 0.0) continue;
      throw InvalidRequest("joint " + robot.joints()[static_cast<std::size_t>(i)].name +
                           " has no velocity in its URDF: a plan in time needs one");
    }
    return velocities;
  }

  double unit_;
  double start_time_;
  Eigen::VectorXd velocities_;
};

TimedPlanningRequest validated(TimedPlanningRequest request) {
  request.state = detail::ofOneCall(request.state);
  request.planning = detail::ofOneCall(request.planning);
  if (!request.state.threshold) throw InvalidRequest("a plan in time needs a threshold");
  validateRequest(request.state);
  detail::refuseBand(request.state, "robots");
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

/// When the robot has to be at the goal.
double latestOf(const RobotQuery& query, const TimedPlanningRequest& request) {
  std::optional<double> latest = request.latest;
  for (const Obstacle& obstacle : query.obstacles()) {
    if (obstacle.over_time.empty()) continue;
    if (!detail::isPredicted(obstacle)) {
      throw InvalidRequest("obstacle " + obstacle.name +
                           " has states without times: a plan in time needs those of a prediction");
    }
    const double end = *obstacle.over_time.back().time - request.hold;
    if (request.latest && *request.latest > end) detail::predictedAt(obstacle, *request.latest + request.hold);
    detail::predictedAt(obstacle, request.start_time);
    latest = std::min(latest.value_or(end), end);
  }
  if (!latest) {
    throw InvalidRequest("no obstacle is predicted over time: a plan in time needs the latest time "
                         "of arrival, or planCertified()");
  }
  if (!(*latest > request.start_time)) {
    throw InvalidRequest("the latest time of arrival, " + detail::numberText(*latest) +
                         " s, is not after the start, " + detail::numberText(request.start_time) +
                         " s");
  }
  return *latest;
}

class TimedPlanner {
 public:
  TimedPlanner(const RobotQuery& query, const SelfCollision& self,
               const TimedPlanningRequest& request, const Eigen::VectorXd& start,
               const Eigen::VectorXd& goal)
      : query_(query),
        self_(self),
        request_(validated(request)),
        latest_(latestOf(query, request_)),
        states_(query.robot(), request_),
        run_([this](const auto& state) { return isAllowed(state); }, request_.planning,
             [this](const auto& from, const auto& to) { return states_.isForwardInTime(from, to); }),
        start_(states_.at(request_.start_time, start)),
        goal_(goal),
        space_(detail::JointSpace::withTime(query.robot(), start_, states_.at(latest_, goal),
                                            run_)) {}

  TimedPlan plan() {
    TimedPlan plan;
    plan.status = solve(plan);
    plan.states = run_.states();
    return plan;
  }

 private:
  PlanningStatus solve(TimedPlan& plan) {
    if (!run_.isAllowed(start_)) return run_.stopped().value_or(PlanningStatus::start_refused);
    const std::vector<Eigen::VectorXd> goals = allowedGoals();
    if (goals.empty()) return run_.stopped().value_or(PlanningStatus::goal_refused);
    path_ = detail::connected(space_, run_, start_, goals);
    if (path_.empty()) return run_.stopped().value_or(PlanningStatus::state_limit);
    if (request_.planning.shorten) shorten();
    plan.shortened = request_.planning.shorten && !run_.isStopped();
    if (request_.hold > 0.0) path_.push_back(heldFrom(path_.back()));
    tell(plan);
    return PlanningStatus::solved;
  }

  bool isAllowed(const Eigen::VectorXd& state) const {
    const Eigen::VectorXd values = TimedStates::valuesOf(state);
    if (self_.collides(values)) return false;
    const RobotQuery then = query_.at(states_.timeOf(state));
    const detail::StateScreen screen(then.among());
    if (const auto told = screen.tell(values, *request_.state.threshold)) return *told;
    return then.state(values, withinLimits()).decision == Decision::below;
  }

  /// A state gives what it has where the plan's time ends. A limit must be > 0.
  ProbabilityRequest withinLimits() const {
    ProbabilityRequest request = request_.state;
    if (!request_.planning.time_limit) return request;
    const double left = std::max(1e-9, *request_.planning.time_limit - watch_.seconds());
    request.time_limit = std::min(request.time_limit.value_or(left), left);
    return request;
  }

  Eigen::VectorXd heldFrom(const Eigen::VectorXd& goal) const {
    return states_.at(states_.timeOf(goal) + request_.hold, TimedStates::valuesOf(goal));
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

  void shorten() {
    run_.beginShortening();
    path_ = detail::pulledTaut(detail::cutShort(std::move(path_), run_), run_);
    if (hurry()) path_ = detail::pulledTaut(std::move(path_), run_);
  }

  /// The same way in less time, if its states are allowed then.
  bool hurry() {
    const double start = request_.start_time, arrival = states_.timeOf(path_.back());
    const double soonest = start + states_.soonest(path_.front(), path_.back());
    for (int i = 0; i < kHurries && !run_.isStopped(); ++i) {
      const double sooner = soonest + (arrival - soonest) * i / kHurries;
      std::vector<Eigen::VectorXd> hurried;
      for (const Eigen::VectorXd& state : path_) {
        const double part = (states_.timeOf(state) - start) / (arrival - start);
        hurried.push_back(states_.at(start + part * (sooner - start), TimedStates::valuesOf(state)));
      }
      if (!isPathAllowed(hurried)) continue;
      path_ = std::move(hurried);
      return true;
    }
    return false;
  }

  bool isPathAllowed(const std::vector<Eigen::VectorXd>& path) {
    for (std::size_t i = 1; i < path.size(); ++i) {
      if (!states_.isForwardInTime(path[i - 1], path[i])) return false;
    }
    for (std::size_t i = 1; i < path.size(); ++i) {
      if (!run_.isMotionAllowed(path[i - 1], path[i])) return false;
    }
    return isGoalAllowed(path.back());
  }

  void tell(TimedPlan& plan) const {
    for (const Eigen::VectorXd& state : path_) {
      plan.waypoints.push_back({states_.timeOf(state), TimedStates::valuesOf(state)});
      if (plan.waypoints.size() > 1) {
        plan.length += (plan.waypoints.back().values - plan.waypoints.rbegin()[1].values).norm();
      }
    }
    plan.arrival = plan.waypoints.back().time - request_.hold;
    plan.largest = {0.0, 0.0};
    for (const Eigen::VectorXd& state : interpolated(path_, request_.planning.largest_step)) {
      const Eigen::VectorXd values = TimedStates::valuesOf(state);
      const RobotQuery then = query_.at(states_.timeOf(state));
      if (detail::StateScreen(then.among()).isBelow(values, plan.largest.lower)) continue;
      ProbabilityRequest request = withinLimits();
      request.threshold.reset();
      const Bounds any = then.state(values, request).any;
      plan.largest.lower = std::max(plan.largest.lower, any.lower);
      if (any.upper <= plan.largest.upper) continue;
      plan.largest.upper = any.upper;
      plan.likeliest_time = states_.timeOf(state);
    }
    // By the decisions, which may have been closer to the threshold than the tolerance.
    plan.largest.upper = std::min(plan.largest.upper, *request_.state.threshold);
  }

  const RobotQuery& query_;
  const SelfCollision& self_;
  const TimedPlanningRequest request_;
  const double latest_;
  const TimedStates states_;
  detail::PlanningRun run_;
  const Eigen::VectorXd start_;
  const Eigen::VectorXd goal_;
  detail::JointSpace space_;
  std::vector<Eigen::VectorXd> path_;
  const detail::Stopwatch watch_;
};

}  // namespace

std::vector<TimedWaypoint> interpolated(const std::vector<TimedWaypoint>& waypoints,
                                        double largest_step, double largest_time_step) {
  std::vector<Eigen::VectorXd> states;
  const double unit = largest_step / largest_time_step;
  for (const TimedWaypoint& waypoint : waypoints) {
    states.emplace_back(waypoint.values.size() + 1);
    states.back() << waypoint.values, waypoint.time * unit;
  }
  std::vector<TimedWaypoint> result;
  for (const Eigen::VectorXd& state : interpolated(states, largest_step)) {
    result.push_back({state[state.size() - 1] / unit, TimedStates::valuesOf(state)});
  }
  return result;
}

TimedPlan planInTime(const RobotQuery& query, const SelfCollision& self,
                     const Eigen::VectorXd& start, const Eigen::VectorXd& goal,
                     const TimedPlanningRequest& request) {
  query.robot().validate(start);
  query.robot().validate(goal);
  detail::requireSameJoints(self.robot(), query.robot());
  return TimedPlanner(query, self, request, start, goal).plan();
}

}  // namespace fcl_prob
