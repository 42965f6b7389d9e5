// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Random numbers, poses and errors for benchmarks with random scenes, and quantiles of what comes
// out.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "fcl_prob/gaussian_displacement.h"
#include "fcl_prob/triangle_mesh.h"
#include "fcl_prob/whitening.h"

namespace fcl_prob::cli {

/// Rotation number `index` of a seed, uniform on SO(3).
Eigen::Matrix3d randomRotation(std::uint64_t seed, std::uint64_t index);

/// The mesh with its vertices rotated about the origin.
TriangleMesh rotated(TriangleMesh mesh, const Eigen::Matrix3d& rotation);

/// Deterministic numbers in (0, 1).
class Uniforms {
 public:
  explicit Uniforms(std::uint64_t seed) : seed_(seed) {}

  double next();
  double between(double lo, double hi) { return lo + (hi - lo) * next(); }
  double logBetween(double lo, double hi);
  std::size_t below(std::size_t count);
  Eigen::Matrix3d rotation();

 private:
  Whitening unit_{GaussianDisplacement::fromStandardDeviations({1.0, 1.0, 1.0})};
  std::uint64_t seed_;
  std::uint64_t index_ = 0;
};

/// Standard deviations between two lengths (metres), their logarithms uniform, along random axes.
GaussianDisplacement randomError(Uniforms& random, double least, double most);

/// The value below which lies a share of them.
double quantile(std::vector<double> values, double share);

}  // namespace fcl_prob::cli
