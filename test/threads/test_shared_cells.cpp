// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What the threads of one query share, on threads that ThreadSanitizer sees.
#include <algorithm>
#include <atomic>
#include <memory>
#include <thread>

#include "catch.h"
#include "cells/cell_carver.h"
#include "cells/cell_divider.h"
#include "cells/point_tester.h"
#include "random_bodies.h"
#include "whitened_meshes.h"

using namespace fcl_prob;
using namespace fcl_prob::detail;
using namespace fcl_prob_test;

namespace {

constexpr std::size_t kWorkers = 4;
constexpr int kDivided = 60;

/// What `work()` comes to on each of several threads at once.
template <typename Work>
std::vector<std::vector<double>> onThreads(const Work& work) {
  std::vector<std::vector<double>> results(kWorkers);
  std::vector<std::thread> threads;
  for (auto& result : results) threads.emplace_back([&result, &work] { result = work(); });
  for (std::thread& thread : threads) thread.join();
  return results;
}

// The largest cells first; then a few points of each that is left.
std::vector<double> divided(const PartitionScene& scene, ObstacleTable& obstacles) {
  ProbabilityStatistics statistics;
  CellDivider divider(scene, obstacles, statistics);
  std::vector<OpenCell> open;
  std::vector<double> numbers;
  const auto collect = [&](Division& division) {
    for (Examination& part : division.parts) {
      numbers.push_back(part.settled.mass.lower);
      if (part.open) open.push_back(std::move(*part.open));
    }
  };
  Division division;
  divider.examineRoot(division);
  collect(division);
  for (int i = 0; i < kDivided && !open.empty(); ++i) {
    const auto largest =
        std::max_element(open.begin(), open.end(),
                         [](const OpenCell& x, const OpenCell& y) { return x.gap() < y.gap(); });
    const OpenCell cell = std::move(*largest);
    open.erase(largest);
    division.clear();
    divider.divide(cell, 1000, division);
    collect(division);
  }
  PointTester tester(scene.pair, obstacles, scene.solids);
  for (const OpenCell& cell : open) {
    std::vector<TestedPoint> points;
    for (const double share : {0.2, 0.5, 0.7}) {
      points.push_back({cell.cell.lo + share * (cell.cell.hi - cell.cell.lo), false, false});
    }
    tester.test(cell.front, points);
    for (const TestedPoint& point : points) numbers.push_back(point.collides);
    numbers.push_back(cell.gap());
  }
  return numbers;
}

std::unique_ptr<CarvedCell> wholeSpace(const FatMembers& obstacles) {
  auto root = std::make_unique<CarvedCell>();
  root->box = Cell{Eigen::Vector3d::Constant(-kReach), Eigen::Vector3d::Constant(kReach), 3};
  root->mass = {0.0, 1.0};
  std::vector<FatNode> roots;
  for (int member = 0; member < obstacles.count(); ++member) roots.push_back({member, 0});
  root->nodes = std::make_shared<const std::vector<FatNode>>(std::move(roots));
  return root;
}

std::vector<double> carved(FatMembers& obstacles, std::atomic<std::size_t>& list_memory) {
  ProbabilityStatistics statistics;
  ProbabilityRequest request;
  CellCarver carver(obstacles, nullptr, request, list_memory, statistics);
  std::vector<std::unique_ptr<CarvedCell>> open;
  open.push_back(wholeSpace(obstacles));
  std::vector<double> numbers;
  for (std::size_t i = 0; i < 5 * kDivided && !open.empty(); ++i) {
    const auto largest = std::max_element(
        open.begin(), open.end(), [](const auto& x, const auto& y) { return x->gap() < y->gap(); });
    const std::unique_ptr<CarvedCell> cell = std::move(*largest);
    open.erase(largest);
    Carving carving;
    carver.divide(std::move(*cell), 0.0, carving);
    numbers.push_back(carving.settled.lower);
    numbers.push_back(carving.settled.upper);
    for (auto& part : carving.cells) open.push_back(std::move(part));
  }
  for (const auto& cell : open) numbers.push_back(cell->gap());
  return numbers;
}

}  // namespace

TEST_CASE("threads divide cells over one table of obstacles", "[threads]") {
  const WhitenedMeshes meshes(bumpyMesh(1.0, 8, 10, 1), torusMesh(2.0, 0.7, 14, 8));
  const PartitionScene scene{meshes.pair, 3, nullptr, nullptr, false, false, 0.01};
  ObstacleTable alone(meshes.pair), shared(meshes.pair);
  const std::vector<double> expected = divided(scene, alone);
  CHECK(expected.size() > 2 * kDivided);
  shared.share();
  for (const auto& numbers : onThreads([&] { return divided(scene, shared); })) {
    CHECK(numbers == expected);
  }
  CHECK(shared.pairCount() == alone.pairCount());
}

TEST_CASE("threads carve cells along the planes of one set of obstacles", "[threads]") {
  RandomBodies random(1);
  const WhitenedMeshes meshes(hullMesh(random.onSphere(40, 1.0)), torusMesh(2.0, 0.7, 14, 8));
  const PartitionObject body = meshes.objectOf(true);
  const PartitionObject other = meshes.objectOf(false);
  REQUIRE(meshes.tree_a->parts[0].fan);
  const Eigen::Matrix3d matrix = meshes.whitening.matrix();
  FatMembers alone(meshes.pair, body, other, true, matrix);
  FatMembers shared(meshes.pair, body, other, true, matrix);
  std::atomic<std::size_t> list_memory{0};
  const std::vector<double> expected = carved(alone, list_memory);
  CHECK(expected.size() > 10 * kDivided);
  for (const auto& numbers : onThreads([&] { return carved(shared, list_memory); })) {
    CHECK(numbers == expected);
  }
  CHECK(shared.memory() == alone.memory());
  CHECK(shared.built() == alone.built());
  CHECK(list_memory == 0);
}
