// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cells/cell_divider.h"

#include <algorithm>
#include <utility>

#include "cells/cell_split.h"

namespace fcl_prob::detail {

namespace {

// Not deeper than this, so that limits are looked at often enough.
constexpr int kSoonLevels = 4;

// The density changes over one standard deviation, a smaller C-obstacle over its own width.
Eigen::Vector3d scalesOf(const WhitenedPair& pair) {
  const NodeBox box = obstacleBox(pair, {0, 0});
  Eigen::Vector3d scales;
  for (int k = 0; k < 3; ++k) scales[k] = std::clamp(box.hi[k] - box.lo[k], 1e-100, 1.0);
  return scales;
}

}  // namespace

SettledMass asItIs(const OpenCell& cell) {
  SettledMass settled;
  settled.mass = {cell.lower, cell.upper};
  settled.moment_error = cell.upper * (1.0 + kReach);
  return settled;
}

CellDivider::CellDivider(const PartitionScene& scene, ObstacleTable& obstacles,
                         ProbabilityStatistics& statistics)
    : scene_(scene),
      obstacles_(obstacles),
      examiner_(scene.pair, obstacles, scene.solids, scene.with_moments, scene.sampled,
                scene.relative_tolerance, statistics),
      scales_(scalesOf(scene.pair)) {}

void CellDivider::examineRoot(Division& into) {
  Cell root{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), scene_.rank};
  const double reach = scene_.ball ? std::min(kReach, 1.001 * scene_.ball->radius()) : kReach;
  for (int i = 0; i < scene_.rank; ++i) {
    root.lo[i] = -reach;
    root.hi[i] = reach;
  }
  // Two single pieces are a pair of leaves from the start: there is nothing to expand.
  into.parts.push_back(examine(root, {obstacles_.frontPair({0, 0})}));
}

Examination CellDivider::examine(const Cell& cell, const std::vector<FrontPair>& inherited) {
  const BallTruncation* const ball = scene_.ball;
  if (ball && ball->missesBall(cell)) return {};
  if (cells_left_ > 0) --cells_left_;
  if (!ball || ball->isInBall(cell)) return examiner_.examine(cell, inherited);
  return ball->truncated(cell, inherited, examiner_.examine(cell, inherited));
}

void CellDivider::divide(const OpenCell& parent, std::size_t most_cells, Division& into) {
  cells_left_ = most_cells;
  divide(parent, {kSoon * parent.gap(), kSoonLevels, 0}, into);
}

// Children whose gap is not much smaller would soon be taken from the queue: dividing them at once,
// as long as the data of their front are at hand, saves most of the memory traffic.
void CellDivider::divide(const OpenCell& parent, const Soon& soon, Division& into) {
  const CellSplit split = chooseSplit(
      parent.cell, scales_, parent.hasPlane() ? parent.plane.m : Eigen::Vector3d::Zero().eval());
  if (split.axis < 0) {
    into.indivisible = true;
    into.parts.push_back({asItIs(parent), std::nullopt});
    return;
  }
  if (claim_observer) claim_observer->divided(parent.cell);
  for (const bool upper : {false, true}) {
    Cell half = parent.cell;
    (upper ? half.lo : half.hi)[split.axis] = split.at;
    Examination examination = examine(half, parent.front);
    // The other half is still to be examined.
    const std::size_t then = upper ? soon.awaited : soon.awaited + 1;
    if (examination.open && soon.levels > 0 && examination.open->gap() > soon.gap &&
        hasCellsLeft(then)) {
      const OpenCell child = std::move(*examination.open);
      examination.open.reset();
      into.parts.push_back(std::move(examination));
      divide(child, {soon.gap, soon.levels - 1, then}, into);
    } else {
      into.parts.push_back(std::move(examination));
    }
  }
}

}  // namespace fcl_prob::detail
