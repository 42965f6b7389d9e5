// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "lines/column_bounds.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/constants.h"
#include "base/known.h"

namespace fcl_prob::detail {
namespace {

// Columns of the first look and of the last one; there are twice as many at every look. Measured on
// robot parts beside an arm.
constexpr std::size_t kFirstColumns = 16;
constexpr std::size_t kMostColumns = 1024;

// The more members there are, the longer a column takes: then so many are the most.
constexpr std::size_t kMostColumnsOfGroup = 32;

// The distance of P from an end of the interval falls about with these powers of the number of
// columns.
constexpr double kConvergenceBelow = 0.6;
constexpr double kConvergenceAbove = 0.85;

// Of its gap, what a column leaves to each of its halves.
constexpr double kGapOfHalf = 0.35;

// Of what may be in a column: what one line does not tell of.
constexpr double kUnseen = 0.3;

// Of a sum of masses.
constexpr double kRounded = 1e-12;

// How many it takes until the end of the interval is on the same side of the threshold as P.
double columnsToDecide(const ColumnBounds& known, double threshold) {
  const bool is_above = known.likely > threshold;
  const double end = is_above ? known.bounds.lower : known.bounds.upper;
  const double ratio = std::fabs((known.likely - end) / (known.likely - threshold));
  return static_cast<double>(known.columns) *
         std::pow(ratio, 1.0 / (is_above ? kConvergenceBelow : kConvergenceAbove));
}

}  // namespace

ColumnLooks::ColumnLooks(WholeBodyLines& lines, Taken taken)
    : lines_(lines), taken_(taken), columns_(lines) {
  columns_.divideByMass(kFirstColumns);
}

double ColumnLooks::likely() {
  double sum = 0.0;
  for (const int column : columns_.inOrder()) {
    sum += middleOf(column).mass * columns_[column].measure;
  }
  return sum;
}

Bounds ColumnLooks::look(bool above) {
  double lower = 0.0, upper = 0.0;
  for (const int column : columns_.inOrder()) {
    LineColumns::Node& node = columns_[column];
    const double middle = middleOf(column).mass;
    const double least = above ? leastOf(column) : 0.0;
    const double most = above ? node.most : mostOf(column);
    lower += least * node.measure;
    upper += most * node.measure;
    const double seen = above ? middle - least : most - middle;
    node.weight = std::max({0.0, seen, kUnseen * (most - least)}) * node.measure;
  }
  upper = std::min(columns_.most(), upper * (1.0 + kRounded) + kUnderflow);
  bounds_ = agreed(bounds_, {lower * (1.0 - kRounded), upper});
  return bounds_;
}

// Columns that know all of their mass are not divided.
bool ColumnLooks::divideTo(std::size_t count) {
  const std::size_t before = columns_.inOrder().size();
  columns_.divide(count, kGapOfHalf);
  return columns_.inOrder().size() > before;
}

const WholeBodyLines::LineContacts& ColumnLooks::middleOf(int column) {
  const auto [at, is_new] = known_.try_emplace(column);
  KnownColumn& known = at->second;
  if (!is_new) return known.middle;
  const LineColumns::Node& node = columns_[column];
  known.middle = lines_.contactsOn(detail::middleOf(node.column), node.met, taken_);
  return known.middle;
}

double ColumnLooks::mostOf(int column) {
  KnownColumn& known = known_.at(column);
  if (std::exchange(known.has_most, true)) return known.most;
  const LineColumns::Node& node = columns_[column];
  known.most = std::min(node.most, lines_.mostMeanOn(node.column, node.met));
  return known.most;
}

double ColumnLooks::leastOf(int column) {
  KnownColumn& known = known_.at(column);
  if (std::exchange(known.has_least, true)) return known.least;
  known.least = lines_.leastOn(columns_[column].column, known.middle.chain);
  return known.least;
}

ColumnBounds columnBounds(WholeBodyLines& lines, double threshold, std::size_t limit) {
  const std::size_t most_columns =
      std::min(limit, lines.memberCount() == 1 ? kMostColumns : kMostColumnsOfGroup);
  const auto most = static_cast<double>(most_columns);
  ColumnLooks looks(lines, Taken::cores);
  ColumnBounds known{{0.0, 1.0}, 0.0, 0};
  for (;;) {
    known.columns = looks.columns().inOrder().size();
    known.likely = looks.likely();
    known.bounds = looks.look(known.likely > threshold);
    const bool is_decided = known.bounds.lower > threshold || known.bounds.upper < threshold;
    if (is_decided || 2 * known.columns > most_columns ||
        !(columnsToDecide(known, threshold) < most) || !looks.divideTo(2 * known.columns)) {
      return known;
    }
  }
}

}  // namespace fcl_prob::detail
