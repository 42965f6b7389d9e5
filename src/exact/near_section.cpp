// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "exact/near_section.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"

namespace fcl_prob::detail {
namespace {

/// Of the step: the radius of a ball within the octahedron of the six places, which are where they
/// should be to a thousandth (1/√3 = 0.577).
constexpr double kWithinPlaces = 0.5;
constexpr double kOffPlace = 1e-3;

/// Of an exponential of a small number and of its product.
constexpr double kRounding = 16.0 * kEpsilon;

// A convex set that leaves out a point at a distance d (in deviations) of the mean is within a
// half-space that does, of a mass of Φ(d) <= 1/2 + 0.4 d.
Bounds massAround(const MassOf& mass_of, const ResolvedPart& resolved, double step) {
  const auto wide = GaussianDisplacement::fromStandardDeviations(Eigen::Vector3d::Constant(step),
                                                                 Eigen::Quaterniond::Identity(),
                                                                 resolved.displacement.mean());
  const bool is_within = mass_of(wide).lower > 0.5 + resolved.left_out / step;
  return {is_within ? 1.0 - kEpsilon : 0.0, 1.0};
}

}  // namespace

// With r the radius around the mean m within which the mass M is not below `around`, and u at a
// distance d of m: u lies between m and a point at r, and m between u and the point at r on the
// other side. So M(m) (around / M(m))^(d/r) <= M(u) <= M(m) (M(m) / around)^(d/r).
Bounds massNear(const MassOf& mass_of, const ResolvedPart& resolved, double step) {
  if (resolved.displacement.rank() == 0) return massAround(mass_of, resolved, step);
  const Eigen::Vector3d& mean = resolved.displacement.mean();
  const Bounds middle = mass_of(resolved.displacement);
  double around = middle.lower;
  for (int k = 0; k < 6 && around > 0.0; ++k) {
    const Eigen::Vector3d shift = (k % 2 == 0 ? step : -step) * Eigen::Vector3d::Unit(k / 2);
    const Eigen::Vector3d place = mean + shift;
    if (!((place - mean - shift).norm() <= kOffPlace * step)) return {0.0, 1.0};
    around = std::min(around, mass_of(resolved.displacement.withMean(place)).lower);
  }
  if (!(around > 0.0)) return {0.0, 1.0};
  const double share = resolved.left_out / (kWithinPlaces * step);
  const auto growth = [&](double mass) {
    return std::exp(share * std::log(mass / around) * (1.0 + kRounding)) * (1.0 + kRounding);
  };
  // Beyond the reach there is less than the least double.
  return {middle.lower / growth(middle.lower),
          std::min(1.0, middle.upper * growth(middle.upper) + kUnderflow)};
}

}  // namespace fcl_prob::detail
