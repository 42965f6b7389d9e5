// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "carving/column_bounds.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "carving/line_columns.h"

namespace fcl_prob::detail {
namespace {

// Columns of the first look and of the last one; there are twice as many at every look. Measured on
// robot parts beside an arm.
constexpr std::size_t kFirstColumns = 16;
constexpr std::size_t kMostColumns = 256;

// The more members there are, the longer a column takes: then so many are the most.
constexpr std::size_t kMostColumnsOfGroup = 32;

// The distance of P from an end of the interval falls about with these powers of the number of
// columns.
constexpr double kConvergenceBelow = 0.6;
constexpr double kConvergenceAbove = 0.65;

// Of its gap, what a column leaves to each of its halves.
constexpr double kGapOfHalf = 0.35;

// Of what may be in a column: what one line does not tell of.
constexpr double kUnseen = 0.3;

// Of a sum of masses.
constexpr double kRounded = 1e-12;

/// What is known of one column besides a bound from above.
struct KnownColumn {
  WholeBodyLines::LineContacts middle;  ///< of one line
  double least = 0.0;                   ///< of its lines in the mean, certainly
  bool has_least = false;
};

class ColumnLooks {
 public:
  ColumnLooks(WholeBodyLines& lines, double threshold)
      : lines_(lines),
        threshold_(threshold),
        most_columns_(lines.memberCount() == 1 ? kMostColumns : kMostColumnsOfGroup),
        columns_(lines) {
    columns_.divideByMass(kFirstColumns);
  }

  ColumnBounds run() {
    ColumnBounds bounds{{0.0, 1.0}, 0.0, 0};
    for (;;) {
      const std::size_t before = std::exchange(bounds.columns, columns_.inOrder().size());
      look(bounds);
      const bool is_decided = bounds.bounds.lower > threshold_ || bounds.bounds.upper < threshold_;
      // Columns that know all of their mass are not divided.
      const bool may_be_divided = bounds.columns > before && 2 * bounds.columns <= most_columns_;
      if (is_decided || !may_be_divided ||
          !(columnsToDecide(bounds) < static_cast<double>(most_columns_))) {
        return bounds;
      }
      columns_.divide(2 * bounds.columns, kGapOfHalf);
    }
  }

 private:
  // Only the end of the interval that P is to be separated from is looked for.
  void look(ColumnBounds& bounds) {
    bounds.likely = 0.0;
    for (const int column : columns_.inOrder()) {
      bounds.likely += middleOf(column).mass * columns_[column].measure;
    }
    const bool is_above = bounds.likely > threshold_;
    double lower = 0.0;
    for (const int column : columns_.inOrder()) {
      LineColumns::Node& node = columns_[column];
      const double middle = middleOf(column).mass;
      const double least = is_above ? leastOf(column) : 0.0;
      lower += least * node.measure;
      const double seen = is_above ? middle - least : node.most - middle;
      node.weight = std::max({0.0, seen, kUnseen * (node.most - least)}) * node.measure;
    }
    bounds.bounds.lower = std::max(bounds.bounds.lower, lower * (1.0 - kRounded));
    bounds.bounds.upper = std::min(bounds.bounds.upper, columns_.most());
  }

  const WholeBodyLines::LineContacts& middleOf(int column) {
    const auto [at, is_new] = known_.try_emplace(column);
    KnownColumn& known = at->second;
    if (!is_new) return known.middle;
    known.middle = lines_.contactsOn(detail::middleOf(columns_[column].column));
    const auto parent = known_.find(columns_[column].parent);
    if (parent == known_.end()) return known.middle;
    // The parent's best touch is its first one.
    auto& touches = known.middle.touches;
    const auto& of_parent = parent->second.middle.touches;
    if (!of_parent.empty()) touches.push_back(of_parent.front());
    return known.middle;
  }

  double leastOf(int column) {
    KnownColumn& known = known_.at(column);
    auto& touches = known.middle.touches;
    if (std::exchange(known.has_least, true)) return known.least;
    for (auto& touch : touches) {
      const double least = lines_.leastOn(columns_[column].column, touch);
      if (!(least > known.least)) continue;
      known.least = least;
      std::swap(touch, touches.front());
    }
    return known.least;
  }

  // How many it takes until the end of the interval is on the same side of the threshold as P.
  double columnsToDecide(const ColumnBounds& known) const {
    const bool is_above = known.likely > threshold_;
    const double end = is_above ? known.bounds.lower : known.bounds.upper;
    const double ratio = std::fabs((known.likely - end) / (known.likely - threshold_));
    return static_cast<double>(known.columns) *
           std::pow(ratio, 1.0 / (is_above ? kConvergenceBelow : kConvergenceAbove));
  }

  WholeBodyLines& lines_;
  double threshold_;
  std::size_t most_columns_;
  LineColumns columns_;
  std::unordered_map<int, KnownColumn> known_;
};

}  // namespace

ColumnBounds columnBounds(WholeBodyLines& lines, double threshold) {
  return ColumnLooks(lines, threshold).run();
}

}  // namespace fcl_prob::detail
