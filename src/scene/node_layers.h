// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The layers in which the C-obstacles of pairs of flat nodes are.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "base/kept_memory.h"
#include "scene/node_slabs.h"
#include "scene/whitened_tree.h"

namespace fcl_prob::detail {

/// lo <= n·y <= hi; n has any length.
struct NodeLayer {
  Eigen::Vector3d n;
  double lo;
  double hi;
};

/// Of pairs of nodes of meshes, whitened: along the surface of the larger one. Where a mesh is
/// dense a box along the axes around a node is much thicker than what is in it.
class NodeLayers {
 public:
  /// Keeps references to the pair. Nothing is known of objects with motions or bands.
  explicit NodeLayers(const WhitenedPair& pair);

  /// Certainly contains the C-obstacle of two nodes, as far as it is within kReach; nothing where
  /// neither is flat.
  std::optional<NodeLayer> of(NodePair nodes);

 private:
  /// A part that is a mesh, and what becomes of the slabs of its nodes.
  struct Part {
    int root;
    const std::vector<NodeSlab>* slabs;
    Eigen::Matrix3d normals;  ///< to those of the whitened frame
    Eigen::Vector3d offset;   ///< of its origin
    double rounding;          ///< metres, of lo and hi
  };

  /// The slab of a flat node in the whitened frame.
  struct Slab {
    NodeLayer layer;
    double square;  ///< |n|²
  };

  /// One object.
  class Side {
   public:
    explicit Side(const WhitenedTree& tree) : tree_(tree) {}

    void useSlabs();
    const NodeBox& box(int node) const { return tree_.boxOf(node); }

    /// Null where a node is not flat; valid until the next call.
    const Slab* slabOf(int node);

   private:
    static constexpr int kUnknown = -2;
    static constexpr int kNotFlat = -1;

    int whiten(int node);

    const WhitenedTree& tree_;
    std::vector<Part> parts_;  ///< in the order of their roots
    /// By node, in `slabs_`; empty where no slabs are used.
    std::vector<int, KeptMemory<int>> places_;
    std::vector<Slab, KeptMemory<Slab>> slabs_;  ///< of nodes that were asked for
  };

  static Part partOf(const WhitenedTree& tree, std::size_t index);
  NodeLayer between(const Slab& slab, bool of_a, const NodeBox& box, const Slab* own) const;

  Side a_;
  Side b_;
  Eigen::Vector3d rounding_;  ///< of what is multiplied with a normal, for each axis
};

}  // namespace fcl_prob::detail
