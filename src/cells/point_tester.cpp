// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cells/point_tester.h"

#include <algorithm>
#include <cmath>

#include "convex/cell_section.h"

namespace fcl_prob::detail {

namespace {

bool isInBox(const NodeBox& box, const Eigen::Vector3d& y) {
  for (int k = 0; k < 3; ++k) {
    if (y[k] < box.lo[k] || y[k] > box.hi[k]) return false;
  }
  return true;
}

}  // namespace

void PointTester::test(const std::vector<FrontPair>& front, std::vector<TestedPoint>& points) {
  if (!observer_) return decide(front, points);
  const std::vector<TestedPoint> before = points;
  decide(front, points);
  claim(before, points);
}

void PointTester::claim(const std::vector<TestedPoint>& before,
                        const std::vector<TestedPoint>& points) const {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const TestedPoint& point = points[i];
    if (before[i].collides || point.doubtful) continue;
    observer_->claim({"sample", point.collides, {point.y, point.y, 3}, {}});
  }
}

void PointTester::decide(const std::vector<FrontPair>& front, std::vector<TestedPoint>& points) {
  collectUndecided(points);
  // The leaves first: they are the cheapest to test.
  for (const bool leaves : {true, false}) {
    for (const FrontPair& pair : front) {
      if (undecided_.empty()) return;
      if ((pair.hasObstacle()) == leaves) testPair(pair, points);
    }
  }
  decideContainment(points);
}

void PointTester::decideContainment(std::vector<TestedPoint>& points) const {
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

void PointTester::collectUndecided(const std::vector<TestedPoint>& points) {
  undecided_.clear();
  for (std::vector<double>& along : coordinates_) along.clear();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].collides) continue;
    undecided_.push_back(static_cast<int>(i));
    for (int k = 0; k < 3; ++k) coordinates_[k].push_back(points[i].y[k]);
  }
  padUndecided();
}

void PointTester::padUndecided() {
  const std::size_t padded = (undecided_.size() + 3) / 4 * 4;
  for (std::vector<double>& along : coordinates_) along.resize(padded, std::nan(""));
}

void PointTester::removeDecided(const std::vector<TestedPoint>& points) {
  std::size_t kept = 0;
  for (std::size_t j = 0; j < undecided_.size(); ++j) {
    if (points[undecided_[j]].collides) continue;
    undecided_[kept] = undecided_[j];
    for (std::vector<double>& along : coordinates_) along[kept] = along[j];
    ++kept;
  }
  undecided_.resize(kept);
  for (std::vector<double>& along : coordinates_) along.resize(kept);
  padUndecided();
}

void PointTester::testPair(const FrontPair& pair, std::vector<TestedPoint>& points) {
  const Range chosen = choose(pair);
  if (chosen.begin == chosen.end) return;
  if (pair.isLayer() || areLeaves(pair_, pair.nodes)) {
    testLeaves(pair, chosen, points);
  } else {
    testParts(pair, chosen, points);
  }
  removeDecided(points);
}

// Those of the undecided points that the pair may decide.
PointTester::Range PointTester::choose(const FrontPair& pair) {
  const std::size_t all = undecided_.size();
  chosen_.resize(std::max(chosen_.size(), all));
  if (pair.isLayer()) {
    std::copy(undecided_.begin(), undecided_.end(), chosen_.begin());
    return {0, all};
  }
  const NodeBox box = obstacleBox(pair_, pair.nodes);
  const PointArrays arrays{{coordinates_[0].data(), coordinates_[1].data(), coordinates_[2].data()},
                           static_cast<int>(coordinates_[0].size())};
  const int count = slabKernels().pointsInBox(arrays, box.lo, box.hi, chosen_.data());
  for (int i = 0; i < count; ++i) chosen_[i] = undecided_[chosen_[i]];
  return {0, static_cast<std::size_t>(count)};
}

// What a pair may decide is chosen from what its parent may, and kept behind that: when the next
// pair is taken from the stack, all that was kept behind its own parent's choice is done with.
void PointTester::testParts(const FrontPair& coarse, Range all, std::vector<TestedPoint>& points) {
  const auto open = [this](const FrontPair& pair, Range chosen) {
    for (const NodePair& child : childrenOf(pair_, pair.nodes)) {
      stack_.push_back({FrontPair::ofNodes(child), chosen});
    }
  };
  stack_.clear();
  open(coarse, all);
  while (!stack_.empty()) {
    const auto [pair, from] = stack_.back();
    stack_.pop_back();
    const Range chosen = chooseFrom(from, obstacleBox(pair_, pair.nodes), points);
    if (chosen.begin == chosen.end) continue;
    if (areLeaves(pair_, pair.nodes)) {
      testLeaves(pair, chosen, points);
    } else {
      open(pair, chosen);
    }
  }
}

PointTester::Range PointTester::chooseFrom(Range from, const NodeBox& box,
                                           const std::vector<TestedPoint>& points) {
  chosen_.resize(std::max(chosen_.size(), 2 * from.end - from.begin));
  std::size_t end = from.end;
  for (std::size_t i = from.begin; i < from.end; ++i) {
    const TestedPoint& point = points[chosen_[i]];
    if (!point.collides && isInBox(box, point.y)) chosen_[end++] = chosen_[i];
  }
  return {from.end, end};
}

PointTester::Range PointTester::dropExcluded(const FaceSlabs& slabs, Range chosen,
                                             const std::vector<TestedPoint>& points) {
  std::size_t end = chosen.begin;
  for (std::size_t i = chosen.begin; i < chosen.end; ++i) {
    if (!slabs.excludes(points[chosen_[i]].y)) chosen_[end++] = chosen_[i];
  }
  return {chosen.begin, end};
}

void PointTester::testLeaves(const FrontPair& pair, Range chosen,
                             std::vector<TestedPoint>& points) {
  if (!pair.hasObstacle() && obstacles_.areTriangles(pair.nodes)) {
    chosen = dropExcluded(obstacles_.faceSlabs(pair.nodes), chosen, points);
    if (chosen.begin == chosen.end) return;
  }
  const SlabArrays slabs = pair.hasObstacle() ? obstacles_.slabs(pair.obstacle)
                                              : obstacles_.slabsOnce(pair.nodes, once_);
  for (std::size_t i = chosen.begin; i < chosen.end; ++i) {
    TestedPoint& point = points[chosen_[i]];
    const CellRelation relation = slabKernels().classifyPoint(slabs, point.y.data());
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
