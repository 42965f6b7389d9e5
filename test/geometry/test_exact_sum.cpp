// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "geometry/exact_sum.h"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>

#include "catch.h"
#include "random_bodies.h"

using namespace fcl_prob::detail;
using namespace fcl_prob_test;

namespace {

using Exact = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<2000>>;

}  // namespace

TEST_CASE("sums of numbers and products are exact however much cancels") {
  RandomBodies random(21);
  for (int i = 0; i < 3000; ++i) {
    ExactSum sum;
    Exact truth = 0;
    std::vector<double> terms;
    for (int j = random.integer(1, 10); j > 0; --j) {
      const double x = random.normal() * std::ldexp(1.0, random.integer(-60, 60));
      const double y = random.normal() * std::ldexp(1.0, random.integer(-60, 60));
      sum.add(x);
      sum.addProduct(x, y);
      truth += Exact(x) + Exact(x) * Exact(y);
      terms.push_back(x);
    }
    // All but the products, in another order: what is left is far smaller.
    for (const double x : terms) {
      sum.add(-x);
      truth -= Exact(x);
    }
    const Exact error = abs(Exact(sum.value()) - truth);
    REQUIRE(error <= abs(truth) * std::ldexp(1.0, -62));
  }
}

TEST_CASE("differences of far positions are exact") {
  RandomBodies random(22);
  for (int i = 0; i < 500; ++i) {
    fcl::Transform3d pose = random.pose(std::ldexp(1.0, 40));
    const Eigen::Vector3d point = std::ldexp(1.0, 40) * random.direction();
    ExactPosition difference;
    difference.add(pose, point);
    const Eigen::Vector3d near = pose * point;
    difference.add(near, -1.0);
    const LongVector value = difference.value();
    for (int k = 0; k < 3; ++k) {
      Exact truth = Exact(pose.translation()[k]) - Exact(near[k]);
      for (int j = 0; j < 3; ++j) truth += Exact(pose.linear()(k, j)) * Exact(point[j]);
      REQUIRE(abs(Exact(value[k]) - truth) <= abs(truth) * std::ldexp(1.0, -62));
    }
  }
}
