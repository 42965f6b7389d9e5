// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene/whole_body.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace fcl_prob::detail {
namespace {

// A fan's arcs are those of its cones as long as whitening stretches it no more than this.
constexpr double kMostAnisotropic = 100.0;

bool isMesh(const PartitionObject& object) {
  return object.tree->isMesh() && !object.tree->isEmpty();
}

/// Whether it can be the body beside that mesh.
bool isBodyBeside(const PartitionObject& mesh, const PartitionObject& object, bool may_be_nearly) {
  const auto& parts = object.tree->parts;
  return isMesh(mesh) && std::all_of(parts.begin(), parts.end(), [may_be_nearly](const auto& part) {
           return part.fan || (part.nearly && may_be_nearly);
         });
}

}  // namespace

std::optional<WholeBody> wholeBodyOf(const PartitionObject& a, const PartitionObject& b,
                                     const GaussianDisplacement& displacement) {
  if (a.tree->isEmpty() || b.tree->isEmpty()) return std::nullopt;
  if (a.motion || b.motion || a.isSwept() || b.isSwept()) return std::nullopt;
  const Eigen::Vector3d& sigma = displacement.standardDeviations();
  if (displacement.rank() != 3 || sigma[0] > kMostAnisotropic * sigma[2]) return std::nullopt;
  const auto which = [&](bool may_be_nearly) {
    return std::pair(isBodyBeside(b, a, may_be_nearly), isBodyBeside(a, b, may_be_nearly));
  };
  auto [a_is_convex, b_is_convex] = which(false);
  if (!a_is_convex && !b_is_convex) std::tie(a_is_convex, b_is_convex) = which(true);
  if (!a_is_convex && !b_is_convex) return std::nullopt;
  const bool a_is_larger = a.tree->triangles.size() >= b.tree->triangles.size();
  if (a_is_convex && (!b_is_convex || a_is_larger)) return WholeBody{a, b, true};
  return WholeBody{b, a, false};
}

bool mayHoldPart(const WholeBody& whole, std::size_t member, const WhitenedFan& fan) {
  const PieceTree::Range& shapes = whole.body.tree->parts[member].bodies;
  const bool is_shape = shapes.begin < shapes.end;
  if (is_shape || whole.body.parts[member].solid) return false;
  const auto& parts = whole.mesh.tree->parts;
  return std::any_of(parts.begin(), parts.end(),
                     [&](const PieceTree::Part& part) { return !fan.isTooSmallFor(part.spans); });
}

}  // namespace fcl_prob::detail
