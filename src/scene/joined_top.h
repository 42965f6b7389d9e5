// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The nodes above those of several piece trees that become one.
#pragma once

#include <fcl/common/types.h>

#include <Eigen/Geometry>
#include <map>
#include <vector>

#include "scene/piece_tree.h"

namespace fcl_prob::detail {

/// Neighbours in the list of trees (the links of an arm) are mostly neighbours in space: they are
/// joined by halves of the list.
///
/// A mesh in a row of places, as a link has along a motion, is interwoven: as long as a part of it
/// is larger than the way that it goes, a node stands for the part in all of these places, then for
/// halves of the places. A cell meets few such nodes, where it would meet as many nodes of single
/// places as the part has within its own size. Only what is small beside the ways belongs to a
/// tree of one place; the nodes that its tree has above that have no parents.
class JoinedTop {
 public:
  /// A node of one of the trees, or of the top.
  struct Place {
    static constexpr int kTop = -1;

    int tree;
    int node;
  };

  struct Node {
    Place left;
    Place right;
  };

  /// Keeps references. \param poses  of all trees, in one frame, or none: nothing is interwoven
  JoinedTop(const std::vector<const PieceTree*>& trees, const std::vector<fcl::Transform3d>& poses);

  /// A parent comes before its children. None above a single tree.
  const std::vector<Node>& nodes() const { return nodes_; }

 private:
  /// Trees from `first` to `last`, which are the same one.
  struct Row {
    int first;
    int last;
  };

  using Boxes = std::vector<Eigen::AlignedBox3d>;

  std::vector<Row> rows() const;
  bool mayBeInterwoven(const PieceTree& tree) const;
  const Boxes& boxesOf(const PieceTree& tree);
  Place halves(const std::vector<Row>& rows, std::size_t begin, std::size_t end);
  Place interwoven(const Boxes& boxes, int node, const Row& row);
  bool movesFar(const Boxes& boxes, int node, const Row& row) const;

  const std::vector<const PieceTree*>& trees_;
  const std::vector<fcl::Transform3d>& poses_;
  std::map<const PieceTree*, Boxes> boxes_;  ///< around the nodes, relative to the part's origin
  std::vector<Node> nodes_;
};

}  // namespace fcl_prob::detail
