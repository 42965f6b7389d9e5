// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Coplanar triangles in polygons: against distances from triangles, and displaced fcl::collide.
#include "scene/coplanar_triangles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <set>

#include "catch.h"
#include "geometry/surface_caps.h"
#include "partition_query.h"
#include "random_bodies.h"
#include "sampled_contact.h"

namespace {

using fcl_prob::ProbabilityResult;
using fcl_prob::TriangleMesh;
using fcl_prob::detail::FlatPolygon;
using fcl_prob_test::boxMesh;
using fcl_prob_test::hullMesh;
using fcl_prob_test::joined;
using fcl_prob_test::RandomBodies;

/// A rectangle around 0 across z, as so many by so many of two triangles each.
TriangleMesh gridMesh(double width, double depth, int columns, int rows) {
  TriangleMesh mesh;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      mesh.vertices.emplace_back(width * (1.0 * i / columns - 0.5), depth * (1.0 * j / rows - 0.5),
                                 0.0);
    }
  }
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const auto at = static_cast<std::size_t>(j * (columns + 1) + i);
      const auto above = at + static_cast<std::size_t>(columns + 1);
      mesh.triangles.emplace_back(at, at + 1, above + 1);
      mesh.triangles.emplace_back(at, above + 1, above);
    }
  }
  return mesh;
}

TriangleMesh placed(TriangleMesh mesh, const Eigen::Vector3d& axis, double angle,
                    const Eigen::Vector3d& by) {
  for (Eigen::Vector3d& v : mesh.vertices) v = Eigen::AngleAxisd(angle, axis) * v + by;
  return mesh;
}

TriangleMesh tableMesh(int cells) {
  TriangleMesh table = placed(gridMesh(0.8, 0.5, cells, cells), {0, 0, 1}, 0, {0, 0, 0.3});
  for (const double x : {-0.35, 0.35}) {
    for (const double y : {-0.2, 0.2}) {
      TriangleMesh leg = gridMesh(0.3, 0.04, 6, 1);
      table = joined(table, placed(leg, {0, 1, 0}, 1.57079632679489662, {x, y, 0.15}));
    }
  }
  return table;
}

/// What is hard on polygons: none of it is closed.
TriangleMesh coplanarMesh(int kind, RandomBodies& random) {
  const int cells = random.integer(2, 7);
  TriangleMesh mesh = gridMesh(0.6, random.uniform(0.05, 0.6), cells, random.integer(1, 6));
  auto& triangles = mesh.triangles;
  const auto any = [&] {
    return static_cast<std::size_t>(random.integer(0, static_cast<int>(triangles.size()) - 1));
  };
  switch (kind % 10) {
    case 0:
      return tableMesh(cells);
    case 1:  // holes
      for (int i = 0; i < cells; ++i) triangles.erase(triangles.begin() + any());
      return mesh;
    case 2:  // twice, and three times
      for (int i = 0; i < 2 * cells; ++i) triangles.push_back(triangles[any()]);
      return mesh;
    case 3:  // either way round
      for (fcl::Triangle& t : triangles) {
        if (random.integer(0, 1) == 0) t.set(t[0], t[2], t[1]);
      }
      return mesh;
    case 4:  // a shelf
      for (int i = 1; i < 4; ++i) {
        mesh = joined(mesh, placed(gridMesh(0.6, 0.3, cells, 3), {0, 0, 1}, 0, {0, 0, 0.15 * i}));
      }
      return mesh;
    case 5:  // folded, back onto itself or nearly so
      for (Eigen::Vector3d& v : mesh.vertices) {
        if (v.x() < 0.0) v = {-v.x(), v.y(), random.integer(0, 1) * v.x() * 1e-3};
      }
      return mesh;
    case 6:  // triangles at random in a plane, with corners in common
      triangles.clear();
      for (int i = 0; i < 12; ++i) {
        const auto corner = [&] {
          return static_cast<std::size_t>(
              random.integer(0, static_cast<int>(mesh.vertices.size()) - 1));
        };
        triangles.emplace_back(corner(), corner(), corner());
      }
      for (std::size_t i = triangles.size(); i-- > 0;) {
        const fcl::Triangle& t = triangles[i];
        const Eigen::Vector3d first = mesh.vertices[t[1]] - mesh.vertices[t[0]];
        const Eigen::Vector3d area = first.cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]);
        if (area.norm() < 1e-9) triangles.erase(triangles.begin() + i);
      }
      if (triangles.empty()) triangles.emplace_back(0, 1, mesh.vertices.size() - 1);
      return mesh;
    case 7: {  // beside a larger one that knows nothing of its corners
      const TriangleMesh one = gridMesh(0.6, 0.2, 1, 1);
      return joined(placed(one, {0, 0, 1}, 0, {0, -0.1, 0}),
                    placed(gridMesh(0.6, 0.2, cells, 2), {0, 0, 1}, 0, {0, 0.1, 0}));
    }
    case 8: {  // an open box
      TriangleMesh box = gridMesh(0.4, 0.4, cells, cells);
      for (int i = 0; i < 4; ++i) {
        const TriangleMesh wall =
            placed(gridMesh(0.4, 0.3, cells, 2), {1, 0, 0}, 1.57079632679489662, {0, -0.2, 0.15});
        box = joined(box, placed(wall, {0, 0, 1}, 1.57079632679489662 * i, {0, 0, 0}));
      }
      return box;
    }
    default:  // uneven, in its plane and across it
      for (Eigen::Vector3d& v : mesh.vertices) v += 0.02 * random.normalVector();
      return mesh;
  }
}

