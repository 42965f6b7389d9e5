// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Boxes along the axes of the whitened frame around the nodes of a piece tree.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <atomic>
#include <boost/container/vector.hpp>
#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

#include "base/kept_memory.h"

namespace fcl_prob::detail {

struct NodeBox {
  double lo[3];
  double hi[3];

  double size() const { return hi[0] - lo[0] + (hi[1] - lo[1]) + (hi[2] - lo[2]); }

  /// The largest m·y of its points, rounded.
  double highestAlong(const Eigen::Vector3d& m) const {
    double highest = 0.0;
    for (int k = 0; k < 3; ++k) highest += m[k] * (m[k] > 0 ? hi[k] : lo[k]);
    return highest;
  }
};

/// Whether a box is clear of [lo, hi].
inline bool isClearOf(const NodeBox& box, const double* lo, const double* hi) {
  for (int k = 0; k < 3; ++k) {
    if (box.lo[k] > hi[k] || box.hi[k] < lo[k]) return true;
  }
  return false;
}

/// [lo - pad, hi + pad]
inline NodeBox paddedBox(const Eigen::Vector3d& lo, const Eigen::Vector3d& hi,
                         const Eigen::Vector3d& pad) {
  NodeBox box;
  for (int k = 0; k < 3; ++k) {
    box.lo[k] = lo[k] - pad[k];
    box.hi[k] = hi[k] + pad[k];
  }
  return box;
}

inline NodeBox boxOfBoth(const NodeBox& one, const NodeBox& other) {
  NodeBox box;
  for (int k = 0; k < 3; ++k) {
    box.lo[k] = std::min(one.lo[k], other.lo[k]);
    box.hi[k] = std::max(one.hi[k], other.hi[k]);
  }
  return box;
}

struct WhitenedTree;

/// Boxes around the nodes of one whitened tree, which all calls are given, padded by its error.
/// Most nodes of a dense mesh are below its clusters, and most of those no query ever looks at:
/// their boxes are made when they are first asked for, by any of several threads.
class NodeBoxes {
 public:
  /// Anew for all nodes; nothing may be asked meanwhile.
  void fit(const WhitenedTree& whitened);

  const NodeBox& of(const WhitenedTree& whitened, int node) const {
    if (isLate(node) && !late_->made[node - first_late_].load(std::memory_order_acquire)) {
      makeUnder(whitened, node);
    }
    return boxes_[node];
  }

 private:
  struct Late {
    explicit Late(std::size_t count) : made(count) {}

    std::vector<std::atomic<bool>, KeptMemory<std::atomic<bool>>> made;
    std::mutex mutex;
  };

  bool isLate(int node) const { return node >= first_late_; }
  void makeUnder(const WhitenedTree& whitened, int node) const;
  const NodeBox& make(const WhitenedTree& whitened, int node) const;

  /// Some MB of a dense mesh, of which what is never looked at is never touched.
  mutable boost::container::vector<NodeBox, KeptMemory<NodeBox>> boxes_;
  int first_late_ = 0;  ///< this node and those behind it
  std::unique_ptr<Late> late_;
};

}  // namespace fcl_prob::detail
