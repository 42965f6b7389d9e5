// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "planning/rrt_connect.h"

#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/goals/GoalStates.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>

#include "planning/quiet_ompl.h"

namespace fcl_prob::detail {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

/// How far the trees of RRT-Connect grow at once, in joint space. An edge is taken whole or not at
/// all: long ones are refused more often.
constexpr double kRange = 0.5;

}  // namespace

std::vector<Eigen::VectorXd> connected(const JointSpace& space, PlanningRun& run,
                                       const Eigen::VectorXd& start,
                                       const std::vector<Eigen::VectorXd>& goals) {
  const QuietOmpl quiet;
  const auto problem = std::make_shared<ob::ProblemDefinition>(space.information());
  ob::ScopedState<> state(space.information());
  space.write(start, state.get());
  problem->addStartState(state);
  const auto goal = std::make_shared<ob::GoalStates>(space.information());
  for (const Eigen::VectorXd& values : goals) {
    space.write(values, state.get());
    goal->addState(state);
  }
  problem->setGoal(goal);
  og::RRTConnect planner(space.information());
  planner.setRange(kRange);
  planner.setProblemDefinition(problem);
  planner.setup();
  // OMPL may go on for long without a state, where no nearer one is left.
  const ob::PlannerTerminationCondition stop([&run] { return run.isStoppedNow(); });
  if (planner.solve(stop) != ob::PlannerStatus::EXACT_SOLUTION) return {};
  return space.waypointsOf(
      *std::static_pointer_cast<og::PathGeometric>(problem->getSolutionPath()));
}

}  // namespace fcl_prob::detail
