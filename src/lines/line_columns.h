// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The displacement space in columns along the first axis, each with a bound on its collisions.
#pragma once

#include <vector>

#include "lines/whole_body_lines.h"

namespace fcl_prob::detail {

/// Whether its lines go on to where there is next to nothing of the normal distribution.
bool reachesOut(const Column& column);

/// Where most of what is normally distributed in a column is, about.
Eigen::Vector2d middleOf(const Column& column);

/// Disjoint columns that together are all of the space.
class LineColumns {
 public:
  struct Node {
    Column column;
    WholeBodyLines::Met met;
    double most;          ///< of any line
    double measure;       ///< of the normal distribution across the lines
    double weight = 0.0;  ///< how much it should be divided
    int left = -1;        ///< child; the right one is behind it

    double mass() const { return most * measure; }
  };

  /// One column, of which nothing is known. Keeps the reference.
  explicit LineColumns(WholeBodyLines& lines);

  /// Certainly no less than P.
  double most() const;

  /// Indices of the columns that may collide, such that those that are near each other stand near
  /// each other.
  const std::vector<int>& inOrder() const { return in_order_; }
  /// Whether the column at u may collide.
  bool mayCollideAt(const Eigen::Vector2d& u) const;

  Node& operator[](int column) { return nodes_[column]; }
  const Node& operator[](int column) const { return nodes_[column]; }

  /// Divides the column of the largest weight again and again, until there are so many.
  /// \param rest  of its weight that a column leaves to each half
  void divide(std::size_t count, double rest);

  /// Divides those of the largest mass.
  void divideByMass(std::size_t count);

 private:
  Node nodeOf(const Column& column, const WholeBodyLines::Met& among, double most);
  void divideOne(int node, double rest);
  void putInOrder();

  WholeBodyLines& lines_;
  std::vector<Node> nodes_;
  std::vector<int> in_order_;
  bool by_mass_ = false;
};

}  // namespace fcl_prob::detail
