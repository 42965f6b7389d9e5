// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Bounds on the masses of cells that are divided again and again.
#pragma once

#include <cstddef>
#include <vector>

#include "fcl_prob/bounds.h"

namespace fcl_prob::detail {

/// Bounds on what each cell contributes to a sum. What is known of a cell holds for the sum of its
/// parts, not for a part: of that nothing is known before it was looked at itself.
class MassTree {
 public:
  /// Of one cell, of which `all` is known.
  explicit MassTree(const Bounds& all);

  /// A part of a cell, of which `known` is known; all parts are to be added before any of them is
  /// tightened. \returns its number; the first cell is 0
  std::size_t addPart(std::size_t cell, const Bounds& known);

  /// What is known of a cell from now on, too.
  void tighten(std::size_t cell, const Bounds& known);

  /// Certified if all that was said is.
  const Bounds& sum() const { return nodes_.front().mass; }

  /// Bytes, about.
  std::size_t memory() const { return nodes_.size() * (sizeof(Node) + 2 * sizeof(std::size_t)); }

 private:
  struct Node {
    Bounds mass;
    std::size_t parent;
    std::vector<std::size_t> parts;
  };

  void tightenByParts(std::size_t cell);

  std::vector<Node> nodes_;
};

}  // namespace fcl_prob::detail
