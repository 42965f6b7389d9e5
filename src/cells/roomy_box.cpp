// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cells/roomy_box.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/constants.h"
#include "base/random_words.h"
#include "cells/cell_draw.h"
#include "fcl_prob/normal_mass.h"
#include "gaussian/normal_density.h"

namespace fcl_prob::detail {
namespace {

constexpr double kSqrtTwoPi = 1.0 / kInverseSqrtTwoPi;

// Rooms that are tried. Too little of it leaves lines that are short within the box, which weigh
// much; too much makes lines that meet nothing.
constexpr double kLeastRoom = 1.0 / 16.0;
constexpr double kMostRoom = 4.0;

// Steps towards the point of a C-obstacle that is nearest to the mean: the box need not be turned
// exactly.
constexpr int kMostSteps = 12;
constexpr double kNearEnough = 0.95;

Eigen::Vector3d farthestOfLeaf(const WhitenedTree& whitened, int node, const Eigen::Vector3d& m) {
  const PieceTree& tree = *whitened.tree;
  const int piece = tree.nodes[node].piece;
  if (!tree.isTriangle(piece)) {
    const int body = tree.bodyOf(piece);
    const ConvexPiece& shape = whitened.shapes[tree.bodies[body].shape];
    return whitened.positions[body] + shape.body.supportPoint(m);
  }
  const Eigen::Vector3i& corners = tree.triangles[piece];
  int farthest = corners[0];
  for (const int corner : corners) {
    if (m.dot(whitened.vertices[corner]) > m.dot(whitened.vertices[farthest])) farthest = corner;
  }
  return whitened.vertices[farthest];
}

/// The point of a node that is farthest along m.
Eigen::Vector3d farthest(const WhitenedTree& whitened, int node, const Eigen::Vector3d& m) {
  Eigen::Vector3d best = Eigen::Vector3d::Zero();
  double most = -kInfinity;
  std::vector<int> stack{node};
  while (!stack.empty()) {
    const int next = stack.back();
    stack.pop_back();
    if (whitened.boxOf(next).highestAlong(m) <= most) continue;
    const PieceTree::Node& of_tree = whitened.tree->nodes[next];
    if (of_tree.isLeaf()) {
      const Eigen::Vector3d point = farthestOfLeaf(whitened, next, m);
      if (!(m.dot(point) > most)) continue;
      most = m.dot(point);
      best = point;
      continue;
    }
    const double of_left = whitened.boxOf(of_tree.left).highestAlong(m);
    const double of_right = whitened.boxOf(of_tree.right).highestAlong(m);
    stack.push_back(of_left > of_right ? of_tree.right : of_tree.left);
    stack.push_back(of_left > of_right ? of_tree.left : of_tree.right);
  }
  return best;
}

/// The point of the C-obstacle's hull that is farthest along m.
Eigen::Vector3d farthest(const WhitenedPair& pair, NodePair nodes, const Eigen::Vector3d& m) {
  return farthest(pair.b, nodes.b, m) - farthest(pair.a, nodes.a, -m);
}

/// From the mean to the nearest point of the C-obstacle's hull, about (Gilbert 1966); zero where
/// that is not far.
Eigen::Vector3d approach(const WhitenedPair& pair, NodePair nodes, int rank) {
  const auto moving = [rank](Eigen::Vector3d y) {
    for (int k = rank; k < 3; ++k) y[k] = 0.0;
    return y;
  };
  const NodeBox box = obstacleBox(pair, nodes);
  Eigen::Vector3d nearest;
  for (int k = 0; k < 3; ++k) nearest[k] = 0.5 * (box.lo[k] + box.hi[k]);
  nearest = moving(nearest);
  for (int step = 0; step < kMostSteps && nearest.norm() > 0.0; ++step) {
    const Eigen::Vector3d point = moving(farthest(pair, nodes, -nearest));
    if (nearest.dot(point) > kNearEnough * nearest.squaredNorm()) return nearest.normalized();
    const Eigen::Vector3d along = point - nearest;
    const double share = -nearest.dot(along) / along.squaredNorm();
    nearest += std::clamp(share, 0.0, 1.0) * along;
  }
  return nearest.norm() > 1.0 ? Eigen::Vector3d(nearest.normalized()) : Eigen::Vector3d::Zero();
}

Eigen::Matrix3d axesAlong(const Eigen::Vector3d& first, int rank) {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  if (rank == 1) return axes;
  axes.row(0) = first;
  axes.row(1) = rank == 2 ? Eigen::Vector3d(-first.y(), first.x(), 0.0) : first.unitOrthogonal();
  axes.row(2) = first.cross(Eigen::Vector3d(axes.row(1)));
  return axes;
}

}  // namespace

RoomyBox::RoomyBox(int rank, double mass)
    : rank_(rank),
      lo_(Eigen::Vector3d::Constant(-kInfinity)),
      hi_(Eigen::Vector3d::Constant(kInfinity)),
      mass_(mass),
      mass_over_density_(kSqrtTwoPi) {}

RoomyBox::RoomyBox(const WhitenedPair& pair, NodePair nodes, int rank) : RoomyBox(rank) {
  const NodeBox box = obstacleBox(pair, nodes);
  for (int k = rank; k < 3; ++k) {
    if (box.lo[k] > 0.0 || box.hi[k] < 0.0) mass_ = 0.0;
  }
  if (!(mass_ > 0.0) || !std::isfinite(box.size())) return;
  fit(pair, nodes, Eigen::Matrix3d::Identity());
  const Eigen::Vector3d first = approach(pair, nodes, rank);
  if (!first.isZero(0.0)) fit(pair, nodes, axesAlong(first, rank));
}

void RoomyBox::fit(const WhitenedPair& pair, NodePair nodes, const Eigen::Matrix3d& axes) {
  Eigen::Vector3d lo, hi;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d axis = axes.row(k);
    lo[k] = axis.dot(farthest(pair, nodes, -axis));
    hi[k] = axis.dot(farthest(pair, nodes, axis));
  }
  for (double room = kLeastRoom; room <= kMostRoom; room *= 2.0) {
    double mass = 1.0;
    for (int k = 0; k < rank_; ++k) mass *= normalIntervalMass(lo[k] - room, hi[k] + room);
    const double over_density = kSqrtTwoPi * normalIntervalMass(-room, room);
    if (mass / over_density >= mass_ / mass_over_density_) continue;
    axes_ = axes;
    lo_ = lo.array() - room;
    hi_ = hi.array() + room;
    mass_ = mass;
    mass_over_density_ = over_density;
  }
}

double RoomyBox::massAlong(const RandomLine& line) const {
  const Eigen::Vector3d origin = axes_ * line.origin;
  const Eigen::Vector3d direction = axes_ * line.direction;
  double lo = -kInfinity, hi = kInfinity;
  for (int k = 0; k < rank_; ++k) {
    const double u = direction[k];
    if (u == 0.0) {
      if (origin[k] < lo_[k] || origin[k] > hi_[k]) return 0.0;
      continue;
    }
    const double first = (lo_[k] - origin[k]) / u;
    const double second = (hi_[k] - origin[k]) / u;
    lo = std::max(lo, std::min(first, second));
    hi = std::min(hi, std::max(first, second));
    if (!(lo < hi)) return 0.0;
  }
  return normalIntervalMass(lo, hi);
}

Eigen::Vector3d RoomyBox::point(const std::array<std::uint64_t, 4>& words) const {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  for (int k = 0; k < rank_; ++k) {
    const double uniform = unitUniform(words[static_cast<std::size_t>(k)]);
    point[k] = truncatedNormal(lo_[k], hi_[k], uniform);
  }
  return axes_.transpose() * point;
}

}  // namespace fcl_prob::detail