/// Vertices off where they were by as much as that, in half of the meshes not at all.
void disturb(TriangleMesh& mesh, RandomBodies& random) {
  if (random.integer(0, 1) == 0) return;
  const double by = random.logUniform(1e-9, 1e-2);
  for (Eigen::Vector3d& v : mesh.vertices) v += by * random.uniform(-0.3, 0.3) * random.direction();
}

double distanceToSegment(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                         const Eigen::Vector3d& b) {
  const double length = (b - a).squaredNorm();
  const double share = length > 0.0 ? std::clamp((p - a).dot(b - a) / length, 0.0, 1.0) : 0.0;
  return (p - a - share * (b - a)).norm();
}

double distanceToTriangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                          const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const Eigen::Vector3d n = (b - a).cross(c - a);
  const double nearest = std::min(
      {distanceToSegment(p, a, b), distanceToSegment(p, b, c), distanceToSegment(p, c, a)});
  const bool above = n.dot((b - a).cross(p - a)) >= 0.0 && n.dot((c - b).cross(p - b)) >= 0.0 &&
                     n.dot((a - c).cross(p - c)) >= 0.0;
  return above && n.norm() > 0.0 ? std::min(nearest, std::fabs(n.dot(p - a)) / n.norm()) : nearest;
}

Eigen::Vector3d pointAmong(const std::vector<Eigen::Vector3d>& corners, RandomBodies& random) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double weights = 0.0;
  for (const Eigen::Vector3d& corner : corners) {
    const double weight = -std::log(random.uniform(1e-12, 1.0));
    sum += weight * corner;
    weights += weight;
  }
  return sum / weights;
}

std::vector<Eigen::Vector3d> cornersOf(const TriangleMesh& mesh, int triangle) {
  const fcl::Triangle& t = mesh.triangles[triangle];
  return {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
}

std::vector<FlatPolygon> polygonsIn(const TriangleMesh& mesh) {
  using namespace fcl_prob::detail;
  return flatPolygonsIn(mesh, weldVertices(viewOf(mesh)));
}

void checkCovers(const TriangleMesh& mesh, const FlatPolygon& polygon, RandomBodies& random) {
  std::vector<Eigen::Vector3d> corners;
  for (const int v : polygon.corners) corners.push_back(mesh.vertices[v]);
  for (int i = 0; i < 40; ++i) {
    const Eigen::Vector3d p = pointAmong(corners, random);
    double nearest = 1e300;
    for (const int t : polygon.triangles) {
      const auto& of = cornersOf(mesh, t);
      nearest = std::min(nearest, distanceToTriangle(p, of[0], of[1], of[2]));
    }
    CHECK(nearest <= polygon.off + 1e-15);
  }
  for (const int t : polygon.triangles) {
    const Eigen::Vector3d p = pointAmong(cornersOf(mesh, t), random);
    double nearest = 1e300;
    for (std::size_t k = 2; k < corners.size(); ++k) {
      nearest = std::min(nearest, distanceToTriangle(p, corners[0], corners[k - 1], corners[k]));
    }
    CHECK(nearest <= 2 * polygon.off + 1e-15);
  }
}

}  // namespace

