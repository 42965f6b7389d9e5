// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Of open cells: which parts collide, and what the rest may hold.
#include <algorithm>
#include <array>

#include "base/constants.h"
#include "base/left_out.h"
#include "cells/cell_examiner.h"
#include "mass/cell_layer.h"

namespace fcl_prob::detail {

namespace {

// Pairs of which a part of a cell is looked at: how many, of how many of them the mass is taken,
// and the least share of the cell that is worth having.
constexpr int kMostTried = 32;
constexpr int kMostMeasured = 2;
constexpr double kLeastCovered = 0.02;

// For a gradient a part's moment should not be known worse than the rest of its cell.
constexpr double kMomentShare = 0.05;

}  // namespace

// The part of an open cell that one pair covers, up to `most` planes of which cut the cell: of the
// few that seem to cover most the best.
ObstaclePart CellExaminer::largestPart(const OpenCell& open, int most, double& mass) {
  if (isLeftOut("parts of cells")) return {};
  std::array<ObstaclePart, kMostMeasured> best;
  int tried = 0;
  for (const CuttingPair& cutting : front_.cutting()) {
    if (cutting.sides > most || (cutting.layered && !pair_.band && !pair_.turning) ||
        front_.slabs(cutting.pair).outer_only)
      continue;
    if (++tried > kMostTried) break;
    ObstaclePart part = obstaclePart(front_.slabs(cutting.pair), open.cell, most);
    part.by = cutting.pair;
    for (ObstaclePart& other : best) {
      if (part.share > other.share) std::swap(part, other);
    }
  }
  ObstaclePart largest;
  if (best[0].share < kLeastCovered) return largest;
  const PartMeasure measure(open.cell);
  for (ObstaclePart& candidate : best) {
    if (candidate.share < kLeastCovered) break;
    CoveredPart& part = candidate.part;
    if (open.planeCovers()) part.planes[part.count++] = {-open.plane.m, -open.plane.s};
    const auto covered = massOfPart(open, measure, part);
    if (covered && *covered > mass) {
      mass = *covered;
      largest = candidate;
    }
  }
  return largest;
}

// What counts of a part; nothing if its moment would be known worse than the rest of the cell.
std::optional<double> CellExaminer::massOfPart(const OpenCell& open, const PartMeasure& measure,
                                               const CoveredPart& part) {
  if (!sampled_ && !with_moments_) return measure.massAtLeast(part, cutter_);
  const double covered = measure.countedMass(part, cutter_);
  const double gap = open.gap() - covered;
  if (with_moments_ && covered * measure.bend() > kMomentShare * gap) return std::nullopt;
  return covered;
}

// Tightens an open cell by the pair that covers most of it.
void CellExaminer::addPart(OpenCell& open) {
  // Where one object may be inside the other, what a plane leaves is not simply free.
  if (!mayIntegrate(open.cell) || (solids_ && solids_->possible(open.cell))) return;
  double mass = kLeastCovered * open.upper;
  const ObstaclePart best = largestPart(open, CoveredPart::kMostPlanes, mass);
  if (best.share <= 0.0) {
    if (pair_.turning) addPossible(open);
    return;
  }
  // What may collide, along the normals of all planes of the part.
  CoveredPart possible = best.part;
  for (int i = 0; i < possible.count; ++i) {
    const CellPlane& level = possible.planes[i];
    possible.planes[i].s = front_.lowest().ofFront(open.front, level, lowestIn(open.cell, level.m));
  }
  const Eigen::Vector3d& m = possible.planes[0].m;
  open.possible_from = possible.planes[0].s;
  open.tells = OpenCell::PlaneTells::possible;
  open.plane = best.part.planes[0];
  open.part = best.part;
  claim({"part of a cell", true, open.cell, best.part}, best.by);
  for (int i = 0; i < possible.count; ++i) {
    claimBelow("below what is possible", open.cell, possible.planes[i]);
  }
  open.lower = mass;
  open.upper = cellHalfSpaceMass(open.cell, m, open.possible_from, kOpenAccuracy).upper;
  if (possible.count > 1)
    open.upper = std::min(open.upper, PartMeasure(open.cell).massAtMost(possible, cutter_));
  open.upper = std::max(mass, open.upper);
  open.drawn = open.upper;
}

// Where turns leave no part of the cell covered a plane may still tell what is free of it: across
// what of a pair is nearest to the middle.
void CellExaminer::addPossible(OpenCell& open) {
  Eigen::Vector3d m = front_.acrossNearest(0.5 * (open.cell.lo + open.cell.hi));
  for (int k = open.cell.rank; k < 3; ++k) m[k] = 0.0;
  if (m.isZero(0.0)) return;
  m.normalize();
  const double least = lowestIn(open.cell, m);
  const double possible_from = front_.lowest().ofFront(open.front, {m, kInfinity}, least);
  if (!(possible_from > least)) return;
  open.possible_from = possible_from;
  open.tells = OpenCell::PlaneTells::possible;
  open.plane = {m, possible_from};
  claimBelow("below what is possible", open.cell, {m, possible_from});
  open.upper =
      std::min(open.upper, cellHalfSpaceMass(open.cell, m, possible_from, kOpenAccuracy).upper);
  open.drawn = open.upper;
}

// The masses of an open cell with a plane that covers.
void CellExaminer::weigh(OpenCell& open) {
  const Eigen::Vector3d& m = open.plane.m;
  open.lower = cellHalfSpaceMass(open.cell, m, open.plane.s, kOpenAccuracy).lower;
  open.upper = cellHalfSpaceMass(open.cell, m, open.possible_from, kOpenAccuracy).upper;
  open.drawn = open.gap();
  claimBelow("below what is possible", open.cell, {m, open.possible_from});
  double mass = kLeastCovered * open.gap();
  const ObstaclePart below = largestPart(open, CoveredPart::kMostPlanes - 1, mass);
  open.part = below.part;
  if (open.part.count == 0) return;
  claim({"part below a plane", true, open.cell, open.part}, below.by);
  open.lower = std::min(open.upper, open.lower + mass);
}

SettledMass CellExaminer::coveredPart(const OpenCell& open) const {
  SettledMass covered;
  covered.mass = {open.lower, open.lower};
  if (open.planeCovers()) {
    const Moment moment = cellHalfSpaceMoment(open.cell, open.plane.m, open.plane.s);
    covered.moment += moment.value;
    covered.moment_error += moment.error;
  }
  CubeCutter cutter;
  const Moment moment = PartMeasure(open.cell).moment(open.part, cutter);
  covered.moment += moment.value;
  covered.moment_error += moment.error;
  return covered;
}

}  // namespace fcl_prob::detail
