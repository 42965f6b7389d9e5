// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "partition/containment.h"

#include <algorithm>

namespace fcl_prob::detail {

namespace {

// Points, one in every connected part of the object's surface, geometry's frame.
std::vector<Eigen::Vector3d> partPoints(const PartitionObject& object) {
  if (object.solid) return object.solid->partPoints();
  const PieceTree& tree = *object.tree;
  if (tree.isMesh()) return {tree.origin + tree.vertices.front()};
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < tree.pieces.size(); ++i) {
    points.push_back(tree.origin + tree.vertices[i] +
                     tree.shapes[tree.pieces[i]].body.points.front());
  }
  return points;
}

}  // namespace

SolidContact::SolidContact(const PartitionObject& a, const PartitionObject& b,
                           const Whitening& whitening, const WhitenedPair& pair)
    : whitening_(whitening) {
  const auto add = [&](const PartitionObject& inner, const PartitionObject& outer, double sign) {
    if (!outer.solid) return;
    Direction direction;
    direction.outer = outer.solid;
    const fcl::Transform3d to_outer = outer.pose.inverse() * inner.pose;
    for (const Eigen::Vector3d& point : partPoints(inner))
      direction.points.push_back(to_outer * point);
    direction.shift = sign * outer.pose.linear().transpose();
    direction.outer_box = sign > 0 ? pair.b.boxes[0] : pair.a.boxes[0];
    direction.inner_box = sign > 0 ? pair.a.boxes[0] : pair.b.boxes[0];
    direction.sign = sign;
    direction.rounding = 4 * (pair.a.error + pair.b.error);
    directions_.push_back(std::move(direction));
  };
  add(a, b, 1.0);
  add(b, a, -1.0);
}

// The inner object's box, moved, can be within the outer one's for some displacement of the cell.
bool SolidContact::fits(const Direction& direction, const Cell& cell) {
  for (int k = 0; k < 3; ++k) {
    const double lo = direction.sign > 0 ? cell.lo[k] : -cell.hi[k];
    const double hi = direction.sign > 0 ? cell.hi[k] : -cell.lo[k];
    if (direction.inner_box.lo[k] + hi < direction.outer_box.lo[k] - direction.rounding)
      return false;
    if (direction.inner_box.hi[k] + lo > direction.outer_box.hi[k] + direction.rounding)
      return false;
  }
  return true;
}

bool SolidContact::possible(const Cell& cell) const {
  return std::any_of(directions_.begin(), directions_.end(),
                     [&cell](const Direction& direction) { return fits(direction, cell); });
}

Containment SolidContact::decide(const Direction& direction,
                                 const Eigen::Vector3d& displacement) const {
  const Eigen::Vector3d shift = direction.shift * displacement;
  bool unknown = false;
  for (const Eigen::Vector3d& point : direction.points) {
    const Containment containment = direction.outer->contains(point + shift);
    if (containment == Containment::inside) return containment;
    unknown = unknown || containment == Containment::unknown;
  }
  return unknown ? Containment::unknown : Containment::outside;
}

Containment SolidContact::at(const Eigen::Vector3d& y) const {
  const Eigen::Vector3d displacement = whitening_.unapply(y);
  bool unknown = false;
  for (const Direction& direction : directions_) {
    const Containment containment = decide(direction, displacement);
    if (containment == Containment::inside) return containment;
    unknown = unknown || containment == Containment::unknown;
  }
  return unknown ? Containment::unknown : Containment::outside;
}

}  // namespace fcl_prob::detail
