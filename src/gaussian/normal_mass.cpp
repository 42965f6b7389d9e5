// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/normal_mass.h"

#include <algorithm>
#include <cmath>

#include "gaussian/narrow_interval.h"
#include "gaussian/normal_density.h"

namespace fcl_prob {
namespace {

using detail::kInverseSqrtTwo;
using detail::normalDensity;

// 1/√2 - kInverseSqrtTwo
constexpr double kInverseSqrtTwoLow = -4.8336466567264567e-17;

// a * b - product, exactly (Dekker 1971); |a|, |b| < 1e100.
double productError(double a, double b, double product) {
  constexpr double kSplitter = 134217729.0;  // 2^27 + 1
  const double a_scaled = kSplitter * a;
  const double b_scaled = kSplitter * b;
  const double a_high = a_scaled - (a_scaled - a);
  const double b_high = b_scaled - (b_scaled - b);
  const double a_low = a - a_high;
  const double b_low = b - b_high;
  return ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low;
}

// Φ(-h) for h >= 0. The rounding of h/√2 would be amplified by h², so it is corrected for, with
// -d log erfc(x)/dx between x + sqrt(x² + 4/π) and x + sqrt(x² + 2) (Abramowitz and Stegun 7.1.13).
double upperTail(double h) {
  if (!(h < 40)) return std::isnan(h) ? h : 0.0;
  const double x = h * kInverseSqrtTwo;
  const double rounding = productError(h, kInverseSqrtTwo, x) + h * kInverseSqrtTwoLow;
  const double slope = x + std::sqrt(x * x + 4 / M_PI);
  return 0.5 * std::erfc(x) * (1 - rounding * slope);
}

}  // namespace

double normalTailMass(double h) {
  return h < 0 ? 0.5 * std::erfc(h * kInverseSqrtTwo) : upperTail(h);
}

double normalIntervalMass(double lo, double hi) {
  if (!(lo < hi)) return std::isnan(lo) || std::isnan(hi) ? lo + hi : 0.0;
  const double half_width = 0.5 * (hi - lo);
  const double sum = lo + hi;
  const double middle = 0.5 * sum;
  if (detail::isNarrow(middle, half_width)) {
    const double hi_part = sum - lo;
    const double rounding = (lo - (sum - hi_part)) + (hi - hi_part);
    return 2 * half_width * detail::narrowMean(middle, half_width, 0.5 * rounding);
  }
  const double near = middle < 0 ? -hi : lo;  // mirrored so that |near| <= far
  const double far = middle < 0 ? -lo : hi;
  if (far <= 1 || near < 0) {
    return 0.5 * (std::erf(far * kInverseSqrtTwo) - std::erf(near * kInverseSqrtTwo));
  }
  return upperTail(near) - upperTail(far);
}

double normalIntervalMoment(double lo, double hi) {
  if (!(lo < hi)) return std::isnan(lo) || std::isnan(hi) ? lo + hi : 0.0;
  const double near = std::min(std::abs(lo), std::abs(hi));
  if (!(near < 40)) return 0.0;
  const bool is_upper = std::abs(lo) <= std::abs(hi);
  const double exponent = 0.5 * (hi - lo) * std::abs(lo + hi);
  const double moment = -normalDensity(near) * std::expm1(-exponent);
  return is_upper ? moment : -moment;
}

double normalBoxMass(const Eigen::Vector3d& lo, const Eigen::Vector3d& hi) {
  return normalIntervalMass(lo.x(), hi.x()) * normalIntervalMass(lo.y(), hi.y()) *
         normalIntervalMass(lo.z(), hi.z());
}

}  // namespace fcl_prob
