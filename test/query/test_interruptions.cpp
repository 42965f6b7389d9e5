// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Queries that are stopped at any moment still answer rightly; exceptions of the caller's functions
// come through, and then nothing was written.
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>

#include <map>

#include "catch.h"
#include "fcl_prob/batch.h"
#include "fcl_prob/broadphase.h"
#include "fcl_prob/group.h"
#include "fcl_prob/mixture.h"
#include "mesh_shapes.h"
#include "poses.h"
#include "random_bodies.h"
#include "shapes.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

using MutableGeometry = std::shared_ptr<fcl::CollisionGeometryd>;

using Ask = std::function<void(const ProbabilityRequest&, ProbabilityResult&)>;
fcl::Transform3d tiltedAt(double x, double y, double z) {
  fcl::Transform3d pose = kIdentity;
  pose.linear() = Eigen::Quaterniond(0.8, 0.3, -0.2, 0.4).normalized().toRotationMatrix();
  pose.translation() = Eigen::Vector3d(x, y, z);
  return pose;
}

MutableGeometry bumpy() { return makeModel<fcl::OBBRSSd>(bumpyMesh(0.3, 5, 7, 1)); }
MutableGeometry torus() { return makeModel<fcl::OBBRSSd>(torusMesh(0.5, 0.2, 10, 6)); }

GaussianDisplacement displacement() {
  return GaussianDisplacement::fromStandardDeviations({0.1, 0.05, 0.08},
                                                      Eigen::Quaterniond(1, 0.2, 0.1, -0.3));
}

Ask ofPair(const MutableGeometry& a, const MutableGeometry& b, const fcl::Transform3d& pose_a,
           ProbabilityMethod method = ProbabilityMethod::interval) {
  const auto query = std::make_shared<PreparedQuery>(a, b);
  return [=](ProbabilityRequest request, ProbabilityResult& result) {
    request.method = method;
    query->collisionProbability(pose_a, kIdentity, displacement(), request, result);
  };
}

Ask ofGroup() {
  const auto query = std::make_shared<GroupQuery>(
      GroupQuery::Geometries{bumpy(), std::make_shared<fcl::Boxd>(0.2, 0.3, 0.4)},
      GroupQuery::Geometries{torus()});
  return [=](const ProbabilityRequest& request, ProbabilityResult& result) {
    query->collisionProbability({tiltedAt(0.9, 0.1, 0.1), tiltedAt(-0.8, 0.1, 0.0)}, {kIdentity},
                                displacement(), request, result);
  };
}

Ask ofMixture() {
  const auto query = std::make_shared<PreparedQuery>(bumpy(), torus());
  const GaussianMixture mixture(
      {{0.7, displacement()}, {0.3, displacement().withMean({-0.1, 0.1, 0.05})}});
  return [=](const ProbabilityRequest& request, ProbabilityResult& result) {
    collisionProbability(*query, tiltedAt(0.9, 0.1, 0.1), kIdentity, mixture, request, result);
  };
}

Ask ofTruncated() {
  const auto query = std::make_shared<PreparedQuery>(bumpy(), torus());
  const TruncatedGaussian truncated(displacement(), 2.0);
  return [=](const ProbabilityRequest& request, ProbabilityResult& result) {
    collisionProbability(*query, tiltedAt(0.9, 0.1, 0.1), kIdentity, truncated, request, result);
  };
}

/// Certified queries that take some time.
std::map<std::string, Ask> certifiedQueries() {
  const MutableGeometry a = bumpy(), b = torus();
  return {{"interval", ofPair(a, b, tiltedAt(0.9, 0.1, 0.1))},
          {"estimate", ofPair(a, b, tiltedAt(0.9, 0.1, 0.1), ProbabilityMethod::estimate)},
          {"shapes", ofPair(std::make_shared<fcl::Boxd>(0.3, 0.4, 0.5),
                            std::make_shared<fcl::Cylinderd>(0.3, 0.5), tiltedAt(0.6, 0.1, 0.1))},
          {"group", ofGroup()},
          {"mixture", ofMixture()},
          {"truncated", ofTruncated()}};
}

ProbabilityRequest requestWithin(double relative_tolerance) {
  ProbabilityRequest request;
  request.relative_tolerance = relative_tolerance;
  request.absolute_tolerance = 1e-12;
  return request;
}

constexpr double kFine = 3e-4;

struct Reference {
  Bounds bounds;
  int calls = 0;  ///< of on_progress
};

