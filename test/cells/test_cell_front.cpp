// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// How far nodes reach, and how low what pairs of nodes consist of reaches in a cell, against all of
// their triangles.
#include <algorithm>
#include <cmath>
#include <set>

#include "catch.h"
#include "cells/cell_front.h"
#include "random_bodies.h"
#include "whitened_meshes.h"

namespace {

using namespace fcl_prob_test;
using namespace fcl_prob::detail;

std::vector<int> leavesUnder(const PieceTree& tree, int node) {
  std::vector<int> leaves;
  std::vector<int> open{node};
  while (!open.empty()) {
    const int index = open.back();
    open.pop_back();
    if (tree.nodes[index].isLeaf()) {
      leaves.push_back(index);
    } else {
      open.push_back(tree.nodes[index].left);
      open.push_back(tree.nodes[index].right);
    }
  }
  return leaves;
}

std::array<Eigen::Vector3d, 3> cornersOf(const WhitenedTree& mesh, int leaf) {
  const Eigen::Vector3i& t = mesh.tree->triangles[mesh.tree->nodes[leaf].piece];
  return {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
}

Eigen::Vector3d pointOf(const std::array<Eigen::Vector3d, 3>& corners, RandomBodies& random) {
  Eigen::Vector3d weights(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
  weights /= weights.sum();
  return weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2];
}

TEST_CASE("a node reaches as far as the farthest of its vertices", "[front]") {
  RandomBodies random(21);
  const WhitenedMeshes meshes(bumpyMesh(1.0, 12, 16, 3), boxMesh({1, 1, 1}));
  const PieceTree& tree = *meshes.tree_a;
  NodeSupport support(meshes.pair.a);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector3d m = random.direction();
    // In any order, so that what is known of one node serves for those above and below it.
    for (int j = 0; j < 40; ++j) {
      const int node = random.integer(0, static_cast<int>(tree.nodes.size()) - 1);
      double farthest = -std::numeric_limits<double>::infinity();
      for (int leaf : leavesUnder(tree, node)) {
        for (const Eigen::Vector3d& corner : cornersOf(meshes.pair.a, leaf)) {
          farthest = std::max(farthest, m.dot(corner));
        }
      }
      REQUIRE(support.along(m, node) == Approx(farthest).margin(1e-14));
    }
  }
}

// Stretching an axis, as whitening does, is what makes normals long, short and badly rounded.
TEST_CASE("the slabs of two faces contain the pair and exclude what is off it", "[front]") {
  RandomBodies random(23);
  int excluded = 0;
  for (int i = 0; i < 40; ++i) {
    Eigen::Vector3d stretch;
    for (int k = 0; k < 3; ++k) stretch[k] = random.logUniform(1e-2, i % 2 == 0 ? 1e2 : 1e100);
    const auto stretched = [&](TriangleMesh mesh) {
      for (Eigen::Vector3d& vertex : mesh.vertices) vertex = vertex.cwiseProduct(stretch);
      return mesh;
    };
    const WhitenedMeshes meshes(stretched(bumpyMesh(1.0, 6, 8, 7)), stretched(boxMesh({1, 2, 1})));
    ObstacleTable obstacles(meshes.pair);
    const std::vector<int> leaves_a = leavesUnder(*meshes.tree_a, 0);
    const std::vector<int> leaves_b = leavesUnder(*meshes.tree_b, 0);
    for (int j = 0; j < 500; ++j) {
      const NodePair leaves{leaves_a[random.integer(0, static_cast<int>(leaves_a.size()) - 1)],
                            leaves_b[random.integer(0, static_cast<int>(leaves_b.size()) - 1)]};
      const FaceSlabs slabs = obstacles.faceSlabs(leaves);
      const Eigen::Vector3d y = pointOf(cornersOf(meshes.pair.b, leaves.b), random) -
                                pointOf(cornersOf(meshes.pair.a, leaves.a), random);
      CHECK(!slabs.excludes(y));
      const Eigen::Vector3d off = y + stretch.cwiseProduct(0.5 * random.normalVector());
      excluded += slabs.excludes(off);
    }
  }
  CHECK(excluded > 5000);
}

// Whatever of a pair is not said to reach below the level keeps above what is said of it.
TEST_CASE("parts of a pair that may reach below a level are all told", "[front]") {
  RandomBodies random(22);
  const WhitenedMeshes meshes(bumpyMesh(1.0, 10, 14, 5), sphereMesh(0.7, 8, 10));
  const std::vector<int> leaves_a = leavesUnder(*meshes.tree_a, 0);
  const std::vector<int> leaves_b = leavesUnder(*meshes.tree_b, 0);
  fcl_prob::ProbabilityStatistics statistics;
  ObstacleTable obstacles(meshes.pair);
  CellFront front(meshes.pair, obstacles, statistics);
  int below_level = 0;
  int above_level = 0;
  const double all = static_cast<double>(leaves_a.size() * leaves_b.size());
  int short_lists = 0;
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d m = random.direction();
    const Eigen::Vector3d middle = random.uniform(1.2, 1.8) * random.direction();
    const Eigen::Vector3d half = Eigen::Vector3d::Constant(random.logUniform(0.05, 0.5));
    const Cell cell{middle - half, middle + half, 3};
    front.take(cell, {});
    const double level = m.dot(middle) + random.uniform(-1, 1) * half.norm();
    const double known = random.integer(0, 1) ? level - random.uniform(0, 1) : 1e300;
    LowestInCell::PartsBelow below;
    const int budget = random.integer(0, 1) ? 1000000 : random.integer(0, 50);
    front.lowest().findBelow({FrontPair::ofNodes({0, 0})}, {m, level}, known, budget, below);
    std::set<std::pair<int, int>> told;
    for (const FrontPair& pair : below.pairs) {
      for (int a : leavesUnder(*meshes.tree_a, pair.nodes.a)) {
        for (int b : leavesUnder(*meshes.tree_b, pair.nodes.b)) told.insert({a, b});
      }
    }
    const double share = static_cast<double>(told.size()) / all;
    short_lists += !below.pairs.empty() && share < 0.5;
    for (int j = 0; j < 3000; ++j) {
      const int a = leaves_a[random.integer(0, static_cast<int>(leaves_a.size()) - 1)];
      const int b = leaves_b[random.integer(0, static_cast<int>(leaves_b.size()) - 1)];
      const Eigen::Vector3d y = pointOf(cornersOf(meshes.pair.b, b), random) -
                                pointOf(cornersOf(meshes.pair.a, a), random);
      if ((y.array() < cell.lo.array()).any() || (y.array() > cell.hi.array()).any()) continue;
      CHECK(m.dot(y) >= std::min(below.lowest, below.lowest_of_others) - 1e-12);
      if (told.count({a, b})) continue;
      CHECK(m.dot(y) >= below.lowest_of_others - 1e-12);
      CHECK(m.dot(y) >= level - 1e-12);
      ++above_level;
    }
    below_level += !below.pairs.empty();
  }
  CHECK(below_level > 100);
  CHECK(above_level > 100);
  CHECK(short_lists > 20);
}

}  // namespace
