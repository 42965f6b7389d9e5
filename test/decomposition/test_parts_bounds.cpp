// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <fcl/geometry/shape/sphere.h>

#include <cmath>

#include "benchmark_scenes.h"
#include "catch.h"
#include "fcl_prob/convex_pcd.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/group.h"
#include "fcl_prob/part_tree.h"
#include "fcl_prob/parts_bounds.h"
#include "mesh_shapes.h"
#include "random_bodies.h"

namespace {

using Eigen::Vector3d;
using namespace fcl_prob;
using namespace fcl_prob_test;

DecompositionRequest quickRequest() {
  DecompositionRequest request;
  request.max_parts = 6;
  request.pieces = 10;
  return request;
}

ConvexBody boxBody(const Vector3d& sides, const Vector3d& centre) {
  std::vector<Vector3d> corners;
  for (int i = 0; i < 8; ++i) {
    const Vector3d sign(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    corners.push_back(centre + 0.5 * sign.cwiseProduct(sides));
  }
  return ConvexBody(corners);
}

double massOfInterval(double low, double high) {
  return 0.5 * (std::erf(high / std::sqrt(2.0)) - std::erf(low / std::sqrt(2.0)));
}

TriangleMesh randomMesh(RandomBodies& random) {
  const Eigen::Isometry3d pose = random.pose(0.3);
  switch (random.integer(0, 4)) {
    case 0:
      return transformed(torusMesh(0.4, 0.12, 14, 8), pose);
    case 1:
      return transformed(bumpyMesh(0.5, 8, 12, static_cast<unsigned>(random.integer(1, 99))), pose);
    case 2:
      return joined(boxMesh({0.2, 0.9, 0.2}), transformed(boxMesh({0.7, 0.2, 0.2}), pose));
    case 3: {
      TriangleMesh open = transformed(bumpyMesh(0.5, 8, 12, 4), pose);
      open.triangles.resize(open.triangles.size() / 2);
      return open;
    }
    default: {
      TriangleMesh soup = boxMesh({1, 1, 1});
      for (auto& v : soup.vertices) v = 0.3 * random.normalVector();
      return soup;
    }
  }
}

GaussianDisplacement randomDisplacement(RandomBodies& random) {
  const double largest = random.logUniform(0.01, 0.5);
  Vector3d sigma(largest, largest * random.logUniform(0.01, 1),
                 largest * random.logUniform(0.01, 1));
  if (random.integer(0, 9) == 0) sigma[2] = 0.0;
  return GaussianDisplacement::fromStandardDeviations(sigma, random.quaternion());
}

/// Bounds with parts against the certified interval of the meshes and of the parts themselves.
void checkRandomScene(RandomBodies& random) {
  const TriangleMesh a = randomMesh(random), b = randomMesh(random);
  const fcl::Transform3d pose_a = random.pose(0.2), pose_b = random.pose(1.5);
  const GaussianDisplacement displacement = randomDisplacement(random);
  const ConvexParts parts_a(a, quickRequest()), parts_b(b, quickRequest());
  const PartsBoundsResult bounds = partsBounds(parts_a, pose_a, parts_b, pose_b, displacement);
  CHECK(bounds.any.lower <= bounds.any.upper);
  CHECK(bounds.any.upper <= std::min(1.0, bounds.sum * (1 + 1e-12)));

  ProbabilityRequest request;
  request.method = ProbabilityMethod::interval;
  request.relative_tolerance = 0.05;
  request.max_cells = 3'000;
  ProbabilityResult of_meshes;
  collisionProbability(makeModel<fcl::OBBRSSd>(a).get(), pose_a, makeModel<fcl::OBBRSSd>(b).get(),
                       pose_b, displacement, request, of_meshes);
  CHECK(bounds.any.upper >= *of_meshes.lower);
  for (const PartVolume volume : {PartVolume::sphere, PartVolume::obb, PartVolume::convex}) {
    GeneralPcdRequest pcd;
    pcd.leaf_bound = random.integer(0, 1) ? LeafBound::volumes : LeafBound::triangles;
    CHECK(generalPcd(PartTree(parts_a, volume), pose_a, PartTree(parts_b, volume), pose_b,
                     displacement, pcd)
              .upper >= *of_meshes.lower);
  }
  // One half-space where that is enough: no less than certain, and more than the hulls by no more
  // than was allowed.
  GeneralPcdRequest screening;
  screening.negligible = random.integer(0, 1) ? 1e-2 : 1e-4;
  const double screened =
      generalPcd(PartTree(parts_a, PartVolume::convex), pose_a,
                 PartTree(parts_b, PartVolume::convex), pose_b, displacement, screening)
          .raw_sum;
  const double of_hulls = generalPcd(PartTree(parts_a, PartVolume::convex), pose_a,
                                     PartTree(parts_b, PartVolume::convex), pose_b, displacement)
                              .raw_sum;
  CHECK(std::min(1.0, screened) >= *of_meshes.lower);
  const auto pairs = static_cast<double>(parts_a.size() * parts_b.size());
  CHECK(screened <= of_hulls * (1.0 + 1e-6) + screening.negligible * pairs);

  ProbabilityResult of_parts;
  GroupQuery(parts_a.geometries(), parts_b.geometries())
      .collisionProbability(std::vector<fcl::Transform3d>(parts_a.size(), pose_a),
                            std::vector<fcl::Transform3d>(parts_b.size(), pose_b), displacement,
                            request, of_parts);
  CHECK(bounds.any.upper >= *of_parts.lower);
  CHECK(bounds.any.lower <= *of_parts.upper);
}

ProbabilityResult decide(const ConvexParts& parts, const fcl::Transform3d& pose, double threshold) {
  ProbabilityRequest request;
  request.threshold = threshold;
  ProbabilityResult result;
  GroupQuery(parts.geometries(), parts.geometries())
      .collisionProbability(
          std::vector<fcl::Transform3d>(parts.size(), pose),
          std::vector<fcl::Transform3d>(parts.size(), fcl::Transform3d::Identity()),
          GaussianDisplacement::fromStandardDeviations({0.1, 0.2, 0.15}), request, result);
  return result;
}

}  // namespace

TEST_CASE("one pair has its exact mass on both sides", "[decomposition]") {
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.1, 0.2, 0.3});
  const fcl::Transform3d identity = fcl::Transform3d::Identity();
  const std::vector<ConvexBody> a{boxBody({0.2, 0.2, 0.2}, {0, 0, 0})};
  const std::vector<ConvexBody> b{boxBody({0.4, 0.4, 0.4}, {0.4, 0, 0})};
  const PartsBoundsResult bounds = partsBounds(a, identity, b, identity, displacement);
  const double p = massOfInterval(1.0, 7.0) * massOfInterval(-1.5, 1.5) * massOfInterval(-1, 1);
  CHECK(bounds.any.lower <= p);
  CHECK(bounds.any.upper >= p);
  CHECK(bounds.any.width() < 1e-9 * p);
}

