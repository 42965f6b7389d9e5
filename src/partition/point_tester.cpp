// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "partition/point_tester.h"

#include <algorithm>

#include "cobstacle/cell_section.h"

namespace fcl_prob::detail {

namespace {

bool isInBox(const NodeBox& box, const Eigen::Vector3d& y) {
  for (int k = 0; k < 3; ++k) {
    if (y[k] < box.lo[k] || y[k] > box.hi[k]) return false;
  }
  return true;
}

}  // namespace

PointTester::PointTester(const WhitenedPair& pair, ObstacleTable& obstacles,
                         const SolidContact* solids)
    : pair_(pair), obstacles_(obstacles), solids_(solids) {}

void PointTester::test(const std::vector<FrontPair>& front, std::vector<TestedPoint>& points) {
  undecided_.clear();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].collides) undecided_.push_back(static_cast<int>(i));
  }
  // The leaves first: they are the cheapest to test.
  for (const bool leaves : {true, false}) {
    for (const FrontPair& pair : front) {
      if (undecided_.empty()) return;
      if ((pair.obstacle >= 0) == leaves) testPair(pair, points);
    }
  }
  for (int i : undecided_) {
    TestedPoint& point = points[i];
    if (solids_) {
      const Containment containment = solids_->at(point.y);
      point.collides = containment == Containment::inside;
      point.doubtful = !point.collides && (point.doubtful || containment == Containment::unknown);
    }
    point.collides = point.collides || point.doubtful;
  }
}

void PointTester::testPair(const FrontPair& first, std::vector<TestedPoint>& points) {
  stack_.assign(1, {first, static_cast<int>(undecided_.size())});
  bool found = false;
  while (!stack_.empty()) {
    const auto [pair, above] = stack_.back();
    stack_.pop_back();
    const int count = moveForward(pair, above, points);
    if (count == 0) continue;
    if (pair.isHalfSpace() || areLeaves(pair_, pair.nodes)) {
      testLeaves(pair, count, points);
      found = true;
      continue;
    }
    for (const NodePair& child : childrenOf(pair_, pair.nodes))
      stack_.push_back({{child, -1}, count});
  }
  if (!found) return;
  const auto decided = [&](int i) { return points[i].collides; };
  undecided_.erase(std::remove_if(undecided_.begin(), undecided_.end(), decided), undecided_.end());
}

// Moves those of the first `count` points that the pair may decide before the others; how many
// there are. What the pairs still on the stack are to be tested against stays the same set.
int PointTester::moveForward(const FrontPair& pair, int count,
                             const std::vector<TestedPoint>& points) {
  const auto begin = undecided_.begin();
  if (pair.isHalfSpace()) return count;
  const NodeBox box = obstacleBox(pair_, pair.nodes);
  const auto end = std::partition(begin, begin + count, [&](int i) {
    return !points[i].collides && isInBox(box, points[i].y);
  });
  return static_cast<int>(end - begin);
}

void PointTester::testLeaves(const FrontPair& pair, int count, std::vector<TestedPoint>& points) {
  const SlabArrays slabs =
      pair.obstacle >= 0 ? obstacles_.slabs(pair.obstacle) : obstacles_.slabsOnce(pair.nodes);
  for (int j = 0; j < count; ++j) {
    TestedPoint& point = points[undecided_[j]];
    const CellBox box{{point.y[0], point.y[1], point.y[2]}, {0.0, 0.0, 0.0}};
    const CellRelation relation = slabKernels().classify(slabs, box).relation;
    if (relation == CellRelation::outside) continue;
    if (slabs.outer_only) {
      point.collides = contains(obstacles_.support(pair.nodes), point.y);
    } else {
      point.collides = relation == CellRelation::inside;
      point.doubtful = true;
    }
    if (point.collides) point.doubtful = false;
  }
}

}  // namespace fcl_prob::detail
