// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <limits>
#include <vector>

#include "catch.h"
#include "cells/face_kernels.h"
#include "random_bodies.h"

using fcl_prob::detail::faceKernels;
using fcl_prob::detail::kFaceLanes;
using fcl_prob_test::RandomBodies;

TEST_CASE("faces above their limits are found in any number of them", "[faces]") {
  RandomBodies random(3);
  for (int i = 0; i < 2'000; ++i) {
    const int count = random.integer(1, 40);
    const double share = random.uniform(-0.5, 1.5);
    std::vector<double> values, limits;
    for (int f = 0; f < count; ++f) {
      limits.push_back(random.uniform(-1, 1));
      values.push_back(limits.back() + 0.25 + share - random.uniform(0, 1));
      if (f % 13 == 5) values.back() = limits.back() + 0.25;  // not above
      if (f % 17 == 7) values.back() = std::numeric_limits<double>::quiet_NaN();
    }
    std::vector<int> expected;
    for (int f = 0; f < count; ++f) {
      if (!(values[f] <= limits[f] + 0.25)) expected.push_back(f);
    }
    std::vector<int> found(static_cast<std::size_t>(count + kFaceLanes));
    found.resize(static_cast<std::size_t>(
        faceKernels().allAbove(values.data(), limits.data(), 0.25, count, found.data())));
    CHECK(found == expected);
    const int first = faceKernels().firstAbove(values.data(), limits.data(), 0.25, count);
    CHECK(first == (expected.empty() ? count : expected.front()));
  }
}
