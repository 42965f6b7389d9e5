// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Every kind of manager in every state, against all pairs of its objects by themselves.
#include <fcl/broadphase/broadphase_SSaP.h>
#include <fcl/broadphase/broadphase_SaP.h>
#include <fcl/broadphase/broadphase_bruteforce.h>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree_array.h>
#include <fcl/broadphase/broadphase_interval_tree.h>
#include <fcl/broadphase/broadphase_spatialhash.h>
#include <fcl/geometry/octree/octree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/plane.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>

#include "catch.h"
#include "fcl_prob/fcl_prob.h"
#include "fcl_prob/normal_mass.h"
#include "mesh_shapes.h"
#include "shapes.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

using Object = fcl::CollisionObjectd;
using Manager = fcl::BroadPhaseCollisionManagerd;
using ObjectPair = std::pair<const Object*, const Object*>;

std::vector<std::unique_ptr<Manager>> allManagers() {
  std::vector<std::unique_ptr<Manager>> all;
  all.push_back(std::make_unique<fcl::NaiveCollisionManagerd>());
  all.push_back(std::make_unique<fcl::SSaPCollisionManagerd>());
  all.push_back(std::make_unique<fcl::SaPCollisionManagerd>());
  all.push_back(std::make_unique<fcl::IntervalTreeCollisionManagerd>());
  all.push_back(std::make_unique<fcl::SpatialHashingCollisionManagerd<>>(
      0.3, Eigen::Vector3d::Constant(-1.0), Eigen::Vector3d::Constant(1.0)));
  all.push_back(std::make_unique<fcl::DynamicAABBTreeCollisionManagerd>());
#ifndef __SANITIZE_ADDRESS__  // FCL 0.7 leaks memory of its own there
  all.push_back(std::make_unique<fcl::DynamicAABBTreeCollisionManager_Arrayd>());
#endif
  return all;
}

std::shared_ptr<fcl::CollisionGeometryd> voxels() {
  auto tree = std::make_shared<octomap::OcTree>(0.2);
  for (const float x : {0.1f, 0.3f, 0.5f}) tree->updateNode(octomap::point3d(x, 0.1f, 0.1f), true);
  return std::make_shared<fcl::OcTreed>(tree);
}

ObjectPair unordered(const Object* a, const Object* b) { return std::minmax(a, b); }

/// Objects of all kinds, each displaced on its own.
class World {
 public:
  World(RandomBodies& random, int count, bool unbounded) {
    const auto mesh = makeModel<fcl::OBBRSSd>(bumpyMesh(0.3, 4, 6, 1));
    std::vector<std::shared_ptr<fcl::CollisionGeometryd>> kinds = {
        std::make_shared<fcl::Boxd>(0.3, 0.4, 0.5), mesh, std::make_shared<fcl::Capsuled>(0.2, 0.4),
        voxels()};
    for (int i = 0; i < count; ++i) {
      auto geometry = kinds[static_cast<std::size_t>(random.integer(0, 3))];
      if (unbounded && i == 1) {
        geometry = std::make_shared<fcl::Halfspaced>(random.direction(), -random.uniform(0, 2));
      } else if (unbounded && i == 2) {
        geometry = std::make_shared<fcl::Planed>(Eigen::Vector3d::UnitZ(), -1.0);
      }
      objects.push_back(std::make_unique<Object>(geometry, random.pose(2.0)));
      displacements[objects.back().get()] =
          randomDisplacement(random, 0.01, 0.1).withMean(0.1 * random.direction());
    }
    request.query.relative_tolerance = 0.3;
    request.displacement = [this](const Object& object) { return displacements.at(&object); };
  }

  Bounds pair(const Object* a, const Object* b) {
    const auto [known, is_new] = known_.try_emplace(unordered(a, b));
    if (is_new) {
      ProbabilityResult result;
      collisionProbability(
          a, b, GaussianDisplacement::fromIndependent(displacements.at(a), displacements.at(b)),
          request.query, result);
      known->second = {*result.lower, *result.upper};
    }
    return known->second;
  }

  std::vector<std::unique_ptr<Object>> objects;
  std::map<const Object*, GaussianDisplacement> displacements;
  BroadphaseRequest request;

 private:
  std::map<ObjectPair, Bounds> known_;
};

/// Every one of `pairs` once: answered as by itself, or within what is said of the culled ones.
void checkAnswers(World& world, std::set<ObjectPair> pairs, const BroadphaseResult& result) {
  CHECK(result.pairs.size() + result.pairs_culled == pairs.size());
  CHECK(result.pairs_culled <= pairs.size());
  double largest = 0.0, of_culled = 0.0, most = 0.0;
  for (const ObjectPair& pair : pairs)
    largest = std::max(largest, world.pair(pair.first, pair.second).lower);
  for (const PairProbability& pair : result.pairs) {
    REQUIRE(pairs.erase(unordered(pair.a, pair.b)) == 1);
    most += *pair.result.upper;
  }
  for (const ObjectPair& culled : pairs) of_culled += world.pair(culled.first, culled.second).lower;
  CHECK(of_culled <= result.culled_upper);
  CHECK(result.any.lower <= result.any.upper);
  CHECK(result.any.upper >= largest);
  CHECK(result.any.upper >= std::min(1.0, most));
  CHECK(result.any.upper <= std::min(1.0, (most + result.culled_upper) * (1 + 1e-9)));
}

