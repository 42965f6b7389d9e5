// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "bounds/tail_mean.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fcl_prob/normal_mass.h"
#include "gaussian/normal_density.h"

namespace fcl_prob::detail {
namespace {

/// The series is used where (spread of l) · max(1, l) is below this.
constexpr double kCloseSpread = 0.2;

constexpr int kReciprocalCount = 16;
constexpr std::array<double, kReciprocalCount> reciprocals() {
  std::array<double, kReciprocalCount> table{};
  for (int k = 1; k < kReciprocalCount; ++k) table[k] = 1.0 / k;
  return table;
}
constexpr std::array<double, kReciprocalCount> kReciprocals = reciprocals();

bool close(double least, double largest) {
  return (largest - least) * std::max(1.0, 0.5 * (least + largest)) <= kCloseSpread;
}

/// G[a, b].
double meanSlope(const TailValue& a, const TailValue& b) {
  if (close(a.l, b.l)) return TailSeries(0.5 * (a.l + b.l)).meanSlope(a.l, b.l);
  return (b.antiderivative - a.antiderivative) / (b.l - a.l);
}

/// By T(l) = 2 - T(-l), so that the antiderivative stays small.
double meanOfNegative(const TailValue& a, const TailValue& b, const TailValue& c) {
  return 2.0 - tailMean(TailValue(-a.l), TailValue(-b.l), TailValue(-c.l));
}

}  // namespace

TailValue::TailValue(double value) : l(value) {
  tail = normalTailMass(l);
  density = normalDensity(l);
  antiderivative = (1.0 + l * l) * tail - l * density;
  if (l > 0.0) antiderivative = std::max(antiderivative, 0.0);
}

double tailMean(TailValue a, TailValue b, TailValue c) {
  if (a.l > b.l) std::swap(a, b);
  if (b.l > c.l) std::swap(b, c);
  if (a.l > b.l) std::swap(a, b);
  if (close(a.l, c.l)) return TailSeries(0.5 * (a.l + c.l)).mean(a.l, b.l, c.l);
  if (c.l < 0.0) return meanOfNegative(a, b, c);
  return 2.0 * (meanSlope(b, c) - meanSlope(a, b)) / (c.l - a.l);
}

double tailMeanError(double least_l) {
  const double l = std::max(least_l, 0.0);
  return 1e-13 * (2.0 + l * l) * (2.0 + l * l);
}

TailSeries::TailSeries(double centre) : centre_(centre) {
  const double density = normalDensity(centre);
  const double tail = normalTailMass(centre);
  value_ = 2.0 * tail;
  slope_of_antiderivative_ = -2.0 * (density - centre * tail);
  // T' = -2 φ and T^(k+1) = -l T^(k) - (k - 1) T^(k-1).
  coefficients_[0] = -2.0 * density;
  coefficients_[1] = -0.5 * centre * coefficients_[0];
  for (int k = 2; k < kTerms; ++k) {
    coefficients_[k] = -(centre * kReciprocals[k + 1] * coefficients_[k - 1] +
                         (k - 1) * kReciprocals[k] * kReciprocals[k + 1] * coefficients_[k - 2]);
  }
}

bool TailSeries::converges(double centre, double half_width) {
  return half_width * std::max(1.0, centre) <= 0.5 * kCloseSpread;
}

double TailSeries::meanDifference(double l1, double l2, double l3) const {
  // The mean of d^k over a triangle is 2/((k+1)(k+2)) times the complete homogeneous symmetric
  // polynomial of degree k of the corners' values.
  const double d1 = l1 - centre_;
  const double d2 = l2 - centre_;
  const double d3 = l3 - centre_;
  double of_one = 1.0;
  double of_two = 1.0;
  double of_three = 1.0;
  double sum = 0.0;
  for (int k = 1; k <= kTerms; ++k) {
    of_one *= d1;
    of_two = of_one + d2 * of_two;
    of_three = of_two + d3 * of_three;
    sum += coefficients_[k - 1] * of_three * (2.0 * kReciprocals[k + 1] * kReciprocals[k + 2]);
  }
  return sum;
}

double TailSeries::mean(double l1, double l2, double l3) const {
  return value_ + meanDifference(l1, l2, l3);
}

double TailSeries::meanSlope(double l1, double l2) const {
  const double d1 = l1 - centre_;
  const double d2 = l2 - centre_;
  double of_one = d1;
  double of_two = d1 + d2;
  double sum = slope_of_antiderivative_ + 0.5 * value_ * of_two;
  for (int k = 2; k <= kTerms + 1; ++k) {
    of_one *= d1;
    of_two = of_one + d2 * of_two;
    sum += coefficients_[k - 2] * of_two * (kReciprocals[k] * kReciprocals[k + 1]);
  }
  return sum;
}

}  // namespace fcl_prob::detail
