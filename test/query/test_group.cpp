// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Groups with one displacement: against sampling, closed forms and the bounds by single pairs.
#include "fcl_prob/group.h"

#include <fcl/geometry/octree/octree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/plane.h>
#include <fcl/geometry/shape/sphere.h>

#include <algorithm>

#include "catch.h"
#include "fcl_prob/combined_bounds.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/normal_mass.h"
#include "geometry/displaced_collider.h"
#include "mesh_shapes.h"
#include "poses.h"
#include "shapes.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

using Geometries = GroupQuery::Geometries;
using Poses = std::vector<fcl::Transform3d>;

struct GroupScene {
  Geometries a, b;
  Poses poses_a, poses_b;
  GaussianDisplacement displacement;

  ProbabilityResult answer(const ProbabilityRequest& request = {}) const {
    ProbabilityResult result;
    GroupQuery(a, b).collisionProbability(poses_a, poses_b, displacement, request, result);
    return result;
  }

  /// Of every pair by itself.
  std::vector<Bounds> pairs(const ProbabilityRequest& request = {}) const {
    std::vector<Bounds> bounds;
    for (std::size_t i = 0; i < a.size(); ++i) {
      for (std::size_t j = 0; j < b.size(); ++j) {
        ProbabilityResult result;
        collisionProbability(a[i].get(), poses_a[i], b[j].get(), poses_b[j], displacement, request,
                             result);
        bounds.push_back({*result.lower, *result.upper});
      }
    }
    return bounds;
  }

  int hits(int samples, ContactMeaning contact, RandomBodies& random) const {
    std::vector<std::unique_ptr<detail::DisplacedCollider>> colliders;
    for (std::size_t i = 0; i < a.size(); ++i) {
      for (std::size_t j = 0; j < b.size(); ++j) {
        colliders.push_back(std::make_unique<detail::DisplacedCollider>(*a[i], poses_a[i], *b[j],
                                                                        poses_b[j], contact));
      }
    }
    const Eigen::Matrix3d factor =
        displacement.axes() * displacement.standardDeviations().asDiagonal();
    int count = 0;
    for (int i = 0; i < samples; ++i) {
      const Eigen::Vector3d moved = displacement.mean() + factor * random.normalVector();
      count += std::any_of(colliders.begin(), colliders.end(),
                           [&](const auto& collider) { return collider->collides(moved); });
    }
    return count;
  }
};

void add(Geometries& group, Poses& poses, Geometries::value_type geometry,
         const fcl::Transform3d& pose) {
  group.push_back(std::move(geometry));
  poses.push_back(pose);
}

Geometries::value_type randomMember(RandomBodies& random) {
  switch (random.integer(0, 4)) {
    case 0:
      return std::make_shared<fcl::Boxd>(0.2, 0.3, 0.4);
    case 1:
      return std::make_shared<fcl::Capsuled>(0.1, 0.4);
    case 2:
      return makeModel<fcl::OBBRSSd>(bumpyMesh(0.25, 4, 6, 3));
    case 3:
      return randomConvex(10, 0.3, 4);
    default:
      return makeModel<fcl::OBBRSSd>(torusMesh(0.25, 0.1, 7, 4));
  }
}

/// Links of an arm beside something that is not convex, or beside a few.
GroupScene convexScene(RandomBodies& random) {
  GroupScene scene;
  for (int i = random.integer(2, 5); i > 0; --i) {
    const TriangleMesh hull = hullMesh(random.onSphere(random.integer(6, 40), 0.2));
    add(scene.a, scene.poses_a, makeModel<fcl::OBBRSSd>(hull), random.pose(0.7));
  }
  const fcl::Transform3d away = at(random.uniform(0.3, 0.9), 0.2, -0.1);
  for (int i = random.integer(1, 2); i > 0; --i) {
    const auto seed = static_cast<std::uint64_t>(random.integer(0, 99));
    add(scene.b, scene.poses_b, makeModel<fcl::OBBRSSd>(bumpyMesh(0.4, 8, 12, seed)),
        away * random.pose(0.6));
  }
  scene.displacement = randomDisplacement(random, 0.1, 0.3).withMean(0.05 * random.direction());
  return scene;
}

/// Five standard deviations, and as many hits more for the small P.
void checkHolds(const ProbabilityResult& result, int hits, int samples) {
  const auto deviation = [&](double p) { return 5 * std::sqrt(p * (1 - p) * samples) + 5; };
  CAPTURE(*result.lower, *result.upper, hits);
  CHECK(hits >= *result.lower * samples - deviation(*result.lower));
  CHECK(hits <= *result.upper * samples + deviation(*result.upper));
}