TEST_CASE("pairs that overlap are not counted twice", "[decomposition]") {
  // C-obstacles: [1, 3] and [2, 4] along x, in deviations; all of the other axes.
  const auto displacement = GaussianDisplacement::fromStandardDeviations({1, 1, 1});
  const fcl::Transform3d identity = fcl::Transform3d::Identity();
  const std::vector<ConvexBody> a{boxBody({1, 40, 40}, {0, 0, 0})};
  const std::vector<ConvexBody> b{boxBody({1, 40, 40}, {2, 0, 0}), boxBody({1, 40, 40}, {3, 0, 0}),
                                  boxBody({1, 40, 40}, {-30, 0, 0})};
  const PartsBoundsResult bounds = partsBounds(a, identity, b, identity, displacement);
  const double p = massOfInterval(1.0, 4.0);
  CHECK(bounds.any.lower <= p);
  CHECK(bounds.any.upper >= p);
  CHECK(bounds.any.width() < 1e-6);
  CHECK(bounds.sum == Approx(massOfInterval(1, 3) + massOfInterval(2, 4)).epsilon(1e-9));
  CHECK(bounds.intersections == 1);
}

TEST_CASE("bounds far out keep their relative accuracy", "[decomposition]") {
  const auto displacement = GaussianDisplacement::fromStandardDeviations({1, 1, 1});
  const fcl::Transform3d identity = fcl::Transform3d::Identity();
  const std::vector<ConvexBody> a{boxBody({1, 6, 6}, {0, 0, 0})};
  const std::vector<ConvexBody> b{boxBody({1, 6, 6}, {9, 0, 0}), boxBody({1, 6, 6}, {9.05, 0, 0})};
  PartsBoundsRequest request;
  request.negligible = 0.0;
  const PartsBoundsResult bounds = partsBounds(a, identity, b, identity, displacement, request);
  const double side = 2.0 * massOfInterval(0, 6);
  // The far side of the union counts, too: 7e-9 of P.
  const double p =
      0.5 * (std::erfc(8.0 / std::sqrt(2.0)) - std::erfc(10.05 / std::sqrt(2.0))) * side * side;
  CHECK(bounds.any.lower <= p * (1 + 1e-12));
  CHECK(bounds.any.upper >= p * (1 - 1e-12));
  CHECK(bounds.any.width() < 1e-2 * p);
}

TEST_CASE("curved bodies and displacements of lower rank are bounded by single pairs",
          "[decomposition]") {
  const fcl::Transform3d identity = fcl::Transform3d::Identity();
  const std::vector<ConvexBody> spheres{ConvexBody(fcl::Sphered(0.5))};
  const std::vector<ConvexBody> boxes{boxBody({1, 1, 1}, {1.2, 0, 0}),
                                      boxBody({1, 1, 1}, {1.3, 0, 0})};
  for (const double third : {0.2, 0.0}) {
    const auto displacement = GaussianDisplacement::fromStandardDeviations({0.2, 0.2, third});
    for (const auto& a : {spheres, boxes}) {
      const PartsBoundsResult bounds = partsBounds(a, identity, boxes, identity, displacement);
      CHECK(bounds.any.lower <= bounds.any.upper);
      CHECK(bounds.any.upper > 0.01);
    }
  }
}

