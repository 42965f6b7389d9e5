// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene/containment.h"

#include <Eigen/LU>
#include <algorithm>

#include "base/constants.h"
#include "geometry/exact_sum.h"

namespace fcl_prob::detail {

namespace {

// Roundings of a point's way to the frame of the outer solid, relative to the sum of the
// coordinates on it: nine of the inverse of its rotation, three of each product; doubled.
constexpr double kRoundings = 32.0;

BoxesWithin boxesOf(const std::vector<SurfacePart>& parts) {
  std::vector<NodeBox> boxes;
  boxes.reserve(parts.size());
  for (const SurfacePart& part : parts) boxes.push_back(part.box);
  return BoxesWithin(boxes);
}

// From the outer solid's origin to those of the inner object's parts, displaced by the mean, in the
// axes of the world.
std::vector<Eigen::Vector3d> offsetsTo(const PartitionObject& inner, const fcl::Transform3d& outer,
                                       const Eigen::Vector3d& mean) {
  std::vector<Eigen::Vector3d> offsets;
  for (std::size_t i = 0; i < inner.parts.size(); ++i) {
    ExactPosition offset;
    offset.add(mean);
    offset.add(outer.translation(), -1.0);
    offset.add(inner.parts[i].pose, inner.tree->parts[i].origin);
    offsets.push_back(offset.value().cast<double>());
  }
  return offsets;
}

}  // namespace

SolidContact::SolidContact(const PartitionObject& a, const PartitionObject& b,
                           const Whitening& whitening, const WhitenedPair& pair)
    : unwhitening_(whitening.inverse()) {
  const std::vector<SurfacePart> parts_of_a = surfaceParts(a, pair.a);
  const std::vector<SurfacePart> parts_of_b = surfaceParts(b, pair.b);
  parts_of_a_ = boxesOf(parts_of_a);
  parts_of_b_ = boxesOf(parts_of_b);
  Eigen::Vector3d rounding = 4 * (pair.a.error + pair.b.error);
  // The boxes may contain motions, on either side.
  for (const WhitenedTree* tree : {&pair.a, &pair.b}) {
    if (!tree->node_motions.empty()) rounding += 2 * tree->node_motions[0];
  }
  addDirections(a, parts_of_a, b, pair.b, {1.0, whitening.mean(), rounding});
  addDirections(b, parts_of_b, a, pair.a, {-1.0, -whitening.mean(), rounding});
}

void SolidContact::addDirections(const PartitionObject& inner,
                                 const std::vector<SurfacePart>& parts,
                                 const PartitionObject& outer, const WhitenedTree& of_outer,
                                 const Motion& motion) {
  for (std::size_t j = 0; j < outer.parts.size(); ++j) {
    const PlacedPart& around = outer.parts[j];
    if (!around.solid) continue;
    Direction direction;
    direction.outer = around.solid;
    direction.sign = motion.sign;
    // Not the transpose: the matrix need not be a rotation to the last bit.
    const Eigen::Matrix3d unrotate = around.pose.linear().inverse();
    direction.shift = motion.sign * unrotate;
    const auto offsets = offsetsTo(inner, around.pose, motion.mean);
    for (const SurfacePart& part : parts) {
      const Eigen::Matrix3d& linear = inner.parts[part.part].pose.linear();
      const Eigen::Vector3d& offset = offsets[part.part];
      const double reach = offset.lpNorm<1>() + (linear.cwiseAbs() * part.point.cwiseAbs()).sum();
      direction.points.push_back(
          {unrotate * (offset + linear * part.point),
           kRoundings * kEpsilon * reach + 2 * inner.tree->parts[part.part].error});
    }
    direction.outer_box = of_outer.boxOf(outer.tree->parts[j].root);
    for (int k = 0; k < 3; ++k) {
      direction.outer_box.lo[k] -= motion.rounding[k];
      direction.outer_box.hi[k] += motion.rounding[k];
    }
    directions_.push_back(std::move(direction));
  }
}

// Calls `function(index)` for the parts of the inner object whose boxes fit into the outer solid's
// for some displacement of the cell, until it returns false.
template <typename Function>
bool SolidContact::visitFitting(const Direction& direction, const Cell& cell,
                                Function&& function) const {
  if (direction.sign > 0) {
    return parts_of_a_.visit(cell.lo, cell.hi, direction.outer_box, function);
  }
  return parts_of_b_.visit(-cell.hi, -cell.lo, direction.outer_box, function);
}

bool SolidContact::possible(const Cell& cell) const {
  const auto stop = [](int) { return false; };
  return std::any_of(directions_.begin(), directions_.end(), [&](const Direction& direction) {
    return !visitFitting(direction, cell, stop);
  });
}

Containment SolidContact::decide(const Direction& direction, const Eigen::Vector3d& y) const {
  const Eigen::Vector3d moved = unwhitening_ * y;
  const Eigen::Vector3d shift = direction.shift * moved;
  const double error = kRoundings * kEpsilon * (unwhitening_.cwiseAbs() * y.cwiseAbs()).sum();
  Containment result = Containment::outside;
  visitFitting(direction, {y, y, 3}, [&](int i) {
    const PartPoint& point = direction.points[i];
    const Containment containment =
        direction.outer->contains(point.position + shift, point.error + error);
    if (containment != Containment::outside) result = containment;
    return containment != Containment::inside;
  });
  return result;
}

Containment SolidContact::at(const Eigen::Vector3d& y) const {
  bool unknown = false;
  for (const Direction& direction : directions_) {
    const Containment containment = decide(direction, y);
    if (containment == Containment::inside) return containment;
    unknown = unknown || containment == Containment::unknown;
  }
  return unknown ? Containment::unknown : Containment::outside;
}

}  // namespace fcl_prob::detail
