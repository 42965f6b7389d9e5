// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Managers against all pairs by themselves.
#include "fcl_prob/broadphase.h"

#include <fcl/broadphase/broadphase_SSaP.h>
#include <fcl/broadphase/broadphase_SaP.h>
#include <fcl/broadphase/broadphase_bruteforce.h>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/broadphase/broadphase_interval_tree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/halfspace.h>

#include <map>
#include <memory>

#include "catch.h"
#include "fcl_prob/combined_bounds.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/fcl_prob.h"
#include "mesh_shapes.h"
#include "shapes.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

using Object = fcl::CollisionObjectd;
using Manager = fcl::BroadPhaseCollisionManagerd;

/// Objects in a cube, each with a displacement of its own.
struct World {
  std::vector<std::unique_ptr<Object>> objects;
  std::map<const Object*, GaussianDisplacement> displacements;

  World(int count, double reach, unsigned seed) {
    RandomBodies random(seed);
    const auto mesh = makeModel<fcl::OBBRSSd>(bumpyMesh(0.3, 4, 6, 1));
    const auto box = std::make_shared<fcl::Boxd>(0.3, 0.4, 0.5);
    const auto capsule = std::make_shared<fcl::Capsuled>(0.2, 0.4);
    const std::vector<std::shared_ptr<fcl::CollisionGeometryd>> geometries = {box, mesh, capsule};
    for (int i = 0; i < count; ++i) {
      fcl::Transform3d pose = random.pose(reach);
      if (i == 0) pose.translation().setZero();  // the first has neighbours
      objects.push_back(std::make_unique<Object>(
          geometries[static_cast<std::size_t>(random.integer(0, 2))], pose));
      displacements[objects.back().get()] =
          randomDisplacement(random, 0.01, 0.1).withMean(0.1 * random.direction());
    }
  }

  std::vector<Object*> pointers() const {
    std::vector<Object*> result;
    for (const auto& object : objects) result.push_back(object.get());
    return result;
  }

  BroadphaseRequest request() const {
    BroadphaseRequest request;
    request.query.relative_tolerance = 0.05;
    request.displacement = [this](const Object& object) { return displacements.at(&object); };
    return request;
  }

  ProbabilityResult pair(const Object& a, const Object& b) const {
    ProbabilityResult result;
    collisionProbability(
        &a, &b, GaussianDisplacement::fromIndependent(displacements.at(&a), displacements.at(&b)),
        request().query, result);
    return result;
  }
};

/// Without DynamicAABBTreeCollisionManager_Array, which leaks memory of its own in FCL 0.7.
std::vector<std::unique_ptr<Manager>> managers() {
  std::vector<std::unique_ptr<Manager>> all;
  all.push_back(std::make_unique<fcl::NaiveCollisionManagerd>());
  all.push_back(std::make_unique<fcl::SSaPCollisionManagerd>());
  all.push_back(std::make_unique<fcl::SaPCollisionManagerd>());
  all.push_back(std::make_unique<fcl::IntervalTreeCollisionManagerd>());
  all.push_back(std::make_unique<fcl::DynamicAABBTreeCollisionManagerd>());
  return all;
}

void fill(Manager& manager, const std::vector<Object*>& objects) {
  manager.registerObjects(objects);
  manager.setup();
}

}  // namespace

TEST_CASE("an object against FCL's managers: what is culled is within the remainder") {
  const World world(24, 3.4, 1);
  const auto objects = world.pointers();
  const Object& moving = *objects[0];
  std::map<const Object*, ProbabilityResult> by_itself;
  double sum = 0.0, largest = 0.0;
  for (const Object* other : objects) {
    if (other == &moving) continue;
    by_itself[other] = world.pair(moving, *other);
    sum += *by_itself[other].upper;
    largest = std::max(largest, *by_itself[other].lower);
  }
  CHECK(largest > 1e-3);
  for (const auto& manager : managers()) {
    fill(*manager, objects);
    BroadphaseResult result;
    const double p = collisionProbability(&moving, manager.get(), world.request(), result);
    CHECK(result.pairs.size() + result.pairs_culled == 23);
    CHECK(result.pairs_culled > 5);
    CHECK(result.pairs.size() > 2);
    auto left = by_itself;
    for (const PairProbability& pair : result.pairs) {
      REQUIRE(pair.a == &moving);
      REQUIRE(left.count(pair.b) == 1);
      CHECK(pair.result.lower == left[pair.b].lower);
      CHECK(pair.result.upper == left[pair.b].upper);
      left.erase(pair.b);
    }
    double of_culled = 0.0;
    for (const auto& [unused, culled] : left) of_culled += *culled.lower;
    CHECK(of_culled <= result.culled_upper);
    CHECK(result.culled_upper <= 40e-12);
    CHECK(result.any.lower == largest);
    CHECK(result.any.upper <= std::min(1.0, sum * (1 + 1e-12) + 40e-12));
    CHECK(result.any.upper >= largest);
    CHECK(p == result.any.middle());
  }
}

