// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// docs/conjunction.md, where P is known: errors that are the same in all directions, and no miss.
#include <fcl/geometry/shape/sphere.h>

#include <cmath>
#include <cstdio>

#include "fcl_prob/collision_probability.h"

namespace {

fcl_prob::ProbabilityResult encounter(double R, double deviation) {
  const Eigen::Vector3d r1(7e6, 0.0, 0.0), r2(7e6, 3e-9, 0.0);
  const Eigen::Vector3d v1(0.0, 7500.0, 100.0), v2(300.0, -7000.0, 2000.0);
  const Eigen::Matrix3d c1 = 0.36 * deviation * deviation * Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d c2 = 0.64 * deviation * deviation * Eigen::Matrix3d::Identity();
#include "conjunction_1.inc"
  return result;
}

}  // namespace

int main() {
  for (const double deviation : {3.0, 30.0, 300.0}) {
    const auto result = encounter(12.0, deviation);
    const double truth = -std::expm1(-72.0 / (deviation * deviation));
    std::printf("%.12g <= P <= %.12g, %.12g\n", *result.lower, *result.upper, truth);
    if (truth < *result.lower || truth > *result.upper || *result.upper > 1.000001 * *result.lower)
      return 1;
  }
  return 0;
}
