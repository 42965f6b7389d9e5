// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Batches: the same as single queries, on any number of threads, cancelled or not.
#include "fcl_prob/batch.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>

#include <chrono>
#include <thread>

#include "catch.h"
#include "fcl_prob/exceptions.h"
#include "mesh_shapes.h"
#include "shapes.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

/// A mesh that passes a torus, partly through it.
std::vector<Waypoint> passage(int count, unsigned seed) {
  RandomBodies random(seed);
  std::vector<Waypoint> waypoints;
  for (int i = 0; i < count; ++i) {
    Waypoint waypoint;
    waypoint.pose_a.linear() = random.rotation();
    waypoint.pose_a.translation() =
        Eigen::Vector3d(3.0 * (i + 0.5) / count - 1.5, 0.4, 0.3) + 0.1 * random.normalVector();
    waypoint.displacement = randomDisplacement(random, 0.02, 0.1);
    waypoints.push_back(waypoint);
  }
  return waypoints;
}

PreparedQuery meshAndTorus() {
  return {makeModel<fcl::OBBRSSd>(bumpyMesh(0.3, 5, 7, 1)),
          makeModel<fcl::OBBRSSd>(torusMesh(0.5, 0.2, 12, 7))};
}

BatchRequest requestWith(unsigned threads) {
  BatchRequest request;
  request.query.threads = threads;
  request.query.relative_tolerance = 0.05;
  request.query.gradient = true;
  return request;
}

void requireSame(const ProbabilityResult& x, const ProbabilityResult& y) {
  REQUIRE(x.lower == y.lower);
  REQUIRE(x.upper == y.upper);
  REQUIRE(x.estimate == y.estimate);
  REQUIRE(x.status == y.status);
  REQUIRE(x.gradient == y.gradient);
  REQUIRE(x.statistics.cells == y.statistics.cells);
}

}  // namespace

TEST_CASE("a batch gives what single queries give, on one thread and on two") {
  const PreparedQuery query = meshAndTorus();
  const std::vector<Waypoint> waypoints = passage(36, 1);
  const BatchResult one = collisionProbabilities(query, waypoints, requestWith(1));
  const BatchResult two = collisionProbabilities(query, waypoints, requestWith(2));
  REQUIRE(one.done == waypoints.size());
  REQUIRE(two.done == waypoints.size());
  CHECK_FALSE(two.cancelled);
  int likely = 0, unlikely = 0;
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    ProbabilityResult single;
    query.collisionProbability(waypoints[i].pose_a, waypoints[i].pose_b,
                               std::get<GaussianDisplacement>(waypoints[i].displacement),
                               requestWith(1).query, single);
    requireSame(*one.waypoints[i], single);
    requireSame(*two.waypoints[i], single);
    likely += *single.lower > 0.5;
    unlikely += *single.upper < 0.01;
  }
  CHECK(likely > 3);
  CHECK(unlikely > 3);
}

TEST_CASE("the path bound is between the largest waypoint and the sum of them") {
  const PreparedQuery query(std::make_shared<fcl::Boxd>(0.2, 0.3, 0.4),
                            std::make_shared<fcl::Boxd>(0.5, 0.5, 0.5));
  std::vector<Waypoint> waypoints(3);
  for (int i = 0; i < 3; ++i) {
    waypoints[i].pose_a.translation() = Eigen::Vector3d(0.55 + 0.05 * i, 0.0, 0.0);
    waypoints[i].displacement = GaussianDisplacement::fromStandardDeviations({0.1, 0.1, 0.1});
  }
  const BatchResult result = collisionProbabilities(query, waypoints, requestWith(2));
  double sum = 0.0, largest = 0.0;
  for (const auto& waypoint : result.waypoints) {
    sum += *waypoint->upper;
    largest = std::max(largest, *waypoint->lower);
  }
  CHECK(sum < 0.9);
  CHECK(result.path.lower == largest);
  CHECK(result.path.upper == Approx(sum).epsilon(1e-12));
  CHECK(result.path.upper >= sum);
}

TEST_CASE("progress counts every waypoint once, and may cancel") {
  const PreparedQuery query = meshAndTorus();
  const std::vector<Waypoint> waypoints = passage(24, 2);
  for (const unsigned threads : {1u, 2u}) {
    BatchRequest request = requestWith(threads);
    std::size_t last = 0;
    request.on_progress = [&](const BatchProgress& progress) {
      CHECK(progress.done == last + 1);
      CHECK(progress.total == 24);
      last = progress.done;
      return true;
    };
    collisionProbabilities(query, waypoints, request);
    CHECK(last == 24);
    request.on_progress = [](const BatchProgress& progress) { return progress.done < 7; };
    const BatchResult stopped = collisionProbabilities(query, waypoints, request);
    CHECK(stopped.cancelled);
    CHECK(stopped.done >= 7);
    CHECK(stopped.done <= 6 + threads);
    CHECK(stopped.path.upper == 1.0);
  }
}

TEST_CASE("a batch cancelled at a random moment has only complete entries") {
  const PreparedQuery query = meshAndTorus();
  const std::vector<Waypoint> waypoints = passage(30, 3);
  const auto start = std::chrono::steady_clock::now();
  const BatchResult whole = collisionProbabilities(query, waypoints, requestWith(1));
  const std::chrono::duration<double> duration = std::chrono::steady_clock::now() - start;
  RandomBodies random(4);
  int partly = 0;
  for (int i = 0; i < 10; ++i) {
    CancellationToken token;
    BatchRequest request = requestWith(1 + i % 2);
    request.cancellation = &token;
    std::thread canceller([&token, wait = random.uniform(0.0, 0.6) * duration] {
      std::this_thread::sleep_for(wait);
      token.cancel();
    });
    const BatchResult result = collisionProbabilities(query, waypoints, request);
    canceller.join();
    std::size_t set = 0;
    for (std::size_t j = 0; j < waypoints.size(); ++j) {
      if (!result.waypoints[j]) continue;
      ++set;
      requireSame(*result.waypoints[j], *whole.waypoints[j]);
    }
    REQUIRE(set == result.done);
    REQUIRE(result.cancelled == (set < waypoints.size()));
    partly += set > 0 && set < waypoints.size();
  }
  CHECK(partly > 2);
}

TEST_CASE("a batch refuses what a query refuses, and names the waypoint") {
  const PreparedQuery query(std::make_shared<fcl::Boxd>(1, 1, 1),
                            std::make_shared<fcl::Capsuled>(1, 1));
  std::vector<Waypoint> waypoints(3);
  waypoints[2].pose_b.translation().x() = std::numeric_limits<double>::infinity();
  CHECK_THROWS_WITH(collisionProbabilities(query, waypoints, requestWith(2)),
                    Catch::Contains("waypoint 2"));
  CHECK_THROWS_AS(collisionProbabilities(query, waypoints, requestWith(1)), InvalidPose);
  CHECK_THROWS_AS(collisionProbabilities(query, {}, requestWith(0)), InvalidRequest);
  BatchRequest request = requestWith(1);
  request.query.on_progress = [](const ProbabilityProgress&) { return true; };
  CHECK_THROWS_AS(collisionProbabilities(query, {}, request), InvalidRequest);
  const BatchResult empty = collisionProbabilities(query, {}, requestWith(2));
  CHECK(empty.path.upper == 0.0);
  CHECK_FALSE(empty.cancelled);
}
