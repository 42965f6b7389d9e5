// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <algorithm>

#include "catch.h"
#include "decomposition/cover_proof.h"
#include "decomposition/solid_cover_proof.h"
#include "fcl_prob/convex_parts.h"
#include "fcl_prob/exceptions.h"
#include "mesh_shapes.h"
#include "random_bodies.h"

namespace {

using Eigen::Vector3d;
using fcl_prob::ConvexParts;
using fcl_prob::ConvexPolytope;
using fcl_prob::DecompositionRequest;
using fcl_prob::TriangleMesh;
using namespace fcl_prob_test;

constexpr fcl_prob::detail::CoverMargins kMargins{1.28e-11, 1.6e-11};

DecompositionRequest quick(std::size_t parts = 8) {
  DecompositionRequest request;
  request.max_parts = parts;
  request.pieces = 2 * parts;
  return request;
}

bool contains(const ConvexPolytope& polytope, const Vector3d& point) {
  return std::all_of(polytope.faces.begin(), polytope.faces.end(),
                     [&](const auto& face) { return face.normal.dot(point) <= face.offset; });
}

bool contains(const ConvexParts& parts, const Vector3d& point) {
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (contains(parts.polytope(i), point)) return true;
  }
  return false;
}

Vector3d pointOnTriangle(const TriangleMesh& mesh, RandomBodies& random) {
  const auto& triangle =
      mesh.triangles[random.integer(0, static_cast<int>(mesh.triangles.size()) - 1)];
  double u = random.uniform(0, 1), v = random.uniform(0, 1);
  if (u + v > 1) u = 1 - u, v = 1 - v;
  const Vector3d a = mesh.vertices[triangle[0]];
  return a + u * (mesh.vertices[triangle[1]] - a) + v * (mesh.vertices[triangle[2]] - a);
}

void checkPointsOnSurface(const TriangleMesh& mesh, const ConvexParts& parts) {
  RandomBodies random(7);
  int missed = 0;
  for (int i = 0; i < 20'000; ++i) missed += !contains(parts, pointOnTriangle(mesh, random));
  CHECK(missed == 0);
}

double volumeOf(const ConvexParts& parts) {
  double sum = 0.0;
  for (std::size_t i = 0; i < parts.size(); ++i) sum += parts.volume(i);
  return sum;
}

std::vector<ConvexPolytope> polytopesOf(const ConvexParts& parts) {
  std::vector<ConvexPolytope> polytopes;
  for (std::size_t i = 0; i < parts.size(); ++i) polytopes.push_back(parts.polytope(i));
  return polytopes;
}

/// Boxes thicker than those that they stand for, so that neighbours overlap.
ConvexPolytope boxPart(const Vector3d& lower, const Vector3d& upper) {
  constexpr double kThicker = 1e-10;
  std::vector<Vector3d> corners;
  for (int i = 0; i < 8; ++i) {
    Vector3d corner;
    for (int k = 0; k < 3; ++k) corner[k] = i >> k & 1 ? upper[k] + kThicker : lower[k] - kThicker;
    corners.push_back(corner);
  }
  return fcl_prob::convexHull(corners);
}

/// Six plates around the middle of the box from -1 to 1, which they leave out from -1/2 to 1/2.
std::vector<ConvexPolytope> platesAroundMiddle() {
  std::vector<ConvexPolytope> plates;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      Vector3d lower = Vector3d::Constant(-1.0), upper = Vector3d::Ones();
      (sign < 0.0 ? upper : lower)[axis] = 0.5 * sign;
      plates.push_back(boxPart(lower, upper));
    }
  }
  return plates;
}

bool solidIsCovered(const TriangleMesh& mesh, const std::vector<ConvexPolytope>& parts) {
  using namespace fcl_prob::detail;
  REQUIRE_FALSE(firstUncovered(mesh, parts, kMargins).has_value());
  return fcl_prob::detail::solidIsCovered(mesh, ClosedMesh(viewOf(mesh), "mesh"), parts, kMargins);
}

TriangleMesh angle() {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Vector3d(0.6, 0.5, 0.0);
  return joined(boxMesh({0.2, 2.0, 0.3}), transformed(boxMesh({1.0, 0.2, 0.3}), pose));
}

}  // namespace

TEST_CASE("a convex mesh is one part", "[decomposition]") {
  for (const TriangleMesh& mesh : {boxMesh({1, 2, 3}), sphereMesh(0.7, 12, 20)}) {
    const ConvexParts parts(mesh, quick());
    CHECK(parts.size() == 1);
    checkPointsOnSurface(mesh, parts);
  }
}

TEST_CASE("two boxes beside each other are two parts without anything between", "[decomposition]") {
  const TriangleMesh mesh = angle();
  const ConvexParts parts(mesh, quick());
  CHECK(parts.size() == 2);
  CHECK(volumeOf(parts) == Approx(2.0 * 0.2 * 0.3 + 1.0 * 0.2 * 0.3).epsilon(1e-8));
  checkPointsOnSurface(mesh, parts);
}

