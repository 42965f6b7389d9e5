// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A convex mesh taken whole beside another mesh: what is recognised as convex, the planes of its
// C-obstacles, polytope cells and their masses, and intervals against sampling.
#include <algorithm>
#include <cmath>

#include "catch.h"
#include "cells/cell_polytope.h"
#include "cells/fat_obstacles.h"
#include "fcl_prob/convex_polytope.h"
#include "fcl_prob/monte_carlo.h"
#include "fcl_prob/normal_mass.h"
#include "fcl_prob/polytope_mass.h"
#include "partition_query.h"
#include "random_bodies.h"
#include "sampled_contact.h"
#include "whitened_meshes.h"

namespace {

using fcl_prob::Bounds;
using fcl_prob::ConvexPolytope;
using fcl_prob::ProbabilityResult;
using fcl_prob::TriangleMesh;
using namespace fcl_prob::detail;
using fcl_prob_test::boxMesh;
using fcl_prob_test::bumpyMesh;
using fcl_prob_test::hullMesh;
using fcl_prob_test::PartitionQuery;
using fcl_prob_test::RandomBodies;
using fcl_prob_test::sphereMesh;
using fcl_prob_test::WhitenedMeshes;

std::shared_ptr<const ConvexFan> fanOf(const TriangleMesh& mesh) {
  const auto model = fcl_prob_test::makeModel<fcl::OBBRSSd>(mesh);
  return buildPieceTree(*model)->parts[0].fan;
}

TriangleMesh inSinglePrecision(TriangleMesh mesh) {
  for (Eigen::Vector3d& v : mesh.vertices) v = v.cast<float>().cast<double>();
  return mesh;
}

bool isCarved(const ProbabilityResult& result) {
  return fcl_prob_test::planMentions(result, "is convex: one piece");
}

}  // namespace

TEST_CASE("convex meshes are recognised, in single precision too", "[carving]") {
  RandomBodies random(1);
  CHECK(fanOf(boxMesh({1, 2, 3})));
  CHECK(fanOf(boxMesh({1, 2, 3}))->normals.size() == 6);
  CHECK(fanOf(sphereMesh(0.3, 12, 16)));
  for (int i = 0; i < 50; ++i) {
    const TriangleMesh mesh = hullMesh(random.onSphere(random.integer(4, 60), 0.2));
    CHECK(fanOf(mesh));
    TriangleMesh moved = mesh;
    for (Eigen::Vector3d& v : moved.vertices) v += Eigen::Vector3d(0.5, -0.2, 0.1);
    CHECK(fanOf(inSinglePrecision(moved)));
  }
}

TEST_CASE("what is not closed or not convex is not taken for convex", "[carving]") {
  CHECK_FALSE(fanOf(bumpyMesh(0.3, 10, 12, 1)));
  CHECK_FALSE(fanOf(fcl_prob_test::torusMesh(0.3, 0.1, 12, 8)));
  CHECK_FALSE(fanOf(fcl_prob_test::reversed(boxMesh({1, 1, 1}))));
  TriangleMesh open = boxMesh({1, 1, 1});
  open.triangles.pop_back();
  CHECK_FALSE(fanOf(open));
  TriangleMesh two = boxMesh({1, 1, 1});
  TriangleMesh far = two;
  for (Eigen::Vector3d& v : far.vertices) v += Eigen::Vector3d(3, 0, 0);
  CHECK_FALSE(fanOf(fcl_prob_test::joined(two, far)));
}

// A vertex pushed inwards: either the mesh is not taken for convex, or it is by margins that hold
// it.
TEST_CASE("a dent is noticed, or is within the margins", "[carving]") {
  for (const double dent : {1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2}) {
    CAPTURE(dent);
    TriangleMesh mesh = sphereMesh(0.5, 10, 12);
    mesh.vertices[40] *= 1.0 - 2 * dent;
    // A neighbour of the dent in the middle of a face would be the same; this one is a corner of
    // six.
    const auto fan = fanOf(mesh);
    if (dent >= 1e-2) CHECK_FALSE(fan);
    if (!fan) continue;
    const double deepest = *std::max_element(fan->depths.begin(), fan->depths.end());
    for (const auto& t : mesh.triangles) {
      // Every triangle is in the shallow layer of some plane.
      double least = 1e300;
      for (std::size_t f = 0; f < fan->normals.size(); ++f) {
        double depth = 0.0;
        for (int k = 0; k < 3; ++k) {
          const Eigen::Vector3d v = mesh.vertices[t[k]];
          // Both meshes are centred; sphereMesh() is, too.
          depth = std::max(depth, fan->offsets[f] - fan->normals[f].dot(v - fan->centre));
        }
        least = std::min(least, depth);
      }
      CHECK(least <= deepest + 1e-12);
    }
  }
}

