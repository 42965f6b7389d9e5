// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Seeded random inputs for the tests of this room.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <random>

namespace fcl_prob_test {

inline double uniform(std::mt19937& random, double lo, double hi) {
  return std::uniform_real_distribution<double>(lo, hi)(random);
}

/// Uniform in the exponent.
inline double logUniform(std::mt19937& random, double lo, double hi) {
  return std::exp(uniform(random, std::log(lo), std::log(hi)));
}

inline Eigen::Vector3d randomVector(std::mt19937& random) {
  std::normal_distribution<double> normal;
  const double x = normal(random), y = normal(random), z = normal(random);
  return {x, y, z};
}

inline Eigen::Quaterniond randomQuaternion(std::mt19937& random) {
  std::normal_distribution<double> normal;
  const double w = normal(random), x = normal(random), y = normal(random), z = normal(random);
  return Eigen::Quaterniond(w, x, y, z).normalized();
}

inline Eigen::Matrix3d randomRotation(std::mt19937& random) {
  return randomQuaternion(random).toRotationMatrix();
}

}  // namespace fcl_prob_test