GroupScene swapped(const GroupScene& scene) {
  return {scene.b, scene.a, scene.poses_b, scene.poses_a, scene.displacement.reversed()};
}

bool mentions(const ProbabilityResult& result, const std::string& words) {
  return std::any_of(result.plan.begin(), result.plan.end(), [&](const std::string& note) {
    return note.find(words) != std::string::npos;
  });
}

GroupScene randomScene(RandomBodies& random) {
  GroupScene scene;
  for (int i = random.integer(1, 4); i > 0; --i) {
    add(scene.a, scene.poses_a, randomMember(random), random.pose(0.8));
  }
  const fcl::Transform3d away = at(random.uniform(0.3, 0.9), 0.2, -0.1);
  for (int i = random.integer(2, 3); i > 0; --i) {
    add(scene.b, scene.poses_b, randomMember(random), away * random.pose(0.6));
  }
  scene.displacement = randomDisplacement(random, 0.1, 0.3).withMean(0.05 * random.direction());
  return scene;
}

}  // namespace

TEST_CASE("random groups hold what FCL counts, and lie between largest pair and sum", "[slow]") {
  RandomBodies random(1);
  constexpr int kSamples = 400;
  int representative = 0, below_sum = 0;
  for (int i = 0; i < 12; ++i) {
    const GroupScene scene = randomScene(random);
    ProbabilityRequest request;
    request.relative_tolerance = 0.05;
    request.contact = i % 3 == 0 ? ContactMeaning::solid : ContactMeaning::fcl;
    const ProbabilityResult result = scene.answer(request);
    CAPTURE(i);
    CHECK(result.status == ProbabilityStatus::converged);
    const int hits = scene.hits(kSamples, request.contact, random);
    checkHolds(result, hits, kSamples);
    const std::vector<Bounds> pairs = scene.pairs(request);
    CHECK(*result.upper >= anyOf(pairs).lower);
    CHECK(*result.lower <= anyOf(pairs).upper);
    double sum = 0.0;
    for (const Bounds& pair : pairs) sum += pair.lower;
    below_sum += *result.upper < sum;
    representative += hits > 10 && hits < kSamples - 10;
  }
  CHECK(representative > 5);
  CHECK(below_sum > 2);
}

TEST_CASE("groups of convex meshes are taken whole and hold what FCL counts") {
  RandomBodies random(7);
  constexpr int kSamples = 1'000;
  int whole = 0, representative = 0;
  for (int i = 0; i < 24; ++i) {
    const GroupScene scene = i % 2 == 0 ? convexScene(random) : swapped(convexScene(random));
    ProbabilityRequest request;
    request.relative_tolerance = 0.01;
    request.contact = i % 3 == 0 ? ContactMeaning::solid : ContactMeaning::fcl;
    const ProbabilityResult result = scene.answer(request);
    CAPTURE(i);
    CHECK(result.status == ProbabilityStatus::converged);
    const int hits = scene.hits(kSamples, request.contact, random);
    checkHolds(result, hits, kSamples);
    whole += mentions(result, "are convex: a piece each");
    representative += hits > 10 && hits < kSamples - 10;
    // A gradient needs the other partition, whose cells are boxes.
    request.gradient = true;
    request.relative_tolerance = 0.1;
    const ProbabilityResult boxes = scene.answer(request);
    CHECK_FALSE(mentions(boxes, "are convex: a piece each"));
    CHECK(*boxes.lower <= *result.upper);
    CHECK(*boxes.upper >= *result.lower);
  }
  CHECK(whole > 12);
  CHECK(representative > 10);
}

TEST_CASE("two boxes apart along one axis: the mass of the union of their slabs") {
  GroupScene scene;
  const auto plate = std::make_shared<fcl::Boxd>(0.2, 100.0, 100.0);
  add(scene.a, scene.poses_a, std::make_shared<fcl::Boxd>(0.1, 0.1, 0.1), kIdentity);
  add(scene.b, scene.poses_b, plate, at(0.35, 0, 0));
  add(scene.b, scene.poses_b, plate, at(0.45, 0, 0));  // overlaps the first
  add(scene.b, scene.poses_b, plate, at(-0.55, 0, 0));
  scene.displacement = GaussianDisplacement::fromStandardDeviations({0.1, 0.1, 0.1});
  ProbabilityRequest request;
  request.relative_tolerance = 1e-6;
  request.absolute_tolerance = 0.0;
  const double expected = normalIntervalMass(2.0, 6.0) + normalIntervalMass(-7.0, -4.0);
  const ProbabilityResult result = scene.answer(request);
  CHECK(*result.lower <= expected * (1 + 1e-13));
  CHECK(*result.upper >= expected * (1 - 1e-13));
  CHECK(*result.upper - *result.lower <= 1e-6 * expected);
}

