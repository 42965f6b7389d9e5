// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "carving/column_bounds.h"

#include <algorithm>

#include "carving/line_columns.h"

namespace fcl_prob::detail {
namespace {

// Columns of the first look and of the last one; there are twice as many at every look. Measured on
// robot parts beside an arm.
constexpr std::size_t kFirstColumns = 16;
constexpr std::size_t kMostColumns = 64;

// Of the width of the interval: a threshold that is farther from both of its ends is left to
// others.
constexpr double kNearEnd = 0.25;

// Of its gap, what a column leaves to each of its halves.
constexpr double kGapOfHalf = 0.35;

// Of a sum of masses.
constexpr double kRounded = 1e-12;

Bounds look(LineColumns& columns, WholeBodyLines& lines) {
  double lower = 0.0;
  for (const int column : columns.inOrder()) {
    LineColumns::Node& node = columns[column];
    node.least = std::max(node.least, lines.leastOn(node.column));
    lower += node.least * node.measure;
    node.weight = std::max(0.0, node.most - node.least) * node.measure;
  }
  return {lower * (1.0 - kRounded), std::min(1.0, columns.most())};
}

}  // namespace

ColumnBounds columnBounds(WholeBodyLines& lines, double threshold) {
  LineColumns columns(lines);
  columns.divideByMass(kFirstColumns);
  for (std::size_t before = 0;;) {
    const Bounds bounds = look(columns, lines);
    const std::size_t count = columns.inOrder().size();
    const double missing = std::min(bounds.upper - threshold, threshold - bounds.lower);
    const bool is_decided = missing < 0.0;
    const bool is_far = missing > kNearEnd * bounds.width() || 2 * count > kMostColumns;
    // Columns that know all of their mass are not divided.
    if (is_decided || is_far || count <= before) return {bounds, count};
    before = count;
    columns.divide(2 * count, kGapOfHalf);
  }
}

}  // namespace fcl_prob::detail
