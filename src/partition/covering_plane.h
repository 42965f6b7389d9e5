// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What a C-obstacle covers of a cell when one of its planes is kept and the others are cut away.
#pragma once

#include "partition/open_cell.h"
#include "partition/slab_kernels.h"

namespace fcl_prob::detail {

/// `inner.m·y >= inner.s` in `within`, a part of the cell, is within the C-obstacle, which lies in
/// {inner.m·y >= outer}. `share` is roughly the share of the cell covered so; 0 if there is none.
struct CoveringPlane {
  CellPlane inner;
  double outer = 0.0;
  Cell within{};
  double share = 0.0;
};

/// Keeps the plane that cuts off most of the cell, and narrows the cell until the obstacle's other
/// planes do not cut it.
CoveringPlane coveringPlane(const SlabArrays& slabs, const Cell& cell);

}  // namespace fcl_prob::detail