TEST_CASE("polygons hold their triangles and are covered by them", "[coplanar]") {
  RandomBodies random(41);
  std::size_t found = 0;
  std::size_t merged = 0;
  for (int scene = 0; scene < 200; ++scene) {
    TriangleMesh mesh = coplanarMesh(scene, random);
    disturb(mesh, random);
    mesh = placed(mesh, random.direction(), random.uniform(0, 3), random.normalVector());
    std::set<int> held;
    for (const FlatPolygon& polygon : polygonsIn(mesh)) {
      CAPTURE(scene, polygon.triangles.size(), polygon.corners.size(), polygon.off);
      for (const int t : polygon.triangles) CHECK(held.insert(t).second);
      CHECK(polygon.triangles.size() > 1);
      CHECK(polygon.off < 1e-5);
      checkCovers(mesh, polygon, random);
      merged += polygon.triangles.size();
      ++found;
    }
  }
  CHECK(found > 200);
  CHECK(merged > 3 * found);
}

TEST_CASE("what lies in one plane is few polygons", "[coplanar]") {
  const auto count = [](const TriangleMesh& mesh) { return polygonsIn(mesh).size(); };
  CHECK(count(gridMesh(1.0, 0.3, 100, 1)) == 1);
  CHECK(count(gridMesh(1.0, 1.0, 40, 30)) == 1);
  CHECK(count(placed(gridMesh(1.0, 1.0, 40, 30), {0.6, 0.0, 0.8}, 0.7, {3, 2, 1})) == 1);
  // Rounded to single precision.
  TriangleMesh rounded = placed(gridMesh(1.0, 1.0, 40, 30), {0.6, 0.0, 0.8}, 0.7, {0.3, 0.2, 0.1});
  for (Eigen::Vector3d& v : rounded.vertices) v = v.cast<float>().cast<double>();
  CHECK(count(rounded) == 1);
  CHECK(count(boxMesh({1, 2, 3})) == 6);
  CHECK(count(tableMesh(8)) == 5);
  // A hole amid 100 squares, a corner without one.
  TriangleMesh holed = gridMesh(1.0, 1.0, 10, 10);
  holed.triangles.erase(holed.triangles.begin() + 90, holed.triangles.begin() + 92);
  CHECK(count(holed) <= 8);
  TriangleMesh notched = gridMesh(1.0, 1.0, 10, 10);
  notched.triangles.erase(notched.triangles.begin(), notched.triangles.begin() + 2);
  CHECK(count(notched) <= 6);
  // Seen from both sides.
  TriangleMesh both = gridMesh(1.0, 0.3, 10, 3);
  both = joined(both, fcl_prob_test::reversed(both));
  CHECK(count(both) == 1);
}

TEST_CASE("how far triangles are off one plane is noticed", "[coplanar]") {
  for (const double share : {1e-12, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2}) {
    TriangleMesh mesh = gridMesh(1.0, 1.0, 4, 4);
    mesh.vertices[12].z() += share;
    CAPTURE(share);
    double most = 0.0;
    std::size_t triangles = 0;
    for (const FlatPolygon& polygon : polygonsIn(mesh)) {
      const bool holds_it =
          std::any_of(polygon.triangles.begin(), polygon.triangles.end(), [&](int t) {
            const fcl::Triangle& corners = mesh.triangles[t];
            return corners[0] == 12 || corners[1] == 12 || corners[2] == 12;
          });
      if (holds_it) most = std::max(most, polygon.off);
      triangles += polygon.triangles.size();
    }
    if (share <= 1e-7) CHECK(triangles == 32);
    if (share <= 1e-7) CHECK(most >= 0.5 * share);
    CHECK(most <= 2.1 * share + 1e-14);
    // What is as far off as this is nobody's.
    if (share >= 1e-5) CHECK(most < 1e-14);
  }
}

namespace {

void checkCoplanarScenes(int scenes, int samples, unsigned seed) {
  RandomBodies random(seed);
  int merged = 0;
  for (int i = 0; i < scenes; ++i) {
    const double size = random.logUniform(0.03, 0.3);
    const TriangleMesh body = hullMesh(random.onSphere(random.integer(6, 40), size));
    TriangleMesh other = coplanarMesh(i, random);
    disturb(other, random);
    RandomBodies draws(1000 + seed + static_cast<unsigned>(i));
    INFO("scene " << i);
    const ProbabilityResult result = fcl_prob_test::checkedInterval(
        {body, other, i % 4 == 1, false, 0.0, 0.5, 0.02, 0.15, 0.01}, random, samples, draws);
    merged += fcl_prob_test::planMentions(result, "convex polygons");
  }
  CHECK(merged > scenes / 4);
}

}  // namespace

TEST_CASE("intervals by polygons hold sampled probabilities on random scenes",
          "[coplanar][random]") {
  checkCoplanarScenes(60, 1'500, 42);
}

TEST_CASE("intervals by polygons hold sampled probabilities on 5,000 scenes",
          "[coplanar][random][long]") {
  checkCoplanarScenes(5'000, 3'000, 43);
}
