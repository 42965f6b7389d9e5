// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene/node_slabs.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/constants.h"

namespace fcl_prob::detail {

namespace {

// Of more triangles nodes are hardly ever flat; looking at all of them would take longer than
// linear time.
constexpr int kMostOfFlat = 256;

// A node counts as flat if it is no thicker than this share of its diagonal.
constexpr double kFlat = 0.35;

// Parts of other sizes have none, so that no float over- or underflows.
constexpr double kLeastRadius = 1e-30;
constexpr double kMostRadius = 1e30;

class SlabFitter {
 public:
  SlabFitter(const PieceTree& tree, const PieceTree::Part& part)
      : tree_(tree), part_(part), rounding_(8 * kEpsilon * part.radius) {}

  std::vector<NodeSlab> run() {
    const int triangles = part_.triangles.end - part_.triangles.begin;
    const std::size_t count = 2 * static_cast<std::size_t>(triangles) - 1;
    std::vector<NodeSlab> slabs(count);
    if (!(part_.radius > kLeastRadius && part_.radius < kMostRadius)) return slabs;
    // Children stand behind their node.
    std::vector<Eigen::Vector3d> areas(count, Eigen::Vector3d::Zero());
    for (std::size_t i = count; i-- > 0;) {
      const PieceTree::Node& node = tree_.nodes[part_.root + i];
      if (node.isLeaf()) {
        areas[i] = areaOf(tree_.triangles[node.piece]);
      } else {
        areas[i] = areas[node.left - part_.root] + areas[node.right - part_.root];
      }
      if (node.last_piece - node.piece < kMostOfFlat) slabs[i] = fit(node, areas[i]);
    }
    return slabs;
  }

 private:
  Eigen::Vector3d areaOf(const Eigen::Vector3i& triangle) const {
    const Eigen::Vector3d& corner = tree_.vertices[triangle[0]];
    return (tree_.vertices[triangle[1]] - corner).cross(tree_.vertices[triangle[2]] - corner);
  }

  NodeSlab fit(const PieceTree::Node& node, const Eigen::Vector3d& area) const {
    NodeSlab slab;
    const double size = area.norm();
    if (!(size > 0.0)) return slab;
    const Eigen::Vector3f normal = (area / size).cast<float>();
    const Eigen::Vector3d n = normal.cast<double>();
    double lo = kInfinity, hi = -kInfinity;
    Eigen::Vector3d least = Eigen::Vector3d::Constant(kInfinity), most = -least;
    for (int piece = node.piece; piece <= node.last_piece; ++piece) {
      for (const int corner : tree_.triangles[piece]) {
        const Eigen::Vector3d& x = tree_.vertices[corner];
        const double along = n.dot(x);
        lo = std::min(lo, along);
        hi = std::max(hi, along);
        least = least.cwiseMin(x);
        most = most.cwiseMax(x);
      }
    }
    if (!(hi - lo <= kFlat * (most - least).norm())) return slab;
    slab.normal = normal;
    slab.lo = std::nextafter(static_cast<float>(lo - rounding_), -kInfiniteFloat);
    slab.hi = std::nextafter(static_cast<float>(hi + rounding_), kInfiniteFloat);
    return slab;
  }

  static constexpr float kInfiniteFloat = std::numeric_limits<float>::infinity();

  const PieceTree& tree_;
  const PieceTree::Part& part_;
  double rounding_;  ///< of a product with a normal
};

}  // namespace

const std::vector<NodeSlab>& SlabsOfNodes::of(const PieceTree& tree,
                                              const PieceTree::Part& part) const {
  std::call_once(once_, [&] { made_ = SlabFitter(tree, part).run(); });
  return made_;
}

}  // namespace fcl_prob::detail
