// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "pose/mass_tree.h"

#include <algorithm>

#include "base/constants.h"

namespace fcl_prob::detail {

MassTree::MassTree(const Bounds& all) : nodes_{{all, 0, {}}} {}

std::size_t MassTree::addPart(std::size_t cell, const Bounds& known) {
  const std::size_t part = nodes_.size();
  nodes_.push_back({known, cell, {}});
  nodes_[cell].parts.push_back(part);
  return part;
}

void MassTree::tighten(std::size_t cell, const Bounds& known) {
  Bounds& mass = nodes_[cell].mass;
  mass.lower = std::max(mass.lower, known.lower);
  mass.upper = std::min(mass.upper, known.upper);
  while (cell != 0) {
    cell = nodes_[cell].parent;
    tightenByParts(cell);
  }
}

void MassTree::tightenByParts(std::size_t cell) {
  Bounds sum{0.0, 0.0};
  for (const std::size_t part : nodes_[cell].parts) {
    sum.lower += nodes_[part].mass.lower;
    sum.upper += nodes_[part].mass.upper;
  }
  // An ε for each addition, and two for the factor below.
  const double rounding = kEpsilon * static_cast<double>(nodes_[cell].parts.size() + 2);
  Bounds& mass = nodes_[cell].mass;
  mass.lower = std::max(mass.lower, sum.lower * (1.0 - rounding));
  mass.upper = std::min(mass.upper, sum.upper * (1.0 + rounding));
}

}  // namespace fcl_prob::detail
