// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "bench/stability_truth.h"

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/special_functions/erf.hpp>

namespace fcl_prob::cli {
namespace {

// Beyond, a tail is below 1e-2000: less than anything it is compared with.
constexpr double kFarthest = 100;

// The density beyond is below 1e-20 of any mass above 1e-300.
constexpr double kFarthestColumn = 40;

// Φ(-h), h >= 0
Precise upperTail(const Precise& h) {
  if (h > kFarthest) return 0;
  return boost::math::erfc(h * boost::math::constants::one_div_root_two<Precise>()) / 2;
}

Precise density(const Precise& x) {
  if (abs(x) > kFarthest) return 0;
  return exp(-x * x / 2) * boost::math::constants::one_div_root_two_pi<Precise>();
}

}  // namespace

Precise preciseNormalMass(const Precise& x) { return x < 0 ? upperTail(-x) : 1 - upperTail(x); }

Precise preciseIntervalMass(const Precise& lo, const Precise& hi) {
  if (!(lo < hi)) return 0;
  if (lo + hi < 0) return preciseIntervalMass(-hi, -lo);
  return lo < 0 ? 1 - upperTail(-lo) - upperTail(hi) : upperTail(lo) - upperTail(hi);
}

Precise preciseBallMass(const Precise& distance, const Precise& radius) {
  if (distance == 0) {
    return preciseIntervalMass(-radius, radius) - 2 * radius * density(radius);
  }
  return preciseIntervalMass(distance - radius, distance + radius) -
         (density(distance - radius) - density(distance + radius)) / distance;
}

Precise AxisRange::mass(bool open) const {
  if (sigma > 0) return preciseIntervalMass(lo / sigma, hi / sigma);
  const bool touches = open ? lo < 0 && hi > 0 : lo <= 0 && hi >= 0;
  return touches ? 1 : 0;
}

Precise preciseBoxMass(const std::array<AxisRange, 3>& ranges, bool open) {
  Precise mass = 1;
  for (const AxisRange& range : ranges) mass *= range.mass(open);
  return mass;
}

Precise SlantedStrip::mass() const {
  const Precise from = std::max(Precise(x / sigma_x), Precise(-kFarthestColumn));
  const Precise to = std::min(Precise((x + width) / sigma_x), Precise(kFarthestColumn));
  if (!(from < to)) return 0;
  const auto column = [&](const Precise& at) {
    const Precise line = y + height * (1 - (at * sigma_x - x) / width);
    return density(at) * preciseIntervalMass(line / sigma_y, top / sigma_y);
  };
  const int panels = 1 + static_cast<int>(to - from);
  Precise sum = 0;
  for (int k = 0; k < panels; ++k) {
    sum += boost::math::quadrature::gauss<Precise, 30>::integrate(
        column, from + (to - from) * k / panels, from + (to - from) * (k + 1) / panels);
  }
  return sum;
}

std::array<Precise, 3> preciseCoordinates(const Eigen::Matrix3d& axes,
                                          const std::array<Precise, 3>& world) {
  using Vector = std::array<Precise, 3>;
  const auto cross = [](const Vector& p, const Vector& q) {
    return Vector{p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
  };
  const auto dot = [](const Vector& p, const Vector& q) {
    return Precise(p[0] * q[0] + p[1] * q[1] + p[2] * q[2]);
  };
  std::array<Vector, 3> column;
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector3d axis = axes.col(static_cast<Eigen::Index>(k));
    column[k] = {axis.x(), axis.y(), axis.z()};
  }
  Vector local;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector across = cross(column[(k + 1) % 3], column[(k + 2) % 3]);
    local[k] = dot(across, world) / dot(across, column[k]);
  }
  return local;
}

}  // namespace fcl_prob::cli
