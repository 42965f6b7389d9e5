// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// One query on several threads: the same to the last bit on any number of them.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/cylinder.h>

#include <atomic>
#include <thread>

#include "base/round_workers.h"
#include "catch.h"
#include "fcl_prob/group.h"
#include "partition_query.h"
#include "random_bodies.h"
#include "scene/obstacle_table.h"
#include "whitened_meshes.h"
#ifdef FCL_PROB_HAS_IO
#include "fcl_prob/mesh_io.h"
#endif

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

// Of the first cells, which are divided one by one.
constexpr std::size_t kAlone = 300;

GaussianDisplacement displacement() {
  return GaussianDisplacement::fromStandardDeviations({0.05, 0.02, 0.04});
}

fcl::Transform3d at(double x, double y, double z) {
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.translation() = Eigen::Vector3d(x, y, z);
  return pose;
}

void checkSame(const ProbabilityResult& one, const ProbabilityResult& other) {
  CHECK(one.lower == other.lower);
  CHECK(one.upper == other.upper);
  CHECK(one.estimate == other.estimate);
  CHECK(one.standard_error == other.standard_error);
  CHECK(one.gradient == other.gradient);
  CHECK(one.gradient_upper == other.gradient_upper);
  CHECK(one.gradient_standard_error == other.gradient_standard_error);
  CHECK(one.decision == other.decision);
  CHECK(one.status == other.status);
  CHECK(one.plan == other.plan);
  CHECK(one.statistics.cells == other.statistics.cells);
  CHECK(one.statistics.cells_open == other.statistics.cells_open);
  CHECK(one.statistics.pairs_tested == other.statistics.pairs_tested);
  CHECK(one.statistics.leaf_pairs == other.statistics.leaf_pairs);
  CHECK(one.statistics.peak_front == other.statistics.peak_front);
  CHECK(one.statistics.peak_memory == other.statistics.peak_memory);
  CHECK(one.statistics.samples == other.statistics.samples);
}

/// Asks `ask(request)` on several numbers of threads. \return the answer on one
template <typename Ask>
ProbabilityResult sameOnAnyThreads(const Ask& ask, ProbabilityRequest request) {
  request.threads = 1;
  const ProbabilityResult alone = ask(request);
  for (const unsigned threads : {2U, 3U, 8U}) {
    CAPTURE(threads);
    request.threads = threads;
    checkSame(ask(request), alone);
  }
  return alone;
}

ProbabilityResult sameOnAnyThreads(const PartitionQuery& query, const ProbabilityRequest& request) {
  return sameOnAnyThreads(
      [&](const ProbabilityRequest& one) { return query.run(displacement(), one); }, request);
}

// Neither is convex: box cells.
PartitionQuery boxCells() {
  PartitionQuery query(bumpyMesh(0.3, 16, 20, 1), torusMesh(0.5, 0.2, 28, 14));
  query.pose_a = at(0.85, 0.1, 0.1);
  return query;
}

// Polytope cells.
PartitionQuery polytopeCells() {
  RandomBodies random(5);
  PartitionQuery query(hullMesh(random.onSphere(150, 0.3)), bumpyMesh(0.5, 20, 28, 2));
  query.pose_a = at(0.82, 0.1, 0.1);
  return query;
}

ProbabilityRequest estimateRequest(double relative_tolerance) {
  ProbabilityRequest request = intervalRequest(relative_tolerance);
  request.method = ProbabilityMethod::estimate;
  return request;
}

}  // namespace

TEST_CASE("intervals, gradients and estimates do not depend on the threads", "[rounds]") {
  for (const bool convex : {false, true}) {
    CAPTURE(convex);
    PartitionQuery query = convex ? polytopeCells() : boxCells();
    const ProbabilityResult surfaces = sameOnAnyThreads(query, intervalRequest(0.002));
    CHECK(surfaces.status == ProbabilityStatus::converged);
    CHECK(surfaces.statistics.cells > kAlone);
    CHECK(*surfaces.upper - *surfaces.lower <= 0.002 * *surfaces.upper);
    CHECK(planMentions(surfaces, "own planes") == convex);
    sameOnAnyThreads(query, estimateRequest(0.001));
    ProbabilityRequest gradient = intervalRequest(0.01);
    gradient.gradient = true;
    sameOnAnyThreads(query, gradient);
    gradient.method = ProbabilityMethod::estimate;
    sameOnAnyThreads(query, gradient);
    query.makeSolid();
    CHECK(sameOnAnyThreads(query, intervalRequest(0.002)).statistics.cells > kAlone);
    sameOnAnyThreads(query, estimateRequest(0.002));
  }
}

