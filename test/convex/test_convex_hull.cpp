// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <set>
#include <thread>

#include "catch.h"
#include "fcl_prob/convex_polytope.h"
#include "fcl_prob/exceptions.h"

namespace fcl_prob {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

double uniform(std::mt19937& random, double lo, double hi) {
  return std::uniform_real_distribution<double>(lo, hi)(random);
}

Vector3d randomVector(std::mt19937& random) {
  std::normal_distribution<double> normal;
  const double x = normal(random), y = normal(random), z = normal(random);
  return {x, y, z};
}

Matrix3d randomRotation(std::mt19937& random) {
  const Vector3d axis = randomVector(random).normalized();
  return Eigen::AngleAxisd(uniform(random, 0, 3), axis).toRotationMatrix();
}

Points cubeCorners() {
  Points corners;
  for (int k = 0; k < 8; ++k) corners.emplace_back(k & 1, (k >> 1) & 1, (k >> 2) & 1);
  return corners;
}

Points transformed(const Points& points, const Matrix3d& matrix, const Vector3d& shift) {
  Points result;
  for (const Vector3d& p : points) result.push_back(matrix * p + shift);
  return result;
}

double largestCoordinate(const Points& points) {
  double largest = 0;
  for (const Vector3d& p : points) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  return largest;
}

// Of the image under `to_unit`, which undoes a stretch that would drown the volume in rounding.
double volume(const ConvexPolytope& hull, const Matrix3d& to_unit = Matrix3d::Identity()) {
  const Vector3d apex = hull.vertices.front();
  double six_volumes = 0;
  for (const auto& face : hull.faces) {
    const auto at = [&](std::size_t k) -> Vector3d {
      return to_unit * (hull.vertices[face.vertices[k]] - apex);
    };
    for (std::size_t k = 2; k < face.vertices.size(); ++k) {
      six_volumes += at(0).dot(at(k - 1).cross(at(k)));
    }
  }
  return six_volumes / 6;
}

// Everything that ConvexPolytope promises, to `tolerance` (a length).
void requireHull(const ConvexPolytope& hull, const Points& points, double tolerance,
                 const Matrix3d& to_unit = Matrix3d::Identity()) {
  std::set<std::pair<int, int>> edges;
  for (const auto& face : hull.faces) {
    REQUIRE(face.vertices.size() >= 3);
    REQUIRE(face.normal.norm() == Approx(1).epsilon(1e-14));
    for (std::size_t k = 0; k < face.vertices.size(); ++k) {
      const int from = face.vertices[k];
      const int to = face.vertices[(k + 1) % face.vertices.size()];
      REQUIRE(edges.emplace(from, to).second);
      REQUIRE(face.normal.dot(hull.vertices[from]) <= face.offset);
      REQUIRE(face.normal.dot(hull.vertices[from]) >= face.offset - tolerance);
    }
    for (const Vector3d& p : points) REQUIRE(face.normal.dot(p) <= face.offset);
  }
  for (const auto& [from, to] : edges) REQUIRE(edges.count({to, from}) == 1);
  const int euler = static_cast<int>(hull.vertices.size()) - static_cast<int>(edges.size() / 2) +
                    static_cast<int>(hull.faces.size());
  REQUIRE(euler == 2);
  REQUIRE(volume(hull, to_unit) > 0);  // counter-clockwise seen from outside
}

}  // namespace

TEST_CASE("the hull of a cube has six faces of four vertices") {
  Points points = cubeCorners();
  points.insert(points.begin(), Vector3d(0.5, 0.5, 0.5));  // inside
  points.push_back({0.5, 0.25, 0});                        // in a face
  points.push_back({0.5, 0, 0});                           // in an edge
  points.push_back({1, 1, 1});                             // twice
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    const double size = std::pow(10.0, uniform(random, -9, 9));
    const Points moved = transformed(points, size * randomRotation(random),
                                     size * uniform(random, 0, 100) * randomVector(random));
    const ConvexPolytope hull = convexHull(moved);
    CHECK(hull.vertices.size() == 8);
    CHECK(hull.faces.size() == 6);
    for (const auto& face : hull.faces) CHECK(face.vertices.size() == 4);
    requireHull(hull, moved, 1e-14 * largestCoordinate(moved));
    CHECK(volume(hull) == Approx(size * size * size).epsilon(1e-10));
  }
}

TEST_CASE("hulls of random points contain them") {
  std::mt19937 random(2);
  for (int i = 0; i < 100; ++i) {
    Points points;
    const int count = 4 + i % 60;
    for (int k = 0; k < count; ++k) {
      points.push_back(i % 2 == 0 ? randomVector(random) : randomVector(random).normalized());
    }
    const ConvexPolytope hull = convexHull(points);
    requireHull(hull, points, 1e-14);
    if (i % 2 == 1) CHECK(hull.vertices.size() == points.size());
  }
}