std::set<ObjectPair> allPairs(const std::vector<Object*>& a, const std::vector<Object*>& b) {
  std::set<ObjectPair> pairs;
  for (const Object* first : a) {
    for (const Object* second : b) {
      if (first != second) pairs.insert(unordered(first, second));
    }
  }
  return pairs;
}

/// What callers do to a manager, or leave out.
enum class State { set_up, not_set_up, stale, twice };

/// FCL's dynamic trees crash over an object that is registered twice.
bool bearsRepetition(const Manager& manager) {
  return dynamic_cast<const fcl::DynamicAABBTreeCollisionManagerd*>(&manager) == nullptr &&
         dynamic_cast<const fcl::DynamicAABBTreeCollisionManager_Arrayd*>(&manager) == nullptr;
}

/// Some managers of FCL cannot be set up, or moved in, with infinite boxes.
void fill(Manager& manager, const std::vector<Object*>& objects, State state, RandomBodies& random,
          bool unbounded) {
  for (Object* object : objects) manager.registerObject(object);
  if (state == State::twice && bearsRepetition(manager)) {
    for (std::size_t i = 0; i < objects.size(); i += 2) manager.registerObject(objects[i]);
  }
  if (state != State::not_set_up && !unbounded) manager.setup();
  if (state != State::stale) return;
  for (Object* object : objects) object->setTransform(random.pose(1.0));  // and no computeAABB()
}

}  // namespace

TEST_CASE("no kind of manager, in no state, makes a pair go missing", "[slow]") {
  int answered = 0, culled = 0;
  for (const State state : {State::set_up, State::not_set_up, State::stale, State::twice}) {
    for (const bool unbounded : {false, true}) {
      for (std::size_t kind = 0; kind < allManagers().size(); ++kind) {
        RandomBodies random(static_cast<unsigned>(100 + 10 * kind + (unbounded ? 1 : 0)));
        World world(random, 9, unbounded);
        std::vector<Object*> first, second;  // with three objects in both
        for (std::size_t i = 0; i < 9; ++i) {
          if (i < 6) first.push_back(world.objects[i].get());
          if (i >= 3) second.push_back(world.objects[i].get());
        }
        const auto manager_a = std::move(allManagers()[kind]);
        const auto manager_b = std::move(allManagers()[kind]);
        fill(*manager_a, first, state, random, unbounded);
        fill(*manager_b, second, state, random, unbounded);
        CAPTURE(static_cast<int>(state), unbounded, kind);
        BroadphaseResult result;
        collisionProbability(manager_a.get(), world.request, result);
        checkAnswers(world, allPairs(first, first), result);
        collisionProbability(manager_a.get(), manager_b.get(), world.request, result);
        checkAnswers(world, allPairs(first, second), result);
        for (Object* object : {first[1], second[5]}) {
          collisionProbability(object, manager_a.get(), world.request, result);
          checkAnswers(world, allPairs({object}, first), result);
          answered += static_cast<int>(result.pairs.size());
          culled += static_cast<int>(result.pairs_culled);
        }
      }
    }
  }
  CHECK(answered > 50);
  CHECK(culled > 50);
}

TEST_CASE("an object that FCL's dynamic trees are given twice in one list counts once") {
  RandomBodies random(7);
  World world(random, 4, false);
  const std::vector<Object*> once{world.objects[0].get(), world.objects[1].get(),
                                  world.objects[2].get(), world.objects[3].get()};
  fcl::DynamicAABBTreeCollisionManagerd tree;
  fcl::DynamicAABBTreeCollisionManager_Arrayd array;
  for (Manager* manager : {static_cast<Manager*>(&tree), static_cast<Manager*>(&array)}) {
    manager->registerObjects({once[0], once[1], once[0], once[2], once[3], once[1]});
    manager->setup();
    BroadphaseResult result;
    collisionProbability(manager, world.request, result);
    checkAnswers(world, allPairs(once, once), result);
  }
}

TEST_CASE("what is infinite is met in every manager") {
  const double truth = normalTailMass(2.0);
  for (const auto& manager : allManagers()) {
    Object floor(std::make_shared<fcl::Halfspaced>(Eigen::Vector3d::UnitZ(), 0.0));
    fcl::Transform3d pose = fcl::Transform3d::Identity();
    pose.translation().z() = 0.3;
    Object box(std::make_shared<fcl::Boxd>(0.2, 0.2, 0.2), pose);
    manager->registerObject(&floor);
    manager->registerObject(&box);
    BroadphaseRequest request;
    request.displacement = [&](const Object& object) {
      const Eigen::Vector3d sigma = Eigen::Vector3d::Constant(&object == &box ? 0.1 : 0.0);
      return GaussianDisplacement::fromStandardDeviations(sigma);
    };
    BroadphaseResult result;
    collisionProbability(manager.get(), request, result);
    CHECK(result.any.lower <= truth * (1 + 1e-9));
    CHECK(result.any.upper >= truth * (1 - 1e-9));
    collisionProbability(&box, manager.get(), request, result);
    CHECK(result.any.upper >= truth * (1 - 1e-9));
    collisionProbability(&floor, manager.get(), request, result);
    CHECK(result.any.upper >= truth * (1 - 1e-9));
  }
}

