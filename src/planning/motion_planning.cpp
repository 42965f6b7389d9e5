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

/// Trees that are grown in vain, one after the other, before a path is taken for the shortest.
constexpr int kMostInVain = 3;

/// A path counts as shorter if it is by this factor: each try costs as many states as the first.
constexpr double kShorter = 0.95;

/// Samples for each state that a tree may ask for: beside refused edges it draws without asking.
constexpr std::size_t kSamplesPerState = 10;

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
/// \param most_states  that may be asked for
std::shared_ptr<og::PathGeometric> connect(const detail::JointSpace& space,
                                           detail::PlanningRun& run, const Eigen::VectorXd& start,
                                           const Eigen::VectorXd& goal, std::size_t most_states) {
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
  std::size_t samples = 0;
  const ob::PlannerTerminationCondition stop([&] {
    return run.isStoppedNow() || run.hasNoStatesLeft() ||
           ++samples / kSamplesPerState > most_states;
  });
  run.limitStates(most_states);
  const ob::PlannerStatus status = planner.solve(stop);
  run.limitStates(detail::kAll);
  if (status != ob::PlannerStatus::EXACT_SOLUTION) return nullptr;
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
    if (!connectShorter(result, detail::kAll)) {
      return run_.stopped().value_or(PlanningStatus::state_limit);
    }
    if (run_.request().shorten) lookForShorter(result);
    return PlanningStatus::solved;
  }

  /// The path of two trees, where it is shorter than the one that is known.
  bool connectShorter(PlanningResult& result, std::size_t most_states) {
    const auto path = connect(space_, run_, start_, goal_, most_states);
    if (!path) return false;
    std::vector<Eigen::VectorXd> waypoints = space_.waypointsOf(*path);
    const double planned_length = jointLength(waypoints);
    if (run_.request().shorten) waypoints = detail::shortened(std::move(waypoints), run_);
    const double length = jointLength(waypoints);
    if (!result.waypoints.empty() && length > kShorter * result.length) return false;
    result.waypoints = std::move(waypoints);
    result.planned_length = planned_length;
    result.length = length;
    return true;
  }

  /// The first path may pass an obstacle on its far side, which no short cut mends: further trees
  /// grow where shorter ones pass, as long as they find some. Half of the states and of the time
  /// are left to those who have uses for the path.
  void lookForShorter(PlanningResult& result) {
    const double straight = (goal_ - start_).norm();
    const std::size_t states = run_.states();
    const double seconds = run_.seconds();
    std::uint64_t seed = run_.request().seed;
    for (int in_vain = 0; in_vain < kMostInVain && mayCostAgain(states, seconds); ++in_vain) {
      const double longest = kShorter * result.length;
      if (longest <= straight || space_.dimension() < 2) break;
      space_.drawWithin(longest, ++seed);
      if (connectShorter(result, states)) in_vain = -1;
    }
    result.shortened = !run_.isStopped();
  }

  bool mayCostAgain(std::size_t states, double seconds) const {
    const auto& limit = run_.request().time_limit;
    return !run_.isStopped() && run_.states() + states <= run_.request().max_states / 2 &&
           !(limit && run_.seconds() + seconds > 0.5 * *limit);
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