TEST_CASE("hulls with many coplanar, collinear and equal points are closed and merged") {
  std::mt19937 random(3);
  int flat = 0, solid = 0;
  for (int i = 0; i < 1000; ++i) {
    Points points;
    const int count = 1 + static_cast<int>(random() % 40);
    for (int k = 0; k < count; ++k) {
      points.emplace_back(random() % 3, random() % 3, random() % (1 + i % 4));
    }
    if (i % 2 == 0) points = transformed(points, randomRotation(random), randomVector(random));
    const ConvexPolytope hull = convexHull(points);
    REQUIRE(!hull.vertices.empty());
    if (hull.faces.empty()) {
      ++flat;
      continue;
    }
    ++solid;
    requireHull(hull, points, 1e-14);
    // Merged: no two faces in one plane.
    for (std::size_t a = 0; a < hull.faces.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        REQUIRE(hull.faces[a].normal.dot(hull.faces[b].normal) < 1 - 1e-6);
      }
    }
  }
  CHECK(flat > 100);
  CHECK(solid > 400);
}

TEST_CASE("stretched bodies keep their faces, down to a thickness of 1e-12") {
  std::mt19937 random(4);
  for (int i = 0; i < 300; ++i) {
    const Vector3d size(1, std::pow(10.0, uniform(random, -12, 0)),
                        std::pow(10.0, uniform(random, -12, 0)));
    const Points box = transformed(cubeCorners(), size.asDiagonal(), Vector3d::Zero());
    const ConvexPolytope hull = convexHull(box);
    CHECK(hull.vertices.size() == 8);
    CHECK(hull.faces.size() == 6);
    requireHull(hull, box, 1e-15);
    CHECK(volume(hull) == Approx(size.prod()).epsilon(1e-12));

    const Matrix3d rotation = randomRotation(random);
    const Points turned = transformed(box, rotation, Vector3d::Zero());
    const ConvexPolytope turned_hull = convexHull(turned);
    REQUIRE(!turned_hull.faces.empty());
    const Matrix3d to_unit = size.cwiseInverse().asDiagonal() * rotation.transpose();
    requireHull(turned_hull, turned, 1e-14, to_unit);
    CHECK(volume(turned_hull, to_unit) == Approx(1).epsilon(0.05));
  }
}

TEST_CASE("point sets without volume give their extreme points and no faces") {
  std::mt19937 random(5);
  for (int i = 0; i < 200; ++i) {
    const Vector3d shift = randomVector(random);
    const Vector3d along = randomVector(random);
    CHECK(convexHull({shift}).vertices == Points{shift});
    CHECK(convexHull({shift, shift, shift}).vertices == Points{shift});

    const ConvexPolytope segment =
        convexHull({shift, shift + along, shift + 0.5 * along, shift - along});
    CHECK(segment.faces.empty());
    CHECK(segment.vertices.size() == 2);

    Points square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0}, {0.25, 0.75, 0}};
    square = transformed(square, randomRotation(random), Vector3d::Zero());
    const ConvexPolytope polygon = convexHull(square);
    CHECK(polygon.faces.empty());
    CHECK(polygon.vertices.size() == 4);
  }
}

TEST_CASE("a hull of nothing or of a non-finite point is refused") {
  CHECK_THROWS_AS(convexHull({}), InvalidGeometry);
  const double nan = std::nan("");
  CHECK_THROWS_AS(convexHull({{0, 0, 0}, {0, nan, 0}}), InvalidGeometry);
  CHECK_THROWS_WITH(convexHull({{0, 0, 0}, {0, nan, 0}}), Catch::Matchers::Contains("(0, nan, 0)"));
}

TEST_CASE("hulls can be built on several threads at once") {
  const auto work = [](unsigned seed) {
    std::mt19937 random(seed);
    double sum = 0;
    for (int i = 0; i < 50; ++i) {
      Points points;
      for (int k = 0; k < 30; ++k) points.push_back(randomVector(random));
      sum += volume(convexHull(points));
      points.assign(10, points.front());
      sum += static_cast<double>(convexHull(points).vertices.size());
    }
    return sum;
  };
  constexpr unsigned kThreads = 4;
  std::vector<double> alone, together(kThreads);
  std::vector<std::thread> threads;
  for (unsigned k = 0; k < kThreads; ++k) {
    alone.push_back(work(k));
    threads.emplace_back([&, k] { together[k] = work(k); });
  }
  for (std::thread& thread : threads) thread.join();
  CHECK(alone == together);
}

}  // namespace fcl_prob
