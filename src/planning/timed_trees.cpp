// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "planning/timed_trees.h"

#include <algorithm>

#include "base/constants.h"
#include "planning/joint_space.h"
#include "planning/moving_joints.h"

namespace fcl_prob::detail {
namespace {

/// Samples, one after the other, that no state is asked for: joints are too slow for all of them.
constexpr int kMostSamplesInVain = 10'000;

}  // namespace

TimedTrees::TimedTrees(const Robot& robot, const TimedStates& states, PlanningRun& run,
                       const Eigen::VectorXd& start, const std::vector<Eigen::VectorXd>& goals)
    : states_(states), run_(run), random_(run.request().seed) {
  from_start_.nodes.push_back({start, -1});
  for (const Eigen::VectorXd& goal : goals) from_goal_.nodes.push_back({goal, -1});
  for (std::size_t i = 0; i < robot.joints().size(); ++i) {
    const auto index = static_cast<Eigen::Index>(i);
    ranges_.emplace_back(start[index], start[index]);
  }
  for (const Eigen::Index i : movingJoints(robot, run.request().joints)) {
    const auto index = static_cast<std::size_t>(i);
    ranges_[index] =
        sampledRange(robot.joints()[index], start[i], goals[0][i], run.request().largest_step);
  }
}

std::vector<Eigen::VectorXd> TimedTrees::connect(std::size_t most_states) {
  const std::size_t before = run_.states();
  Tree* grows = &from_start_;
  Tree* other = &from_goal_;
  const auto mayGoOn = [&] { return run_.states() - before < most_states && !run_.isStoppedNow(); };
  std::size_t asked = before;
  for (int in_vain = 0; in_vain < kMostSamplesInVain && mayGoOn(); std::swap(grows, other)) {
    in_vain = run_.states() > asked ? 0 : in_vain + 1;
    asked = run_.states();
    const Eigen::VectorXd to = sample();
    const int from = nearest(*grows, to);
    if (from < 0 || extend(*grows, from, to) == Growth::none) continue;
    if (reach(*other, grows->nodes.back().state)) return path();
  }
  return {};
}

/// At a time at which the state can be on the way from the start to the latest goal.
Eigen::VectorXd TimedTrees::sample() {
  const Eigen::VectorXd& start = from_start_.nodes.front().state;
  const auto latest = [this](const Node& x, const Node& y) {
    return states_.timeOf(x.state) < states_.timeOf(y.state);
  };
  const Eigen::VectorXd& goal =
      std::max_element(from_goal_.nodes.begin(), from_goal_.nodes.end(), latest)->state;
  Eigen::VectorXd values(start.size() - 1);
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    const auto [low, high] = ranges_[static_cast<std::size_t>(i)];
    values[i] = low + uniform() * (high - low);
  }
  const double begin = states_.timeOf(start) + states_.soonest(start, values);
  const double end = states_.timeOf(goal) - states_.soonest(values, goal);
  return states_.at(begin + uniform() * std::max(0.0, end - begin), values);
}

/// Among those from which the state is reached in time; -1: there is none.
int TimedTrees::nearest(const Tree& tree, const Eigen::VectorXd& to) const {
  int best = -1;
  double least = kInfinity;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const Eigen::VectorXd& state = tree.nodes[i].state;
    const double distance = (to - state).squaredNorm();
    if (!(distance < least)) continue;
    if (!(tree.forward ? states_.isForwardInTime(state, to) : states_.isForwardInTime(to, state)))
      continue;
    least = distance;
    best = static_cast<int>(i);
  }
  return best;
}

TimedTrees::Growth TimedTrees::extend(Tree& tree, int from, const Eigen::VectorXd& to) {
  const Eigen::VectorXd state = tree.nodes[static_cast<std::size_t>(from)].state;
  const double distance = (to - state).norm();
  const bool is_near = distance <= kTreeRange;
  const Eigen::VectorXd next = is_near ? to : (state + kTreeRange / distance * (to - state)).eval();
  if (!(tree.forward ? run_.isMotionAllowed(state, next)
                     : run_.isAllowed(next) && run_.isMotionAllowed(next, state))) {
    return Growth::none;
  }
  tree.nodes.push_back({next, from});
  return is_near ? Growth::reached : Growth::some;
}

bool TimedTrees::reach(Tree& tree, const Eigen::VectorXd& to) {
  for (int from = nearest(tree, to); from >= 0; from = static_cast<int>(tree.nodes.size()) - 1) {
    const Growth growth = extend(tree, from, to);
    if (growth != Growth::some) return growth == Growth::reached;
  }
  return false;
}

/// Through the state that was last added to both trees.
std::vector<Eigen::VectorXd> TimedTrees::path() const {
  const auto wayOf = [](const Tree& tree) {
    std::vector<Eigen::VectorXd> way;
    for (int i = static_cast<int>(tree.nodes.size()) - 1; i >= 0;) {
      const Node& node = tree.nodes[static_cast<std::size_t>(i)];
      way.push_back(node.state);
      i = node.parent;
    }
    return way;
  };
  std::vector<Eigen::VectorXd> path = wayOf(from_start_);
  std::reverse(path.begin(), path.end());
  const std::vector<Eigen::VectorXd> rest = wayOf(from_goal_);
  path.insert(path.end(), rest.begin() + 1, rest.end());
  return path;
}

}  // namespace fcl_prob::detail
