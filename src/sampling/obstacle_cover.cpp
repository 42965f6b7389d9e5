// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "sampling/obstacle_cover.h"

#include <algorithm>

#include "base/quantiles.h"
#include "fcl_prob/normal_mass.h"

namespace fcl_prob::detail {
namespace {

/// Every box is looked at for every hit, so more of them stop paying off.
constexpr std::size_t kMostBoxes = 128;

struct BoxedPair {
  int a;
  int b;
  CoverBox box;
};

bool lighter(const BoxedPair& left, const BoxedPair& right) {
  return left.box.mass < right.box.mass;
}

class CoverBuilder {
 public:
  CoverBuilder(const CoverSide& a, const CoverSide& b, int rank, const Eigen::Vector3d& margin)
      : a_(a), b_(b), rank_(rank), margin_(margin) {}

  /// Opens the heaviest pair again and again. The sum may rise before it falls, so all steps are
  /// taken and the best state among them is returned.
  ObstacleCover build(const Interruption& interruption) {
    add(0, 0);
    ObstacleCover best = state();
    while (!heap_.empty() && heap_.size() + closed_.size() < kMostBoxes && !isDue(interruption)) {
      std::pop_heap(heap_.begin(), heap_.end(), lighter);
      const BoxedPair pair = heap_.back();
      heap_.pop_back();
      open(pair);
      ObstacleCover now = state();
      if (now.mass < best.mass) best = std::move(now);
    }
    return best;
  }

 private:
  const fcl::AABBd& boxOf(const CoverSide& side, int node) const {
    return side.tree.getBV(node).bv;
  }

  bool opens(const CoverSide& side, int node) const {
    return side.surface && !side.tree.getBV(node).isLeaf();
  }

  void add(int a, int b) {
    const fcl::AABBd& of_a = boxOf(a_, a);
    const fcl::AABBd& of_b = boxOf(b_, b);
    CoverBox box{of_b.min_ - of_a.max_ - margin_, of_b.max_ - of_a.min_ + margin_, 1.0};
    for (int k = 0; k < 3; ++k) {
      if (k < rank_) {
        box.mass *= normalIntervalMass(box.lo[k], box.hi[k]);
      } else if (box.lo[k] > 0.0 || box.hi[k] < 0.0) {
        return;
      }
    }
    if (box.mass == 0.0) return;
    heap_.push_back({a, b, box});
    std::push_heap(heap_.begin(), heap_.end(), lighter);
  }

  void open(const BoxedPair& pair) {
    const bool may_a = opens(a_, pair.a);
    const bool may_b = opens(b_, pair.b);
    if (!may_a && !may_b) {
      closed_.push_back(pair.box);
    } else if (may_a && (!may_b || boxOf(a_, pair.a).size() > boxOf(b_, pair.b).size())) {
      add(a_.tree.getBV(pair.a).leftChild(), pair.b);
      add(a_.tree.getBV(pair.a).rightChild(), pair.b);
    } else {
      add(pair.a, b_.tree.getBV(pair.b).leftChild());
      add(pair.a, b_.tree.getBV(pair.b).rightChild());
    }
  }

  ObstacleCover state() const {
    ObstacleCover cover;
    cover.boxes = closed_;
    for (const BoxedPair& pair : heap_) cover.boxes.push_back(pair.box);
    for (const CoverBox& box : cover.boxes) cover.mass += box.mass;
    return cover;
  }

  const CoverSide& a_;
  const CoverSide& b_;
  int rank_;
  Eigen::Vector3d margin_;
  std::vector<BoxedPair> heap_;
  std::vector<CoverBox> closed_;
};

}  // namespace

ObstacleCover coverByBoxes(const CoverSide& a, const CoverSide& b, int rank,
                           const Eigen::Vector3d& margin, const Interruption& interruption) {
  return CoverBuilder(a, b, rank, margin).build(interruption);
}

// |y|² is chi-squared with `rank` degrees of freedom.
ObstacleCover coverByShell(double radius, int rank) {
  ObstacleCover cover;
  cover.shell_radius = radius;
  cover.mass = gammaQ(0.5 * rank, 0.5 * radius * radius);
  return cover;
}

}  // namespace fcl_prob::detail