// Points are held against the planes and against FCL, with the link's hull as the solid.
TEST_CASE("the planes of P ⊕ T hold it, and what is within their margins", "[carving]") {
  RandomBodies random(3);
  int inside = 0;
  int outside = 0;
  for (int scene = 0; scene < 60; ++scene) {
    const TriangleMesh body = hullMesh(random.onSphere(random.integer(4, 40), 1.0));
    TriangleMesh one;
    const double size = random.logUniform(0.05, 3.0);
    for (int k = 0; k < 3; ++k) one.vertices.push_back(size * random.normalVector());
    if (scene % 3 == 0) {
      // Edges along those of the body.
      one.vertices[1] = one.vertices[0] + size * (body.vertices[1] - body.vertices[0]);
    }
    one.triangles.emplace_back(0, 1, 2);
    for (const bool body_is_a : {true, false}) {
      const WhitenedMeshes scene_meshes(body_is_a ? body : one, body_is_a ? one : body);
      const auto& tree = body_is_a ? scene_meshes.tree_a : scene_meshes.tree_b;
      REQUIRE(tree->parts[0].fan);
      const Eigen::Matrix3d linear = scene_meshes.whitening.matrix();
      const WhitenedPolygons pieces(body_is_a ? scene_meshes.pair.b : scene_meshes.pair.a,
                                    scene_meshes.objectOf(!body_is_a), linear);
      FatObstacles obstacles(scene_meshes.pair, tree->parts[0], *tree->parts[0].fan, body_is_a,
                             linear, pieces);
      REQUIRE(obstacles.usable());
      std::vector<ObstaclePlane> planes = obstacles.otherPlanes(0);
      obstacles.faceOffsets(0);
      for (int f = 0; f < obstacles.faceCount(); ++f) planes.push_back(obstacles.planesOf(0)[f]);
      REQUIRE_FALSE(obstacles.failed());
      // The middle of A's part is the origin of the whitened frame, which moves both alike.
      std::vector<Eigen::Vector3d> sum;
      for (const Eigen::Vector3d& b : body_is_a ? one.vertices : body.vertices) {
        for (const Eigen::Vector3d& a : body_is_a ? body.vertices : one.vertices) {
          sum.push_back(b - a);
        }
      }
      const ConvexPolytope hull = fcl_prob::convexHull(sum);
      for (int i = 0; i < 60; ++i) {
        const auto vertex =
            static_cast<std::size_t>(random.integer(0, static_cast<int>(hull.vertices.size()) - 1));
        const Eigen::Vector3d y =
            random.uniform(0.8, 1.1) * hull.vertices[vertex] + 0.2 * size * random.normalVector();
        double height = -1e300;
        for (const ConvexPolytope::Face& face : hull.faces) {
          height = std::max(height, face.normal.dot(y) - face.offset);
        }
        double outer = -1e300;
        double inner = -1e300;
        for (const ObstaclePlane& plane : planes) {
          outer = std::max(outer, plane.n.dot(linear * y) - plane.outer);
          inner = std::max(inner, plane.n.dot(linear * y) - plane.inner());
        }
        INFO("height " << height << ", outer " << outer << ", inner " << inner);
        if (height < -1e-9) CHECK(outer <= 0.0);
        if (inner <= 0.0) CHECK(height <= 1e-9);
        inside += inner <= 0.0;
        outside += outer > 0.0;
      }
    }
  }
  CHECK(inside > 500);
  CHECK(outside > 500);
}

