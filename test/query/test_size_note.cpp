// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Lengths that are far from each other are pointed out, and usual ones are not.
#include <algorithm>
#include <string>

#include "catch.h"
#include "fcl_prob/fcl_prob.h"
#include "mesh_shapes.h"

namespace {

using namespace fcl_prob_test;

/// Balls of these diameters that touch, and the same deviation along all axes.
bool asksForUnits(double of_a, double of_b, double deviation) {
  const auto a = makeModel<fcl::OBBRSSd>(sphereMesh(0.5 * of_a, 8, 12));
  const auto b = makeModel<fcl::OBBRSSd>(sphereMesh(0.5 * of_b, 8, 12));
  fcl::Transform3d beside = fcl::Transform3d::Identity();
  beside.translation().x() = 0.5 * (of_a + of_b);
  const fcl_prob::GaussianDisplacement error(Eigen::Vector3d::Zero(),
                                             deviation * deviation * Eigen::Matrix3d::Identity());
  fcl_prob::ProbabilityRequest request;
  request.max_cells = 50;  // the lengths are told however wide the interval is
  fcl_prob::ProbabilityResult result;
  fcl_prob::collisionProbability(a.get(), fcl::Transform3d::Identity(), b.get(), beside, error,
                                 request, result);
  return std::any_of(result.plan.begin(), result.plan.end(), [](const std::string& line) {
    return line.find("in metres?") != std::string::npos;
  });
}

}  // namespace

TEST_CASE("lengths that may be in other units are pointed out", "[query]") {
  for (const double unit : {1e-3, 1.0, 1e3}) {
    CAPTURE(unit);
    CHECK_FALSE(asksForUnits(unit, 0.2 * unit, 0.01 * unit));
    CHECK_FALSE(asksForUnits(unit, 0.01 * unit, 0.001 * unit));
    CHECK_FALSE(asksForUnits(0.1 * unit, 0.2 * unit, unit));
    CHECK(asksForUnits(unit, 2000 * unit, 10 * unit));
    CHECK(asksForUnits(unit, 0.0002 * unit, 0.01 * unit));
    CHECK(asksForUnits(unit, unit, 2000 * unit));
    CHECK(asksForUnits(unit, unit, 5e-5 * unit));
  }
}
