// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "mass/part_cubature.h"

#include <algorithm>
#include <cmath>

#include "mass/part_rules.h"

namespace fcl_prob::detail {
namespace {

constexpr int kMostPartDepth = 60;

/// Where the density is less than the smallest double.
constexpr double kFarthest = 39.0;

/// Roundings of a term besides those of y: of weights, of the volume element and of the sums.
constexpr double kTermRounding = 512.0 * kEpsilon;

/// Below the smallest normal double, for every term of a rule.
constexpr double kTermUnderflow = 1e-306;

}  // namespace

// A part whose volume element may have either sign is rounding of a part without volume: all of it
// counts as error.
template <class Part>
void PartCubature::addPart(const Part& part) {
  part_sum_ = {};
  const double most = std::abs(part.factor) + part.factor_error;
  if (most == 0.0) return;
  if (!std::isfinite(most)) {
    sum_.error = sum_.moment_error = kInfinity;
    return;
  }
  addBox(part, part.parameters(), 0);
  const double scale = kDensityScale * std::abs(part.factor);
  const double uncertain =
      kDensityScale * ((part.factor < 0.0 ? 2.0 * -part.factor : 0.0) + part.factor_error);
  sum_.mass += scale * part_sum_.mass;
  sum_.moment += scale * part_sum_.moment;
  sum_.error += kDensityScale * most * part_sum_.error + uncertain * part_sum_.mass;
  sum_.moment_error += kDensityScale * most * part_sum_.moment_error +
                       uncertain * kFarthest * (part_sum_.mass + part_sum_.error);
}

template <class Part>
void PartCubature::addBox(const Part& part, const ParameterBox& box, int depth) {
  ++cells_;
  const double target = limits_.tolerance / scaleOf(part);
  const typename Part::Cell cell(part, box, directionOf(nearPoint(part, box).point));
  const PartBound real = cell.bound(ComplexBox(box));
  const double all = volumeOf(box) * supremumOf(real) * kBoundSlack;
  const bool is_last = depth >= kMostPartDepth || cells_ >= limits_.most_cells;
  if (all <= target || is_last) {
    part_sum_.error += all;
    // Beyond kFarthest there is nothing.
    part_sum_.moment_error += kFarthest * all + kTermUnderflow * volumeOf(box) * real.weight;
    return;
  }
  const PartPlan plan = planBox(cell, box, target, guess_);
  if (!plan.exists()) {
    for (const ParameterBox& half : halves(box, plan)) addBox(part, half, depth + 1);
    return;
  }
  const DensitySums terms = evaluateBox(part, box, plan);
  const double reach = std::min(std::sqrt(terms.farthest_square), kFarthest);
  const double rounding =
      reach * part.position_error + 4.0 * kEpsilon * reach * reach + kTermRounding;
  const double rounded = terms.sum * rounding + kTermUnderflow * volumeOf(box) * real.weight;
  part_sum_.mass += terms.sum;
  part_sum_.moment += Eigen::Vector3d::Map(terms.moment);
  part_sum_.error += plan.error + rounded;
  part_sum_.moment_error +=
      plan.moment_error + kFarthest * rounded + part.position_error * terms.sum;
}

void PartCubature::add(const AnyPart& any) {
  std::visit([&](const auto& part) { addPart(part); }, any);
}

}  // namespace fcl_prob::detail
