// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene/whitened_fan.h"

#include <Eigen/LU>
#include <cmath>

#include "base/constants.h"

namespace fcl_prob::detail {
namespace {

/// A point of a part, in the tree's frame and in the whitened one.
struct Anchor {
  Eigen::Vector3d of_tree;
  Eigen::Vector3d whitened;
};

Anchor anchorOf(const WhitenedTree& body, const PieceTree::Part& part) {
  const int vertex = part.vertices.begin, shape = part.bodies.begin;
  if (vertex < part.vertices.end) return {body.tree->vertices[vertex], body.vertices[vertex]};
  return {body.tree->bodies[shape].position, body.positions[shape]};
}

// Beyond this share of P nothing is certified of its inside.
constexpr double kLargestShare = 1e-3;

}  // namespace

WhitenedFan::WhitenedFan(const WhitenedPair& pair, const PieceTree::Part& part,
                         const ConvexFan& fan, bool fan_is_a, const Eigen::Matrix3d& linear)
    : mesh_(fan_is_a ? pair.b : pair.a), sign_(fan_is_a ? 1.0 : -1.0), arcs_(fan.arcs) {
  const WhitenedTree& body = fan_is_a ? pair.a : pair.b;
  Eigen::Vector3d largest = Eigen::Vector3d::Constant(kReach);
  for (const WhitenedTree* tree : {&body, &mesh_}) {
    const NodeBox& box = tree->boxOf(0);
    for (int k = 0; k < 3; ++k) {
      largest[k] += 2 * std::max(std::fabs(box.lo[k]), std::fabs(box.hi[k]));
    }
  }
  reach_ = 2 * largest.norm();
  // Four errors of a vertex of either object: of the corner, the support point and the two ends of
  // an edge. Sums of products of a normal and points within reach: 64 ε.
  pad_ = 4 * (body.error + mesh_.error) + 64 * kEpsilon * largest;
  moveFan(body, part, fan, linear);
}

// In the whitened frame a normal n of the fan has the direction m with Lᵀm ∥ n; however m was
// rounded, the offset follows from how far Lᵀm is off n.
void WhitenedFan::moveFan(const WhitenedTree& body, const PieceTree::Part& part,
                          const ConvexFan& fan, const Eigen::Matrix3d& linear) {
  const Anchor anchor = anchorOf(body, part);
  centre_ = anchor.whitened + linear * (fan.centre - anchor.of_tree);
  for (int k = 0; k < 3; ++k) {
    box_.lo[k] = kInfinity;
    box_.hi[k] = -kInfinity;
  }
  for (const Eigen::Vector3d& vertex : fan.vertices) {
    points_.emplace_back(-sign_ * (linear * vertex));
    for (int k = 0; k < 3; ++k) {
      box_.lo[k] = std::min(box_.lo[k], points_.back()[k] - pad_[k]);
      box_.hi[k] = std::max(box_.hi[k], points_.back()[k] + pad_[k]);
    }
  }
  const Eigen::Matrix3d inverse = linear.inverse();
  const double size = linear.cwiseAbs().sum();
  double share = 0.0;
  for (std::size_t f = 0; f < fan.normals.size(); ++f) {
    const Eigen::Vector3d n = (inverse.transpose() * fan.normals[f]).normalized();
    const Eigen::Vector3d back = linear.transpose() * n;
    const double scale = back.dot(fan.normals[f]);
    const double off =
        (back - scale * fan.normals[f]).norm() * fan.radius + 16 * kEpsilon * size * fan.radius;
    const double offset = scale * fan.offsets[f] + off + padding(n);
    const double depth = scale * fan.depths[f] + 2 * (off + padding(n));
    usable_ = usable_ && scale > 0.0 && offset > depth && std::isfinite(offset);
    normals_.push_back(-sign_ * n);
    offsets_.push_back(offset);
    share = std::max(share, depth / offset);
  }
  coordinates_.resize(faceCount(), 3);
  for (int f = 0; f < faceCount(); ++f) coordinates_.row(f) = normals_[f].transpose();
  // See docs/rounding.md: once for the mesh off its hull, once for the fan off the hull.
  share_ = 2.5 * share;
  usable_ = usable_ && share_ < kLargestShare;
  for (std::size_t f = 0; f < normals_.size(); ++f) {
    pads_.push_back(padding(normals_[f]));
    margins_.push_back(share_ * offsets_[f] + 3 * pads_[f]);
    most_margin_ = std::max(most_margin_, margins_[f]);
  }
  measureRoundness();
}

double WhitenedFan::support(const Eigen::Vector3d& n) const {
  double highest = -kInfinity;
  for (const Eigen::Vector3d& point : points_) highest = std::max(highest, n.dot(point));
  return highest + padding(n);
}

void WhitenedFan::measureRoundness() {
  double nearest = kInfinity;
  double farthest = 0.0;
  for (int f = 0; f < faceCount(); ++f) {
    nearest = std::min(nearest, offsets_[f] + pads_[f] - margins_[f]);
  }
  for (const Eigen::Vector3d& point : points_) farthest = std::max(farthest, point.norm());
  roundness_ = nearest > 0.0 ? (farthest + pad_.norm()) / nearest : kInfinity;
}

Eigen::Matrix3d WhitenedFan::corners(int triangle) const {
  const Eigen::Vector3i& t = mesh_.tree->triangles[triangle];
  Eigen::Matrix3d corners;
  for (int k = 0; k < 3; ++k) corners.col(k) = corner(t[k]);
  return corners;
}

NodeBox WhitenedFan::cornerBox(const NodeBox& box) const {
  NodeBox result;
  for (int k = 0; k < 3; ++k) {
    result.lo[k] = sign_ * ((sign_ > 0 ? box.lo[k] : box.hi[k]) - centre_[k]);
    result.hi[k] = sign_ * ((sign_ > 0 ? box.hi[k] : box.lo[k]) - centre_[k]);
  }
  return result;
}

NodeBox WhitenedFan::obstacleBox(const NodeBox& of_mesh) const {
  NodeBox box = cornerBox(of_mesh);
  for (int k = 0; k < 3; ++k) {
    box.lo[k] = box_.lo[k] + box.lo[k] - pad_[k];
    box.hi[k] = box_.hi[k] + box.hi[k] + pad_[k];
  }
  return box;
}

bool WhitenedFan::isTooSmallFor(const std::vector<std::pair<int, int>>& spans) const {
  if (spans.empty()) return false;
  return std::all_of(spans.begin(), spans.end(), [this](const std::pair<int, int>& span) {
    if (span.first < 0) return false;
    const Eigen::Vector3d along = mesh_.vertices[span.second] - mesh_.vertices[span.first];
    const Eigen::Vector3d n = along.normalized();
    return n.allFinite() && n.dot(along) - 4 * padding(n) > support(n) + support(-n);
  });
}

}  // namespace fcl_prob::detail