TEST_CASE("cancelling within a pair ends the whole call, and what was not looked at counts as 1") {
  RandomBodies random(7);
  World world(random, 8, false);
  std::vector<Object*> objects;
  fcl::NaiveCollisionManagerd manager;
  for (const auto& object : world.objects) {
    object->setTransform(random.pose(0.3));
    manager.registerObject(object.get());
  }
  world.request.query.method = ProbabilityMethod::interval;
  world.request.query.relative_tolerance = 0.01;
  double last_seconds = 0.0, last_fraction = 0.0;
  int calls = 0;
  world.request.query.on_progress = [&](const ProbabilityProgress& progress) {
    CHECK(progress.seconds >= last_seconds);
    CHECK(progress.fraction >= last_fraction - 1e-12);
    CHECK(progress.fraction <= 1.0);
    last_seconds = progress.seconds;
    last_fraction = std::floor(progress.fraction * 28.0) / 28.0;  // of pairs, one after another
    return ++calls < 40;
  };
  BroadphaseResult result;
  collisionProbability(&manager, world.request, result);
  CHECK(calls == 40);
  CHECK(result.interrupted == ProbabilityStatus::cancelled);
  CHECK(result.pairs.size() + result.pairs_culled < 28);
  CHECK(result.any.upper == 1.0);
  world.request.query.on_progress = nullptr;
  world.request.query.time_limit = 1e-9;
  collisionProbability(&manager, world.request, result);
  CHECK(result.interrupted == ProbabilityStatus::time_limit);
  CHECK(result.pairs.empty());
  CHECK(result.any.upper == 1.0);
}

TEST_CASE("pairs of managers share cells: one that uses up its share leaves the others theirs") {
  // One pair with a surface that takes thousands of cells, and five that take next to none.
  const auto mesh = makeModel<fcl::OBBRSSd>(bumpyMesh(0.3, 12, 18, 1));
  const auto box = std::make_shared<fcl::Boxd>(0.3, 0.4, 0.5);
  const Object moving(mesh, fcl::Transform3d::Identity());
  std::vector<std::unique_ptr<Object>> others;
  for (const double x : {0.6, 0.72, 0.74, 0.76, 0.78, 0.8}) {
    fcl::Transform3d pose = fcl::Transform3d::Identity();
    pose.translation() = Eigen::Vector3d(x, 0.1, 0.05);
    const std::shared_ptr<fcl::CollisionGeometryd> next = box;
    const std::shared_ptr<fcl::CollisionGeometryd> hard = mesh;
    others.push_back(std::make_unique<Object>(others.empty() ? hard : next, pose));
  }
  BroadphaseRequest request;
  request.displacement = [&](const Object& object) {
    return &object == &moving ? GaussianDisplacement(0.0025 * Eigen::Matrix3d::Identity())
                              : GaussianDisplacement();
  };
  request.query.relative_tolerance = 1e-3;
  request.query.absolute_tolerance = 1e-3;  // enough for the boxes at once
  const auto askIn = [&](bool reversed, std::size_t cells) {
    fcl::NaiveCollisionManagerd manager;
    std::vector<Object*> objects;
    for (const auto& other : others) objects.push_back(other.get());
    if (reversed) std::reverse(objects.begin(), objects.end());
    for (Object* object : objects) manager.registerObject(object);
    request.query.max_cells = cells;
    BroadphaseResult result;
    collisionProbability(&moving, &manager, request, result);
    return result;
  };
  const BroadphaseResult whole = askIn(false, 1'000'000);
  REQUIRE(whole.pairs.size() == 6);
  CHECK_FALSE(whole.interrupted);
  const std::size_t of_hard = whole.pairs[0].result.statistics.cells;
  std::size_t of_all = 0;
  for (const auto& pair : whole.pairs) of_all += pair.result.statistics.cells;
  REQUIRE(of_hard > of_all / 2);
  for (const bool reversed : {false, true}) {
    // As much as all need is enough, though an even share is not enough for the hard one.
    CHECK_FALSE(askIn(reversed, 3 * of_all).interrupted);
    const BroadphaseResult cut = askIn(reversed, of_hard / 2);
    CHECK(cut.interrupted == ProbabilityStatus::cell_limit);
    REQUIRE(cut.pairs.size() == 6);
    for (const auto& pair : cut.pairs) {
      const bool is_hard = pair.b == others[0].get();
      CHECK((pair.result.status == ProbabilityStatus::cell_limit) == is_hard);
      CHECK(*pair.result.upper < 1.0);
    }
    CHECK(cut.any.lower <= whole.any.upper);
    CHECK(cut.any.upper >= whole.any.lower);
  }
}
