// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Mass of a ball under N(0, I): the noncentral chi-square distribution with three degrees of
// freedom.
#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "base/number_text.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/normal_mass.h"
#include "gaussian/gauss_legendre.h"
#include "gaussian/normal_density.h"

namespace fcl_prob {
namespace {

using detail::gaussianExp;
using detail::kInverseSqrtTwoPi;
using detail::normalDensity;

using detail::kEpsilon;
constexpr double kBallUnderflow = 1e-307;

// a + b and what rounding took from it (Knuth).
struct Sum {
  Sum(double a, double b) : value(a + b) {
    const double b_part = value - a;
    low = (a - (value - b_part)) + (b - b_part);
  }

  double density() const { return kInverseSqrtTwoPi * gaussianExp(value, low); }

  double value, low;
};

Bounds around(double mass, double error) {
  error += kBallUnderflow;
  return {std::clamp(mass - error, 0.0, 1.0), std::clamp(mass + error, 0.0, 1.0)};
}

// (1 - exp(-x)) / x
double meanDecay(double x) { return x > 0 ? -std::expm1(-x) / x : 1.0; }

// Φ(d + R) - Φ(d - R) - (φ(d - R) - φ(d + R)) / d
Bounds closedForm(double distance, double radius) {
  const Sum near(distance, -radius), far(distance, radius);
  const double interval = normalIntervalMass(near.value, far.value) - near.density() * near.low +
                          far.density() * far.low;
  const double decay = near.density() * 2 * radius * meanDecay(2 * distance * radius);
  // The two may cancel, so that the error counts before: 16 ε of an interval's mass, and for the
  // decay those of a density, whose argument is exact, of expm1 and of four products.
  return around(interval - decay, 20 * kEpsilon * (interval + decay));
}

// ∫ φ(d + t) (1 - exp(-(R² - t²)/2)) dt over discs: nothing cancels. In panels of about the length
// over which the density falls by e², from the nearest disc on until the rest does not matter.
Bounds discIntegral(double distance, double radius) {
  constexpr unsigned kPoints = 20;
  constexpr double kRange = 46;  // of the exponent
  const double steepness = std::max(1.0, distance);
  const double reach = std::min(2 * radius, kRange / steepness);
  const int panels = static_cast<int>(std::ceil(0.5 * steepness * reach));
  const double half = 0.5 * reach / panels;
  double mass = 0, error = 0;
  for (int k = 0; k < panels; ++k) {
    const double centre = (2 * k + 1) * half;  // measured from the nearest disc
    detail::forEachGaussNode<kPoints>(centre, half, [&](double depth, double weight) {
      const double disc = -std::expm1(-0.5 * depth * (2 * radius - depth));
      mass += weight * Sum(distance, depth - radius).density() * disc;
    });
    // Around the panel: |φ(d + z)| + exp(-R²/2) φ(d) |exp(-d z)|.
    const detail::BernsteinEllipse ellipse(half, 4 + 4 / (half * steepness));
    const double b = ellipse.imaginary_axis;
    const double from = centre - radius - ellipse.real_axis;
    const double maximum =
        normalDensity(std::max(0.0, distance + from)) * std::exp(0.5 * b * b) +
        kInverseSqrtTwoPi *
            std::exp(-0.5 * (distance * distance + radius * radius) - distance * from);
    error += detail::gaussErrorBound(kPoints, half, 4 + 4 / (half * steepness), maximum);
  }
  if (reach < 2 * radius) error += normalTailMass(distance - radius + reach);
  return around(mass, error + 24 * kEpsilon * mass);
}

void requireNotNegative(double value, const char* name) {
  if (!(value >= 0)) {
    throw InvalidGeometry(std::string(name) +
                          " of a ball is not >= 0: " + detail::numberText(value));
  }
}

}  // namespace

Bounds normalBallMass(double distance, double radius) {
  requireNotNegative(distance, "distance");
  requireNotNegative(radius, "radius");
  if (radius == 0) return {0, 0};
  if (std::isinf(distance)) return {0, std::isinf(radius) ? 1.0 : kBallUnderflow};
  if (std::isinf(radius)) return {1, 1};
  return radius < 1 ? discIntegral(distance, radius) : closedForm(distance, radius);
}

}  // namespace fcl_prob
