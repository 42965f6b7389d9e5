// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "bench/uniforms.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "cli/random_displacement.h"

namespace fcl_prob::cli {

Eigen::Matrix3d randomRotation(std::uint64_t seed, std::uint64_t index) {
  // Four normals have no preferred direction in the space of quaternions.
  const Eigen::Vector3d first = detail::standardNormalFrom(detail::randomWords({seed}, index, 0));
  const Eigen::Vector3d second = detail::standardNormalFrom(detail::randomWords({seed}, index, 1));
  return Eigen::Quaterniond(second.x(), first.x(), first.y(), first.z())
      .normalized()
      .toRotationMatrix();
}

TriangleMesh rotated(TriangleMesh mesh, const Eigen::Matrix3d& rotation) {
  for (fcl::Vector3d& vertex : mesh.vertices) vertex = rotation * vertex;
  return mesh;
}

double Uniforms::next() {
  const Eigen::Vector3d three = randomDisplacement(unit_, seed_, index_++);
  return 0.5 * std::erfc(three.x() / std::sqrt(2.0));
}

double Uniforms::logBetween(double lo, double hi) {
  return std::exp(between(std::log(lo), std::log(hi)));
}

std::size_t Uniforms::below(std::size_t count) {
  return std::min(count - 1, static_cast<std::size_t>(next() * static_cast<double>(count)));
}

Eigen::Matrix3d Uniforms::rotation() { return randomRotation(seed_, index_++); }

GaussianDisplacement randomError(Uniforms& random, double least, double most) {
  Eigen::Vector3d sigma;
  for (int k = 0; k < 3; ++k) sigma[k] = random.logBetween(least, most);
  return GaussianDisplacement::fromStandardDeviations(sigma, Eigen::Quaterniond(random.rotation()));
}

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(
      std::ceil(share * static_cast<double>(values.size() - 1)))];
}

}  // namespace fcl_prob::cli
