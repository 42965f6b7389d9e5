// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The obstacle of a list that covers most of a cell, as far as a few samples tell.
#pragma once

#include <vector>

#include "cells/carved_cell.h"

namespace fcl_prob::detail {

/// Steers: no bound depends on the choice.
class ObstacleChooser {
 public:
  /// Keeps a reference to the obstacles.
  explicit ObstacleChooser(const FatMembers& obstacles) : obstacles_(obstacles) {}

  /// Index of an entry. Hulls come last: they settle nothing.
  std::size_t best(const CellPolytope& body, const ObstacleList& list);

 private:
  void takeSamples(const CellPolytope& body);
  double scoreOf(const ObstacleList& list, const ObstacleList::Entry& entry, double most) const;

  const FatMembers& obstacles_;
  std::vector<Eigen::Vector3d> samples_;  ///< of a cell, and what they stand for
  std::vector<double> weights_;
};

}  // namespace fcl_prob::detail
