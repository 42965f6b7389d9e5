// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The oracle against every subset of corners that may hold the origin, in whole numbers: corners on
// a small lattice touch, overlap, align and degenerate often.
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>

#include "catch.h"
#include "mesh_shapes.h"
#include "oracle/oracle.h"
#include "random_bodies.h"

using namespace fcl_prob_test;
using oracle::Contact;
using oracle::Scene;
using oracle::Verdict;

namespace {

using Whole = Eigen::Matrix<long long, 3, 1>;

// Four around the origin.
bool surround(const Whole& p, const Whole& q, const Whole& r, const Whole& s) {
  const auto det = [](const Whole& u, const Whole& v, const Whole& w) { return u.dot(v.cross(w)); };
  const long long a = det(q, r, s), b = -det(p, r, s), c = det(p, q, s), d = -det(p, q, r);
  return (a > 0 && b > 0 && c > 0 && d > 0) || (a < 0 && b < 0 && c < 0 && d < 0);
}

// Three around it in a plane.
bool surround(const Whole& p, const Whole& q, const Whole& r) {
  const Whole a = p.cross(q), b = q.cross(r), c = r.cross(p);
  return p.dot(b) == 0 && a.dot(b) > 0 && b.dot(c) > 0;
}

// By Carathéodory some affinely independent points have it strictly between them.
bool hasOrigin(const std::vector<Whole>& points) {
  const std::size_t count = points.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (points[i].isZero()) return true;
    for (std::size_t j = 0; j < i; ++j) {
      if (points[i].cross(points[j]).isZero() && points[i].dot(points[j]) < 0) return true;
      for (std::size_t k = 0; k < j; ++k) {
        if (surround(points[i], points[j], points[k])) return true;
        for (std::size_t l = 0; l < k; ++l) {
          if (surround(points[i], points[j], points[k], points[l])) return true;
        }
      }
    }
  }
  return false;
}

Whole randomCorner(RandomBodies& random, int reach) {
  return {random.integer(-reach, reach), random.integer(-reach, reach),
          random.integer(-reach, reach)};
}

bool touch(const std::vector<Whole>& a, const std::vector<Whole>& b) {
  std::vector<Whole> differences;
  for (const Whole& p : a) {
    for (const Whole& q : b) differences.push_back(q - p);
  }
  return hasOrigin(differences);
}

std::shared_ptr<fcl::BVHModel<fcl::OBBRSSd>> modelOf(const std::vector<Whole>& corners,
                                                     double scale) {
  TriangleMesh mesh;
  for (const Whole& corner : corners) mesh.vertices.push_back(scale * corner.cast<double>());
  mesh.triangles.emplace_back(0, 1, 2);
  return makeModel<fcl::OBBRSSd>(mesh);
}

fcl::Transform3d movedTo(const Eigen::Vector3d& position) {
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.translation() = position;
  return pose;
}

}  // namespace

TEST_CASE("Triangles with corners on a lattice") {
  RandomBodies random(77);
  int touching = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const int reach = 1 + trial % 4;
    std::vector<Whole> a, b;
    for (int i = 0; i < 3; ++i) {
      a.push_back(randomCorner(random, reach));
      b.push_back(randomCorner(random, reach));
    }
    const double scale = std::ldexp(1.0, random.integer(-40, 40));
    const auto model_a = modelOf(a, scale), model_b = modelOf(b, scale);
    // Beside each other by a displacement that takes the pose back.
    const Eigen::Vector3d away = scale * randomCorner(random, 1000).cast<double>();
    const Scene scene({model_a.get(), movedTo(away)}, {model_b.get(), movedTo({0, 0, 0})},
                      Contact::surface);
    const bool expected = touch(a, b);
    touching += expected;
    if (scene.touches(Eigen::Vector3d(-away)) != (expected ? Verdict::touching : Verdict::apart)) {
      FAIL_CHECK("trial " << trial);
    }
  }
  CHECK(touching > 1000);
  CHECK(touching < 3000);
}

TEST_CASE("Boxes and triangles with corners on a lattice") {
  RandomBodies random(78);
  int touching = 0;
  for (int trial = 0; trial < 600; ++trial) {
    const Whole half = randomCorner(random, 2).cwiseAbs() + Whole::Ones();
    std::vector<Whole> corners, triangle;
    for (int i = 0; i < 8; ++i) {
      corners.emplace_back(i & 1 ? half[0] : -half[0], i & 2 ? half[1] : -half[1],
                           i & 4 ? half[2] : -half[2]);
    }
    const Whole shift = randomCorner(random, 3);
    for (int i = 0; i < 3; ++i) triangle.push_back(randomCorner(random, 3) + shift);
    const fcl::Boxd box(2 * half.cast<double>());
    const auto model = modelOf(triangle, 1.0);
    const Scene scene({&box, movedTo({0, 0, 0})}, {model.get(), movedTo({0, 0, 0})},
                      Contact::surface);
    const bool expected = touch(corners, triangle);
    touching += expected;
    if (scene.touches(Eigen::Vector3d(0, 0, 0)) !=
        (expected ? Verdict::touching : Verdict::apart)) {
      FAIL_CHECK("trial " << trial);
    }
  }
  CHECK(touching > 100);
  CHECK(touching < 500);
}
