// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Random lines of a column.
#pragma once

#include "cells/cell_draw.h"
#include "lines/node_spans.h"

namespace fcl_prob::detail {

/// Distributed as the normal distribution is in the column. \param uniform  in the open unit
/// square; reflected at its middle gives the line that is mirrored at that of the column's mass
inline Eigen::Vector2d pointOf(const Column& column, const Eigen::Vector2d& uniform) {
  return {truncatedNormal(column.lo[0], column.hi[0], uniform[0]),
          truncatedNormal(column.lo[1], column.hi[1], uniform[1])};
}

}  // namespace fcl_prob::detail
