// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cells/cell_front.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/constants.h"
#include "mass/cell_layer.h"
#include "scene/band_margin.h"
#include "scene/turning_margin.h"

namespace fcl_prob::detail {

namespace {

// The constants below only steer; no bound depends on them. Measured on the benchmark scenes.

// A pair can cover (a slice of) a cell only if its C-obstacle is about as large as the cell: pairs
// are probed for that, most central first, until kProbes pairs a cell were leaves or too small.
constexpr double kProbeRatio = 0.5;
constexpr int kProbes = 60;

// Beyond the probes a pair is refined only if its C-obstacle is this many times larger than the
// cell along every axis.
constexpr double kRefineRatio = 6.0;

// The least share of a cell's width that is worth cutting off, in a last look at all pairs and as
// soon as a pair is met.
constexpr double kLeastShare = 0.05;
constexpr double kImmediateShare = 0.3;
constexpr int kCarveRounds = 8;

// Narrowing a part a second time, from what is left of it, cuts off a little more.
constexpr int kClipRounds = 2;

// The planes of a curved obstacle closer than this count as one.
constexpr double kThinLayer = 1e-11;

// A cell counts as filled by a sweep, up to its plane, where it is no larger than this share of how
// far that goes: what of it is not filled is of the order of the way squared.
constexpr double kSmallBesideSweep = 0.7;

// Depth of a plane that covers nothing of the cell.
constexpr double kDeepest = 0.9999;

}  // namespace

CellFront::CellFront(const WhitenedPair& pair, ObstacleTable& obstacles,
                     ProbabilityStatistics& statistics)
    : pair_(pair),
      obstacles_(obstacles),
      statistics_(statistics),
      kernels_(slabKernels()),
      cell_{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 0},
      box_{},
      layers_(pair),
      lowest_(pair, obstacles, cell_, box_, layers_, statistics) {}

void CellFront::take(const Cell& cell, const std::vector<FrontPair>& inherited) {
  cell_ = cell;
  box_ = cell.box();
  covered_.clear();
  cutting_.clear();
  least_depth_ = kDeepest;
  coarse_.clear();
  stack_.clear();
  gatherLeaves(inherited);
  if (!cell_.empty()) gatherCoarse(inherited);
  noteFront(0);
}

void CellFront::noteFront(std::size_t covered_before) {
  statistics_.peak_front = std::max(statistics_.peak_front, coarse_.size() + cutting_.size());
  if (!cell_.empty() && covered_.size() > covered_before) classifyAgain();
}

// Most central pairs first: they are the most likely to cover the cell.
void CellFront::open() {
  const std::size_t before = cutting_.size(), covered_before = covered_.size();
  ordered_.clear();
  boxed_.clear();
  const auto isToOpen = [this](const FrontPair& pair) {
    const NodeBox box = obstacleBox(pair_, pair.nodes);
    if (!largerThanCell(pair, box, kProbeRatio)) return false;
    rankPair(eccentricity(box), {obstacles_.frontPair(pair.nodes), box});
    return true;
  };
  coarse_.erase(std::remove_if(coarse_.begin(), coarse_.end(), isToOpen), coarse_.end());
  std::sort(ordered_.begin(), ordered_.end(),
            [](const Ranked& x, const Ranked& y) { return x.rank < y.rank; });
  int probes = kProbes;
  for (const Ranked& ranked : ordered_) {
    refine(boxed_[ranked.place], probes);
    if (cell_.empty()) break;
  }
  if (!cell_.empty() && cutting_.size() > before) carve();
  noteFront(covered_before);
}

void CellFront::gatherLeaves(const std::vector<FrontPair>& inherited) {
  for (const FrontPair& pair : inherited) {
    if (!pair.hasObstacle()) continue;
    ++statistics_.pairs_tested;
    if (meetsCell(obstacleBoxOf(pair_, pair))) gatherLeaf(pair);
    if (cell_.empty()) return;
  }
  carve();
}

void CellFront::gatherLeaf(const FrontPair& pair) {
  const SlabArrays& slabs = obstacles_.slabs(pair.obstacle);
  const CellCut cut = kernels_.classify(slabs, box_);
  if (cut.relation == CellRelation::outside) return;
  if (slabs.outer_only) return gatherSection(pair);
  if (cut.relation == CellRelation::inside) return coverAll(pair);
  CuttingPair cutting{pair, cut.sides, cut.covered, {}, 0.0, 2.0};
  if (cut.sides == 1) setPlane(cut, cutting);
  cutting_.push_back(cutting);
}

// The one plane of a pair's slabs that cuts the cell.
void CellFront::setPlane(const CellCut& cut, CuttingPair& cutting) const {
  const SlabArrays& slabs = obstacles_.slabs(cutting.pair.obstacle);
  const double sign = cut.upper_side ? -1.0 : 1.0;
  const int i = cut.slab;
  cutting.inner.m = sign * Eigen::Vector3d(slabs.nx()[i], slabs.ny()[i], slabs.nz()[i]);
  cutting.outer = cut.upper_side ? -slabs.hi()[i] : slabs.lo()[i];
  cutting.inner.s = cutting.outer + slabs.margin()[i];
  cutting.layered = (pair_.band || pair_.turning) && slabs.margin()[i] > kThinLayer;
  cutting.depth = depthOf(cutting.inner);
}

// As one of the cutting pairs, or as what covers all.
std::optional<CuttingPair> CellFront::addLayer(const FrontPair& layer) {
  const std::size_t before = cutting_.size();
  gatherLeaf(layer);
  if (cutting_.size() == before || cutting_.back().sides != 1) return std::nullopt;
  return cutting_.back();
}

void CellFront::coverAll(const FrontPair& by) {
  covered_.push_back({cell_, by});
  cell_.hi = cell_.lo;
  cell_.settled = true;
}

// A pair that is known by its support function. It is examined closely only if it reaches out of
// what the best plane so far covers.
void CellFront::gatherSection(const FrontPair& pair) {
  const SupportObstacle obstacle = obstacles_.support(pair.nodes);
  CuttingPair cutting{pair, 2, -1.0, {}, 0.0, 2.0};
  if (least_depth_ < kDeepest &&
      lowest_.ofSupport(obstacle, pair.nodes, deepest_.m) >= deepest_.s) {
    cutting_.push_back(cutting);
    return;
  }
  const CellSection section = sectionOfPair(obstacle, pair.nodes);
  if (section.relation == CellSection::Relation::outside) return;
  if (section.relation == CellSection::Relation::inside) return coverAll(pair);
  if (!section.normal.isZero(0.0)) {
    cutting.sides = 1;
    cutting.inner = {-section.normal, -section.inner};
    cutting.outer = -section.outer;
    cutting.layered = section.outer - section.inner > 64 * obstacle.error() + kThinLayer;
    // Even a plane that covers nothing bounds what may collide.
    cutting.depth = std::min(depthOf(cutting.inner), kDeepest);
    noteDepth(cutting);
  }
  cutting_.push_back(cutting);
}

// Within a band V loses, from inside, what is closer to its boundary than that: what a plane leaves
// of a cell that is larger by the band all around is known to be V's.
CellSection CellFront::sectionOfPair(const SupportObstacle& obstacle, NodePair nodes) const {
  if (!pair_.band) return sectionOf(obstacle, cell_.lo, cell_.hi, cell_.rank);
  if (pair_.band->isOfSweeps()) return sectionOfSweep(obstacle, nodes);
  Eigen::Vector3d grown;
  for (int k = 0; k < 3; ++k) grown[k] = pair_.band->inwardAlong(Eigen::Vector3d::Unit(k));
  const int rank = grown.isZero(0.0) ? cell_.rank : 3;
  CellSection section = sectionOf(obstacle, cell_.lo - grown, cell_.hi + grown, rank);
  const Eigen::Vector3d& n = section.normal;
  moveSection(pair_.band->outwardAlong(n, nodes), -pair_.band->inwardAlong(n), section);
  return section;
}

// V is moved as far as it goes along the normal that it has at rest, and its section taken there.
// The upper plane is that of all ways. The lower one need not be that of a way that V goes: of what
// is swept only the upper end of the interval counts.
CellSection CellFront::sectionOfSweep(const SupportObstacle& obstacle, NodePair nodes) const {
  CellSection still = sectionOf(obstacle, cell_.lo, cell_.hi, cell_.rank);
  if (still.normal.isZero(0.0)) return still;
  Eigen::Vector3d way = pair_.band->wayAlong(still.normal, nodes);
  way.tail(3 - cell_.rank).setZero();
  CellSection section = sectionOf(obstacle, cell_.lo - way, cell_.hi - way, cell_.rank);
  const Eigen::Vector3d& n = section.normal;
  const double outward = pair_.band->outwardAlong(n, nodes);
  const bool is_small = cell_.largestWidth() <= kSmallBesideSweep * outward;
  moveSection(outward, is_small ? kInfinity : n.dot(way), section);
  return section;
}

// Moves its planes outwards.
void CellFront::moveSection(double outer, double inner, CellSection& section) const {
  const Eigen::Vector3d& n = section.normal;
  if (n.isZero(0.0)) return;
  const double rounding = 64 * kEpsilon * (kReach + std::fabs(section.outer));
  section.outer += outer + rounding;
  section.inner = std::min(section.outer, section.inner + inner - rounding);
  section.relation =
      n.dot(cell_.lowestCorner(n)) - rounding > section.outer     ? CellSection::Relation::outside
      : n.dot(cell_.lowestCorner(-n)) + rounding <= section.inner ? CellSection::Relation::inside
                                                                  : CellSection::Relation::cut;
}

double CellFront::depthOf(const CellPlane& plane) const {
  double middle = 0.0;
  double radius = 0.0;
  for (int k = 0; k < 3; ++k) {
    middle += plane.m[k] * box_.center[k];
    radius += std::fabs(plane.m[k]) * box_.half[k];
  }
  return (plane.s - middle) / std::max(radius, 1e-300);
}

void CellFront::noteDepth(const CuttingPair& cutting) {
  if (cutting.depth >= least_depth_) return;
  least_depth_ = cutting.depth;
  deepest_ = cutting.inner;
}

void CellFront::rankPair(double rank, const BoxedPair& boxed) {
  ordered_.push_back({rank, static_cast<int>(boxed_.size())});
  boxed_.push_back(boxed);
}

void CellFront::gatherCoarse(const std::vector<FrontPair>& inherited) {
  for (const FrontPair& pair : inherited) {
    if (pair.hasObstacle()) continue;
    ++statistics_.pairs_tested;
    if (meetsCell(obstacleBox(pair_, pair.nodes))) coarse_.push_back(pair);
  }
}

void CellFront::refine(const BoxedPair& coarse, int& probes) {
  stack_.push_back(coarse);
  while (!stack_.empty()) {
    const BoxedPair boxed = stack_.back();
    const FrontPair& pair = boxed.pair;
    stack_.pop_back();
    ++statistics_.pairs_tested;
    if (!meetsCell(boxed.box)) continue;
    if (pair.hasObstacle()) {
      --probes;
      const std::size_t before = cutting_.size();
      gatherLeaf(pair);
      if (cutting_.size() > before && cutting_.back().covered > kImmediateShare) {
        carveBy(pair, kImmediateShare);
      }
      if (cell_.empty()) return;
    } else if (largerThanCell(boxed.pair, boxed.box, probes > 0 ? kProbeRatio : kRefineRatio)) {
      expand(boxed);
    } else {
      --probes;
      coarse_.push_back(pair);
    }
  }
}

// Pushes the more central child last.
void CellFront::expand(const BoxedPair& boxed) {
  const std::array<NodePair, 2> children = childrenOf(pair_, boxed.pair.nodes);
  std::array<NodeBox, 2> boxes{obstacleBox(pair_, children[0]), obstacleBox(pair_, children[1])};
  const int last = eccentricity(boxes[0]) < eccentricity(boxes[1]) ? 0 : 1;
  for (const int i : {1 - last, last}) {
    if (!meetsCell(boxes[i]) || !meetsLayer(children[i])) continue;
    stack_.push_back({obstacles_.frontPair(children[i]), boxes[i]});
  }
}

// Settles slices of the cell that a cutting pair covers, largest first.
void CellFront::carve() {
  for (int round = 0; round < kCarveRounds; ++round) {
    CellSlice best{-1, false, 0.0};
    const CuttingPair* by = nullptr;
    double share = kLeastShare;
    // What a pair may cover was computed for the cell as it was; a smaller cell may be covered
    // better, so that from the second round on the filter is a guess.
    for (const CuttingPair& cutting : cutting_) {
      if (cutting.covered <= (round == 0 ? share : 0.5 * share)) continue;
      const CellSlice slice = kernels_.coveredSlice(obstacles_.slabs(cutting.pair.obstacle), box_);
      if (slice.axis < 0 || slice.axis >= cell_.rank) continue;
      if (slice.width > share * 2 * box_.half[slice.axis]) {
        share = slice.width / (2 * box_.half[slice.axis]);
        best = slice;
        by = &cutting;
      }
    }
    if (!by) return;
    cover(best, by->pair);
    if (cell_.empty()) return;
  }
}

bool CellFront::carveBy(const FrontPair& pair, double least_share) {
  const CellSlice slice = kernels_.coveredSlice(obstacles_.slabs(pair.obstacle), box_);
  if (slice.axis < 0 || slice.axis >= cell_.rank) return false;
  if (slice.width <= least_share * 2 * box_.half[slice.axis]) return false;
  cover(slice, pair);
  return true;
}

void CellFront::cover(const CellSlice& covered, const FrontPair& by) {
  Cell slice = cell_;
  const int k = covered.axis;
  if (covered.at_lower_end) {
    cell_.lo[k] = std::min(slice.hi[k], slice.lo[k] + covered.width);
    slice.hi[k] = cell_.lo[k];
  } else {
    cell_.hi[k] = std::max(slice.lo[k], slice.hi[k] - covered.width);
    slice.lo[k] = cell_.hi[k];
  }
  covered_.push_back({slice, by});
  box_ = cell_.box();
}

void CellFront::classifyAgain() {
  previous_.swap(cutting_);
  cutting_.clear();
  least_depth_ = kDeepest;
  for (const CuttingPair& cutting : previous_) {
    if (meetsCell(obstacleBoxOf(pair_, cutting.pair))) gatherLeaf(cutting.pair);
    if (cell_.empty()) return;
  }
}

bool CellFront::meetsCell(const NodeBox& box) const {
  return !isClearOf(box, cell_.lo.data(), cell_.hi.data());
}

// Whether the layer of two nodes, if they have one, meets the cell.
bool CellFront::meetsLayer(NodePair nodes) {
  const std::optional<NodeLayer> layer = layers_.of(nodes);
  return !layer || meets(box_, *layer);
}

// How far the middle of the cell is from that of the C-obstacle's box.
double CellFront::eccentricity(const NodeBox& box) const {
  double off = 0.0;
  for (int k = 0; k < cell_.rank; ++k) {
    off += std::fabs(0.5 * (box.lo[k] + box.hi[k]) - box_.center[k]);
  }
  return off;
}

// What a band adds to the box may collide, but does not for certain; what sweeps add counts.
bool CellFront::largerThanCell(const FrontPair& pair, const NodeBox& box, double ratio) const {
  for (int k = 0; k < cell_.rank; ++k) {
    double own = box.hi[k] - box.lo[k];
    if (pair_.band && !pair_.band->isOfSweeps()) {
      own -= 2.0 * outwardOfBand(pair_, Eigen::Vector3d::Unit(k), pair.nodes);
    }
    if (own < ratio * (cell_.hi[k] - cell_.lo[k])) return false;
  }
  return true;
}

std::optional<CuttingPair> CellFront::champion() const {
  std::optional<CuttingPair> best;
  for (const CuttingPair& cutting : cutting_) {
    if (cutting.sides == 1 && cutting.depth < (best ? best->depth : 1.0)) best = cutting;
  }
  return best;
}

Eigen::Vector3d CellFront::acrossNearest(const Eigen::Vector3d& point) const {
  Eigen::Vector3d across = Eigen::Vector3d::Zero();
  double nearest = kInfinity;
  for (const CuttingPair& cutting : cutting_) {
    if (cutting.pair.isLayer()) continue;
    const CellPlane plane = farthestPlane(slabs(cutting.pair), point);
    const double beyond = plane.s - plane.m.dot(point);
    if (plane.m.isZero(0.0) || beyond >= nearest) continue;
    nearest = beyond;
    across = plane.m;
  }
  return across;
}

bool CellFront::clip(const FrontPair& pair, Cell& part) const {
  const NodeBox box = obstacleBoxOf(pair_, pair);
  for (int k = 0; k < cell_.rank; ++k) {
    part.lo[k] = std::max(box.lo[k], part.lo[k]);
    part.hi[k] = std::min(box.hi[k], part.hi[k]);
  }
  if (!pair.hasObstacle()) return !part.empty();
  for (int round = 0; round < kClipRounds && !part.empty(); ++round) {
    double lo[3] = {part.lo[0], part.lo[1], part.lo[2]};
    double hi[3] = {part.hi[0], part.hi[1], part.hi[2]};
    kernels_.contract(obstacles_.slabs(pair.obstacle), part.box(), lo, hi);
    for (int k = 0; k < cell_.rank; ++k) {
      part.lo[k] = lo[k];
      part.hi[k] = hi[k];
    }
  }
  return !part.empty();
}

}  // namespace fcl_prob::detail
