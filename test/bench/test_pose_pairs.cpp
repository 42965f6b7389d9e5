// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <fcl/narrowphase/collision.h>

#include <cmath>
#include <string>

#include "bench/benchmark.h"
#include "bench/superquadric.h"
#include "catch.h"

using namespace fcl_prob;
using namespace fcl_prob::cli;

TEST_CASE("superquadrics between box, ellipsoid and octahedron", "[cli]") {
  const Eigen::Vector3d semi_axes(0.3, 0.5, 1.1);
  // Volumes in closed form (Barr 1981): of a box, of an ellipsoid, of an octahedron.
  const double unit = semi_axes.prod();
  const auto volume = [&](double exponent) {
    return superquadricHull(semi_axes, exponent, exponent)->computeVolume();
  };
  CHECK(volume(0.02) == Approx(8.0 * unit).epsilon(0.1));
  CHECK(volume(1.0) == Approx(4.0 / 3.0 * std::acos(-1.0) * unit).epsilon(0.05));
  CHECK(volume(2.0) == Approx(4.0 / 3.0 * unit).epsilon(1e-9));
  CHECK(volume(1.0) < 4.0 / 3.0 * std::acos(-1.0) * unit);
}

TEST_CASE("bounds of pose_pairs are not below what counting finds", "[cli][slow]") {
  BenchOptions options;
  options.cases = 2;
  options.quick = true;
  const BenchReport report =
      benchPosePairs(options, [](double, const std::string&) { return true; });
  REQUIRE(report.records.size() == 2 * 4 * 5);
  for (const auto& record : report.records) {
    const std::string method = record["method"];
    CAPTURE(record.dump());
    CHECK(record["scenes"] == 2);
    CHECK(std::isfinite(double(record["mean_difference"])));
    const bool turns = record["rotation_sigma"] > 0.0;
    if (method.rfind("interval", 0) == 0 || !turns) CHECK(record["violations"] == 0);
    if (method.rfind("estimate", 0) == 0) {
      CHECK(std::abs(double(record["mean_difference"])) <= 0.05);
    }
  }
  int asked = 0;
  const BenchReport stopped =
      benchPosePairs(options, [&](double, const std::string&) { return ++asked < 3; });
  CHECK(stopped.records.size() < report.records.size());
}
