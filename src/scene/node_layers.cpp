// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene/node_layers.h"

#include "base/left_out.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "convex/slab_kernels.h"

namespace fcl_prob::detail {

namespace {

double largestRowSum(const Eigen::Matrix3d& matrix) {
  return matrix.cwiseAbs().rowwise().sum().maxCoeff();
}

/// Of n·x over a box, rounded.
struct Range {
  double lo;
  double hi;
};

Range rangeAlong(const NodeBox& box, const Eigen::Vector3d& n) {
  Range range{0.0, 0.0};
  for (int k = 0; k < 3; ++k) {
    const double of_lo = n[k] * box.lo[k];
    const double of_hi = n[k] * box.hi[k];
    range.lo += std::min(of_lo, of_hi);
    range.hi += std::max(of_lo, of_hi);
  }
  return range;
}

}  // namespace

NodeLayers::NodeLayers(const WhitenedPair& pair)
    : a_(pair.a),
      b_(pair.b),
      // The errors are no less than 16 epsilon of coordinates and of what they are sums of.
      rounding_(8 * (pair.a.error + pair.b.error).array() + 64 * kEpsilon * kReach) {
  const bool moves = !pair.a.node_motions.empty() || !pair.b.node_motions.empty();
  if (pair.band || moves || isLeftOut("layers of nodes")) return;
  a_.useSlabs();
  b_.useSlabs();
}

void NodeLayers::Side::useSlabs() {
  if (!tree_.tree->isMesh()) return;
  for (std::size_t i = 0; i < tree_.tree->parts.size(); ++i) {
    if (!tree_.tree->parts[i].slabs) continue;  // an octree without occupied cells
    const Part part = partOf(tree_, i);
    if (!part.normals.allFinite() || !part.offset.allFinite()) return;
    parts_.push_back(part);
  }
  places_.assign(tree_.tree->nodes.size(), kUnknown);
}

// x = linear·p + offset for the points p of a part, so that normals transform by the inverse of the
// transposed matrix. That is rounded: what n·linear·p is off normal·p counts as rounding.
NodeLayers::Part NodeLayers::partOf(const WhitenedTree& tree, std::size_t index) {
  const PieceTree::Part& part = tree.tree->parts[index];
  const Eigen::Matrix3d transposed = tree.linear[index].transpose();
  const Eigen::Matrix3d normals = transposed.inverse();
  const double off = largestRowSum(transposed * normals - Eigen::Matrix3d::Identity()) +
                     64 * kEpsilon * largestRowSum(transposed.cwiseAbs() * normals.cwiseAbs());
  return {part.root, &part.slabs->of(*tree.tree, part), normals, tree.offsets[index],
          3 * off * part.radius};
}

const NodeLayers::Slab* NodeLayers::Side::slabOf(int node) {
  if (places_.empty()) return nullptr;
  int& place = places_[node];
  if (place == kUnknown) place = whiten(node);
  return place == kNotFlat ? nullptr : &slabs_[place];
}

int NodeLayers::Side::whiten(int node) {
  const auto behind = std::upper_bound(parts_.begin(), parts_.end(), node,
                                       [](int i, const Part& other) { return i < other.root; });
  if (behind == parts_.begin()) return kNotFlat;
  const Part& part = *std::prev(behind);
  const NodeSlab& own = (*part.slabs)[node - part.root];
  if (!own.isFlat()) return kNotFlat;
  const Eigen::Vector3d n = part.normals * own.normal.cast<double>();
  const double offset = n.dot(part.offset);
  slabs_.push_back(
      {{n, own.lo + offset - part.rounding, own.hi + offset + part.rounding}, n.squaredNorm()});
  return static_cast<int>(slabs_.size()) - 1;
}

// Of the other node's points n·x is what it is in their box; with n = α n' + r where it is flat
// itself also α times what its own slab tells and what r·x is in the box.
NodeLayer NodeLayers::between(const Slab& slab, bool of_a, const NodeBox& box,
                              const Slab* own) const {
  const Eigen::Vector3d& n = slab.layer.n;
  Eigen::Vector3d terms = n.cwiseAbs();
  Range range = rangeAlong(box, n);
  if (own) {
    const double alpha = n.dot(own->layer.n) / own->square;
    const Eigen::Vector3d along = alpha * own->layer.n;
    terms += along.cwiseAbs();
    const Range rest = rangeAlong(box, n - along);
    const double ends[] = {alpha * own->layer.lo, alpha * own->layer.hi};
    range.lo = std::max(range.lo, rest.lo + std::min(ends[0], ends[1]));
    range.hi = std::min(range.hi, rest.hi + std::max(ends[0], ends[1]));
  }
  const double rounding = rounding_.dot(terms);
  if (of_a) return {n, range.lo - slab.layer.hi - rounding, range.hi - slab.layer.lo + rounding};
  return {n, slab.layer.lo - range.hi - rounding, slab.layer.hi - range.lo + rounding};
}

std::optional<NodeLayer> NodeLayers::of(NodePair nodes) {
  const Slab* const of_a = a_.slabOf(nodes.a);
  const Slab* const of_b = b_.slabOf(nodes.b);
  if (!of_a && !of_b) return std::nullopt;
  const NodeBox& a = a_.box(nodes.a);
  const NodeBox& b = b_.box(nodes.b);
  if (of_a && (!of_b || a.size() >= b.size())) return between(*of_a, true, b, of_b);
  return between(*of_b, false, a, of_a);
}

}  // namespace fcl_prob::detail
