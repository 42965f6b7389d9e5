// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "bench/superquadric.h"

#include <cmath>
#include <vector>

#include "fcl_prob/convex_parts.h"

namespace fcl_prob::cli {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kLatitudes = 16;
constexpr int kLongitudes = 32;

/// Of a sine or cosine: what rounding leaves of 0 would be far from it once raised to 0.02.
double signedPower(double base, double exponent) {
  if (std::abs(base) < 1e-12) return 0.0;
  return std::copysign(std::pow(std::abs(base), exponent), base);
}

}  // namespace

std::shared_ptr<const fcl::Convexd> superquadricHull(const Eigen::Vector3d& semi_axes, double north,
                                                     double east) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i <= kLatitudes; ++i) {
    const double latitude = kPi * (static_cast<double>(i) / kLatitudes - 0.5);
    for (int k = 0; k < kLongitudes; ++k) {
      const double longitude = 2.0 * kPi * k / kLongitudes;
      const double ring = signedPower(std::cos(latitude), north);
      const Eigen::Vector3d point(ring * signedPower(std::cos(longitude), east),
                                  ring * signedPower(std::sin(longitude), east),
                                  signedPower(std::sin(latitude), north));
      points.emplace_back(semi_axes.cwiseProduct(point));
    }
  }
  return convexGeometry(convexHull(points));
}

}  // namespace fcl_prob::cli