Reference referenceOf(const Ask& ask) {
  Reference reference;
  ProbabilityRequest request = requestWithin(kFine);
  request.on_progress = [&](const ProbabilityProgress&) { return ++reference.calls > 0; };
  ProbabilityResult result;
  ask(request, result);
  reference.bounds = {*result.lower, *result.upper};
  REQUIRE(reference.calls > 3);
  REQUIRE(reference.bounds.lower > 0.01);
  REQUIRE(reference.bounds.upper < 0.99);
  REQUIRE(reference.bounds.width() < 0.05);
  return reference;
}

void checkValid(const ProbabilityResult& result, const Reference& reference) {
  const Bounds bounds{result.lower.value(), result.upper.value()};
  CHECK(bounds.lower <= bounds.upper);
  CHECK(bounds.lower >= 0.0);
  CHECK(bounds.upper <= 1.0);
  CHECK(bounds.lower <= reference.bounds.upper);
  CHECK(bounds.upper >= reference.bounds.lower);
  if (result.estimate) CHECK(bounds.contains(*result.estimate));
}

struct Thrown {};

ProbabilityResult markedResult() {
  ProbabilityResult result;
  result.estimate = 42.0;
  return result;
}

/// on_progress that throws at its call of this number.
std::function<bool(const ProbabilityProgress&)> throwingAt(int number) {
  const auto calls = std::make_shared<int>(0);
  return [=](const ProbabilityProgress&) -> bool {
    if (++*calls == number) throw Thrown();
    return true;
  };
}

}  // namespace

TEST_CASE("a query cancelled at a random moment has a valid interval", "[query]") {
  RandomBodies random(1);
  for (const auto& [name, ask] : certifiedQueries()) {
    CAPTURE(name);
    const Reference reference = referenceOf(ask);
    for (int i = 0; i < 4; ++i) {
      const int last = random.integer(1, reference.calls);
      int calls = 0;
      ProbabilityRequest request = requestWithin(kFine);
      request.on_progress = [&](const ProbabilityProgress& progress) {
        CHECK(progress.interval.lower <= reference.bounds.upper);
        CHECK(progress.interval.upper >= reference.bounds.lower);
        return ++calls < last;
      };
      ProbabilityResult result;
      ask(request, result);
      CHECK(calls == last);
      CHECK(result.status == ProbabilityStatus::cancelled);
      checkValid(result, reference);
    }
  }
}

TEST_CASE("a query that meets a limit of cells, memory or time has a valid interval", "[query]") {
  RandomBodies random(2);
  for (const auto& [name, ask] : certifiedQueries()) {
    CAPTURE(name);
    const Reference reference = referenceOf(ask);
    int limited = 0;
    for (int i = 0; i < 12; ++i) {
      ProbabilityRequest request = requestWithin(kFine);
      if (i % 3 == 0) request.max_cells = static_cast<std::size_t>(random.logUniform(1, 1e4));
      if (i % 3 == 1) request.max_memory = static_cast<std::size_t>(random.logUniform(1, 1e6));
      if (i % 3 == 2) request.time_limit = random.logUniform(1e-9, 1e-2);
      ProbabilityResult result;
      ask(request, result);
      checkValid(result, reference);
      limited += result.status == ProbabilityStatus::cell_limit ||
                 result.status == ProbabilityStatus::memory_limit ||
                 result.status == ProbabilityStatus::time_limit;
    }
    CHECK(limited >= 4);
  }
}

TEST_CASE("an exception of on_progress comes through and leaves the result alone", "[query]") {
  RandomBodies random(3);
  for (const auto& [name, ask] : certifiedQueries()) {
    CAPTURE(name);
    const Reference reference = referenceOf(ask);
    for (int i = 0; i < 2; ++i) {
      ProbabilityRequest request = requestWithin(kFine);
      request.on_progress = throwingAt(random.integer(1, reference.calls));
      ProbabilityResult result = markedResult();
      CHECK_THROWS_AS(ask(request, result), Thrown);
      CHECK(result.estimate == 42.0);
      CHECK_FALSE(result.lower);
    }
  }
}