TEST_CASE("bounds of parts refuse what they cannot use", "[decomposition]") {
  const auto displacement = GaussianDisplacement::fromStandardDeviations({1, 1, 1});
  const fcl::Transform3d identity = fcl::Transform3d::Identity();
  const std::vector<ConvexBody> box{boxBody({1, 1, 1}, {0, 0, 0})};
  CHECK_THROWS_AS(partsBounds({}, identity, box, identity, displacement), InvalidGeometry);
  PartsBoundsRequest request;
  request.negligible = -1.0;
  CHECK_THROWS_AS(partsBounds(box, identity, box, identity, displacement, request), InvalidRequest);
  const ConvexParts parts(boxMesh({1, 1, 1}));
  CHECK_THROWS_AS(generalPcd(PartTree(parts, PartVolume::obb), identity,
                             PartTree(parts, PartVolume::aabb), identity, displacement),
                  InvalidRequest);
  GeneralPcdRequest below_nothing;
  below_nothing.negligible = -1.0;
  const PartTree tree(parts, PartVolume::obb);
  CHECK_THROWS_AS(generalPcd(tree, identity, tree, identity, displacement, below_nothing),
                  InvalidRequest);
}

TEST_CASE("thresholds that sums decide start no partition", "[decomposition]") {
  const ConvexParts torus(torusMesh(1.0, 0.3, 20, 10), quickRequest());
  REQUIRE(torus.size() > 1);
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.translation() = Vector3d(2.7, 0.2, 0.1);
  const ProbabilityResult whole = decide(torus, pose, 0.5);
  const double p = 0.5 * (*whole.lower + *whole.upper);
  REQUIRE(p > 0.01);
  const ProbabilityResult below = decide(torus, pose, 2.0 * *whole.upper);
  CHECK(below.decision == Decision::below);
  CHECK(below.statistics.cells == 0);
  const ProbabilityResult above = decide(torus, pose, 0.3 * *whole.lower);
  CHECK(above.decision == Decision::above);
  CHECK(above.statistics.cells == 0);
}

TEST_CASE("the heaviest pair is bounded where its mass was not worth computing",
          "[decomposition]") {
  const std::vector<ConvexBody> a{boxBody({1, 1, 1}, Vector3d::Zero())};
  const std::vector<ConvexBody> b{boxBody({1, 1, 1}, {2, 0, 0})};
  const fcl::Transform3d identity = fcl::Transform3d::Identity();
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.14, 0.14, 0.14});
  PartsBoundsRequest request;
  request.negligible = 0.0;
  const PartsBoundsResult weighed = partsBounds(a, identity, b, identity, displacement, request);
  const PartsBoundsResult bounds = partsBounds(a, identity, b, identity, displacement);
  CHECK(weighed.any.lower > 0.0);
  CHECK(bounds.largest >= weighed.any.lower);
  CHECK(bounds.largest <= bounds.sum);
}

TEST_CASE("parts of thin triangles are what a group takes", "[decomposition]") {
  const auto box = boxMesh({1, 1, 1});
  RandomBodies random(5);
  for (int i = 0; i < 60; ++i) {
    const double width = std::pow(10.0, -1.0 - i % 11);
    const Eigen::Isometry3d turned(random.quaternion());
    TriangleMesh triangle;
    triangle.vertices = {turned * Vector3d::Zero(), turned * Vector3d(1, 0, 0),
                         turned * Vector3d(random.uniform(0, 1), width, 0)};
    triangle.triangles = {fcl::Triangle(0, 1, 2)};
    CAPTURE(i, width);
    CHECK_NOTHROW(GroupQuery(ConvexParts(triangle).geometries(), ConvexParts(box).geometries()));
  }
}

TEST_CASE("bounds with parts are never below the meshes' probability, on random scenes",
          "[decomposition][slow]") {
  RandomBodies random(1);
  for (int i = 0; i < 8; ++i) {
    CAPTURE(i);
    checkRandomScene(random);
  }
}

TEST_CASE("the same on two thousand random scenes", "[decomposition][long]") {
  RandomBodies random(2);
  for (int i = 0; i < 2'000; ++i) {
    CAPTURE(i);
    checkRandomScene(random);
  }
}

TEST_CASE("Hunter's bound is within 1.3 of P on the benchmark scenes", "[decomposition][long]") {
  for (const std::string& name : benchmarkSceneNames()) {
    const auto scene = benchmarkSceneOrSkip(name);
    if (!scene) return;
    CAPTURE(name);
    const ConvexParts a(scene->a), b(scene->b);
    const PartsBoundsResult bounds =
        partsBounds(a, scene->pose_a, b, scene->pose_b, scene->displacement);
    CHECK(bounds.any.upper >= scene->reference.lower);
    CHECK(bounds.any.upper <= 1.3 * scene->reference.upper);
    CHECK(bounds.any.lower <= bounds.any.upper);
  }
}
