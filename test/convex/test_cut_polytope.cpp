// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Polytopes cut by planes, many of which nearly meet in a point.
#include "convex/cut_polytope.h"

#include <Eigen/LU>
#include <algorithm>

#include "base/constants.h"
#include "catch.h"
#include "random_bodies.h"

namespace {

using namespace fcl_prob;
using namespace fcl_prob_test;
using detail::CutPolytope;
using detail::FaceSet;

using LongVector = Eigen::Matrix<long double, 3, 1>;
using LongMatrix = Eigen::Matrix<long double, 3, 3>;

struct Plane {
  Eigen::Vector3d normal;
  double limit;
};

std::vector<Plane> cubePlanes() {
  std::vector<Plane> planes;
  for (int k = 0; k < 3; ++k) {
    planes.push_back({Eigen::Vector3d::Unit(k), 1.0});
    planes.push_back({-Eigen::Vector3d::Unit(k), 1.0});
  }
  return planes;
}

FaceSet cube() {
  FaceSet faces;
  setToBox(Eigen::Vector3d::Constant(-1.0), Eigen::Vector3d::Ones(), faces);
  return faces;
}

// Of a point before the planes: how far it is beyond one of them.
long double beyond(const std::vector<Plane>& planes, const LongVector& point) {
  long double most = -1e30L;
  for (const Plane& plane : planes) {
    most = std::max(most, plane.normal.cast<long double>().dot(point) - plane.limit);
  }
  return most;
}

// Corners, by trying where any three of the planes meet; what is cut at a small angle is left out.
std::vector<Eigen::Vector3d> cornersByTriples(const std::vector<Plane>& planes) {
  std::vector<Eigen::Vector3d> corners;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    for (std::size_t j = i + 1; j < planes.size(); ++j) {
      for (std::size_t k = j + 1; k < planes.size(); ++k) {
        LongMatrix normals;
        normals << planes[i].normal.cast<long double>().transpose(),
            planes[j].normal.cast<long double>().transpose(),
            planes[k].normal.cast<long double>().transpose();
        if (std::fabs(normals.determinant()) < 1e-3L) continue;
        const LongVector limits(planes[i].limit, planes[j].limit, planes[k].limit);
        const LongVector corner = normals.inverse() * limits;
        if (beyond(planes, corner) < 1e-17L) corners.push_back(corner.cast<double>());
      }
    }
  }
  return corners;
}

double highest(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& direction) {
  double most = -detail::kInfinity;
  for (const Eigen::Vector3d& p : points) most = std::max(most, direction.dot(p));
  return most;
}

}  // namespace

TEST_CASE("no corner is lost where many planes nearly meet in a point") {
  RandomBodies random(11);
  int repaired = 0;
  for (int i = 0; i < 600; ++i) {
    // Planes through one point, moved by a few roundings.
    const Eigen::Vector3d tip = 0.5 * random.direction();
    std::vector<Plane> planes = cubePlanes();
    CutPolytope polytope(cube());
    for (int k = 0; k < 24; ++k) {
      const Eigen::Vector3d n = (0.7 * tip.normalized() + random.direction()).normalized();
      if (n.dot(tip) < 0.1) continue;
      planes.push_back({n, n.dot(tip) + 1e-16 * std::floor(random.uniform(-4.0, 4.0))});
      const double wrong_side = polytope.cut(n, planes.back().limit);
      CHECK(wrong_side < 1e-15);
      repaired += wrong_side > 0.0 ? 1 : 0;
    }
    FaceSet faces;
    polytope.writeTo(faces);
    CAPTURE(i);
    CHECK(faces.closed());
    for (const Eigen::Vector3d& v : faces.vertices()) {
      CHECK(beyond(planes, v.cast<long double>()) < 1e-14L);
    }
    const std::vector<Eigen::Vector3d> corners = cornersByTriples(planes);
    for (int k = 0; k < 20; ++k) {
      const Eigen::Vector3d u = random.direction();
      CHECK(highest(faces.vertices(), u) > highest(corners, u) - 1e-12);
    }
  }
  CHECK(repaired > 2);
}

TEST_CASE("planes through edges and corners of a cube leave it whole, or closed") {
  for (const Eigen::Vector3d& n : {Eigen::Vector3d(1, 1, 0), Eigen::Vector3d(1, 1, 1)}) {
    for (const double limit : {n.sum(), n.sum() * (1 - 1e-16), n.sum() - 1.0, 0.0, -n.sum()}) {
      CutPolytope polytope(cube());
      CHECK(polytope.cut(n, limit) == 0.0);
      FaceSet faces;
      polytope.writeTo(faces);
      CHECK(faces.closed());
      CHECK(highest(faces.vertices(), n) == Approx(limit));
    }
  }
}

TEST_CASE("nothing is left beyond all of a polytope, and a two-sided polygon stays one") {
  CutPolytope polytope(cube());
  CHECK(polytope.cut(Eigen::Vector3d::UnitX(), -2.0) == 0.0);
  FaceSet faces;
  polytope.writeTo(faces);
  CHECK(faces.faceCount() == 0);

  FaceSet square;
  for (const double x : {0.0, 1.0}) {
    for (const double y : {0.0, 1.0}) square.addVertex({x, y, 0.0});
  }
  square.addFace({0, 2, 3, 1});
  square.addFace({1, 3, 2, 0});
  polytope.start(square);
  CHECK(polytope.cut(Eigen::Vector3d(1, 1, 0), 0.5) == 0.0);
  polytope.writeTo(faces);
  CHECK(faces.faceCount() == 2);
  CHECK(faces.closed());
  CHECK(highest(faces.vertices(), Eigen::Vector3d::UnitX()) == Approx(0.5));
}

TEST_CASE("a surface that is not closed is not cut") {
  FaceSet whole = cube(), open;
  for (const Eigen::Vector3d& v : whole.vertices()) open.addVertex(v);
  for (std::size_t f = 1; f < whole.faceCount(); ++f) {
    open.beginFace();
    for (int k = 0; k < whole.cornerCount(f); ++k) open.addCorner(whole.corner(f, k));
  }
  const Eigen::Vector3d across = whole.position(0, 1) - whole.position(0, 0);
  CutPolytope polytope(open);
  CHECK(polytope.cut(across, 0.0) == detail::kInfinity);
  FaceSet faces;
  polytope.writeTo(faces);
  CHECK(faces.faceCount() == 5);
  CHECK(highest(faces.vertices(), across) == highest(whole.vertices(), across));
}
