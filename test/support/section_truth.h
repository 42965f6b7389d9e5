// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Masses of bodies by nested quadrature over their sections; shares no code with the library.
#pragma once

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <functional>
#include <vector>

namespace fcl_prob_test {

inline double densityAt(double t) { return std::exp(-0.5 * t * t) / std::sqrt(2.0 * M_PI); }

/// Φ(hi) - Φ(lo)
inline double massBetween(double lo, double hi) {
  if (!(lo < hi)) return 0.0;
  if (lo + hi < 0.0) return massBetween(-hi, -lo);
  return 0.5 * (std::erfc(lo / std::sqrt(2.0)) - std::erfc(hi / std::sqrt(2.0)));
}

/// ∫ f over the pieces between sorted breaks, where f is smooth but may have roots at the ends: by
/// t = sin², which makes square roots smooth.
inline double integrateOver(std::vector<double> breaks, const std::function<double(double)>& f) {
  using Rule = boost::math::quadrature::gauss<double, 60>;
  std::sort(breaks.begin(), breaks.end());
  double sum = 0.0;
  for (std::size_t k = 1; k < breaks.size(); ++k) {
    const double from = breaks[k - 1], length = breaks[k] - from;
    if (!(length > 0.0)) continue;
    const int parts = std::max(1, static_cast<int>(std::ceil(length / 4.0)));
    for (int part = 0; part < parts; ++part) {
      // Angles from part to part, of all of the piece.
      const double begin = 0.5 * M_PI * part / parts, end = 0.5 * M_PI * (part + 1) / parts;
      sum += Rule::integrate(
          [&](double angle) {
            const double s = std::sin(angle), c = std::cos(angle);
            return 2.0 * length * s * c * f(from + length * s * s);
          },
          begin, end);
    }
  }
  return sum;
}

/// Mass under N(0, I) of a disc in a plane.
inline double discMassAt(double distance, double radius) {
  if (!(radius > 0.0)) return 0.0;
  return integrateOver({distance - radius, distance, distance + radius}, [&](double x) {
    const double half =
        std::sqrt(std::max(0.0, (radius - (x - distance)) * (radius + (x - distance))));
    return densityAt(x) * massBetween(-half, half);
  });
}

}  // namespace fcl_prob_test
