// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <random>

#include "catch.h"
#include "closed_meshes.h"
#include "fcl_prob/exceptions.h"
#include "geometry/closed_mesh.h"
#include "mesh_shapes.h"

using namespace fcl_prob::detail;
using namespace fcl_prob_test;

namespace {

using Model = fcl::BVHModel<fcl::OBBRSSd>;

std::optional<std::string> openness(const TriangleMesh& mesh) {
  return opennessOf(meshView(*makeModel<fcl::OBBRSSd>(mesh)));
}

Eigen::Isometry3d moved(double x, double y, double z) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

}  // namespace

TEST_CASE("closed meshes are recognised") {
  CHECK_FALSE(openness(boxMesh({1, 2, 3})));
  CHECK_FALSE(openness(sphereMesh(1, 8, 12)));
  CHECK_FALSE(openness(torusMesh(1, 0.3, 12, 8)));
  CHECK_FALSE(openness(reversed(boxMesh({1, 1, 1}))));
}

TEST_CASE("vertices of equal coordinates are one vertex") {
  const TriangleMesh box = boxMesh({1, 2, 3});
  TriangleMesh soup;
  for (const auto& t : box.triangles) {
    for (int k = 0; k < 3; ++k) soup.vertices.push_back(box.vertices[t[k]]);
    const std::size_t n = soup.vertices.size();
    soup.triangles.emplace_back(n - 3, n - 2, n - 1);
  }
  CHECK_FALSE(openness(soup));
  CHECK(closedMesh(soup).contains({0.4, 0.9, 1.4}) == Containment::inside);
  soup.vertices[0][0] = std::nextafter(soup.vertices[0][0], 2.0);
  CHECK(openness(soup));
}

TEST_CASE("open, branching and twisted meshes are refused by name of the edge") {
  TriangleMesh hole = sphereMesh(1, 8, 12);
  hole.triangles.pop_back();
  REQUIRE(openness(hole));
  CHECK_THAT(*openness(hole), Catch::Matchers::Contains("one face only"));
  CHECK_THROWS_AS(closedMesh(hole), fcl_prob::OpenMesh);

  TriangleMesh fin = boxMesh({1, 1, 1});
  fin.vertices.push_back({2, 2, 2});
  fin.triangles.emplace_back(0, 1, fin.vertices.size() - 1);
  CHECK_THAT(*openness(fin), Catch::Matchers::Contains("face"));

  TriangleMesh twisted = boxMesh({1, 1, 1});
  std::swap(twisted.triangles[3][0], twisted.triangles[3][1]);
  CHECK_THAT(*openness(twisted), Catch::Matchers::Contains("same direction"));
}

TEST_CASE("a degenerate triangle neither closes nor opens a mesh") {
  TriangleMesh box = boxMesh({1, 1, 1});
  box.triangles.emplace_back(0, 0, 1);
  CHECK_FALSE(openness(box));
}

TEST_CASE("containment in a box mesh agrees with the box") {
  std::mt19937_64 generator(11);
  std::uniform_real_distribution<double> coordinate(-1.5, 1.5);
  const Eigen::Vector3d sides(1, 2, 1.5);
  const ClosedMesh mesh = closedMesh(boxMesh(sides));
  int inside = 0;
  const int count = 20000;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d p(coordinate(generator), coordinate(generator), coordinate(generator));
    const bool expected = (p.cwiseAbs().array() <= 0.5 * sides.array()).all();
    inside += expected;
    REQUIRE(mesh.contains(p) == (expected ? Containment::inside : Containment::outside));
  }
  CHECK(inside > count / 20);
  CHECK(inside < count / 2);
}

TEST_CASE("containment in a torus agrees with its faceted cross-sections") {
  std::mt19937_64 generator(12);
  std::uniform_real_distribution<double> coordinate(-1.4, 1.4);
  const ClosedMesh mesh = closedMesh(torusMesh(1, 0.3, 96, 64));
  int inside = 0;
  int outside = 0;
  for (int i = 0; i < 20000; ++i) {
    const Eigen::Vector3d p(coordinate(generator), coordinate(generator),
                            0.3 * coordinate(generator));
    const double tube = std::hypot(std::hypot(p[0], p[1]) - 1.0, p[2]);
    if (std::abs(tube - 0.3) < 0.005) continue;  // between the facets and the round torus
    const bool expected = tube < 0.3;
    (expected ? inside : outside) += 1;
    REQUIRE(mesh.contains(p) == (expected ? Containment::inside : Containment::outside));
  }
  CHECK(inside > 1000);
  CHECK(outside > 1000);
}

TEST_CASE("points on the surface are never certain, points an ulp-scale away always right") {
  const TriangleMesh box = boxMesh({1, 1, 1});
  const ClosedMesh mesh = closedMesh(box);
  for (const auto& vertex : box.vertices) CHECK(mesh.contains(vertex) == Containment::unknown);
  CHECK(mesh.contains({0.5, 0.1, 0.2}) == Containment::unknown);
  CHECK(mesh.contains({0.5 + 1e-12, 0.1, 0.2}) == Containment::outside);
  CHECK(mesh.contains({0.5 - 1e-12, 0.1, 0.2}) == Containment::inside);
}

