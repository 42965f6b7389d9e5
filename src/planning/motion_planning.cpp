// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/motion_planning.h"

#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/goals/GoalState.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>

#include <mutex>

#include "planning/joint_space.h"
#include "planning/shorten_path.h"

namespace fcl_prob {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

std::mutex& quietMutex() {
  static std::mutex mutex;
  return mutex;
}

int quiet_plans = 0;
ompl::msg::OutputHandler* handler_before = nullptr;

/// While any of these lives OMPL's log, which belongs to the whole process, goes nowhere; then to
/// where it went before.
class QuietOmpl {
 public:
  QuietOmpl() {
    const std::lock_guard<std::mutex> lock(quietMutex());
    if (quiet_plans++ > 0) return;
    handler_before = ompl::msg::getOutputHandler();
    ompl::msg::noOutputHandler();
  }
  ~QuietOmpl() {
    const std::lock_guard<std::mutex> lock(quietMutex());
    if (--quiet_plans == 0) ompl::msg::useOutputHandler(handler_before);
  }
  QuietOmpl(const QuietOmpl&) = delete;
  QuietOmpl& operator=(const QuietOmpl&) = delete;
};

/// By RRT-Connect; nothing if a limit ended it.
std::shared_ptr<og::PathGeometric> connect(const detail::JointSpace& space,
                                           detail::PlanningRun& run, const Eigen::VectorXd& start,
                                           const Eigen::VectorXd& goal) {
  const auto problem = std::make_shared<ob::ProblemDefinition>(space.information());
  ob::ScopedState<> from(space.information()), to(space.information());
  space.write(start, from.get());
  space.write(goal, to.get());
  problem->setStartAndGoalStates(from, to);
  og::RRTConnect planner(space.information());
  planner.setRange(detail::kTreeRange);
  planner.setProblemDefinition(problem);
  planner.setup();
  // OMPL may go on for long without a state, where no nearer one is left.
  const ob::PlannerTerminationCondition stop([&run] { return run.isStoppedNow(); });
  if (planner.solve(stop) != ob::PlannerStatus::EXACT_SOLUTION) return nullptr;
  return std::static_pointer_cast<og::PathGeometric>(problem->getSolutionPath());
}

class MotionPlan {
 public:
  MotionPlan(const Robot& robot, const StateTest& allowed, const Eigen::VectorXd& start,
             const Eigen::VectorXd& goal, const PlanningRequest& request)
      : run_(allowed, request), space_(robot, start, goal, run_), start_(start), goal_(goal) {}

  PlanningResult make() {
    PlanningResult result;
    result.status = solve(result);
    result.states = run_.states();
    return result;
  }

 private:
  PlanningStatus solve(PlanningResult& result) {
    if (!run_.isAllowed(start_)) return run_.stopped().value_or(PlanningStatus::start_refused);
    if (!run_.isAllowed(goal_)) return run_.stopped().value_or(PlanningStatus::goal_refused);
    if (space_.dimension() == 0 || start_ == goal_) {
      result.waypoints = {start_, goal_};
      result.shortened = true;
      return PlanningStatus::solved;
    }
    const QuietOmpl quiet;
    const auto path = connect(space_, run_, start_, goal_);
    if (!path) return run_.stopped().value_or(PlanningStatus::state_limit);
    result.waypoints = space_.waypointsOf(*path);
    result.planned_length = jointLength(result.waypoints);
    if (run_.request().shorten) {
      result.waypoints = detail::shortened(std::move(result.waypoints), run_);
      result.shortened = !run_.isStopped();
    }
    result.length = jointLength(result.waypoints);
    return PlanningStatus::solved;
  }

  detail::PlanningRun run_;
  detail::JointSpace space_;
  Eigen::VectorXd start_;
  Eigen::VectorXd goal_;
};

}  // namespace

std::string toString(PlanningStatus status) {
  switch (status) {
    case PlanningStatus::solved:
      return "solved";
    case PlanningStatus::start_refused:
      return "start-refused";
    case PlanningStatus::goal_refused:
      return "goal-refused";
    case PlanningStatus::state_limit:
      return "state-limit";
    case PlanningStatus::time_limit:
      return "time-limit";
    case PlanningStatus::cancelled:
      return "cancelled";
    case PlanningStatus::threshold:
      return "threshold";
  }
  return "unknown";
}

double jointLength(const std::vector<Eigen::VectorXd>& waypoints) {
  double length = 0.0;
  for (std::size_t i = 1; i < waypoints.size(); ++i) {
    length += (waypoints[i] - waypoints[i - 1]).norm();
  }
  return length;
}

PlanningResult planMotion(const Robot& robot, const StateTest& allowed,
                          const Eigen::VectorXd& start, const Eigen::VectorXd& goal,
                          const PlanningRequest& request) {
  return MotionPlan(robot, allowed, start, goal, request).make();
}

}  // namespace fcl_prob