TEST_CASE("cut polytopes add up, and have the mass of the exact formula", "[carving]") {
  RandomBodies random(4);
  PolytopeCutter cutter;
  for (int scene = 0; scene < 200; ++scene) {
    Cell box{random.uniform(0.0, 2.0) * random.normalVector(), {}, 3};
    box.hi = box.lo + Eigen::Vector3d(random.uniform(0.1, 1.5), random.uniform(0.1, 1.5),
                                      random.uniform(0.1, 1.5));
    CellPolytope body(box);
    const double accuracy = random.logUniform(1e-7, 1e-3);
    const Bounds whole = cellMass(box);
    const Bounds cubature = body.mass({accuracy, 0.0});
    CHECK(cubature.lower <= whole.upper);
    CHECK(cubature.upper >= whole.lower);
    CHECK(cubature.width() <= 4 * accuracy * whole.upper + 1e-7 * whole.upper);
    double lower = 0.0;
    double upper = 0.0;
    for (int cut = 0; cut < 6; ++cut) {
      const Eigen::Vector3d n = random.direction();
      const CellPolytope::Extent extent = body.along(n);
      // Every third plane goes through a vertex.
      const double s =
          cut % 3 == 0 ? n.dot(body.vertices().front()) : random.uniform(extent.lo, extent.hi);
      CellPolytope above;
      cutter.cut(body, n, s, &body, &above);
      const Bounds off = above.mass({accuracy, 0.0});
      lower += off.lower;
      upper += off.upper;
      if (body.empty()) break;
      for (const Eigen::Vector3d& v : body.vertices()) CHECK(n.dot(v) <= s + 1e-12);
      for (const Eigen::Vector3d& v : above.vertices()) CHECK(n.dot(v) >= s - 1e-12);
    }
    if (!body.empty()) {
      const Bounds last = body.mass({accuracy, 0.0});
      const Bounds exact = fcl_prob::polytopeMass(fcl_prob::convexHull(body.vertices()), 1e-12);
      CHECK(last.lower <= exact.upper + 1e-13);
      CHECK(last.upper >= exact.lower - 1e-13);
      lower += last.lower;
      upper += last.upper;
    }
    CHECK(lower <= whole.upper + 1e-12);
    CHECK(upper >= whole.lower - 1e-12);
  }
}

// Slivers, too: every other plane cuts hardly more than a vertex or an edge off, or leaves hardly
// more of it.
TEST_CASE("the balls of cut polytopes are within all planes", "[carving]") {
  RandomBodies random(9);
  PolytopeCutter cutter;
  int found = 0;
  for (int scene = 0; scene < 500; ++scene) {
    const Cell box{random.uniform(0.0, 3.0) * random.normalVector(), {}, 3};
    CellPolytope body({box.lo, box.lo + random.logUniform(1e-3, 1.0) * Eigen::Vector3d::Ones(), 3});
    std::vector<std::pair<Eigen::Vector3d, double>> planes;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d n = Eigen::Vector3d::Unit(k);
      planes.emplace_back(n, body.along(n).hi);
      planes.emplace_back(-n, body.along(-n).hi);
    }
    for (int cut = 0; cut < 8; ++cut) {
      Eigen::Vector3d n = random.direction();
      if (cut % 3 == 2) n = (planes.back().first + 1e-6 * n).normalized();
      const CellPolytope::Extent extent = body.along(n);
      const double share = random.logUniform(1e-9, 1.0);
      const double s = extent.hi - (cut % 4 == 3 ? 1.0 - share : share) * (extent.hi - extent.lo);
      CellPolytope below;
      cutter.cut(body, n, s, &below, nullptr);
      if (below.empty()) continue;
      body = below;
      planes.emplace_back(n, s);
      const CellPolytope::Ball ball = body.ballWithin();
      found += ball.radius > 0.0;
      for (const auto& [normal, level] : planes) {
        CHECK(normal.dot(ball.middle) + ball.radius <= level + 1e-12);
      }
    }
  }
  CHECK(found > 2'000);
}

