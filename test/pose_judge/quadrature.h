// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Means over a few standard normals to ten digits, for truths of their own; no code of the library.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace fcl_prob_judge {

/// f(z) in [0, 1] of `dimension` (0 to 3) standard normals; the others are 0.
struct Integrand {
  std::function<double(const Eigen::Vector3d&)> value;
  int dimension = 0;

  /// How far z goes, in deviations, until f changes much: a Gaussian of that width has smoothed it
  /// if it is smooth; else it is only where panels begin.
  double feature = 1.0;

  /// Analytic. What is not has kinks, or jumps where `inside` tells.
  bool smooth = true;

  /// If set: f is 0 where this is below 0, and analytic elsewhere.
  std::function<double(const Eigen::Vector3d&)> inside;
};

/// By the trapezoidal rule, whose error falls as exp(-2 π² (feature / step)²) for what is smooth:
/// the step is halved until nothing changes. \throws std::runtime_error if that does not end
double meanBySums(const Integrand& integrand, double relative_error = 1e-10);

/// By Gauss-Kronrod rules over panels that are halved where they differ, one dimension within the
/// other.
double meanByPanels(const Integrand& integrand, double relative_error = 1e-9);

/// By whichever suits: to nine digits or more.
double meanOf(const Integrand& integrand);

/// To a percent or so of P or of 1 - P, where it is smooth: enough to choose scenes by.
double roughMeanOf(const Integrand& integrand);

}  // namespace fcl_prob_judge
