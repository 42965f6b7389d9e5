// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "carving/column_bounds.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "carving/line_columns.h"

namespace fcl_prob::detail {
namespace {

// Columns of the first look and of the last one; there are twice as many at every look. Measured on
// robot parts beside an arm.
constexpr std::size_t kFirstColumns = 16;
const std::size_t kMostColumns = getenv("MC") ? atoi(getenv("MC")) : 256;

// The distance of P from an end of the interval falls about with these powers of the number of
// columns.
constexpr double kConvergenceBelow = 0.8;
constexpr double kConvergenceAbove = 0.5;

// Of its gap, what a column leaves to each of its halves.
constexpr double kGapOfHalf = 0.35;

// Of a sum of masses.
constexpr double kRounded = 1e-12;

ColumnBounds look(LineColumns& columns, WholeBodyLines& lines) {
  double lower = 0.0, likely = 0.0;
  for (const int column : columns.inOrder()) {
    LineColumns::Node& node = columns[column];
    const auto mass = lines.leastOn(node.column, middleOf(node.column), node.of_least);
    node.least = mass.least;
    node.of_least = mass.of_least;
    lower += node.least * node.measure;
    likely += mass.middle * node.measure;
    node.weight = std::max(0.0, node.most - node.least) * node.measure;
  }
  const Bounds bounds{lower * (1.0 - kRounded), std::min(1.0, columns.most())};
  return {bounds, likely, columns.inOrder().size()};
}

// How many columns it takes until the end of the interval is on the same side of the threshold as
// P.
double columnsToDecide(const ColumnBounds& known, double threshold) {
  const bool is_above = known.likely > threshold;
  const double end = is_above ? known.bounds.lower : known.bounds.upper;
  const double ratio = std::fabs((known.likely - end) / (known.likely - threshold));
  return static_cast<double>(known.columns) *
         std::pow(ratio, 1.0 / (is_above ? kConvergenceBelow : kConvergenceAbove));
}

}  // namespace

ColumnBounds columnBounds(WholeBodyLines& lines, double threshold) {
  LineColumns columns(lines);
  columns.divideByMass(kFirstColumns);
  for (std::size_t before = 0;;) {
    const ColumnBounds known = look(columns, lines);
    if (getenv("DBG"))
      fprintf(stderr, "  cols %zu [%.4f %.4f] ~%.4f\n", known.columns, known.bounds.lower,
              known.bounds.upper, known.likely);
    const bool is_decided = known.bounds.lower > threshold || known.bounds.upper < threshold;
    // Columns that know all of their mass are not divided.
    const bool is_divided = known.columns > before && 2 * known.columns <= kMostColumns;
    if (is_decided || !is_divided ||
        !(columnsToDecide(known, threshold) < static_cast<double>(kMostColumns))) {
      return known;
    }
    before = known.columns;
    columns.divide(2 * known.columns, kGapOfHalf);
  }
}

}  // namespace fcl_prob::detail