TEST_CASE("parts cover the surface, and the inside of a closed one", "[decomposition]") {
  const TriangleMesh torus = torusMesh(1.0, 0.3, 30, 16);
  const TriangleMesh bumpy = bumpyMesh(1.0, 16, 24, 3);
  Eigen::Isometry3d far = Eigen::Isometry3d::Identity();
  far.translation() = Vector3d(1e3, -2e3, 5e2);
  const std::vector<TriangleMesh> meshes{torus, bumpy, transformed(bumpy, far)};
  for (const TriangleMesh& mesh : meshes) {
    const ConvexParts parts(mesh, quick());
    CHECK(parts.size() > 2);
    CHECK(parts.coversSolid());
    CHECK(parts.size() <= 8);
    checkPointsOnSurface(mesh, parts);
  }
  const ConvexParts parts(torus, quick());
  RandomBodies random(11);
  int missed = 0;
  for (int i = 0; i < 5'000; ++i) {
    const double along = random.uniform(0, 2 * M_PI), around = random.uniform(0, 2 * M_PI);
    const double radius = 0.29 * random.uniform(0, 0.95);
    const double distance = 1.0 + radius * std::cos(around);
    missed += !contains(
        parts, {distance * std::cos(along), distance * std::sin(along), radius * std::sin(around)});
  }
  CHECK(missed == 0);
}

TEST_CASE("more parts fit better", "[decomposition][slow]") {
  const TriangleMesh bumpy = bumpyMesh(1.0, 16, 24, 3);
  double before = 1e300, first = 0.0;
  for (const std::size_t count : {1, 2, 4, 12}) {
    DecompositionRequest request;
    request.max_parts = count;
    request.pieces = 24;
    const ConvexParts parts(bumpy, request);
    CHECK(parts.size() <= count);
    CHECK(volumeOf(parts) < before);
    before = volumeOf(parts);
    if (count == 1) first = before;
  }
  CHECK(before < 0.95 * first);
}

TEST_CASE("the same mesh gives the same parts, at any scale", "[decomposition]") {
  const TriangleMesh mesh = bumpyMesh(1.0, 10, 14, 5);
  const ConvexParts first(mesh, quick());
  const ConvexParts second(mesh, quick());
  REQUIRE(first.size() == second.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    CHECK(first.polytope(i).vertices == second.polytope(i).vertices);
  }
  for (const double scale : {0x1p-100, 0x1p60}) {
    TriangleMesh scaled = mesh;
    for (auto& v : scaled.vertices) v *= scale;
    const ConvexParts parts(scaled, quick());
    REQUIRE(parts.size() == first.size());
    CHECK(parts.polytope(0).vertices[0] == scale * first.polytope(0).vertices[0]);
  }
}

TEST_CASE("flat and degenerate meshes have parts with faces", "[decomposition]") {
  TriangleMesh flat = boxMesh({1, 1, 1});
  for (auto& v : flat.vertices) v.z() = 0.0;
  TriangleMesh line = flat;
  for (auto& v : line.vertices) v.y() = 0.0;
  TriangleMesh point = line;
  for (auto& v : point.vertices) v = Vector3d(1, 2, 3);
  for (const TriangleMesh& mesh : {flat, line, point}) {
    const ConvexParts parts(mesh, quick());
    CHECK(parts.size() == 1);
    CHECK(parts.polytope(0).faces.size() >= 4);
    checkPointsOnSurface(mesh, parts);
  }
}

TEST_CASE("the proof of the cover fails where a part is missing or moved", "[decomposition]") {
  const TriangleMesh mesh = torusMesh(1.0, 0.3, 24, 12);
  const std::vector<ConvexPolytope> all = polytopesOf(ConvexParts(mesh, quick()));
  REQUIRE_FALSE(fcl_prob::detail::firstUncovered(mesh, all, kMargins).has_value());
  for (std::size_t missing = 0; missing < all.size(); ++missing) {
    std::vector<ConvexPolytope> others = all;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(missing));
    CHECK(fcl_prob::detail::firstUncovered(mesh, others, kMargins).has_value());

    std::vector<ConvexPolytope> moved = all;
    for (Vector3d& v : moved[missing].vertices) v *= 1.0 - 1e-9;
    CHECK(fcl_prob::detail::firstUncovered(mesh, moved, kMargins).has_value());
  }
}

TEST_CASE("plates that cover a surface cover the solid only where nothing is left inside",
          "[decomposition]") {
  const TriangleMesh box = boxMesh({2, 2, 2});
  const std::vector<ConvexPolytope> plates = platesAroundMiddle();
  CHECK_FALSE(solidIsCovered(box, plates));
  std::vector<ConvexPolytope> filled = plates;
  filled.push_back(boxPart({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}));
  CHECK(solidIsCovered(box, filled));
  filled.back() = boxPart({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5 - 1e-6});
  CHECK_FALSE(solidIsCovered(box, filled));

  const TriangleMesh hollow = joined(box, reversed(boxMesh({1.1, 1.1, 1.1})));
  CHECK(solidIsCovered(hollow, plates));
  const TriangleMesh twice = joined(box, boxMesh({1.1, 1.1, 1.1}));
  CHECK_FALSE(solidIsCovered(twice, plates));
}