namespace {

void checkScenes(int scenes, int samples, unsigned seed) {
  RandomBodies random(seed);
  int carved = 0;
  for (int i = 0; i < scenes; ++i) {
    TriangleMesh body = hullMesh(random.onSphere(random.integer(6, 60), random.uniform(0.1, 0.4)));
    if (i % 2 == 0) body = inSinglePrecision(body);
    // Nearly convex: some are recognised, some are not.
    if (i % 5 == 0) body.vertices[0] *= 1.0 - random.logUniform(1e-9, 1e-2);
    TriangleMesh other = bumpyMesh(random.uniform(0.2, 0.5), 10, 14, static_cast<std::uint64_t>(i));
    if (i % 7 == 3) other.triangles.resize(other.triangles.size() - 5);
    if (i % 7 == 4) other = fcl_prob_test::reversed(other);
    if (i % 7 == 5) other = hullMesh(random.onSphere(20, 0.3));
    const bool solid = i % 3 == 0 && i % 7 != 3;
    const bool swapped = i % 4 == 1;
    RandomBodies draws(1000 + seed + static_cast<unsigned>(i));
    INFO("scene " << i);
    const ProbabilityResult result = fcl_prob_test::checkedInterval(
        {body, other, swapped, solid, 0.0, 0.9, 0.03, 0.2, 0.01}, random, samples, draws);
    carved += isCarved(result);
  }
  CHECK(carved > scenes / 4);
}

}  // namespace

