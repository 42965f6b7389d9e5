// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/volumes.h"

#include "paper/hull_tree.h"

namespace fcl_prob::cli {
double hullVolume(const TriangleMesh& mesh) {
  return detail::volumeOf(detail::makeConvexMesh(mesh.vertices));
}

std::vector<double> volumesByLevel(const ConvexHullTree& tree, int levels) {
  return volumesByLevel(
      levels, [&tree](int node) { return tree.volume(node); },
      [&tree](int node) { return tree.tree().leftChild(node); });
}

}  // namespace fcl_prob::cli
