// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cells/possible_parts.h"

#include <algorithm>

#include "base/constants.h"

namespace fcl_prob::detail {

namespace {

// A pair that reaches farther out of the first part than this share of the cell's extent is worth a
// part of its own.
constexpr double kWorthAPart = 0.05;

// Of the mass above a plane, relative to that of the cell.
constexpr double kPossibleAccuracy = 1e-4;

double extentAlong(const Cell& cell, const Eigen::Vector3d& m) {
  return m.cwiseAbs().dot(cell.hi - cell.lo);
}

}  // namespace

PossibleParts::Reach PossibleParts::reachOf(const OpenCell& open, const FrontPair& pair,
                                            const CoveredPart& part) const {
  Reach reach;
  reach.below = -kInfinity;
  for (int i = 0; i < part.count; ++i) {
    const CellPlane& plane = part.planes[i];
    double lowest = front_.lowestOfBox(pair, plane.m);
    if (lowest < plane.s && pair.hasObstacle()) {
      if (!pair.isLayer()) {
        lowest = std::max(lowest, front_.lowestOfVertices(pair.nodes, plane.m));
      }
      if (lowest < plane.s) lowest = std::max(lowest, front_.lowestOfSlabs(pair, plane.m));
    }
    reach.lowest[i] = lowest;
    reach.below = std::max(reach.below, (plane.s - lowest) / extentAlong(open.cell, plane.m));
  }
  return reach;
}

void PossibleParts::start(const OpenCell& open, const CoveredPart& first) {
  first_ = first;
  reaches_.clear();
  for (const FrontPair& pair : open.front) reaches_.push_back(reachOf(open, pair, first_));
}

CoveredPart PossibleParts::whole() const {
  CoveredPart whole = first_;
  for (const Reach& reach : reaches_) include(reach, whole);
  return whole;
}

// Of the pairs with planes the one that reaches farthest out of the first part.
bool PossibleParts::chooseSecond(const OpenCell& open) {
  double farthest = kWorthAPart;
  int chosen = -1;
  for (std::size_t i = 0; i < open.front.size(); ++i) {
    const FrontPair& pair = open.front[i];
    if (reaches_[i].below <= farthest || !pair.hasObstacle()) continue;
    farthest = reaches_[i].below;
    chosen = static_cast<int>(i);
  }
  if (chosen < 0) return false;
  second_ = outerPart(front_.slabs(open.front[chosen]), open.cell, CoveredPart::kMostPlanes - 1);
  return second_.count > 0;
}

void PossibleParts::include(const Reach& reach, CoveredPart& part) const {
  for (int i = 0; i < part.count; ++i) {
    part.planes[i].s = std::min(part.planes[i].s, reach.lowest[i]);
  }
}

double PossibleParts::massAtMost(const OpenCell& open, double most) {
  if (!chooseSecond(open)) return most;
  around_first_ = first_;
  around_second_ = second_;
  of_second_.lowest.fill(kInfinity);
  for (std::size_t i = 0; i < open.front.size(); ++i) {
    if (reaches_[i].below > kWorthAPart) {
      const Reach beyond = reachOf(open, open.front[i], second_);
      if (beyond.below < reaches_[i].below) {
        include(beyond, around_second_);
        for (int j = 0; j < first_.count; ++j) {
          of_second_.lowest[j] = std::min(of_second_.lowest[j], reaches_[i].lowest[j]);
        }
        continue;
      }
    }
    include(reaches_[i], around_first_);
  }
  const double mass = massOfBoth(open.cell);
  if (!(mass < most)) return most;
  if (observer_) claimBeside(open.cell);
  return mass;
}

// Of the first part, and of what of the second is below one of its planes.
double PossibleParts::massOfBoth(const Cell& cell) const {
  const PartMeasure measure(cell);
  const CellPlane& only = around_first_.planes[0];
  double mass = 0.0;
  if (around_first_.count == 1) {
    mass = cellHalfSpaceMass(cell, only.m, only.s, kPossibleAccuracy).upper;
  } else {
    mass = measure.massAtMost(around_first_, cutter_);
  }
  for (int i = 0; i < around_first_.count; ++i) {
    const CellPlane& plane = around_first_.planes[i];
    if (of_second_.lowest[i] >= plane.s) continue;
    CoveredPart below = around_second_;
    below.planes[below.count++] = {-plane.m, -plane.s};
    mass += measure.massAtMost(below, cutter_);
  }
  return mass;
}

// What is below a plane of either part.
void PossibleParts::claimBeside(const Cell& cell) const {
  for (int i = 0; i < around_first_.count; ++i) {
    for (int j = 0; j < around_second_.count; ++j) {
      const CellPlane& one = around_first_.planes[i];
      const CellPlane& other = around_second_.planes[j];
      CoveredPart beside;
      beside.planes[0] = {-one.m, -one.s};
      beside.planes[1] = {-other.m, -other.s};
      beside.count = 2;
      observer_->claim({"beside two parts", false, cell, beside});
    }
  }
}

}  // namespace fcl_prob::detail
