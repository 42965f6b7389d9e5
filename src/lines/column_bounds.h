// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A first, certified interval where convex meshes are taken whole.
#pragma once

#include <unordered_map>

#include "fcl_prob/bounds.h"
#include "lines/line_columns.h"

namespace fcl_prob::detail {

struct ColumnBounds {
  Bounds bounds;
  double likely;  ///< P, about
  std::size_t columns;
};

/// Columns across the nearest contact, what the line in the middle of each tells, and certified
/// bounds on the lines in the mean.
class ColumnLooks {
 public:
  /// Keeps the reference.
  /// \param taken  what members are taken for on the line in the middle
  ColumnLooks(WholeBodyLines& lines, Taken taken);

  /// P, about: by the lines in the middle of the columns as they are.
  double likely();

  /// Certified, of all columns so far: the end of the interval that P is to be separated from, the
  /// other one as it was. Columns are then divided for its sake.
  /// \param above  whether that is the lower one
  Bounds look(bool above);

  /// Until there are so many. False if no more have anything open.
  bool divideTo(std::size_t count);

  const LineColumns& columns() const { return columns_; }

  /// Of the line in the middle, about.
  double massInMiddle(int column) { return middleOf(column).mass; }

  /// Of the lines of the column in the mean: certain.
  double leastOf(int column);
  double mostOf(int column);

 private:
  /// What is known of one column besides a bound on each of its lines.
  struct KnownColumn {
    WholeBodyLines::LineContacts middle;  ///< of one line
    double least = 0.0;                   ///< of its lines in the mean, certainly
    bool has_least = false;
    double most = 1.0;  ///< the same
    bool has_most = false;
  };

  const WholeBodyLines::LineContacts& middleOf(int column);

  WholeBodyLines& lines_;
  Taken taken_;
  LineColumns columns_;
  std::unordered_map<int, KnownColumn> known_;
  Bounds bounds_{0.0, 1.0};
};

/// Ends when it is certain on which side of the threshold P lies, or when that would likely
/// take more columns than pay, or than `limit` if that is not less than those of the first look.
ColumnBounds columnBounds(WholeBodyLines& lines, double threshold, std::size_t limit);

}  // namespace fcl_prob::detail
