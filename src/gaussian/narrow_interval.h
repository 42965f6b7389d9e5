// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Masses of intervals over which the density changes little, by Taylor series: no cancellation.
#pragma once

#include <array>
#include <cmath>

#include "gaussian/normal_density.h"

namespace fcl_prob::detail {

inline constexpr double kNarrowHalfWidth = 0.25;
inline constexpr double kNarrowSteepness = 0.35;
inline constexpr int kTaylorDegree = 8;

using TaylorTable = std::array<std::array<double, kTaylorDegree>, kTaylorDegree>;

/// Taylor coefficients of T(u, v) = ∫₀¹ cosh(√u s) exp(-v s²/2) ds:
/// u^i v^j / ((2i)! j! (-2)^j (2i+2j+1)).
constexpr TaylorTable taylorTable() {
  TaylorTable table{};
  double cosh_coefficient = 1;
  for (int i = 0; i < kTaylorDegree; ++i) {
    double exp_coefficient = 1;
    for (int j = 0; i + j < kTaylorDegree; ++j) {
      table[i][j] = cosh_coefficient * exp_coefficient / (2 * i + 2 * j + 1);
      exp_coefficient /= -2.0 * (j + 1);
    }
    cosh_coefficient /= (2.0 * i + 1) * (2.0 * i + 2);
  }
  return table;
}

inline constexpr TaylorTable kTaylor = taylorTable();

template <int kDegree>
double narrowSeries(double u, double v) {
  double sum = 0;
  for (int i = kDegree - 1; i >= 0; --i) {
    double inner = 0;
    for (int j = kDegree - 1 - i; j >= 0; --j) inner = inner * v + kTaylor[i][j];
    sum = sum * u + inner;
  }
  return sum;
}

/// Whether narrowMean() may be used.
inline bool isNarrow(double middle, double half_width) {
  return half_width <= kNarrowHalfWidth && std::abs(middle) * half_width <= kNarrowSteepness;
}

/// Mean of the normal density over [middle - half_width, middle + half_width], which isNarrow():
/// φ(middle) T(middle² half², half²). `middle_low` is what rounding took from the middle.
inline double narrowMean(double middle, double half_width, double middle_low = 0.0) {
  const double v = half_width * half_width;
  const double u = middle * middle * v;
  const double shape = u + v < 1e-4 ? narrowSeries<4>(u, v) : narrowSeries<kTaylorDegree>(u, v);
  return kInverseSqrtTwoPi * gaussianExp(middle, middle_low) * shape;
}

}  // namespace fcl_prob::detail