TEST_CASE("spheres that are not in each other's way: the sum of their balls' masses") {
  GroupScene scene;
  add(scene.a, scene.poses_a, std::make_shared<fcl::Sphered>(0.5), at({0.1, 0.2, 0.3}));
  const std::vector<Eigen::Vector3d> places = {{1.6, 0.2, 0.3}, {-1.3, 0.1, 0.2}, {0.2, 9.0, 0.1}};
  for (const Eigen::Vector3d& place : places) {
    add(scene.b, scene.poses_b, std::make_shared<fcl::Sphered>(0.4), at(place));
  }
  scene.displacement = GaussianDisplacement::fromStandardDeviations({0.1, 0.1, 0.1});
  std::vector<double> masses;
  for (const Eigen::Vector3d& place : places) {
    const double distance = (place - Eigen::Vector3d(0.1, 0.2, 0.3)).norm();
    masses.push_back(normalBallMass(distance / 0.1, 0.9 / 0.1).middle());
  }
  const auto check = [&](double expected) {
    ProbabilityRequest request;
    request.relative_tolerance = 1e-3;
    request.absolute_tolerance = 0.0;
    const ProbabilityResult result = scene.answer(request);
    CHECK(result.status == ProbabilityStatus::converged);
    CHECK(*result.lower <= expected * (1 + 1e-12));
    CHECK(*result.upper >= expected * (1 - 1e-12));
    CHECK(*result.upper - *result.lower <= 1e-3 * *result.upper);
  };
  check(masses[0] + masses[1] + masses[2]);
  scene.poses_b[1] = scene.poses_b[0];  // two of them as one
  check(masses[0] + masses[2]);
}

TEST_CASE("groups of convex shapes hold what their pairs and a gradient's cells tell") {
  RandomBodies random(29);
  const std::vector<NamedGeometry> shapes = boundedShapes();
  for (int i = 0; i < 20; ++i) {
    GroupScene scene;
    const auto shape = [&] {
      return shapes[static_cast<std::size_t>(random.integer(0, 7))].geometry;
    };
    for (int k = random.integer(1, 2); k > 0; --k) {
      add(scene.a, scene.poses_a, shape(), random.pose(0.2));
    }
    for (int k = random.integer(2, 4); k > 0; --k) {
      fcl::Transform3d pose = random.pose(0.0);
      pose.translation() = random.uniform(1.0, 2.5) * random.direction();
      add(scene.b, scene.poses_b, shape(), pose);
    }
    const double size = i % 2 == 0 ? 0.3 : 0.1;
    scene.displacement = randomDisplacement(random, 0.3 * size, size);
    ProbabilityRequest request;
    request.absolute_tolerance = 1e-12;
    request.relative_tolerance = 0.03;
    request.max_cells = 20'000;
    const ProbabilityResult result = scene.answer(request);
    request.gradient = true;
    request.relative_tolerance = 0.1;
    const ProbabilityResult cells = scene.answer(request);
    CAPTURE(i, *result.lower, *result.upper, *cells.lower, *cells.upper);
    CHECK(*result.lower <= *cells.upper);
    CHECK(*result.upper >= *cells.lower);
    const Bounds any = anyOf(scene.pairs());
    CHECK(*result.lower <= any.upper);
    CHECK(*result.upper >= any.lower);
  }
}

TEST_CASE("copies of one geometry at one place are one geometry") {
  RandomBodies random(2);
  GroupScene scene;
  const auto mesh = makeModel<fcl::OBBRSSd>(bumpyMesh(0.4, 5, 7, 1));
  const auto torus = makeModel<fcl::KDOPd<24>>(torusMesh(0.5, 0.2, 9, 6));
  const fcl::Transform3d pose = at(0.9, 0.3, 0.1);
  for (int i = 0; i < 3; ++i) add(scene.a, scene.poses_a, mesh, kIdentity);
  for (int i = 0; i < 2; ++i) add(scene.b, scene.poses_b, torus, pose);
  scene.displacement = randomDisplacement(random, 0.1, 0.2);
  ProbabilityResult one;
  collisionProbability(mesh.get(), kIdentity, torus.get(), pose, scene.displacement, {}, one);
  const ProbabilityResult group = scene.answer();
  CHECK(*group.lower <= *one.upper);
  CHECK(*group.upper >= *one.lower);
  CHECK(*one.upper > 0.01);
}

