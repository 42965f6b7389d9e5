// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cells/cell_examiner.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/constants.h"
#include "base/left_out.h"
#include "mass/cell_layer.h"

namespace fcl_prob::detail {

namespace {

// A pair that sticks out of the leader's half-space by less than this is settled with it: the
// sliver between goes into the upper bound.
constexpr double kSliver = kLayerMargin;

// Accuracy, relative to the cell's mass, of the masses of cells that are settled. They add up, and
// need not be better than this share of what is asked of P.
constexpr double kSettledAccuracy = 1e-11;
constexpr double kSettledShare = 1e-4;

// What remains of an open cell is cut back to the box of its front if that holds less than this
// share of its mass.
constexpr double kCutBack = 0.8;

// Nodes opened to see how low the pairs of a cell reach below a plane: 60 take 1.4 times the cells
// of dense meshes, 3,000 save a tenth of them but no time.
constexpr int kMostOpened = 300;

// Beside large triangles a proof by topology is tried with longer fronts than this only. It settles
// deep cells that no pair of triangles covers: the bunnies of 69,451 triangles take a 25th of the
// time with it.
constexpr std::size_t kLongFront = 70;

// A layer deeper in the cell than this is worth less than a look at its pairs of triangles.
constexpr double kWorthwhileDepth = 0.9;

// In a cell thinner than this, the slivers below known layers may be all there is.
constexpr double kThinBesideSlivers = 16 * kSliver;

// Whether all of the cell below a plane, where no surfaces meet but in slivers at its sides, is
// free: it is convex, so that one point of it tells, if it lies deeper than those.
bool isOutsideBelow(const SolidContact& solids, const Cell& cell, const CellPlane& plane) {
  const Eigen::Vector3d lowest = cell.lowestCorner(plane.m);
  const double room = plane.s - plane.m.dot(lowest);
  if (!(room > 0.0)) return true;
  const Eigen::Vector3d to_middle = 0.5 * (cell.lo + cell.hi) - lowest;
  const double share = std::min(0.5, 0.25 * room / plane.m.dot(to_middle));
  return 0.5 * share * cell.leastWidth() > kThinBesideSlivers &&
         solids.at(lowest + share * to_middle) == Containment::outside;
}

void include(const Cell& part, Cell& box) {
  box.lo = box.lo.cwiseMin(part.lo);
  box.hi = box.hi.cwiseMax(part.hi);
}

// Whether what stays open of the cell is only this box.
bool isCutBack(const Cell& box, const Cell& cell) {
  return cellMass(box).upper < kCutBack * cellMass(cell).upper;
}

bool isWhole(const Cell& box, const Cell& cell) { return box.lo == cell.lo && box.hi == cell.hi; }

// What is left of a cell around a box within, in up to six parts.
template <typename Visit>
void visitAround(Cell rest, const Cell& box, const Visit& visit) {
  for (int k = 0; k < rest.rank; ++k) {
    Cell part = rest;
    part.hi[k] = box.lo[k];
    visit(part);
    part = rest;
    part.lo[k] = box.hi[k];
    visit(part);
    rest.lo[k] = box.lo[k];
    rest.hi[k] = box.hi[k];
  }
}

}  // namespace

CellExaminer::CellExaminer(const WhitenedPair& pair, ObstacleTable& obstacles,
                           const SolidContact* solids, bool with_moments, bool sampled,
                           double relative_tolerance, ProbabilityStatistics& statistics)
    : pair_(pair),
      front_(pair, obstacles, statistics),
      solids_(solids),
      with_moments_(with_moments),
      sampled_(sampled),
      relative_tolerance_(relative_tolerance),
      statistics_(statistics) {}

Examination CellExaminer::examine(const Cell& cell, const std::vector<FrontPair>& inherited) {
  result_ = Examination{};
  ++statistics_.cells;
  if (inherited.size() > kLongFront && witness() && witness()->covers(cell)) {
    settle({"crossing surfaces", true, cell, {}, {}, witness_->proof()});
    return std::move(result_);
  }
  front_.take(cell, inherited);
  const std::optional<CuttingPair> leader = findLeader();
  for (const CoveredSlice& slice : front_.covered())
    settle({"one pair", true, slice.cell, {}}, slice.by);
  if (front_.cell().empty()) return std::move(result_);
  if (front_.coarse().empty() && front_.cutting().empty()) {
    settleFree(front_.cell());
    return std::move(result_);
  }
  if (leader) {
    openWithPlane(*leader);
  } else {
    openWithoutPlane();
  }
  return std::move(result_);
}

// The pair, or the layer that topology proves, that covers most of the cell under a single plane.
// The one that is likely to serve is asked first, and the other one only where it is needed.
std::optional<CuttingPair> CellExaminer::findLeader() {
  std::optional<CuttingPair> leader;
  // Where hardly any pair of triangles covers much of the cell.
  const bool topology_first = !front_.coarse().empty() && mayIntegrate(front_.cell()) &&
                              witness() && witness()->isBesideSmallTriangles(front_.cell());
  if (topology_first) improveByTopology(leader);
  if (leader && leader->depth < kWorthwhileDepth) return leader;
  front_.open();
  if (!mayIntegrate(front_.cell())) return std::nullopt;
  leader = front_.champion();
  const bool is_long = front_.coarse().size() + front_.cutting().size() > kLongFront;
  if (!topology_first && is_long) improveByTopology(leader);
  return leader;
}

void CellExaminer::improveByTopology(std::optional<CuttingPair>& best) {
  const Cell& cell = front_.cell();
  if (cell.empty() || !witness() || isLeftOut("layers by topology")) return;
  near_ = front_.coarse();
  for (const CuttingPair& cutting : front_.cutting()) {
    if (!cutting.pair.isLayer()) near_.push_back(cutting.pair);
  }
  const auto layer = witness()->layer(cell, near_);
  if (!layer) return;
  const FrontPair known = front_.newLayer(layer->m, layer->from, layer->to);
  if (observer_) proofs_[known.obstacle] = layer->proof;
  const auto leader = front_.addLayer(known);
  if (leader && (!best || leader->depth < best->depth)) best = leader;
}

// Null where there is nothing to try.
CrossingWitness* CellExaminer::witness() {
  if (!witness_) {
    witness_.emplace(pair_, solids_ != nullptr);
    witness_->setHint(hint_);
  }
  return witness_->usable() ? &*witness_ : nullptr;
}

void CellExaminer::setHint(const CrossingWitness::Hint& hint) {
  hint_ = hint;
  if (witness_) witness_->setHint(hint);
}

// By a pair of leaves, a layer, or something else.
void CellExaminer::claim(Claim claim, const FrontPair& by) const {
  if (!observer_ || claim.cell.empty()) return;
  if (by.hasObstacle() && by.isLayer()) claim.crossing = proofs_.at(by.obstacle);
  if (by.hasObstacle() && !by.isLayer()) claim.pair = by.nodes;
  observer_->claim(claim);
}

// Nothing of `cell` with m·y < s collides.
void CellExaminer::claimBelow(const char* method, const Cell& cell, const CellPlane& plane) const {
  if (!observer_) return;
  CoveredPart below;
  below.planes[0] = {-plane.m, -plane.s};
  below.count = 1;
  claim({method, false, cell, below});
}

// All of `cell` above the leader's plane collides.
void CellExaminer::claimAbove(const char* method, const Cell& cell,
                              const CuttingPair& leader) const {
  CoveredPart above;
  above.planes[0] = leader.inner;
  above.count = 1;
  claim({method, true, cell, above}, leader.pair);
}

// All of the claim's cell collides.
void CellExaminer::settle(const Claim& all, const FrontPair& by) {
  claim(all, by);
  const Cell& cell = all.cell;
  SettledMass settled;
  settled.mass = cellMass(cell);
  if (with_moments_) {
    settled.moment = cellMoment(cell);
    settled.moment_error = 1e-13 * settled.mass.upper * (1.0 + kReach);
  }
  result_.settled += settled;
}

// The part of `cell` in the plane's half-space collides; sign -1 takes it away again.
void CellExaminer::settlePart(const Cell& cell, const CellPlane& plane, double sign,
                              double accuracy) {
  const Bounds mass = cellHalfSpaceMass(cell, plane.m, plane.s, accuracy);
  SettledMass settled;
  settled.mass = sign > 0 ? mass : Bounds{-mass.upper, -mass.lower};
  if (with_moments_) {
    const Moment moment = cellHalfSpaceMoment(cell, plane.m, plane.s);
    settled.moment = sign * moment.value;
    settled.moment_error = moment.error;
  }
  result_.settled += settled;
}

// No surfaces meet anywhere in `cell`, but for slivers at its sides that were settled with layers:
// one point of the rest tells whether the solids overlap.
void CellExaminer::settleFree(const Cell& cell) {
  if (!solids_ || cell.empty() || !solids_->possible(cell))
    return claim({"no pair", false, cell, {}});
  const bool is_thin = cell.leastWidth() < kThinBesideSlivers;
  switch (is_thin ? Containment::unknown : solids_->at(0.5 * (cell.lo + cell.hi))) {
    case Containment::inside:
      settle({"containment", true, cell, {}});
      break;
    case Containment::outside:
      claim({"no containment", false, cell, {}});
      break;
    case Containment::unknown: {
      const double mass = cellMass(cell).upper;
      result_.settled.mass.upper += mass;
      result_.settled.moment_error += mass * (1.0 + kReach);
      break;
    }
  }
}

// What is left of the cell around `box` is free.
void CellExaminer::settleAround(const Cell& box) {
  if (!solids_ && !observer_) return;
  visitAround(front_.cell(), box, [this](const Cell& part) { settleFree(part); });
}

void CellExaminer::openWithoutPlane() {
  OpenCell open;
  const Cell& cell = front_.cell();
  Cell box{cell.hi, cell.lo, cell.rank};
  open.front.reserve(front_.cutting().size() + front_.coarse().size());
  const auto keep = [&](const FrontPair& pair) {
    if (!isWhole(box, cell)) {
      Cell part = cell;
      if (!front_.clip(pair, part)) return;
      include(part, box);
    }
    open.front.push_back(pair);
  };
  for (const CuttingPair& cutting : front_.cutting()) keep(cutting.pair);
  for (const FrontPair& pair : front_.coarse()) keep(pair);
  if (open.front.empty()) return settleFree(cell);
  settleAround(box);
  open.cell = box;
  open.upper = cellMass(box).upper;
  open.drawn = open.upper;
  addPart(open);
  result_.open = std::move(open);
}

// What openWithPlane() says of the cell, but for what stays open.
void CellExaminer::claimBeside(const CuttingPair& leader, const Cell& box, double settled_from,
                               bool nothing_below) const {
  const Cell& cell = front_.cell();
  const Eigen::Vector3d& m = leader.inner.m;
  const auto above = leader.pair.isLayer() ? "plane of crossing surfaces" : "plane of a pair";
  if (settled_from < leader.inner.s) observer_->excuse(cell, m, settled_from, leader.inner.s);
  const CellPlane from{m, settled_from};
  if (nothing_below) claimBelow("nothing below a plane", cell, from);
  if (nothing_below || !isCutBack(box, cell)) return claimAbove(above, cell, leader);
  claimAbove(above, box, leader);
  visitAround(cell, box, [&](const Cell& part) {
    claimAbove(above, part, leader);
    claimBelow("beside what stays open", part, from);
  });
}

// The leader covers cell ∩ {m·y >= s}. All that is left to know lies below that plane, in the parts
// of the other pairs (pairs without such a part leave the front), and, if it is curved, in the
// layer between the leader's own planes.
void CellExaminer::openWithPlane(const CuttingPair& leader) {
  const Cell& cell = front_.cell();
  const Eigen::Vector3d& m = leader.inner.m;
  const double level = leader.layered ? leader.inner.s : leader.outer;
  const double enough = observer_ && observer_->needsAll() ? level : level - kSliver;
  double settled_from = level;
  OpenCell open;
  open.possible_from = leader.outer;
  open.front.push_back(leader.pair);
  Cell box{cell.hi, cell.lo, cell.rank};
  const Cell below = layerBox(cell, m, -kInfinity, leader.inner.s);
  if (leader.layered) include(layerBox(cell, m, leader.outer, leader.inner.s), box);
  const auto keep = [&](const FrontPair& pair, double lowest) {
    Cell part = below;
    if (lowest < enough && !isWhole(box, below)) {
      if (!front_.clip(pair, part)) return;
      lowest = std::max(lowest, lowestIn(part, m));
    }
    if (lowest >= enough) {
      settled_from = std::min(settled_from, lowest);
      return;
    }
    open.possible_from = std::min(open.possible_from, lowest);
    open.front.push_back(pair);
    include(part, box);
  };
  for (const CuttingPair& cutting : front_.cutting()) {
    const FrontPair& pair = cutting.pair;
    if (pair.obstacle == leader.pair.obstacle) continue;
    double lowest = front_.lowest().ofBox(pair, m);
    if (lowest < enough) lowest = std::max(lowest, front_.lowest().ofSlabs(pair, m));
    if (lowest < open.possible_from && !pair.isLayer()) {
      lowest = std::max(lowest, front_.lowest().ofVertices(pair.nodes, m));
    }
    keep(pair, lowest);
  }
  front_.lowest().findBelow(front_.coarse(), {m, enough}, open.possible_from, kMostOpened, below_);
  settled_from = std::min(settled_from, below_.lowest_of_others);
  for (const FrontPair& pair : below_.pairs) keep(pair, below_.lowest);
  if (open.front.size() > 1) box = layerBox(box, m, open.possible_from, leader.inner.s);
  if (solids_ && solids_->possible(cell)) {
    if (!isOutsideBelow(*solids_, cell, {m, open.possible_from})) return openWithoutPlane();
    box = cell;
  }

  const double sliver = massNear(cell, m, leader.inner.s - settled_from);
  result_.settled.mass.upper += sliver;
  result_.settled.moment_error += sliver * (1.0 + kReach);
  const bool nothing_below = open.front.size() == 1 && !leader.layered;
  if (observer_) claimBeside(leader, box, settled_from, nothing_below);
  if (nothing_below) return settlePart(cell, leader.inner, 1.0, kSettledAccuracy);

  leaveOpen(std::move(open), leader, box);
}

// All of the cell, or what may collide below the leader's plane and is not covered: a box.
void CellExaminer::leaveOpen(OpenCell open, const CuttingPair& leader, const Cell& box) {
  const Cell& cell = front_.cell();
  open.tells = OpenCell::PlaneTells::covered;
  open.plane = leader.inner;
  const bool is_cut_back = isCutBack(box, cell);
  open.cell = is_cut_back ? box : cell;
  weigh(open);
  if (is_cut_back) {
    // What may collide of the open cell is about its share of P.
    const double mass = cellMass(cell).upper;
    const double share = mass > 0.0 ? open.upper / mass : 0.0;
    const double accuracy =
        std::clamp(kSettledShare * relative_tolerance_ * share, kSettledAccuracy, kOpenAccuracy);
    settlePart(cell, leader.inner, 1.0, accuracy);
    settlePart(box, leader.inner, -1.0, accuracy);
  }
  result_.open = std::move(open);
}

}  // namespace fcl_prob::detail