TEST_CASE("a coarse culling probability leaves out more, and says how much that may be", "[slow]") {
  const World world(16, 2.5, 2);
  const auto objects = world.pointers();
  fcl::DynamicAABBTreeCollisionManagerd manager;
  fill(manager, objects);
  BroadphaseRequest request = world.request();
  std::size_t culled = 0;
  for (const double share : {1e-12, 1e-3, 0.1}) {
    request.culling_probability = share;
    BroadphaseResult result;
    collisionProbability(&manager, request, result);
    CHECK(result.pairs.size() + result.pairs_culled == 16 * 15 / 2);
    CHECK(result.pairs_culled > culled);
    culled = result.pairs_culled;
    CHECK(result.culled_upper ==
          Approx(std::min(1.0, static_cast<double>(culled) * share)).epsilon(1e-9));
  }
}

TEST_CASE("managers against each other and within themselves visit every pair once") {
  const World world(16, 1.5, 3);
  const auto objects = world.pointers();
  const std::vector<Object*> first(objects.begin(), objects.begin() + 6);
  const std::vector<Object*> second(objects.begin() + 6, objects.end());
  const BroadphaseRequest request = world.request();
  for (const auto& manager : managers()) {
    fill(*manager, second);
    fcl::SaPCollisionManagerd robot;
    fill(robot, first);
    BroadphaseResult between, within;
    collisionProbability(&robot, manager.get(), request, between);
    collisionProbability(manager.get(), request, within);
    std::map<std::pair<const Object*, const Object*>, int> visits;
    for (const auto& pair : between.pairs) ++visits[{pair.a, pair.b}];
    for (const auto& pair : within.pairs) ++visits[std::minmax(pair.a, pair.b)];
    for (const auto& [unused, count] : visits) CHECK(count == 1);
    CHECK(between.pairs.size() + between.pairs_culled == 6 * 10);
    CHECK(within.pairs.size() + within.pairs_culled == 10 * 9 / 2);
    CHECK(between.pairs.size() > 10);
    CHECK(within.pairs.size() > 10);
  }
}

TEST_CASE("allowed contacts are left out, a certain one stops the rest") {
  const World world(20, 0.6, 4);
  const auto objects = world.pointers();
  fcl::DynamicAABBTreeCollisionManagerd manager;
  fill(manager, objects);
  BroadphaseRequest request = world.request();
  request.considers = [](const Object&, const Object&) { return false; };
  BroadphaseResult result;
  collisionProbability(&manager, request, result);
  CHECK(result.pairs.empty());
  CHECK(result.any.upper == result.culled_upper);
  request.considers = nullptr;
  request.stop_above = 0.5;
  collisionProbability(&manager, request, result);
  CHECK(result.stopped);
  CHECK(result.any.lower > 0.5);
  CHECK(result.any.upper == 1.0);
  CHECK(result.pairs.size() < 100);
}

TEST_CASE("a half-space in a manager is reached from everywhere") {
  const World world(5, 1.0, 5);
  Object floor(std::make_shared<fcl::Halfspaced>(Eigen::Vector3d(0.1, 0.2, 1).normalized(), -1.0));
  auto objects = world.pointers();
  objects.push_back(&floor);
  // FCL 0.7 builds its trees from infinite boxes by reading an unset iterator.
  fcl::NaiveCollisionManagerd manager;
  fill(manager, objects);
  BroadphaseRequest request = world.request();
  request.displacement = [&](const Object& object) {
    return &object == &floor ? GaussianDisplacement() : world.displacements.at(&object);
  };
  BroadphaseResult result;
  collisionProbability(&floor, &manager, request, result);
  CHECK(result.pairs.size() == 5);
}

TEST_CASE("the bare callback answers what the manager reports") {
  const World world(14, 1.0, 6);
  const auto objects = world.pointers();
  fcl::DynamicAABBTreeCollisionManagerd manager;
  fill(manager, objects);
  ProbabilityCallbackData data;
  data.request = world.request();
  manager.collide(&data, &collisionProbabilityCallback);
  CHECK(data.result.pairs.size() > 5);
  std::vector<Bounds> pairs;
  for (const auto& pair : data.result.pairs) {
    pairs.push_back({*pair.result.lower, *pair.result.upper});
  }
  CHECK(data.result.any.lower == anyOf(pairs).lower);
  CHECK(data.result.any.upper == Approx(anyOf(pairs).upper).epsilon(1e-12));
}

TEST_CASE("managers refuse what is out of range") {
  const World world(3, 1.0, 7);
  fcl::SaPCollisionManagerd manager;
  fill(manager, world.pointers());
  BroadphaseResult result;
  const Object* const nothing = nullptr;
  CHECK_THROWS_AS(collisionProbability(nothing, &manager, world.request(), result),
                  InvalidGeometry);
  const Manager* const no_manager = nullptr;
  CHECK_THROWS_AS(collisionProbability(no_manager, world.request(), result), InvalidRequest);
  for (const double wrong : {0.0, -1.0, 0.5, std::numeric_limits<double>::quiet_NaN()}) {
    BroadphaseRequest request = world.request();
    request.culling_probability = wrong;
    CHECK_THROWS_AS(collisionProbability(&manager, request, result), InvalidRequest);
  }
  fcl::SaPCollisionManagerd empty;
  collisionProbability(&empty, world.request(), result);
  CHECK(result.any.upper == 0.0);
}
