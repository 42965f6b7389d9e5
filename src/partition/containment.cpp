// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "partition/containment.h"

#include <Eigen/LU>
#include <algorithm>

namespace fcl_prob::detail {

namespace {

// Points, one in every connected part of the surface of object.parts[i], geometry's frame.
std::vector<Eigen::Vector3d> surfacePoints(const PartitionObject& object, std::size_t i) {
  if (object.parts[i].solid) return object.parts[i].solid->partPoints();
  const PieceTree& tree = *object.tree;
  const PieceTree::Part& part = tree.parts[i];
  std::vector<Eigen::Vector3d> points;
  if (part.vertices.begin < part.vertices.end) {
    points.push_back(part.origin + tree.vertices[part.vertices.begin]);
  }
  for (int j = part.bodies.begin; j < part.bodies.end; ++j) {
    const PieceTree::Body& body = tree.bodies[j];
    points.push_back(part.origin + body.position + tree.shapes[body.shape].body.points.front());
  }
  return points;
}

}  // namespace

SolidContact::SolidContact(const PartitionObject& a, const PartitionObject& b,
                           const Whitening& whitening, const WhitenedPair& pair)
    : whitening_(whitening) {
  addDirections(a, pair.a, b, pair.b, 1.0);
  addDirections(b, pair.b, a, pair.a, -1.0);
}

void SolidContact::addDirections(const PartitionObject& inner, const WhitenedTree& of_inner,
                                 const PartitionObject& outer, const WhitenedTree& of_outer,
                                 double sign) {
  for (std::size_t j = 0; j < outer.parts.size(); ++j) {
    const PlacedPart& around = outer.parts[j];
    if (!around.solid) continue;
    for (std::size_t i = 0; i < inner.parts.size(); ++i) {
      if (inner.tree->parts[i].root < 0) continue;
      Direction direction;
      direction.outer = around.solid;
      // Not the transpose: the matrix need not be a rotation to the last bit.
      const Eigen::Matrix3d unrotate = around.pose.linear().inverse();
      const Eigen::Matrix3d rotation = unrotate * inner.parts[i].pose.linear();
      const Eigen::Vector3d translation =
          unrotate * (inner.parts[i].pose.translation() - around.pose.translation());
      for (const Eigen::Vector3d& point : surfacePoints(inner, i)) {
        direction.points.push_back(rotation * point + translation);
      }
      direction.shift = sign * unrotate;
      direction.outer_box = of_outer.boxes[outer.tree->parts[j].root];
      direction.inner_box = of_inner.boxes[inner.tree->parts[i].root];
      direction.sign = sign;
      // The boxes contain motions, on either side.
      direction.rounding = 4 * (of_inner.error + of_outer.error);
      for (const WhitenedTree* tree : {&of_inner, &of_outer}) {
        if (!tree->node_motions.empty()) direction.rounding += 2 * tree->node_motions[0];
      }
      directions_.push_back(std::move(direction));
    }
  }
}

// The inner object's box, moved, can be within the outer one's for some displacement of the cell.
bool SolidContact::fits(const Direction& direction, const Cell& cell) {
  for (int k = 0; k < 3; ++k) {
    const double lo = direction.sign > 0 ? cell.lo[k] : -cell.hi[k];
    const double hi = direction.sign > 0 ? cell.hi[k] : -cell.lo[k];
    if (direction.inner_box.lo[k] + hi < direction.outer_box.lo[k] - direction.rounding[k])
      return false;
    if (direction.inner_box.hi[k] + lo > direction.outer_box.hi[k] + direction.rounding[k])
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
