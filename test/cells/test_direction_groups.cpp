// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cells/direction_groups.h"

#include <set>

#include "catch.h"
#include "random_bodies.h"

using fcl_prob::detail::groupByDirection;
using fcl_prob_test::RandomBodies;

TEST_CASE("vectors that point the same way are one group, however long", "[groups]") {
  CHECK(groupByDirection({}, 4).empty());
  CHECK(groupByDirection({{0, 0, 2}}, 4) == std::vector<int>{0});
  CHECK(groupByDirection({{0, 0, 2}, {0, 0, 1e-9}}, 4) == std::vector<int>{0, 0});
  const std::vector<int> two = groupByDirection({{1, 0, 0}, {0, 1, 0}, {5, 0.01, 0}}, 2);
  CHECK(two[0] == two[2]);
  CHECK(two[0] != two[1]);
  CHECK(groupByDirection({{1, 0, 0}, {0, 1, 0}, {5, 0.01, 0}}, 1) == std::vector<int>{0, 0, 0});
}

TEST_CASE("bundles that are far apart are told from each other", "[groups]") {
  RandomBodies random(11);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Eigen::Vector3d> vectors;
    std::vector<int> bundle;
    const Eigen::Vector3d axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, -1, -1}};
    for (int i = 0; i < 30; ++i) {
      bundle.push_back(i < 4 ? i : random.integer(0, 3));
      vectors.push_back(random.logUniform(1e-3, 1e3) *
                        (axes[bundle.back()].normalized() + 0.1 * random.direction()));
    }
    const std::vector<int> groups = groupByDirection(vectors, 4);
    for (std::size_t i = 0; i < groups.size(); ++i) {
      CHECK((groups[i] >= 0 && groups[i] < 4));
      for (std::size_t j = 0; j < i; ++j) {
        CHECK((groups[i] == groups[j]) == (bundle[i] == bundle[j]));
      }
    }
    const std::vector<int> two = groupByDirection(vectors, 2);
    CHECK(std::set<int>(two.begin(), two.end()).size() == 2);
  }
}