// With the threshold close to P so that many cells are needed.
TEST_CASE("decisions do not depend on the threads", "[rounds]") {
  for (const bool convex : {false, true}) {
    const PartitionQuery query = convex ? polytopeCells() : boxCells();
    const ProbabilityResult known = query.run(displacement(), intervalRequest(0.0002));
    for (const double off : {-0.0006, 0.0006}) {
      ProbabilityRequest request = intervalRequest(0.0);
      request.absolute_tolerance = 1e-15;
      request.threshold = (1.0 + off) * *known.upper;
      const ProbabilityResult result = sameOnAnyThreads(query, request);
      CHECK(result.decision == (off > 0 ? Decision::below : Decision::above));
      CHECK(result.statistics.cells > kAlone);
    }
  }
}

TEST_CASE("limits repeat on any number of threads", "[rounds]") {
  for (const bool convex : {false, true}) {
    CAPTURE(convex);
    const PartitionQuery query = convex ? polytopeCells() : boxCells();
    const ProbabilityResult known = query.run(displacement(), intervalRequest(0.001));
    for (const std::size_t cells : {1, 2, 299, 301, 350, 777, 900}) {
      CAPTURE(cells);
      ProbabilityRequest request = intervalRequest(0.0001);
      request.max_cells = cells;
      const ProbabilityResult result = sameOnAnyThreads(query, request);
      CHECK(result.status == ProbabilityStatus::cell_limit);
      CHECK(result.statistics.cells <= cells);
      CHECK(result.statistics.cells + 1 >= cells);
      CHECK(*result.lower <= *known.upper);
      CHECK(*result.upper >= *known.lower);
    }
    ProbabilityRequest request = intervalRequest(0.0001);
    request.max_memory = known.statistics.peak_memory * 3 / 4;
    const ProbabilityResult result = sameOnAnyThreads(query, request);
    CHECK(result.status == ProbabilityStatus::memory_limit);
    request = estimateRequest(0.0001);
    request.max_cells = 700;
    sameOnAnyThreads(query, request);
  }
}

TEST_CASE("a query on several threads reports to its caller and can be cancelled", "[rounds]") {
  for (const bool convex : {false, true}) {
    CAPTURE(convex);
    const PartitionQuery query = convex ? polytopeCells() : boxCells();
    const ProbabilityResult known = query.run(displacement(), intervalRequest(0.001));
    const auto ask = [&](ProbabilityRequest request) {
      Bounds last{0.0, 1.0};
      int calls = 0;
      const int most_calls = convex ? 25 : 9;
      const auto caller = std::this_thread::get_id();
      bool from_caller = true;
      double fraction = 0.0;
      request.on_progress = [&](const ProbabilityProgress& progress) {
        from_caller = from_caller && std::this_thread::get_id() == caller;
        last = progress.interval;
        fraction = progress.fraction;
        return ++calls < most_calls;
      };
      const ProbabilityResult result = query.run(displacement(), request);
      CHECK(from_caller);
      CHECK(calls == most_calls);
      CHECK(fraction > 0.0);
      CHECK(result.status == ProbabilityStatus::cancelled);
      CHECK(*result.lower <= *known.upper);
      CHECK(*result.upper >= *known.lower);
      CHECK(last.width() >= 0.99 * (*result.upper - *result.lower));
      return result;
    };
    CHECK(sameOnAnyThreads(ask, intervalRequest(0.0001)).statistics.cells > kAlone);
  }
}

TEST_CASE("groups, and shapes known by support functions, do not depend on the threads",
          "[rounds]") {
  const auto ring = makeModel<fcl::OBBRSSd>(torusMesh(0.5, 0.2, 16, 8));
  const GroupQuery group(
      {makeModel<fcl::OBBRSSd>(bumpyMesh(0.3, 8, 10, 1)),
       std::make_shared<fcl::Boxd>(0.2, 0.3, 0.4), std::make_shared<fcl::Cylinderd>(0.15, 0.4)},
      {ring});
  const auto ask = [&](const ProbabilityRequest& request) {
    ProbabilityResult result;
    group.collisionProbability({at(0.9, 0.1, 0.2), at(-0.9, 0, 0.1), at(0.1, 0.95, 0)},
                               {at(0, 0, 0)}, displacement(), request, result);
    return result;
  };
  CHECK(sameOnAnyThreads(ask, intervalRequest(0.005)).statistics.cells > kAlone);
  sameOnAnyThreads(ask, estimateRequest(0.002));
}

