// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The C-obstacles of pairs of convex pieces, built when a cell first needs them.
#pragma once

#include <array>
#include <boost/container/vector.hpp>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <vector>

#include <tbb/concurrent_vector.h>
#include <tsl/robin_map.h>

#include "base/kept_memory.h"
#include "convex/support_obstacle.h"
#include "scene/front_pair.h"
#include "scene/whitened_tree.h"

namespace fcl_prob::detail {

/// Two slabs that contain the C-obstacle of two triangles, across the planes of each.
struct FaceSlabs {
  std::array<Eigen::Vector3d, 2> n;  ///< of any length
  std::array<double, 2> lo;
  std::array<double, 2> hi;

  /// Whether a point within reach is certainly outside of one of them.
  bool excludes(const Eigen::Vector3d& y) const {
    for (std::size_t i = 0; i < 2; ++i) {
      const double along = n[i].dot(y);
      if (along < lo[i] || along > hi[i]) return true;
    }
    return false;
  }
};

/// Where the slabs of two triangles that are looked at once are built.
using TriangleSlabsData = std::array<double, kTriangleSlabs * kSlabFields>;

/// What an obstacle is depends on its leaves only; its index also on who asked for it first.
class ObstacleTable {
 public:
  /// Keeps a reference to `pair`.
  explicit ObstacleTable(const WhitenedPair& pair);

  /// From here on all but memory() may be called from several threads at once.
  void share() { shared_ = true; }

  /// Index of the C-obstacle of a leaf of A and a leaf of B.
  int find(NodePair leaves);

  /// A pair of nodes as it stands in a front: two leaves with their obstacle.
  FrontPair frontPair(NodePair nodes);

  /// The slabs of two leaves that are looked at once: valid as long as what is in `data` is.
  SlabArrays slabsOnce(NodePair leaves, TriangleSlabsData& data);

  /// Whether the pieces of two leaves are triangles both.
  bool areTriangles(NodePair leaves) const;

  /// Of two triangles; quicker than all of their slabs.
  FaceSlabs faceSlabs(NodePair leaves) const;

  /// A layer {from <= m·y <= to}, where one of them is infinite a half-space, as an obstacle of its
  /// own: index of a new one.
  int addLayer(const Eigen::Vector3d& m, double from, double to);

  const SlabArrays& slabs(int obstacle) const { return obstacles_[obstacle]; }

  /// The same C-obstacle by its support function: what its slabs leave open if they are outer_only.
  SupportObstacle support(NodePair leaves) const;

  /// Pairs of leaves that were asked for.
  std::size_t pairCount() const;

  /// Bytes, about: whoever asked for which of the obstacles first, it is the same.
  std::size_t memory() const;

 private:
  /// Of a pair of nodes as one number: the nodes of a mesh are numbered without gaps, so that the
  /// number itself would send many to the same places (Knuth, The Art of Computer Programming 6.4).
  struct PairHash {
    std::size_t operator()(std::uint64_t pair) const {
      const std::uint64_t product = pair * 0x9e3779b97f4a7c15;  // 2⁶⁴ over the golden ratio
      return static_cast<std::size_t>(product ^ (product >> 32));
    }
  };

  /// Its doubles are left uninitialized: most of a last one are never used.
  using Block = boost::container::vector<double, KeptMemory<double>>;

  /// A part of the pairs, so that threads seldom wait for each other.
  struct Part {
    tsl::robin_map<std::uint64_t, int, PairHash, std::equal_to<>,
                   KeptMemory<std::pair<std::uint64_t, int>>>
        index;
    std::mutex mutex;
  };

  std::unique_lock<std::mutex> lock(std::mutex& mutex) const;
  int add(const SlabArrays& slabs);
  double* allocate(int count);
  Eigen::Vector3d errorOf(NodePair leaves) const;
  Eigen::Vector3d paddingOf(NodePair leaves, const Eigen::Vector3d& error) const;
  SlabArrays buildTriangles(NodePair leaves, double* data) const;
  SlabArrays buildTurning(NodePair leaves);
  SlabArrays buildPieces(NodePair leaves);
  bool hasFewSlabs(NodePair leaves) const;

  const WhitenedPair& pair_;
  bool shared_ = false;
  tbb::concurrent_vector<SlabArrays, std::allocator<SlabArrays>> obstacles_;
  std::array<Part, 16> parts_;
  std::mutex blocks_mutex_;
  std::vector<Block> blocks_;
  double* block_end_ = nullptr;   ///< of the last block
  std::size_t block_left_ = 0;    ///< of the last block, in doubles
  std::size_t doubles_used_ = 0;  ///< of all blocks
};

}  // namespace fcl_prob::detail
