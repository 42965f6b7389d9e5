// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "pose/cell_moments.h"

#include <algorithm>
#include <cmath>

#include "fcl_prob/normal_mass.h"
#include "gaussian/normal_density.h"

namespace fcl_prob::detail {
namespace {

// Below this length differences of densities cancel too much for moments beyond the mean, and far
// out, where no mass is left, they are not worth the trouble. In between they are wrong by less
// than 1e-9.
constexpr double kShort = 0.02;
constexpr double kFarOut = 10.0;
constexpr double kMomentError = 1e-8;

double meanOf(double lo, double hi) {
  const double length = hi - lo;
  const double middle = 0.5 * (lo + hi);
  // The next term of the series is below 1e-15 for the |middle| < 20 of cells that matter.
  if (length < 1e-3) return middle - middle * length * length / 12.0;
  const double mean = (normalDensity(lo) - normalDensity(hi)) / normalIntervalMass(lo, hi);
  return std::clamp(mean, lo, hi);
}

// With h half of the length and m the middle: the density is even about the middle but for a factor
// e^(-m t), by which what is odd of it is tanh(m t) times as large as what is even, so that
// |E t³| <= |m| h⁴ and |E t| <= |m| h². It differs from a uniform one by less than (1 + m²) h².
CellMoments momentsOfShort(double lo, double hi, double mean) {
  const double half = 0.5 * (hi - lo);
  const double m = std::fabs(0.5 * (lo + hi));
  const double reach = std::max(hi - mean, mean - lo);
  const double odd = m * half * half;
  CellMoments moments{mean, half * half / 3.0, 0.0, 0.0};
  moments.variance_error = half * half * std::min(1.0, 2.0 * (1.0 + m * m) * half * half);
  moments.third = std::min(4.0 * odd * half * half + 2.0 * odd * odd * odd, reach * reach * reach);
  return moments;
}

}  // namespace

CellMoments cellMoments(double lo, double hi) {
  const double m = meanOf(lo, hi);
  if (hi - lo < kShort || std::max(std::fabs(lo), std::fabs(hi)) > kFarOut) {
    return momentsOfShort(lo, hi, m);
  }
  const double mass = normalIntervalMass(lo, hi);
  const double at_lo = normalDensity(lo) / mass;
  const double at_hi = normalDensity(hi) / mass;
  const double second = 1.0 + lo * at_lo - hi * at_hi;
  const double third = (lo * lo + 2.0) * at_lo - (hi * hi + 2.0) * at_hi;
  const double central = std::fabs(third - 3.0 * m * second + 2.0 * m * m * m);
  return {m, std::clamp(second - m * m, 0.0, 1.0), kMomentError, central + kMomentError};
}

}  // namespace fcl_prob::detail
