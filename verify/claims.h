// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The claims of cells.
#pragma once

#include <string>
#include <vector>

#include "mass.h"
#include "scene.h"

namespace verify {

/// What has been verified, added up. One a thread.
struct Tally {
  Ball contact;    // mass of regions of contact
  Ball cells;      // mass of cells
  Ball undecided;  // mass of what is in no free set
  std::size_t claims = 0;
  slong bits;  // the precision of the sums
  Masses masses;

  explicit Tally(slong precision) : bits(precision), masses(precision) {}
};

/// Checks all claims of a cell and adds its masses; throws Refused.
void check_cell(const Scene& scene, const Cell& cell, Tally& tally);

struct Box {
  std::size_t line;
  Vec lo, hi;
};
/// Lines of two boxes that overlap; zeros if there are none.
std::pair<std::size_t, std::size_t> overlapping(const std::vector<Box>& boxes, int rank);

}  // namespace verify
