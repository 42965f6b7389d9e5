// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "convex/perturbation.h"

#include <cmath>

namespace fcl_prob::detail {
namespace {

constexpr double kLength = 0.5 * kLargestPerturbation;

}  // namespace

Eigen::Vector3d perturbation(int index, int attempt) {
  if (attempt == 0) return Eigen::Vector3d::Zero();
  // A point of a low-discrepancy sequence (fractional parts of multiples of irrational numbers).
  const double k = 1.0 + index + 17.0 * attempt;
  const double height = 2.0 * std::fmod(k * 0.7548776662466927, 1.0) - 1.0;
  const double angle = 6.283185307179586 * std::fmod(k * 0.5698402909980532, 1.0);
  const double radius = std::sqrt(1.0 - height * height);
  const double length = 0.5 + 1.5 * std::fmod(k * 0.4142135623730950, 1.0);
  return kLength * length *
         Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), height);
}

}  // namespace fcl_prob::detail
