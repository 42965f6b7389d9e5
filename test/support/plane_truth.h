// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Masses of convex sections by quadrature over lines, from a function that is negative within;
// shares no code with the library but what describes a displacement.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <utility>
#include <vector>

#include "fcl_prob/gaussian_displacement.h"
#include "section_truth.h"

namespace fcl_prob_test {

/// Of a displacement: convex and negative where there is contact.
using Distance = std::function<double(const Eigen::Vector3d&)>;

/// Where a convex function along a line is below 0: least first by thirds, then ends by halves.
inline std::pair<double, double> whereNegative(const std::function<double(double)>& f,
                                               double reach) {
  double lower = -reach, upper = reach;
  for (int k = 0; k < 200; ++k) {
    const double third = (upper - lower) / 3.0;
    (f(lower + third) < f(upper - third) ? upper : lower) =
        f(lower + third) < f(upper - third) ? upper - third : lower + third;
  }
  const double middle = 0.5 * (lower + upper);
  if (!(f(middle) < 0.0)) return {middle, middle};
  const auto endTowards = [&](double outside) {
    double inside = middle;
    for (int k = 0; k < 70; ++k) {
      const double between = 0.5 * (inside + outside);
      (f(between) < 0.0 ? inside : outside) = between;
    }
    return inside;
  };
  return {endTowards(-reach), endTowards(reach)};
}

/// Of { ε in the plane : distance(ε) < 0 } under deviations along the first two axes.
inline double massInPlane(const Distance& distance, const fcl_prob::GaussianDisplacement& error,
                          double reach) {
  const Eigen::Vector3d s = error.standardDeviations();
  const auto at = [&](double x, double y) {
    return distance(error.axes() * Eigen::Vector3d(x, y, 0.0) + error.mean());
  };
  // The extent along x: the least distance over y is convex in x.
  const auto leastOver = [&](double x) {
    double lower = -reach, upper = reach;
    for (int k = 0; k < 100; ++k) {
      const double third = (upper - lower) / 3.0;
      if (at(x, lower + third) < at(x, upper - third)) {
        upper -= third;
      } else {
        lower += third;
      }
    }
    return at(x, 0.5 * (lower + upper));
  };
  const auto [from, to] = whereNegative(leastOver, reach);
  if (!(to > from)) return 0.0;
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
  std::vector<double> angles;
  for (int k = 0; k <= 60; ++k) angles.push_back(M_PI * (k / 60.0 - 0.5));
  return integrateOver(angles, [&](double angle) {
    const double x = middle + half * std::sin(angle);
    const auto [low, high] = whereNegative([&](double y) { return at(x, y); }, reach);
    return half * std::cos(angle) * densityAt(x / s[0]) / s[0] *
           massBetween(low / s[1], high / s[1]);
  });
}

}  // namespace fcl_prob_test
