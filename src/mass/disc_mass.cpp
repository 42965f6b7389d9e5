// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "mass/disc_mass.h"

#include <algorithm>

#include "fcl_prob/normal_mass.h"
#include "gaussian/narrow_interval.h"
#include "gaussian/normal_density.h"

namespace fcl_prob::detail {
namespace {

constexpr double kDiscTarget = 2e-12;
constexpr int kDiscAttempts = 3;
constexpr double kUnderflowOfSum = 1e-300;

/// How much of ∫ φ dx over a chord there can be next to |exp(-x²/2)| at its near end, with the
/// angles of the rule's strip: its length, or 1 (half-line), both for the complex chord.
double chordFactor(const WhitenedDisc& disc, const DiscRule& rule) {
  const double sinh_square = rule.enlargement() * rule.enlargement() - 1.0;
  const double cos = std::sqrt(rule.largestCos() * rule.largestCos() + sinh_square);
  const double by_length = 2.0 * kInverseSqrtTwoPi * disc.x_radius * cos;
  const double by_line = rule.leastCos() > 0.0 ? 1.0 / rule.leastCos() : kInfinity;
  return disc.y_radius * kInverseSqrtTwoPi * cos * std::min(by_length, by_line) * (1.0 + 1e-9);
}

/// Of a mass whose logarithm is uncertain by `relative`, to first order.
double errorOf(double mass, double relative) {
  return relative < 1e-3 ? mass * relative * 1.001 + 1e-305 : kInfinity;
}

struct Attempt {
  double mass = 0.0;
  double rounding = 0.0;
  double remainder = kInfinity;
};

Attempt attempt(const WhitenedDisc& disc, double digits) {
  const DiscRule rule(disc, digits);
  Attempt result;
  if (!rule.exists()) return result;
  for (int k = 0; k < rule.count(); ++k) {
    const Chord chord = rule.chord(k);
    if (!(chord.cos > 1e3 * chord.cos_error && std::abs(chord.y) * chord.y_error < 1e-3)) {
      // Too uncertain for a bound of first order.
      result.rounding = kInfinity;
      break;
    }
    // Of a term: what its ends make of the mass of the chord (chordMass()), the share that cos is
    // wrong by, |y| times the error of y for the density, and an ε for each factor and each term of
    // the sum.
    const double share = chord.cos_error / chord.cos;
    const ChordMass inner = chordMass(disc.x_centre, chord.half, disc.x_error,
                                      chord.half * (share + disc.radius_error + 0.5 * kEpsilon));
    const double scale = normalDensity(chord.y) * chord.cos;
    result.mass += scale * inner.value;
    result.rounding +=
        scale * (inner.error + inner.value * (share + std::abs(chord.y) * chord.y_error +
                                              (12.0 + rule.count()) * kEpsilon));
  }
  const double weight = disc.y_radius * rule.step();
  result.mass *= weight;
  result.rounding =
      result.rounding * weight * 1.001 + result.mass * (disc.radius_error + 4.0 * kEpsilon);
  result.remainder = chordFactor(disc, rule) * rule.remainder() + rule.massBeyond();
  return result;
}

double startingDigits(const WhitenedDisc& disc) {
  const double thin = std::min(1.0, disc.x_radius) * std::min(1.0, disc.y_radius);
  const double all = std::min(1.0, disc.x_radius * disc.y_radius);
  return 31.0 + std::log(all / thin);
}

}  // namespace

ChordMass chordMass(double middle, double half, double middle_error, double half_error) {
  if (isNarrow(middle, half)) {
    const double mass = 2.0 * half * narrowMean(middle, half);
    // Of log mass: by the length at most 1.08 / half, by the middle no more than the largest |x|.
    const double relative = kIntervalMassRelativeError + 1.1 * half_error / half +
                            (std::abs(middle) + half) * (middle_error + half_error);
    return {mass, errorOf(mass, relative)};
  }
  const double mass = normalIntervalMass(middle - half, middle + half);
  // φ(near end)/mass <= (a + 1)/(1 - exp(-w(a + w/2))), as φ(a)/Φ(-a) <= a + 1; around 0, half of
  // the interval at least is on one side.
  const double near = std::abs(middle) - half;
  const double a = std::max(near, 0.0), width = near > 0.0 ? 2.0 * half : half;
  const double exponent = width * (a + 0.5 * width);
  const double end_error = middle_error + half_error + 0.5 * kEpsilon * (std::abs(middle) + half);
  const double relative = kIntervalMassRelativeError +
                          end_error * (a + 1.0) * ((near > 0.0 ? 1.0 : 2.0) + 2.0 / exponent);
  return {mass, errorOf(mass, relative)};
}

Bounds discMass(const WhitenedDisc& disc, double enough) {
  double digits = startingDigits(disc);
  Bounds best{0.0, 1.0};
  for (int k = 0; k < kDiscAttempts; ++k) {
    const Attempt one = attempt(disc, digits);
    const double error = one.rounding + one.remainder + kUnderflowOfSum;
    if (!(error < kInfinity)) break;
    best.lower = std::max(best.lower, one.mass - error);
    best.upper = std::min(best.upper, one.mass + error);
    const double sought = std::max(enough, kDiscTarget * one.mass);
    if (one.remainder <= std::max(sought, one.rounding * 0.1)) break;
    digits += std::clamp(std::log(one.remainder / std::max(sought, 1e-300)), 1.0, 60.0) + 1.0;
  }
  return best;
}

}  // namespace fcl_prob::detail
