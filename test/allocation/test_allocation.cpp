// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Repeated queries keep no memory, and queries that run out of it leave no half of a result. The
// global operator new and what oneTBB's allocator asks for memory are replaced here, hence an
// executable of its own.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/cylinder.h>
#include <malloc.h>
#include <tbb/scalable_allocator.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "base/kept_memory.h"
#include "catch.h"
#include "fcl_prob/fcl_prob.h"
#include "mesh_shapes.h"
#include "shapes.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

std::atomic<long long> live_bytes{0};

/// Allocations until one fails; below 0 none does.
std::atomic<long long> until_failure{-1};

bool failsNow() { return until_failure >= 0 && until_failure-- == 0; }

void* allocateOrNull(std::size_t size) noexcept {
  if (failsNow()) return nullptr;
  void* const memory = std::malloc(size > 0 ? size : 1);
  if (memory != nullptr) live_bytes += static_cast<long long>(malloc_usable_size(memory));
  return memory;
}

void* allocate(std::size_t size) {
  void* const memory = allocateOrNull(size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

void release(void* memory) noexcept {
  if (memory == nullptr) return;
  live_bytes -= static_cast<long long>(malloc_usable_size(memory));
  std::free(memory);
}

}  // namespace

void* operator new(std::size_t size) { return allocate(size); }
void* operator new[](std::size_t size) { return allocate(size); }
void operator delete(void* memory) noexcept { release(memory); }
void operator delete[](void* memory) noexcept { release(memory); }
void operator delete(void* memory, std::size_t) noexcept { release(memory); }
void operator delete[](void* memory, std::size_t) noexcept { release(memory); }

void* scalable_malloc(std::size_t size) { return allocateOrNull(size); }
void scalable_free(void* memory) { release(memory); }

namespace {

struct Scenes {
  std::vector<fcl::Transform3d> poses;
  std::vector<GaussianDisplacement> displacements;
};

Scenes randomScenes(int count) {
  RandomBodies random(1);
  Scenes scenes;
  for (int i = 0; i < count; ++i) {
    scenes.poses.push_back(random.pose(1.2));
    scenes.displacements.push_back(randomDisplacement(random, 0.03, 0.1));
  }
  return scenes;
}

/// Live bytes after every scene was queried so many times; each scene is certain to be repeated.
long long liveAfter(const PreparedQuery& query, const Scenes& scenes, int queries) {
  ProbabilityRequest request;
  request.threshold = 0.05;
  for (int i = 0; i < queries; ++i) {
    const std::size_t scene = static_cast<std::size_t>(i) % scenes.poses.size();
    ProbabilityResult result;
    query.collisionProbability(scenes.poses[scene], fcl::Transform3d::Identity(),
                               scenes.displacements[scene], request, result);
  }
  return live_bytes;
}

void checkNoGrowth(const PreparedQuery& query, int queries) {
  const Scenes scenes = randomScenes(20);
  const long long at_first = liveAfter(query, scenes, 20);
  CHECK(liveAfter(query, scenes, queries) == at_first);
}

PreparedQuery boxes() {
  return {std::make_shared<fcl::Boxd>(0.4, 0.5, 0.6), std::make_shared<fcl::Boxd>(0.7, 0.3, 0.5)};
}

PreparedQuery boxAndCylinder() {
  return {std::make_shared<fcl::Boxd>(0.4, 0.5, 0.6), std::make_shared<fcl::Cylinderd>(0.3, 0.5)};
}

PreparedQuery meshAndTorus() {
  return {makeModel<fcl::OBBRSSd>(bumpyMesh(0.4, 4, 6, 1)),
          makeModel<fcl::OBBRSSd>(torusMesh(0.5, 0.2, 8, 5))};
}

}  // namespace

TEST_CASE("the count sees what is kept") {
  const long long before = live_bytes;
  const auto kept = std::make_unique<std::vector<double>>(1000);
  CHECK(live_bytes >= before + 8000);
  const std::vector<double, detail::KeptMemory<double>> large(1000);
  CHECK(live_bytes >= before + 16000);
}

TEST_CASE("repeated prepared queries keep no memory") {
  checkNoGrowth(boxes(), 1000);
  checkNoGrowth(boxAndCylinder(), 400);
  checkNoGrowth(meshAndTorus(), 300);
}

TEST_CASE("out of memory, a query throws, keeps no memory and leaves the result alone") {
  const auto a = makeModel<fcl::OBBRSSd>(bumpyMesh(0.4, 4, 6, 1));
  const auto b = makeModel<fcl::OBBRSSd>(torusMesh(0.5, 0.2, 8, 5));
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.translation() = Eigen::Vector3d(0.9, 0.1, 0.1);
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.1, 0.05, 0.08});
  for (const auto method : {ProbabilityMethod::interval, ProbabilityMethod::estimate,
                            ProbabilityMethod::general_pcd, ProbabilityMethod::monte_carlo}) {
    ProbabilityRequest request;
    request.method = method;
    request.samples = 100;
    request.max_cells = 500;
    request.gradient = true;
    ProbabilityResult result;
    result.estimate = 42.0;
    const auto ask = [&] {
      collisionProbability(a.get(), pose, b.get(), fcl::Transform3d::Identity(), displacement,
                           request, result);
    };
    CAPTURE(toString(method));
    // oneTBB waits for ever for an initialisation of its own that has run out of memory.
    ask();
    const ProbabilityResult untouched = [] {
      ProbabilityResult before;
      before.estimate = 42.0;
      return before;
    }();
    result = untouched;
    int failures = 0;
    bool complete = false;
    // Every allocation at first, then fewer and fewer of them.
    for (long long n = 0; !complete; n += 1 + n / 16) {
      const long long before = live_bytes;
      until_failure = n;
      try {
        ask();
        complete = until_failure >= 0;
        // std::stable_sort does without the memory that it does not get.
        if (!complete) result = untouched;
      } catch (const std::bad_alloc&) {
        ++failures;
      }
      until_failure = -1;
      if (complete) break;
      REQUIRE(result.estimate == 42.0);
      REQUIRE(!result.upper);
      REQUIRE(result.plan.empty());
      // Statics and thread-local scratch may stay.
      if (n > 1000) REQUIRE(live_bytes <= before + 4096);
    }
    CHECK(failures > 20);
    CHECK(result.estimate != 42.0);
  }
}

TEST_CASE("a million prepared queries keep no memory", "[long]") {
  checkNoGrowth(boxes(), 1'000'000);
  checkNoGrowth(meshAndTorus(), 100'000);
}
