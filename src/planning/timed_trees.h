// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A first path in joints and time.
#pragma once

#include <random>
#include <utility>
#include <vector>

#include "planning/planning_run.h"
#include "planning/timed_states.h"

namespace fcl_prob::detail {

/// RRT-Connect (Kuffner and LaValle 2000) where time runs one way: a tree grows forwards from the
/// start, another backwards from the goal at several times, and what is nearest is so among the
/// states from which joints are fast enough, as in ST-RRT* (Grothe et al. 2022). OMPL has that from
/// 1.6 on; its older planners know no direction.
class TimedTrees {
 public:
  /// \param goals  at least one
  ///
  /// Keeps references to the states and the run.
  TimedTrees(const Robot& robot, const TimedStates& states, PlanningRun& run,
             const Eigen::VectorXd& start, const std::vector<Eigen::VectorXd>& goals);

  /// From the start to one of the goals; empty if a limit ended the search.
  /// \param most_states  that may be asked for, besides the limits of the run
  std::vector<Eigen::VectorXd> connect(std::size_t most_states);

 private:
  struct Node {
    Eigen::VectorXd state;
    int parent;  ///< -1 at a root
  };
  struct Tree {
    bool forward;  ///< in time
    std::vector<Node> nodes;
  };
  enum class Growth { none, some, reached };

  Eigen::VectorXd sample();
  int nearest(const Tree& tree, const Eigen::VectorXd& to) const;
  Growth extend(Tree& tree, int from, const Eigen::VectorXd& to);
  bool reach(Tree& tree, const Eigen::VectorXd& to);
  std::vector<Eigen::VectorXd> path() const;
  double uniform() { return static_cast<double>(random_() >> 11) * 0x1p-53; }

  const TimedStates& states_;
  PlanningRun& run_;
  std::vector<std::pair<double, double>> ranges_;  ///< by joint
  Tree from_start_{true, {}};
  Tree from_goal_{false, {}};
  std::mt19937_64 random_;
};

}  // namespace fcl_prob::detail
