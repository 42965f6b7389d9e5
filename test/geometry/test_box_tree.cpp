// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "geometry/box_tree.h"

#include <algorithm>
#include <limits>

#include "catch.h"
#include "random_bodies.h"

using namespace fcl_prob::detail;
using namespace fcl_prob_test;

namespace {

BoxTree::Box randomBox(RandomBodies& random, double size) {
  const Eigen::Vector3d from = random.direction() * random.uniform(0.0, 1.0);
  BoxTree::Box box(from);
  box.extend(from + size * random.direction());
  return box;
}

// Some of them several times, some without an inside.
std::vector<BoxTree::Box> randomBoxes(RandomBodies& random, int count) {
  std::vector<BoxTree::Box> boxes;
  for (int i = 0; i < count; ++i) {
    const bool again = i > 0 && random.integer(0, 9) == 0;
    boxes.push_back(again ? boxes[random.integer(0, i - 1)]
                          : randomBox(random, random.integer(0, 4) == 0 ? 0.0 : 0.2));
  }
  return boxes;
}

// What a visit comes to, in ascending order; it is not stopped.
template <typename Visit>
std::vector<int> visited(const Visit& visit) {
  std::vector<int> met;
  REQUIRE(visit([&](int i) {
    met.push_back(i);
    return true;
  }));
  std::sort(met.begin(), met.end());
  return met;
}

std::vector<int> allThatMeet(const std::vector<BoxTree::Box>& boxes, const BoxTree::Box& other) {
  std::vector<int> met;
  for (int i = 0; i < static_cast<int>(boxes.size()); ++i) {
    if (boxes[i].intersects(other)) met.push_back(i);
  }
  return met;
}

}  // namespace

TEST_CASE("a tree of boxes visits each box that another one meets, once, and no other") {
  RandomBodies random(31);
  for (int count = 0; count < 200; ++count) {
    const std::vector<BoxTree::Box> boxes = randomBoxes(random, count);
    const BoxTree tree(boxes);
    const BoxTree::Box other = randomBox(random, 0.7);
    REQUIRE(visited([&](auto&& function) { return tree.visitBox(other, function); }) ==
            allThatMeet(boxes, other));
  }
}

TEST_CASE("a tree of boxes visits each box near a ray, once, and no other") {
  RandomBodies random(32);
  for (int count = 0; count < 200; ++count) {
    const std::vector<BoxTree::Box> boxes = randomBoxes(random, count);
    const BoxTree tree(boxes);
    const Eigen::Vector3d origin = 0.5 * random.direction();
    const double margin = random.uniform(0.0, 0.1);
    const auto ray = [&](int axis, bool upwards, double length) {
      BoxTree::Box box(origin.array() - margin, origin.array() + margin);
      (upwards ? box.max() : box.min())[axis] = upwards ? length : -length;
      return box;
    };
    for (int axis = 0; axis < 3; ++axis) {
      for (const bool upwards : {false, true}) {
        const BoxTree::Box endless = ray(axis, upwards, std::numeric_limits<double>::infinity());
        REQUIRE(visited([&](auto&& function) { return tree.visitBox(endless, function); }) ==
                allThatMeet(boxes, ray(axis, upwards, 1e9)));
      }
    }
  }
}

TEST_CASE("a visit of a tree of boxes stops where it is told to") {
  RandomBodies random(33);
  const std::vector<BoxTree::Box> boxes = randomBoxes(random, 100);
  const BoxTree tree(boxes);
  const BoxTree::Box everything(Eigen::Vector3d::Constant(-9), Eigen::Vector3d::Constant(9));
  for (int most = 1; most <= 100; ++most) {
    int visited = 0;
    CHECK_FALSE(tree.visitBox(everything, [&](int) { return ++visited < most; }));
    CHECK(visited == most);
  }
}