TEST_CASE("interrupted sampling has a valid confidence interval", "[query]") {
  const MutableGeometry a = bumpy(), b = torus();
  const Reference reference = referenceOf(ofPair(a, b, tiltedAt(0.9, 0.1, 0.1)));
  for (const auto method : {ProbabilityMethod::monte_carlo, ProbabilityMethod::rare_event}) {
    const Ask ask = ofPair(a, b, tiltedAt(0.9, 0.1, 0.1), method);
    ProbabilityRequest request = requestWithin(1e-4);
    request.samples = 8'000;
    request.confidence = 1.0 - 1e-9;
    for (const unsigned threads : {1u, 2u}) {
      request.threads = threads;
      for (const int last : {1, 2, 5}) {
        int calls = 0;
        request.on_progress = [&](const ProbabilityProgress&) { return ++calls < last; };
        ProbabilityResult result;
        ask(request, result);
        CHECK(result.status == ProbabilityStatus::cancelled);
        CHECK(result.confidence_interval.value().lower <= reference.bounds.upper);
        CHECK(result.confidence_interval.value().upper >= reference.bounds.lower);
        request.on_progress = throwingAt(last);
        result = markedResult();
        CHECK_THROWS_AS(ask(request, result), Thrown);
        CHECK(result.estimate == 42.0);
      }
    }
  }
}

TEST_CASE("methods that run in one piece obey the limits too", "[query]") {
  struct Case {
    Ask ask;
    bool two_sided;
  };
  // Enclosed between polytopes, coarse ones and fine ones.
  const MutableGeometry cone = std::make_shared<fcl::Coned>(0.4, 0.6);
  const MutableGeometry capsule = std::make_shared<fcl::Capsuled>(0.2, 0.5);
  std::vector<Case> cases;
  cases.push_back({ofPair(cone, capsule, tiltedAt(0.6, 0.1, 0.1), ProbabilityMethod::exact), true});
  for (const auto method : {ProbabilityMethod::general_pcd, ProbabilityMethod::general_pcd_min}) {
    cases.push_back({ofPair(bumpy(), torus(), tiltedAt(0.9, 0.1, 0.1), method), false});
  }
  for (const Case& tried : cases) {
    const Ask& ask = tried.ask;
    int calls = 0;
    ProbabilityRequest request = requestWithin(kFine);
    request.confidence = 0.9999;
    request.on_progress = [&](const ProbabilityProgress&) { return ++calls > 0; };
    ProbabilityResult whole;
    ask(request, whole);
    REQUIRE(calls > 3);
    const int calls_of_whole = calls;
    const auto check = [&](const ProbabilityResult& result, ProbabilityStatus status) {
      CAPTURE(toString(result.method));
      CHECK(result.status == status);
      CHECK(result.upper.value() >= whole.lower.value_or(0.0));
      CHECK(result.upper.value() <= 1.0);
      CHECK(result.lower.has_value() == tried.two_sided);
      CHECK(result.lower.value_or(0.0) <= whole.upper.value());
    };
    for (const int last : {1, 2, calls_of_whole / 2, calls_of_whole}) {
      calls = 0;
      request.on_progress = [&](const ProbabilityProgress& progress) {
        CHECK(progress.interval.upper >= whole.lower.value_or(0.0));
        return ++calls < last;
      };
      ProbabilityResult result;
      ask(request, result);
      CHECK(calls == last);
      check(result, ProbabilityStatus::cancelled);
      request.on_progress = throwingAt(last);
      result = markedResult();
      CHECK_THROWS_AS(ask(request, result), Thrown);
      CHECK(result.estimate == 42.0);
    }
    request.on_progress = nullptr;
    request.time_limit = 1e-9;
    ProbabilityResult result;
    ask(request, result);
    check(result, ProbabilityStatus::time_limit);
  }
}

TEST_CASE("who cancels an estimate that is out of cells is not asked again", "[query]") {
  const MutableGeometry cone = std::make_shared<fcl::Coned>(0.4, 0.6);
  const MutableGeometry capsule = std::make_shared<fcl::Capsuled>(0.2, 0.5);
  const Ask ask = ofPair(cone, capsule, tiltedAt(0.6, 0.1, 0.1), ProbabilityMethod::estimate);
  ProbabilityRequest request = requestWithin(0.01);
  request.max_cells = 2;
  int calls = 0;
  request.on_progress = [&](const ProbabilityProgress&) { return ++calls > 1; };
  ProbabilityResult result;
  ask(request, result);
  CHECK(calls == 1);
  CHECK(result.status == ProbabilityStatus::cancelled);
}

