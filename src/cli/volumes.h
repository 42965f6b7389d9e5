// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Volumes of meshes and of the bounding volumes of their trees.
#pragma once

#include <fcl/geometry/bvh/BVH_model.h>

#include <vector>

#include "fcl_prob/convex_hull_tree.h"
#include "fcl_prob/triangle_mesh.h"
#include "geometry/enclosed_volume.h"
#include "paper/bv_volumes.h"

namespace fcl_prob::cli {

/// Volume of the convex hull of its vertices, cubic metres.
double hullVolume(const TriangleMesh& mesh);

using detail::enclosedVolume;
using detail::volumeOf;

/// For levels 0 to `levels` - 1 of a tree: the volumes of all nodes at that depth, added up. Where
/// nodes overlap, their common volume counts more than once. A leaf counts at all levels below it.
/// \param volume_of, left_child_of  of a node's index; the left child is negative at a leaf, else
/// the right one follows it
template <typename Volume, typename LeftChild>
std::vector<double> volumesByLevel(int levels, Volume&& volume_of, LeftChild&& left_child_of) {
  std::vector<double> volumes;
  std::vector<int> nodes{0};
  for (int level = 0; level < levels; ++level) {
    double sum = 0.0;
    std::vector<int> next;
    for (const int node : nodes) {
      sum += volume_of(node);
      const int left = left_child_of(node);
      if (left < 0) {
        next.push_back(node);
      } else {
        next.insert(next.end(), {left, left + 1});
      }
    }
    volumes.push_back(sum);
    nodes.swap(next);
  }
  return volumes;
}

template <typename BV>
std::vector<double> volumesByLevel(const fcl::BVHModel<BV>& model, int levels) {
  return volumesByLevel(
      levels, [&model](int node) { return volumeOf(model.getBV(node).bv); },
      [&model](int node) {
        return model.getBV(node).isLeaf() ? -1 : model.getBV(node).leftChild();
      });
}

std::vector<double> volumesByLevel(const ConvexHullTree& tree, int levels);

}  // namespace fcl_prob::cli
