// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cells/lowest_in_cell.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "mass/cell_layer.h"
#include "scene/band_margin.h"
#include "scene/turning_margin.h"

namespace fcl_prob::detail {
namespace {

constexpr NodeBox kEverywhere{{-1e300, -1e300, -1e300}, {1e300, 1e300, 1e300}};

// The order of a heap whose first is the lowest.
constexpr auto kHigher = [](const auto& x, const auto& y) { return x.lowest > y.lowest; };

}  // namespace

NodeBox obstacleBoxOf(const WhitenedPair& pair, const FrontPair& of) {
  if (of.isLayer()) return kEverywhere;
  return obstacleBox(pair, of.nodes);
}

bool meets(const CellBox& cell, const NodeLayer& layer) {
  double middle = 0.0;
  double radius = 0.0;
  for (int k = 0; k < 3; ++k) {
    middle += layer.n[k] * cell.center[k];
    radius += std::fabs(layer.n[k]) * cell.half[k];
  }
  return !(middle + radius < layer.lo || middle - radius > layer.hi);
}

double outwardOfBand(const WhitenedPair& pair, const Eigen::Vector3d& m, NodePair nodes) {
  return pair.band ? pair.band->outwardAlong(m, nodes) : 0.0;
}

LowestInCell::LowestInCell(const WhitenedPair& pair, ObstacleTable& obstacles, const Cell& cell,
                           const CellBox& box, NodeLayers& layers,
                           ProbabilityStatistics& statistics)
    : pair_(pair),
      obstacles_(obstacles),
      cell_(cell),
      box_(box),
      layers_(layers),
      statistics_(statistics),
      kernels_(slabKernels()),
      support_a_(pair.a),
      support_b_(pair.b) {}

double LowestInCell::ofSupport(const SupportObstacle& obstacle, NodePair nodes,
                               const Eigen::Vector3d& m) const {
  return -obstacle.supportUpper(-m) - outwardOfBand(pair_, m, nodes);
}

double LowestInCell::ofBox(const NodeBox& box, const Eigen::Vector3d& m) const {
  double lowest = -1e-13;  // rounding of the sum
  for (int k = 0; k < 3; ++k) {
    const double lo = std::max(box.lo[k], cell_.lo[k]);
    const double hi = std::min(box.hi[k], cell_.hi[k]);
    lowest += m[k] * (m[k] > 0 ? lo : hi);
  }
  return lowest;
}

// The side of the layer that is below.
double LowestInCell::ofLayer(const NodeLayer& layer, const NodeBox& box,
                             const Eigen::Vector3d& m) const {
  Eigen::Vector3d lo, hi;
  for (int k = 0; k < 3; ++k) {
    lo[k] = std::max(box.lo[k], cell_.lo[k]);
    hi[k] = std::min(box.hi[k], cell_.hi[k]);
  }
  if (layer.n.dot(m) > 0.0) return lowestBeyond(lo, hi, m, layer.n, layer.lo);
  return lowestBeyond(lo, hi, m, -layer.n, -layer.hi);
}

double LowestInCell::ofSlabs(const FrontPair& pair, const Eigen::Vector3d& m) const {
  const SlabArrays& slabs = obstacles_.slabs(pair.obstacle);
  const double lowest = kernels_.minimumAlong(slabs, box_, m.data());
  if (!slabs.outer_only) return lowest;
  return std::max(lowest, ofSupport(obstacles_.support(pair.nodes), pair.nodes, m));
}

double LowestInCell::ofVertices(NodePair nodes, const Eigen::Vector3d& m) {
  if (!pair_.a.tree->isMesh() || !pair_.b.tree->isMesh()) return -1e300;
  const double a = support_a_.along(m, nodes.a);
  const double b = -support_b_.along(-m, nodes.b);
  const Eigen::Vector3d rounded =
      pair_.turning ? Eigen::Vector3d(pair_.a.error + pair_.b.error) : slabError(pair_, nodes);
  const double moved =
      pair_.turning ? pair_.turning->along(m, nodes) : outwardOfBand(pair_, m, nodes);
  const double error =
      4 * m.cwiseAbs().dot(rounded) + moved + 1e-15 * (std::fabs(a) + std::fabs(b));
  return b - a - error;
}

double LowestInCell::ofFront(const std::vector<FrontPair>& front, const CellPlane& level,
                             double least) {
  const Eigen::Vector3d& m = level.m;
  double result = level.s;
  for (const FrontPair& pair : front) {
    if (result <= least) return result;
    double lowest = ofBox(pair, m);
    if (lowest < result && pair.hasObstacle()) {
      if (!pair.isLayer()) lowest = std::max(lowest, ofVertices(pair.nodes, m));
      if (lowest < result) lowest = std::max(lowest, ofSlabs(pair, m));
    }
    result = std::min(result, lowest);
  }
  return result;
}

// Lower bound of m·y over the C-obstacle of two nodes ∩ cell: as good as it gets if it is below the
// level.
double LowestInCell::ofParts(NodePair nodes, const NodeBox& box, const CellPlane& level) {
  double lowest = ofBox(box, level.m);
  if (lowest >= level.s) return lowest;
  if (const auto layer = layers_.of(nodes)) {
    if (!meets(box_, *layer)) return kInfinity;
    lowest = std::max(lowest, ofLayer(*layer, box, level.m));
    if (lowest >= level.s) return lowest;
  }
  lowest = std::max(lowest, ofVertices(nodes, level.m));
  if (lowest >= level.s || !areLeaves(pair_, nodes) || !obstacles_.areTriangles(nodes)) {
    return lowest;
  }
  const SlabArrays slabs = obstacles_.slabsOnce(nodes, once_);
  if (kernels_.classify(slabs, box_).relation == CellRelation::outside) return kInfinity;
  return std::max(lowest, kernels_.minimumAlong(slabs, box_, level.m.data()));
}

// Adds to the heap of pairs by how low they reach.
void LowestInCell::addBelow(NodePair nodes, const CellPlane& level, PartsBelow& below) {
  ++statistics_.pairs_tested;
  const NodeBox box = obstacleBox(pair_, nodes);
  if (isClearOf(box, cell_.lo.data(), cell_.hi.data())) return;
  const double lowest = ofParts(nodes, box, level);
  if (lowest >= level.s) {
    below.lowest_of_others = std::min(below.lowest_of_others, lowest);
    return;
  }
  heap_.push_back({lowest, nodes});
  std::push_heap(heap_.begin(), heap_.end(), kHigher);
}

void LowestInCell::findBelow(const std::vector<FrontPair>& pairs, const CellPlane& level,
                             double known, int budget, PartsBelow& below) {
  below.pairs.clear();
  below.lowest = kInfinity;
  below.lowest_of_others = kInfinity;
  heap_.clear();
  for (const FrontPair& pair : pairs) addBelow(pair.nodes, level, below);
  for (; !heap_.empty() && budget > 0; --budget) {
    const Reaching lowest = heap_.front();
    if (lowest.lowest >= known || areLeaves(pair_, lowest.nodes)) break;
    std::pop_heap(heap_.begin(), heap_.end(), kHigher);
    heap_.pop_back();
    for (const NodePair child : childrenOf(pair_, lowest.nodes)) addBelow(child, level, below);
  }
  if (!heap_.empty()) below.lowest = heap_.front().lowest;
  for (const Reaching& each : heap_) below.pairs.push_back(FrontPair::ofNodes(each.nodes));
}

}  // namespace fcl_prob::detail