TEST_CASE("a floor and a wall in a group") {
  GroupScene scene;
  add(scene.a, scene.poses_a, std::make_shared<fcl::Sphered>(0.2), at(3.0, 0, 0.5));
  add(scene.a, scene.poses_a, std::make_shared<fcl::Boxd>(0.2, 0.2, 0.2), at(3.0, 0, 0.9));
  add(scene.b, scene.poses_b, std::make_shared<fcl::Halfspaced>(Eigen::Vector3d(0, 0, 1), 0.0),
      kIdentity);
  add(scene.b, scene.poses_b, std::make_shared<fcl::Planed>(Eigen::Vector3d(0, 1, 0), 0.0),
      at(0, 0.5, 0));
  scene.displacement = GaussianDisplacement::fromStandardDeviations({0.1, 0.1, 0.1});
  ProbabilityRequest request;
  request.relative_tolerance = 1e-3;
  // z below -0.3, or y between 0.3 and 0.7 (the ball; the box beside it is narrower).
  const double floor = normalTailMass(3.0);
  const double wall = normalIntervalMass(3.0, 7.0);
  const double expected = floor + (1 - floor) * wall;
  const ProbabilityResult result = scene.answer(request);
  CHECK(result.status == ProbabilityStatus::converged);
  CHECK(*result.lower <= expected * (1 + 1e-12));
  CHECK(*result.upper >= expected * (1 - 1e-12));
  std::swap(scene.a, scene.b);
  std::swap(scene.poses_a, scene.poses_b);
  const ProbabilityResult swapped = scene.answer(request);
  CHECK(*swapped.lower <= expected * (1 + 1e-12));
  CHECK(*swapped.upper >= expected * (1 - 1e-12));
}

TEST_CASE("far groups stop at the sum of bounds; without motion a group collides or not") {
  GroupScene scene;
  const auto mesh = makeModel<fcl::OBBRSSd>(bumpyMesh(0.3, 4, 6, 1));
  for (int i = 0; i < 3; ++i) add(scene.a, scene.poses_a, mesh, at(i, 0, 0));
  add(scene.b, scene.poses_b, mesh, at(1, 2, 0));
  scene.displacement = GaussianDisplacement::fromStandardDeviations({0.1, 0.1, 0.1});
  const ProbabilityResult far = scene.answer();
  CHECK(far.statistics.cells == 0);
  CHECK(*far.upper > 0.0);
  CHECK(*far.upper < 1e-6);
  scene.displacement = GaussianDisplacement();
  CHECK(*scene.answer().upper < 1e-6);
  scene.poses_b[0] = at(2.2, 0, 0);
  CHECK(*scene.answer().lower > 1.0 - 1e-6);
}

TEST_CASE("groups refuse what they cannot answer, by name") {
  GroupScene scene;
  const auto box = std::make_shared<fcl::Boxd>(1, 1, 1);
  const auto floor = std::make_shared<fcl::Halfspaced>(Eigen::Vector3d(0, 0, 1), 0.0);
  CHECK_THROWS_AS(GroupQuery({}, {box}), InvalidGeometry);
  CHECK_THROWS_WITH(GroupQuery({box}, {box, nullptr}), Catch::Contains("member 1 of group B"));
  CHECK_THROWS_AS(GroupQuery({box, floor}, {floor}), UnsupportedGeometry);
  scene.a = {box, box};
  scene.b = {box};
  scene.poses_a = {kIdentity};
  scene.poses_b = {kIdentity};
  CHECK_THROWS_AS(scene.answer(), InvalidRequest);
  scene.poses_a.push_back(kIdentity);
  ProbabilityRequest request;
  request.method = ProbabilityMethod::general_pcd;
  CHECK_THROWS_AS(scene.answer(request), UnsupportedGeometry);
  CHECK_NOTHROW(scene.answer());
}

TEST_CASE("collision objects as groups answer as their geometries do") {
  const auto box = std::make_shared<fcl::Boxd>(0.3, 0.4, 0.5);
  const auto ball = std::make_shared<fcl::Sphered>(0.3);
  const fcl::CollisionObjectd one(box, at(0, 0, 0)), two(ball, at(0.5, 0, 0)),
      three(box, at(1, 0, 0));
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.1, 0.1, 0.1});
  ProbabilityResult objects, geometries;
  collisionProbability({&one, &two}, {&three}, displacement, {}, objects);
  GroupQuery({box, ball}, {box})
      .collisionProbability({at(0, 0, 0), at(0.5, 0, 0)}, {at(1, 0, 0)}, displacement, {},
                            geometries);
  CHECK(objects.lower == geometries.lower);
  CHECK(objects.upper == geometries.upper);
}
