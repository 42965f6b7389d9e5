// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/certified_planning.h"

#include <algorithm>

#include "base/number_text.h"
#include "base/refuse_band.h"
#include "base/until_no.h"
#include "fcl_prob/exceptions.h"
#include "planning/motion_descent.h"
#include "planning/moving_joints.h"
#include "planning/state_decision.h"
#include "robot/moving_obstacle.h"

namespace fcl_prob {
namespace {

/// Attempts at a whole motion, each with half the threshold of the one before.
constexpr int kAttempts = 5;

/// A whole motion may take this many times the cells of a state.
constexpr std::size_t kCellsOfMotion = 20;

ProbabilityRequest intervalOf(ProbabilityRequest request) {
  request.threshold.reset();
  return request;
}

class CertifiedPlanner {
 public:
  CertifiedPlanner(const RobotQuery& query, const SelfCollision& self, const Eigen::VectorXd& start,
                   const CertifiedPlanningRequest& request)
      : query_(query),
        self_(self),
        request_(request),
        decision_(query, request_.errors, start,
                  detail::movingJoints(query.robot(), request_.planning.joints)) {
    request_.state = detail::ofOneCall(request_.state);
    request_.planning = detail::ofOneCall(request_.planning);
    if (!request.state.threshold) throw InvalidRequest("a certified plan needs a threshold");
    const auto& most = request.motion_threshold;
    if (most && !(*most > 0.0 && *most <= 1.0)) {
      throw InvalidRequest("the threshold of a motion must be in (0, 1], is " +
                           detail::numberText(*most));
    }
    if (most && !request.errors.none()) {
      throw InvalidRequest(
          "errors of the robot leave no P of the whole motion: it has no threshold");
    }
    validateRequest(request.state);
    detail::refuseBand(request.state, "robots");
    detail::requireStaying(query.obstacles(), "plans are");
    detail::requireSameJoints(self.robot(), query.robot());
  }

  CertifiedPlan plan(const Eigen::VectorXd& start, const Eigen::VectorXd& goal) const {
    CertifiedPlan plan;
    ProbabilityRequest state = request_.state;
    std::size_t states = 0;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      plan = {};
      plan.state_threshold = *state.threshold;
      plan.path = planMotion(query_.robot(), testOf(state, states), start, goal, remaining(states));
      states = plan.path.states += states;
      if (plan.path.status != PlanningStatus::solved) return plan;
      if (certifyMotion(plan) || descend(plan, state)) {
        certifyStates(plan);
        return plan;
      }
      states = plan.path.states;
      *state.threshold *= 0.5;
      if (states >= request_.planning.max_states) break;
    }
    CertifiedPlan none;
    none.path.status = PlanningStatus::threshold;
    none.path.states = states;
    none.state_threshold = plan.state_threshold;
    return none;
  }

 private:
  /// A decision that is close keeps to the limits of the plan.
  /// \param states  tested so far
  StateTest testOf(const ProbabilityRequest& state, std::size_t states) const {
    return [this, &state, states](const Eigen::VectorXd& values) mutable {
      ++states;
      if (self_.collides(values)) return false;
      return decision_.isBelow(values, withinLimits(state, states, false));
    };
  }

  /// Of a query, which gives what it has where the plan's time ends or its caller cancels it.
  /// \param path_is_found  else states are tested
  ProbabilityRequest withinLimits(ProbabilityRequest request, std::size_t states,
                                  bool path_is_found = true) const {
    request = detail::withinTime(std::move(request), request_.planning, watch_);
    if (request_.planning.on_progress) {
      request.on_progress = [this, states, path_is_found,
                             inner = request.on_progress](const auto& progress) {
        return (!inner || inner(progress)) &&
               request_.planning.on_progress({states, watch_.seconds(), path_is_found});
      };
    }
    return request;
  }

  PlanningRequest remaining(std::size_t states) const {
    PlanningRequest request = request_.planning;
    request.time_limit = detail::secondsLeft(request_.planning, watch_);
    request.max_states -= std::min(states, request.max_states - 1);
    return request;
  }

  /// Whether the whole motion is below its threshold, if there is one.
  bool certifyMotion(CertifiedPlan& plan) const {
    if (!request_.errors.none()) return true;
    const auto states = interpolated(plan.path.waypoints, request_.planning.largest_step);
    ProbabilityRequest motion = intervalOf(withinLimits(request_.state, plan.path.states));
    motion.max_cells *= kCellsOfMotion;
    plan.motion = query_.motion(states, ErrorsOverTime::persistent, motion).any;
    return !request_.motion_threshold || plan.motion.upper < *request_.motion_threshold;
  }

  /// Moves the path until P of the whole motion is below its threshold, if its states allow that.
  bool descend(CertifiedPlan& plan, const ProbabilityRequest& state) const {
    if (!request_.descend) return false;
    detail::DescentRequest descent;
    descent.threshold = *request_.motion_threshold;
    descent.largest_step = request_.planning.largest_step;
    descent.moving = detail::movingJoints(query_.robot(), request_.planning.joints);
    descent.seed = request_.planning.seed;
    descent.go_on = [this, &plan] { return mayGoOn(plan.path.states); };
    const auto moved = detail::descended(query_, plan.path.waypoints, descent);
    if (!moved) return false;
    const StateTest allowed = testOf(state, plan.path.states);
    for (const Eigen::VectorXd& values : interpolated(*moved, request_.planning.largest_step)) {
      if (plan.path.states >= request_.planning.max_states || !mayGoOn(plan.path.states)) {
        return false;
      }
      ++plan.path.states;
      if (!allowed(values)) return false;
    }
    plan.path.waypoints = *moved;
    plan.path.length = jointLength(*moved);
    plan.descended = true;
    return certifyMotion(plan);
  }

  bool mayGoOn(std::size_t states) const {
    if (request_.planning.time_limit && watch_.seconds() >= *request_.planning.time_limit) {
      return false;
    }
    return !request_.planning.on_progress ||
           request_.planning.on_progress({states, watch_.seconds(), true});
  }

  void certifyStates(CertifiedPlan& plan) const {
    const auto states = interpolated(plan.path.waypoints, request_.planning.largest_step);
    detail::LargestOfStates largest;
    for (std::size_t i = 0; i < states.size(); ++i) {
      // What is below the P of another state is not the largest.
      const double least = largest.probability.lower;
      const ProbabilityRequest request = withinLimits(request_.state, plan.path.states);
      if (largest.add(decision_.above(states[i], least, request))) plan.likeliest = i;
    }
    plan.largest = largest.probability;
    // By the decisions, which may have been closer to the threshold than the tolerance.
    plan.largest.upper = std::min(plan.largest.upper, plan.state_threshold);
    // Where a limit ended one of the two, the other one may say more: the motion is no less likely
    // than its states.
    plan.motion.lower = std::max(plan.motion.lower, plan.largest.lower);
    plan.largest.upper = std::min(plan.largest.upper, plan.motion.upper);
  }

  const RobotQuery& query_;
  const SelfCollision& self_;
  CertifiedPlanningRequest request_;
  detail::StateDecision decision_;
  const detail::Stopwatch watch_;
};

}  // namespace

CertifiedPlan planCertified(const RobotQuery& query, const SelfCollision& self,
                            const Eigen::VectorXd& start, const Eigen::VectorXd& goal,
                            const CertifiedPlanningRequest& request) {
  return CertifiedPlanner(query, self, start, request).plan(start, goal);
}

}  // namespace fcl_prob