TEST_CASE("pilot samples of rare events obey the limits too", "[query]") {
  ProbabilityRequest request = requestWithin(1e-4);
  request.samples = 100'000'000;
  request.time_limit = 1e-9;
  ProbabilityResult result;
  ofPair(bumpy(), torus(), tiltedAt(0.9, 0.1, 0.1), ProbabilityMethod::rare_event)(request, result);
  CHECK(result.status == ProbabilityStatus::time_limit);
  CHECK(result.statistics.samples < 1000);
  CHECK(result.confidence_interval.value().upper > 0.0);
}

TEST_CASE("a batch passes an exception of on_progress on", "[query][threads]") {
  const PreparedQuery query(bumpy(), torus());
  std::vector<Waypoint> waypoints(12);
  for (int i = 0; i < 12; ++i) {
    waypoints[static_cast<std::size_t>(i)] = {tiltedAt(0.9 + 0.02 * i, 0, 0), kIdentity,
                                              displacement()};
  }
  BatchRequest request;
  request.query.relative_tolerance = 0.1;
  for (const unsigned threads : {1u, 2u}) {
    request.query.threads = threads;
    for (const std::size_t last : {1, 5, 12}) {
      request.on_progress = [&](const BatchProgress& progress) -> bool {
        if (progress.done == last) throw Thrown();
        return true;
      };
      CHECK_THROWS_AS(collisionProbabilities(query, waypoints, request), Thrown);
    }
  }
}

// Far out, where one round of samples is not enough and cells are divided again.
TEST_CASE("an estimate that is cancelled between rounds asks no more") {
  const fcl::Sphered ball(0.1875);
  const fcl::Capsuled rod(0.09375, 0.1875);
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.translation() = Eigen::Vector3d(-0.5, -0.375, 0.375);
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.0625, 0.1875, 0.0625});
  int cancelled = 0;
  for (int seed = 700; seed < 720; ++seed) {
    for (int most = 0; most < 6; ++most) {
      ProbabilityRequest request;
      request.method = ProbabilityMethod::estimate;
      request.relative_tolerance = 0.1;
      request.absolute_tolerance = 1e-12;
      request.max_cells = 100;
      request.seed = static_cast<std::uint64_t>(seed);
      int calls = 0;
      int calls_after = 0;
      request.on_progress = [&](const ProbabilityProgress&) {
        calls_after += calls > most;
        return ++calls <= most;
      };
      ProbabilityResult result;
      collisionProbability(&ball, pose, &rod, fcl::Transform3d::Identity(), displacement, request,
                           result);
      cancelled += result.status == ProbabilityStatus::cancelled;
      CAPTURE(seed, most, calls);
      CHECK(calls_after == 0);
    }
  }
  CHECK(cancelled > 20);
}

TEST_CASE("an interrupted query of a manager is valid, or leaves the result alone", "[query]") {
  fcl::DynamicAABBTreeCollisionManagerd manager;
  std::vector<std::unique_ptr<fcl::CollisionObjectd>> objects;
  for (const double x : {-0.9, 0.0, 0.95}) {
    objects.push_back(std::make_unique<fcl::CollisionObjectd>(bumpy(), tiltedAt(x, 0.1, 0.1)));
    manager.registerObject(objects.back().get());
  }
  manager.setup();
  const fcl::CollisionObjectd object(torus(), kIdentity);
  BroadphaseRequest request;
  request.query = requestWithin(5.0 * kFine);
  request.displacement = [&](const fcl::CollisionObjectd& moved) {
    return &moved == &object ? displacement() : GaussianDisplacement();
  };
  int calls = 0;
  request.query.on_progress = [&](const ProbabilityProgress&) { return ++calls > 0; };
  BroadphaseResult whole;
  collisionProbability(&object, &manager, request, whole);
  REQUIRE(whole.pairs.size() >= 2);
  REQUIRE(calls > 4);
  RandomBodies random(4);
  for (int i = 0; i < 6; ++i) {
    int left = random.integer(1, calls);
    request.query.on_progress = [&](const ProbabilityProgress&) { return --left > 0; };
    BroadphaseResult result;
    collisionProbability(&object, &manager, request, result);
    CHECK(result.any.lower <= whole.any.upper);
    CHECK(result.any.upper >= whole.any.lower);
    request.query.on_progress = throwingAt(random.integer(1, calls));
    result = whole;
    result.culled_upper = 42.0;
    CHECK_THROWS_AS(collisionProbability(&object, &manager, request, result), Thrown);
    CHECK(result.pairs.size() == whole.pairs.size());
    CHECK(result.culled_upper == 42.0);
  }
}