TEST_CASE("parts say whether they cover the solid", "[decomposition]") {
  const TriangleMesh bumpy = bumpyMesh(1.0, 12, 16, 5);
  CHECK(ConvexParts(bumpy, quick()).coversSolid());
  CHECK(ConvexParts(reversed(bumpy), quick()).coversSolid());
  CHECK(ConvexParts(joined(boxMesh({1, 1, 1}), reversed(boxMesh({0.5, 0.5, 0.5}))), quick())
            .coversSolid());
  TriangleMesh open = bumpy;
  open.triangles.pop_back();
  CHECK_FALSE(ConvexParts(open, quick()).coversSolid());
}

TEST_CASE("a ring is cut although no single cut makes its hulls smaller", "[decomposition]") {
  const TriangleMesh torus = torusMesh(1.0, 0.2, 40, 16);
  DecompositionRequest request;
  request.max_parts = 12;
  request.pieces = 24;
  const ConvexParts parts(torus, request);
  const double hull = volumeOf(ConvexParts(torus, quick(1)));
  const double ring = 2.0 * M_PI * M_PI * 0.2 * 0.2;
  CHECK(volumeOf(parts) < 1.35 * ring);
  CHECK(hull > 3.0 * ring / 2.0);
  CHECK(parts.coversSolid());
  checkPointsOnSurface(torus, parts);
}

TEST_CASE("parts of somebody else's are proven, or refused", "[decomposition]") {
  using Points = std::vector<Vector3d>;
  const TriangleMesh torus = torusMesh(1.0, 0.3, 24, 12);
  for (const double scale : {1.0, 1e-3, 1e6}) {
    TriangleMesh mesh = torus;
    for (Vector3d& v : mesh.vertices) v *= scale;
    std::vector<Points> points;
    const ConvexParts found(mesh, quick());
    for (const ConvexPolytope& part : polytopesOf(found)) points.push_back(part.vertices);
    const ConvexParts proven(mesh, points);
    CHECK(proven.size() == found.size());
    CHECK(proven.coversSolid() == found.coversSolid());
    CHECK(proven.unions() == found.unions());
    CHECK(volumeOf(proven) == Approx(volumeOf(found)).epsilon(1e-8));
    checkPointsOnSurface(mesh, proven);
    for (std::size_t missing = 0; missing < points.size(); ++missing) {
      std::vector<Points> others = points;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(missing));
      CHECK_THROWS_AS(ConvexParts(mesh, others), fcl_prob::InvalidGeometry);
    }
  }
  // As others write them: corners of the mesh, parts that share a face, far more than is needed.
  const TriangleMesh box = boxMesh({2, 2, 2});
  const auto half = [](double from, double to) {
    Points points;
    for (int i = 0; i < 8; ++i) {
      points.emplace_back(i & 1 ? from : to, i & 2 ? -1.0 : 1.0, i & 4 ? -1.0 : 1.0);
    }
    return points;
  };
  CHECK(ConvexParts(box, {half(-1, 0.25), half(0.25, 1)}).coversSolid());
  CHECK(ConvexParts(box, {half(-100, 100)}).size() == 1);
  CHECK_THROWS_AS(ConvexParts(box, {half(-1, 0.2), half(0.25, 1)}), fcl_prob::InvalidGeometry);
  CHECK_THROWS_AS(ConvexParts(box, {half(-1, 1), {}}), fcl_prob::InvalidGeometry);
  CHECK_THROWS_AS(ConvexParts(box, {half(-1, std::nan(""))}), fcl_prob::InvalidGeometry);
  CHECK_THROWS_AS(ConvexParts(box, std::vector<Points>()), fcl_prob::InvalidRequest);
  // One that is flat adds nothing, and does no harm.
  CHECK(ConvexParts(box, {half(-1, 1), half(0.5, 0.5), {Vector3d(0, 0, 0)}}).size() == 3);
}

TEST_CASE("requests that make no sense are refused", "[decomposition]") {
  using fcl_prob::InvalidRequest;
  const TriangleMesh mesh = boxMesh({1, 1, 1});
  DecompositionRequest request;
  request.max_parts = 0;
  CHECK_THROWS_AS(ConvexParts(mesh, request), InvalidRequest);
  request = {};
  request.pieces = 3;
  CHECK_THROWS_AS(ConvexParts(mesh, request), InvalidRequest);
  request = {};
  request.concavity = -1.0;
  CHECK_THROWS_AS(ConvexParts(mesh, request), InvalidRequest);
  TriangleMesh broken = mesh;
  broken.vertices[0].x() = std::nan("");
  CHECK_THROWS_AS(ConvexParts(broken), fcl_prob::InvalidGeometry);
  // Where doubles end nothing can be moved outwards.
  for (const double size : {1e-280, 1e100}) {
    CHECK(ConvexParts(boxMesh({size, size, size})).coversSolid());
  }
  for (const double size : {1e-295, 1e-314, 1e-323}) {
    CHECK_THROWS_AS(ConvexParts(boxMesh({size, size, size})), fcl_prob::InvalidGeometry);
  }
}