#ifdef FCL_PROB_HAS_IO
TEST_CASE("meshes from files do not depend on the threads", "[rounds]") {
  const std::string data = std::string(FCL_PROB_SOURCE_DIR) + "/data/";
  const auto size = [](const TriangleMesh& mesh) {
    double largest = 0.0;
    for (const Eigen::Vector3d& v : mesh.vertices) largest = std::max(largest, v.norm());
    return largest;
  };
  const TriangleMesh knot = normalized(loadMesh(data + "torus_knot.ply"));
  for (const char* const file : {"bracket.stl", "gripper_finger.off"}) {
    CAPTURE(file);
    const TriangleMesh part = normalized(loadMesh(data + file));
    PartitionQuery query(part, knot);
    query.pose_a = at(0.6 * (size(part) + size(knot)), 0.1, 0.05);
    sameOnAnyThreads(query, intervalRequest(0.005));
  }
}
#endif

TEST_CASE("a round does every piece of work once", "[rounds]") {
  for (const unsigned threads : {1U, 2U, 5U}) {
    detail::RoundWorkers<std::vector<std::size_t>> workers(
        threads, std::make_unique<std::vector<std::size_t>>());
    const auto another = [] { return std::make_unique<std::vector<std::size_t>>(); };
    for (const std::size_t count : {0, 1, 2, 7, 1000}) {
      workers.visit([](std::vector<std::size_t>& done) { done.clear(); });
      workers.run(count, another, [](auto& worker, std::size_t i) { worker.push_back(i); });
      std::vector<int> times(count, 0);
      workers.visit([&](const std::vector<std::size_t>& done) {
        for (const std::size_t i : done) ++times[i];
      });
      CHECK(std::all_of(times.begin(), times.end(), [](int once) { return once == 1; }));
    }
    const auto fail = [](auto&, std::size_t i) {
      if (i == 5) throw std::runtime_error("of one piece");
    };
    CHECK_THROWS_AS(workers.run(9, another, fail), std::runtime_error);
  }
}

TEST_CASE("obstacles are the same whoever asks for them first", "[rounds]") {
  const WhitenedMeshes meshes(bumpyMesh(0.3, 5, 6, 1), torusMesh(0.5, 0.2, 6, 5));
  const auto leaves = [](const detail::PieceTree& tree) {
    std::vector<int> found;
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
      if (tree.nodes[i].isLeaf()) found.push_back(static_cast<int>(i));
    }
    return found;
  };
  const std::vector<int> of_a = leaves(*meshes.tree_a), of_b = leaves(*meshes.tree_b);
  const auto pairOf = [&](std::size_t i) {
    return detail::NodePair{of_a[i / of_b.size()], of_b[i % of_b.size()]};
  };
  const std::size_t pairs = of_a.size() * of_b.size();
  detail::ObstacleTable alone(meshes.pair), shared(meshes.pair);
  for (std::size_t i = 0; i < pairs; ++i) alone.find(pairOf(i));
  shared.share();
  std::vector<std::thread> threads;
  std::atomic<int> unlike{0};
  for (std::size_t t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      for (std::size_t i = 0; i < pairs; ++i) {
        const std::size_t pair = (i * (t % 2 == 0 ? 1 : pairs - 1) + t * pairs / 7) % pairs;
        const detail::SlabArrays slabs = shared.slabs(shared.find(pairOf(pair)));
        if (!(slabs.count == detail::kTriangleSlabs)) ++unlike;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  CHECK(unlike == 0);
  CHECK(shared.pairCount() == pairs);
  CHECK(shared.memory() == alone.memory());
  for (std::size_t i = 0; i < pairs; ++i) {
    const detail::SlabArrays one = alone.slabs(alone.find(pairOf(i)));
    const detail::SlabArrays other = shared.slabs(shared.find(pairOf(i)));
    const std::size_t numbers = static_cast<std::size_t>(one.count) * detail::kSlabFields;
    REQUIRE(std::equal(one.data, one.data + numbers, other.data));
  }
}
