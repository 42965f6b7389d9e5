// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The C-obstacles of pairs of convex pieces, built when a cell first needs them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <unordered_map>
#include <vector>

#include "cobstacle/support_obstacle.h"
#include "partition/whitened_tree.h"

namespace fcl_prob::detail {

class ObstacleTable {
 public:
  /// Keeps a reference to `pair`.
  explicit ObstacleTable(const WhitenedPair& pair);

  /// Index of the C-obstacle of a leaf of A and a leaf of B.
  int find(NodePair leaves);

  /// The slabs of two leaves that are looked at once: valid until the next call.
  SlabArrays slabsOnce(NodePair leaves);

  /// A half-space {m·y >= s} as an obstacle of its own: index of a new one.
  int addHalfSpace(const Eigen::Vector3d& m, double s);

  const SlabArrays& slabs(int obstacle) const { return obstacles_[obstacle]; }

  /// The same C-obstacle by its support function: what its slabs leave open if they are outer_only.
  SupportObstacle support(NodePair leaves) const;

  /// Pairs of leaves that were asked for.
  std::size_t pairCount() const { return index_.size(); }

  std::size_t memory() const;

 private:
  double* allocate(int count);
  bool areTriangles(NodePair leaves) const;
  SlabArrays buildTriangles(NodePair leaves, double* data) const;
  SlabArrays buildPieces(NodePair leaves);
  bool hasFewSlabs(NodePair leaves) const;

  const WhitenedPair& pair_;
  std::vector<SlabArrays> obstacles_;
  std::unordered_map<std::uint64_t, int> index_;
  std::deque<std::vector<double>> blocks_;
  std::size_t block_used_ = 0;
  std::array<double, kTriangleSlabs * kSlabFields> once_;
};

}  // namespace fcl_prob::detail