TEST_CASE("carved intervals hold sampled probabilities on random scenes",
          "[carving][random][slow]") {
  checkScenes(60, 1'500, 11);
}

TEST_CASE("carved intervals hold sampled probabilities on 5,000 scenes",
          "[carving][random][long]") {
  checkScenes(5'000, 3'000, 12);
}

// A link that fits into an arm: what touches nothing may be contained, and a point of each such
// cell has to tell.
TEST_CASE("carved cells of solids are hardly more than those of surfaces", "[carving]") {
  RandomBodies random(21);
  for (int i = 0; i < 12; ++i) {
    TriangleMesh link = hullMesh(random.onSphere(60, 0.12));
    TriangleMesh arm = bumpyMesh(0.5, 24, 32, static_cast<std::uint64_t>(i));
    // Pairs of triangles in one plane, which rounding has made thick: obstacles graze many cells.
    Eigen::Isometry3d far = Eigen::Isometry3d::Identity();
    if (i % 2 == 0) {
      far.translation().setConstant(0.3);
      link = inSinglePrecision(
          fcl_prob_test::transformed(fcl_prob_test::sphereMesh(0.12, 8, 12), far));
      arm = inSinglePrecision(fcl_prob_test::torusMesh(0.4, 0.2, 24, 12));
    }
    PartitionQuery query(link, arm);
    query.placeAtRandom(0.6, 0.8, random);
    query.pose_a = query.pose_a * far.inverse();
    const auto displacement = fcl_prob_test::obliqueDisplacement(0.05, 0.2, random);
    const auto request = fcl_prob_test::intervalRequest(i % 2 == 0 ? 0.0003 : 0.01);
    const ProbabilityResult surfaces = query.run(displacement, request);
    query.makeSolid();
    const ProbabilityResult solids = query.run(displacement, request);
    CAPTURE(i, surfaces.statistics.cells, solids.statistics.cells, *surfaces.lower, *solids.upper);
    CHECK(isCarved(surfaces));
    CHECK(isCarved(solids));
    CHECK(solids.status == fcl_prob::ProbabilityStatus::converged);
    CHECK(solids.statistics.cells <= 2 * surfaces.statistics.cells);
    CHECK(*solids.upper >= *surfaces.lower);
  }
}

namespace {

// A triangle in three, with a point of its middle pushed inwards.
TriangleMesh withDent(TriangleMesh mesh, double depth) {
  const fcl::Triangle t = mesh.triangles[0];
  const Eigen::Vector3d& a = mesh.vertices[t[0]];
  const Eigen::Vector3d& b = mesh.vertices[t[1]];
  const Eigen::Vector3d& c = mesh.vertices[t[2]];
  const Eigen::Vector3d bottom = (a + b + c) / 3 - depth * (b - a).cross(c - a).normalized();
  const std::size_t middle = mesh.vertices.size();
  mesh.vertices.push_back(bottom);
  mesh.triangles[0] = {t[0], t[1], middle};
  mesh.triangles.emplace_back(t[1], t[2], middle);
  mesh.triangles.emplace_back(t[2], t[0], middle);
  return mesh;
}

}  // namespace

// The same geometry once as a mesh that is taken whole and once with a dent too deep for that, too
// small to be seen at this tolerance.
TEST_CASE("carved cells and boxes agree", "[carving]") {
  RandomBodies random(5);
  for (int i = 0; i < 6; ++i) {
    TriangleMesh body = hullMesh(random.onSphere(30, 0.3));
    const TriangleMesh dented = withDent(body, 3e-5);
    const TriangleMesh other = bumpyMesh(0.5, 10, 14, static_cast<std::uint64_t>(i));
    const auto displacement = fcl_prob::GaussianDisplacement::fromStandardDeviations(
        {0.05, 0.08, 0.1}, random.quaternion());
    Bounds found[2];
    for (const bool dent : {false, true}) {
      PartitionQuery query(dent ? dented : body, other);
      query.pose_b.translation() = Eigen::Vector3d(0.75, 0.1, 0.0);
      const ProbabilityResult result =
          query.run(displacement, fcl_prob_test::intervalRequest(0.002));
      CHECK(isCarved(result) == !dent);
      found[dent] = {*result.lower, *result.upper};
    }
    CHECK(found[1].lower <= found[0].upper);
    // The dent takes away no more than a layer of 3e-5 m at a deviation of 5 cm.
    CHECK(found[1].upper >= found[0].lower - 0.001);
  }
}

// A box so large that only the face towards a small mesh matters: P is a tail, and nearly all that
// is behind that face is within the obstacle of one triangle, which few boxes have to tell.
TEST_CASE("what one obstacle covers is not divided", "[carving]") {
  constexpr double kDeviation = 0.1;
  for (const double gap : {-0.3, -0.05, 0.05, 0.2}) {
    const TriangleMesh other = bumpyMesh(0.2, 10, 14, 3);
    double reach = 0.0;
    for (const Eigen::Vector3d& v : other.vertices) reach = std::max(reach, -v.x());
    PartitionQuery query(boxMesh({20, 20, 20}), other);
    query.pose_b.translation() = Eigen::Vector3d(10.0 + reach + gap, 0.0, 0.0);
    query.makeSolid();
    const auto displacement = fcl_prob::GaussianDisplacement::fromStandardDeviations(
        Eigen::Vector3d::Constant(kDeviation), {1, 0, 0, 0});
    const ProbabilityResult result = query.run(displacement, fcl_prob_test::intervalRequest(0.01));
    CAPTURE(gap);
    REQUIRE(isCarved(result));
    const double truth = fcl_prob::normalTailMass(gap / kDeviation);
    CHECK(*result.lower <= truth);
    CHECK(*result.upper >= truth);
    // Boxes of one deviation alone would be hundreds.
    if (gap < -2.0 * kDeviation) CHECK(result.statistics.cells < 80);
  }
}

TEST_CASE("obstacles that would not fit into the memory that is allowed are not made",
          "[carving]") {
  const TriangleMesh body = hullMesh(RandomBodies(3).onSphere(30, 0.3));
  PartitionQuery query(body, bumpyMesh(0.5, 60, 80, 1));
  query.pose_b.translation() = Eigen::Vector3d(0.75, 0.1, 0.0);
  const auto displacement =
      fcl_prob::GaussianDisplacement::fromStandardDeviations({0.05, 0.08, 0.1}, {1, 0, 0, 0});
  fcl_prob::ProbabilityRequest request = fcl_prob_test::intervalRequest(0.01);
  const ProbabilityResult whole = query.run(displacement, request);
  REQUIRE(isCarved(whole));
  request.max_memory = 100'000;
  const ProbabilityResult limited = query.run(displacement, request);
  CHECK_FALSE(isCarved(limited));
  CHECK(limited.status == fcl_prob::ProbabilityStatus::memory_limit);
  CHECK(*limited.lower <= *whole.upper);
  CHECK(*limited.upper >= *whole.lower);
}
