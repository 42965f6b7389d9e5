// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Gauss-Legendre rules with a proven bound on their error.
#pragma once

#include <boost/math/quadrature/gauss.hpp>
#include <cmath>

namespace fcl_prob::detail {

/// Calls visit(x, weight) for the `kPoints` nodes of the rule on [centre - half, centre + half].
template <unsigned kPoints, class Visit>
void forEachGaussNode(double centre, double half, Visit&& visit) {
  using Rule = boost::math::quadrature::gauss<double, kPoints>;
  const auto& abscissa = Rule::abscissa();
  const auto& weights = Rule::weights();
  for (std::size_t k = 0; k < abscissa.size(); ++k) {
    const double step = half * abscissa[k];
    const double weight = half * weights[k];
    visit(centre - step, weight);
    if (step != 0) visit(centre + step, weight);
  }
}

/// Semi-axes of the Bernstein ellipse with parameter `rho` > 1 about an interval of the given half
/// length: the foci are its ends.
struct BernsteinEllipse {
  BernsteinEllipse(double half, double rho)
      : real_axis(0.5 * half * (rho + 1 / rho)), imaginary_axis(0.5 * half * (rho - 1 / rho)) {}

  double real_axis;
  double imaginary_axis;
};

/// Bound on the error of an n-point rule on an interval of the given half length, for an integrand
/// that is analytic with |f| <= maximum in the Bernstein ellipse of `rho`: the Chebyshev
/// coefficients are at most 2 maximum rho^-k, the first 2n are integrated exactly, and each later
/// even one is off by at most 2 + 2/15 (Trefethen, Approximation Theory and Approximation Practice,
/// theorem 19.3).
inline double gaussErrorBound(unsigned points, double half, double rho, double maximum) {
  return half * (64.0 / 15) * maximum * std::pow(rho, -2.0 * points) / (1 - 1 / (rho * rho));
}

}  // namespace fcl_prob::detail