TEST_CASE(
    "far from the origin the uncertain layer grows with the coordinates and nothing is wrong") {
  const Eigen::Vector3d offset(1e6, -2e6, 3e6);
  const ClosedMesh mesh = closedMesh(transformed(boxMesh({1, 1, 1}), moved(1e6, -2e6, 3e6)));
  CHECK(mesh.contains(offset + Eigen::Vector3d(0.49, 0.3, 0.2)) == Containment::inside);
  CHECK(mesh.contains(offset + Eigen::Vector3d(0.51, 0.3, 0.2)) == Containment::outside);
  CHECK(mesh.contains({0, 0, 0}) == Containment::outside);
}

TEST_CASE("shells: cavities, overlapping shells, inside-out meshes, parts") {
  const TriangleMesh outer = boxMesh({2, 2, 2});
  const TriangleMesh inner = boxMesh({1, 1, 1});
  const ClosedMesh hollow = closedMesh(joined(outer, reversed(inner)));
  CHECK(hollow.contains({0, 0, 0}) == Containment::outside);
  CHECK(hollow.contains({0.75, 0, 0}) == Containment::inside);
  CHECK(hollow.partPoints().size() == 2);

  const ClosedMesh overlapping = closedMesh(joined(outer, transformed(outer, moved(1, 0.5, 0.3))));
  CHECK(overlapping.contains({0.5, 0.1, 0.2}) == Containment::inside);
  CHECK(overlapping.contains({1.5, 0.1, 0.2}) == Containment::inside);
  CHECK(overlapping.contains({2.5, 0.1, 0.2}) == Containment::outside);

  const ClosedMesh inside_out = closedMesh(reversed(outer));
  CHECK(inside_out.contains({0.3, 0, 0}) == Containment::inside);
  CHECK(inside_out.contains({1.3, 0, 0}) == Containment::outside);
  CHECK(inside_out.partPoints().size() == 1);
}

TEST_CASE("triangles with equal corners are parts of the surface") {
  TriangleMesh mesh = joined(boxMesh({1, 1, 1}), transformed(boxMesh({1, 1, 1}), moved(5, 0, 0)));
  mesh.vertices.push_back({9, 9, 9});
  mesh.vertices.push_back({8, 8, 8});
  mesh.vertices.push_back({7, 7, 7});  // of no triangle
  mesh.triangles.emplace_back(16, 16, 16);
  mesh.triangles.emplace_back(17, 17, 17);
  mesh.triangles.emplace_back(0, 0, 1);  // hangs together with the first box
  const ClosedMesh solid = closedMesh(mesh);
  REQUIRE(solid.partPoints().size() == 4);
  CHECK(solid.partOfVertex().size() == mesh.vertices.size());
  CHECK(solid.partOfVertex().back() == -1);
  for (std::size_t v = 0; v + 1 < mesh.vertices.size(); ++v) {
    const Eigen::Vector3d& point = solid.partPoints()[solid.partOfVertex()[v]];
    CHECK((point - mesh.vertices[v]).norm() < 2);
  }
}

TEST_CASE("points that are known with an error are certain only that far from the surface") {
  std::mt19937_64 generator(13);
  std::uniform_real_distribution<double> coordinate(-1.5, 1.5);
  const ClosedMesh mesh = closedMesh(boxMesh({1, 2, 1.5}));
  const Eigen::Vector3d half(0.5, 1, 0.75);
  int certain = 0;
  for (int i = 0; i < 5000; ++i) {
    const Eigen::Vector3d p(coordinate(generator), coordinate(generator), coordinate(generator));
    const Eigen::Vector3d outside = p.cwiseAbs() - half;
    const double depth = outside.maxCoeff();
    const double error = 0.01;
    const Containment containment = mesh.contains(p, error);
    if (depth > -error && (outside.array() < error).all()) {
      REQUIRE(containment == Containment::unknown);
    } else if (containment != Containment::unknown) {
      REQUIRE(containment == (depth < 0 ? Containment::inside : Containment::outside));
      ++certain;
    }
  }
  CHECK(certain > 500);
}

TEST_CASE("containment at scales at which products leave the normal numbers") {
  std::mt19937_64 generator(14);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  for (const double scale : {1e-120, 1e-150, 1e-156, 1e-158, 1e-160, 1e-165, 1e120}) {
    const ClosedMesh mesh = closedMesh(boxMesh({scale, scale, scale}));
    for (int i = 0; i < 500; ++i) {
      const Eigen::Vector3d p(coordinate(generator), coordinate(generator), coordinate(generator));
      const bool expected = p.cwiseAbs().maxCoeff() < 0.5;
      const Containment containment = mesh.contains(scale * p);
      if (containment == Containment::unknown) continue;
      REQUIRE(containment == (expected ? Containment::inside : Containment::outside));
    }
  }
}

TEST_CASE("points that are not finite are unknown") {
  const ClosedMesh mesh = closedMesh(boxMesh({1, 1, 1}));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(mesh.contains({nan, 0, 0}) == Containment::unknown);
}
