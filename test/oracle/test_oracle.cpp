// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The oracle against cases that can be seen, and against closed forms.
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/plane.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/geometry/shape/triangle_p.h>

#include <cmath>
#include <limits>

#include "catch.h"
#include "mesh_shapes.h"
#include "oracle/oracle.h"
#include "poses.h"

using namespace fcl_prob_test;
using oracle::Contact;
using oracle::Scene;
using oracle::Verdict;

namespace {

using Vector3 = Eigen::Vector3d;

const double kTiny = std::numeric_limits<double>::denorm_min();

Verdict touch(const fcl::CollisionGeometryd& a, const fcl::Transform3d& pose_a,
              const fcl::CollisionGeometryd& b, const fcl::Transform3d& pose_b,
              const Vector3& displacement = Vector3::Zero(), Contact contact = Contact::surface) {
  return Scene({&a, pose_a}, {&b, pose_b}, contact).touches(displacement);
}

std::shared_ptr<fcl::BVHModel<fcl::OBBRSSd>> model(const TriangleMesh& mesh) {
  return makeModel<fcl::OBBRSSd>(mesh);
}

TriangleMesh moved(const TriangleMesh& mesh, const Vector3& by) {
  return transformed(mesh, Eigen::Isometry3d(Eigen::Translation3d(by)));
}

TriangleMesh cube(double side, const Vector3& middle = Vector3::Zero()) {
  return moved(boxMesh(Vector3::Constant(side)), middle);
}

TriangleMesh oneTriangle(const Vector3& a, const Vector3& b, const Vector3& c) {
  TriangleMesh mesh;
  mesh.vertices = {a, b, c};
  mesh.triangles.emplace_back(0, 1, 2);
  return mesh;
}

}  // namespace

TEST_CASE("Boxes that share a corner, an edge or a face touch, and to the last bit no sooner") {
  const fcl::Boxd box(1, 1, 1);
  for (const Vector3& to : {Vector3(1, 0.3, 0.2), Vector3(1, 1, 0.2), Vector3(1, 1, 1)}) {
    INFO(to.transpose());
    CHECK(touch(box, at(0, 0, 0), box, at(to.x(), to.y(), to.z())) == Verdict::touching);
    const double beyond = std::nextafter(1.0, 2.0);
    CHECK(touch(box, at(0, 0, 0), box, at(beyond, to.y(), to.z())) == Verdict::apart);
    // Far below what a double's bits of 1 can tell.
    CHECK(touch(box, at(0, 0, 0), box, at(to.x(), to.y(), to.z()), Vector3(-kTiny, 0, 0)) ==
          Verdict::apart);
    CHECK(touch(box, at(0, 0, 0), box, at(to.x(), to.y(), to.z()), Vector3(kTiny, 0, 0)) ==
          Verdict::touching);
  }
}

TEST_CASE("Coplanar triangles touch where they overlap, at a vertex and along an edge") {
  const auto a = model(oneTriangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
  CHECK(touch(*a, at(0, 0, 0), *a, at(0.25, 0.25, 0)) == Verdict::touching);
  CHECK(touch(*a, at(0, 0, 0), *a, at(1, 0, 0)) == Verdict::touching);
  CHECK(touch(*a, at(0, 0, 0), *a, at(1, 0, 0), Vector3(-kTiny, 0, 0)) == Verdict::apart);
  CHECK(touch(*a, at(0, 0, 0), *a, at(0.25, 0.25, 0), Vector3(0, 0, kTiny)) == Verdict::apart);
  const auto turned = model(oneTriangle({1, 0, 0}, {1, 1, 0}, {0, 1, 0}));
  CHECK(touch(*a, at(0, 0, 0), *turned, at(0, 0, 0)) == Verdict::touching);
  CHECK(touch(*a, at(0, 0, 0), *turned, at(0, 0, 0), Vector3(-kTiny, 0, 0)) == Verdict::apart);
}

TEST_CASE("Points and segments as triangles") {
  const auto point = model(oneTriangle({0, 0, 0}, {0, 0, 0}, {0, 0, 0}));
  const auto segment = model(oneTriangle({-1, 0, 0}, {0, 0, 0}, {1, 0, 0}));
  const auto triangle = model(oneTriangle({-1, -1, 0}, {1, -1, 0}, {0, 1, 0}));
  CHECK(touch(*point, at(0, 0, 0), *triangle, at(0, 0, 0)) == Verdict::touching);
  CHECK(touch(*point, at(0, 0, 0), *triangle, at(0, 0, 0), {0, 0, kTiny}) == Verdict::apart);
  CHECK(touch(*point, at(0, 1, 0), *triangle, at(0, 0, 0)) == Verdict::touching);
  CHECK(touch(*point, at(0, 1, 0), *triangle, at(0, 0, 0), {kTiny, 0, 0}) == Verdict::apart);
  CHECK(touch(*segment, at(0, 0, 0), *triangle, at(0, 0, 0)) == Verdict::touching);
  CHECK(touch(*segment, at(0, 1, 0), *triangle, at(0, 0, 0)) == Verdict::touching);
  CHECK(touch(*segment, at(0, 1, 0), *triangle, at(0, 0, 0), {0, kTiny, 0}) == Verdict::apart);
  CHECK(touch(*point, at(2, 2, 2), *point, at(2, 2, 2)) == Verdict::touching);
  CHECK(touch(*point, at(2, 2, 2), *point, at(2, 2, 2), {0, kTiny, 0}) == Verdict::apart);
  CHECK(touch(*segment, at(0, 0, 0), *segment, at(2, 0, 0)) == Verdict::touching);
  CHECK(touch(*segment, at(0, 0, 0), *segment, at(2, 0, 0), {-kTiny, 0, 0}) == Verdict::apart);
}

TEST_CASE("A matrix off a rotation is used as it is") {
  fcl::Transform3d pose = at(0, 0, 0);
  pose.linear()(0, 0) = 1 + 1e-9;
  const fcl::Boxd box(2, 2, 2);
  const auto mesh = model(boxMesh({2, 2, 2}));
  for (const fcl::CollisionGeometryd* a :
       {static_cast<const fcl::CollisionGeometryd*>(&box),
        static_cast<const fcl::CollisionGeometryd*>(mesh.get())}) {
    CHECK(touch(*a, pose, box, at(2 + 0.9e-9, 0, 0)) == Verdict::touching);
    CHECK(touch(*a, pose, box, at(2 + 1.1e-9, 0, 0)) == Verdict::apart);
  }
  const fcl::Sphered ball(1);
  CHECK(touch(ball, pose, box, at(2 + 0.9e-9, 0, 0)) == Verdict::touching);
  CHECK(touch(ball, pose, box, at(2 + 1.1e-9, 0, 0)) == Verdict::apart);
}

TEST_CASE("Surfaces and solids, nested and inside out") {
  const auto small = model(cube(0.125));
  const auto large = model(cube(4));
  const auto hollow = model(joined(cube(4), reversed(cube(2))));
  const auto twice = model(joined(cube(4), cube(2)));
  const auto inside_out = model(reversed(cube(4)));
  const auto both_out = model(joined(reversed(cube(4)), cube(2)));
  const auto solid = [&](const auto& a, const auto& b, const Vector3& by = Vector3::Zero()) {
    const Verdict one = touch(*a, at(0, 0, 0), *b, at(0, 0, 0), by, Contact::solid);
    CHECK(one == touch(*b, at(0, 0, 0), *a, at(0, 0, 0), -by, Contact::solid));
    return one;
  };
  CHECK(touch(*small, at(0, 0, 0), *large, at(0, 0, 0)) == Verdict::apart);
  CHECK(solid(small, large) == Verdict::touching);
  CHECK(solid(small, hollow) == Verdict::apart);
  CHECK(solid(small, hollow, {1.5, 0, 0}) == Verdict::touching);
  CHECK(solid(small, twice) == Verdict::touching);
  CHECK(solid(small, inside_out) == Verdict::touching);
  CHECK(solid(small, both_out) == Verdict::apart);
  CHECK(solid(small, both_out, {1.5, 0.1, 0.3}) == Verdict::touching);
  CHECK(solid(small, large, {5, 0, 0}) == Verdict::apart);
  CHECK(solid(small, large, {2.0625, 2.0625, 2.0625}) == Verdict::touching);
  CHECK(solid(small, large, {2.0625, 2.0625, 2.0626}) == Verdict::apart);
  CHECK_THROWS_AS(touch(*model(oneTriangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0})), at(0, 0, 0), *large,
                        at(0, 0, 0), Vector3::Zero(), Contact::solid),
                  std::invalid_argument);
}

TEST_CASE("Every shell counts, and a stray point") {
  const auto two = model(joined(cube(0.2), cube(0.2, {10, 0, 0})));
  const auto stray = model(joined(cube(0.2), oneTriangle({10, 0, 0}, {10, 0, 0}, {10, 0, 0})));
  const auto large = model(cube(4));
  for (const auto& mesh : {two, stray}) {
    const auto solid = [&](const Vector3& by) {
      return touch(*mesh, at(0, 0, 0), *large, at(0, 0, 0), by, Contact::solid);
    };
    CHECK(solid({0, 0, 0}) == Verdict::touching);
    CHECK(solid({-10, 0, 0}) == Verdict::touching);
    CHECK(solid({-5, 0, 0}) == Verdict::apart);
    CHECK(touch(*mesh, at(0, 0, 0), *large, at(0, 0, 0), {-8, 0, 0}) == Verdict::touching);
  }
}

TEST_CASE("Rays that would meet edges and vertices") {
  // A point and mesh on a lattice along which the rays run.
  TriangleMesh lattice;
  for (int k = 0; k < 3; ++k) {
    lattice = joined(lattice, cube(2, Vector3(97, 11, 5) * (k + 1)));
    lattice = joined(lattice, cube(2, Vector3(-7, 89, 13) * (k + 1)));
  }
  const auto outer = model(lattice);
  const auto tiny = model(cube(0x1p-20));
  const auto solid = [&](const Vector3& to) {
    return touch(*tiny, at(0, 0, 0), *outer, at(0, 0, 0), to, Contact::solid);
  };
  CHECK(solid({0, 0, 0}) == Verdict::apart);
  CHECK(solid({97, 11, 5}) == Verdict::touching);
  CHECK(solid({194, 22, 10}) == Verdict::touching);
  CHECK(solid({97.5, 11.5, 5}) == Verdict::touching);
  CHECK(solid({-97, -11, -5}) == Verdict::apart);
}

TEST_CASE("Curved shapes at the distances that formulas give") {
  const fcl::Sphered ball(1);
  const fcl::Boxd box(2, 2, 2);
  const double root2 = std::sqrt(2.0), root3 = std::sqrt(3.0);
  struct Case {
    const fcl::CollisionGeometryd& a;
    const fcl::CollisionGeometryd& b;
    Vector3 direction;
    double distance;  // along it, at which they touch
  };
  const fcl::Capsuled capsule(0.5, 3);
  const fcl::Cylinderd cylinder(0.5, 3);
  const fcl::Coned cone(1, 2);
  const fcl::Ellipsoidd ellipsoid(3, 2, 1);
  const Vector3 x = Vector3::UnitX(), z = Vector3::UnitZ();
  const Vector3 diagonal = Vector3(1, 1, 0) / root2;
  const std::vector<Case> cases{
      {ball, ball, Vector3(1, 2, 2) / 3, 2},
      {ball, box, x, 2},
      {ball, box, diagonal, 1 + root2},
      {ball, box, Vector3(1, 1, 1) / root3, 1 + root3},
      {capsule, ball, x, 1.5},
      {capsule, ball, z, 3},
      {cylinder, ball, z, 2.5},
      {cylinder, ball, diagonal, 1.5},
      {cylinder, cylinder, z, 3},
      {cylinder, box, diagonal, 0.5 + root2},
      {ellipsoid, ball, x, 4},
      {ellipsoid, ball, z, 2},
      {ellipsoid, ellipsoid, Vector3(3, 2, 1) / std::sqrt(14.0), 2 * std::sqrt(14.0 / 3)},
      {cone, ball, -z, 2},
      {cone, ball, z, 2},
      // The cone's side leans as 2 to 1; the ball beside it touches halfway up.
      {cone, ball, x, 0.5 + std::sqrt(5.0) / 2}};
  for (const Case& one : cases) {
    INFO(one.distance << " along " << one.direction.transpose());
    const Scene scene({&one.a, at(0, 0, 0)}, {&one.b, at(0, 0, 0)}, Contact::surface);
    for (const double off : {2e-15, 1e-12, 1e-6, 0.1}) {
      CHECK(scene.touches(Vector3(one.direction * (one.distance + off * 8))) == Verdict::apart);
      CHECK(scene.touches(Vector3(one.direction * (one.distance - off * 8))) == Verdict::touching);
    }
    CHECK(scene.touches(Vector3(0, 0, 0)) == Verdict::touching);
  }
}

TEST_CASE("Half-spaces and planes") {
  const fcl::Halfspaced ground(Vector3(0, 0, 1), 1);
  const fcl::Planed plane(Vector3(0, 0, 1), 1);
  const fcl::Sphered ball(0.5);
  const fcl::Boxd box(1, 1, 1);
  const auto mesh = model(cube(1));
  for (const fcl::CollisionGeometryd* a :
       {static_cast<const fcl::CollisionGeometryd*>(&ball),
        static_cast<const fcl::CollisionGeometryd*>(&box),
        static_cast<const fcl::CollisionGeometryd*>(mesh.get())}) {
    for (const bool swapped : {false, true}) {
      const auto meets = [&](const fcl::CollisionGeometryd& b, double z) {
        return swapped ? touch(b, at(3, 2, 1), *a, at(0, 0, 0), {0, 0, -z})
                       : touch(*a, at(0, 0, 0), b, at(3, 2, 1), {0, 0, z});
      };
      CHECK(meets(ground, 2.4999) == Verdict::touching);
      CHECK(meets(ground, 2.5001) == Verdict::apart);
      CHECK(meets(ground, -100) == Verdict::touching);
      CHECK(meets(plane, 2.4999) == Verdict::touching);
      CHECK(meets(plane, 2.5001) == Verdict::apart);
      CHECK(meets(plane, 1.5001) == Verdict::touching);
      CHECK(meets(plane, 1.4999) == Verdict::apart);
    }
  }
  CHECK(touch(box, at(0, 0, 2.5 - 1), ground, at(0, 0, 0)) == Verdict::touching);
  CHECK(touch(box, at(0, 0, 1.5), ground, at(0, 0, 0), {0, 0, kTiny}) == Verdict::apart);
  const fcl::Halfspaced ceiling(Vector3(0, 0, -1), -2);
  CHECK(touch(ground, at(0, 0, 0), ceiling, at(0, 0, 0)) == Verdict::apart);
  CHECK(touch(ground, at(0, 0, 0), ceiling, at(0, 0, 0), {0, 0, 1}) == Verdict::touching);
  CHECK(touch(ceiling, at(0, 0, 0), ground, at(0, 0, 0), {0, 0, -1}) == Verdict::touching);
  CHECK(touch(ceiling, at(0, 0, 0), ground, at(0, 0, 0), {0, 0, -0.999}) == Verdict::apart);
  CHECK(touch(plane, at(0, 0, 0), plane, at(0, 0, 1)) == Verdict::apart);
  CHECK(touch(plane, at(0, 0, 0), plane, at(0, 0, 1), {5, 5, 1}) == Verdict::touching);
  CHECK(touch(plane, at(0, 0, 0), ground, at(0, 0, 0), {0, 0, 0.1}) == Verdict::apart);
  CHECK(touch(plane, at(0, 0, 0), ground, at(0, 0, 0), {0, 0, -0.1}) == Verdict::touching);
  CHECK(touch(plane, at(0, 0, 0), ceiling, at(0, 0, 0), {0, 0, 1.1}) == Verdict::touching);
  CHECK(touch(plane, at(0, 0, 0), ceiling, at(0, 0, 0), {0, 0, 0.9}) == Verdict::apart);
}

TEST_CASE("What is not occupied is not there") {
  fcl::Boxd solid(1, 1, 1), thin(1, 1, 1);
  thin.cost_density = 0.5;
  CHECK(touch(solid, at(0, 0, 0), thin, at(0, 0, 0)) == Verdict::apart);
  CHECK(touch(thin, at(0, 0, 0), solid, at(0, 0, 0)) == Verdict::apart);
  thin.threshold_occupied = 0.5;
  CHECK(touch(solid, at(0, 0, 0), thin, at(0, 0, 0)) == Verdict::touching);
}

TEST_CASE("Groups touch where any two members do") {
  const fcl::Boxd box(1, 1, 1);
  const std::vector<oracle::Placed> a{{&box, at(0, 0, 0)}, {&box, at(0, 0, 10)}};
  const std::vector<oracle::Placed> b{{&box, at(5, 0, 0)}, {&box, at(7, 0, 10)}};
  const Scene scene(a, b, Contact::surface);
  CHECK(scene.touches(Vector3(0, 0, 0)) == Verdict::apart);
  CHECK(scene.touches(Vector3(4, 0, 0)) == Verdict::touching);
  CHECK(scene.touches(Vector3(7, 0, 0)) == Verdict::touching);
  CHECK(scene.touches(Vector3(5, 0, -10)) == Verdict::touching);
  CHECK(scene.touches(Vector3(3, 0, 0)) == Verdict::apart);
}

TEST_CASE("Poses far away, sizes at the ends of the doubles") {
  const fcl::Boxd box(1, 1, 1);
  const double far = 0x1p40;
  CHECK(touch(box, at(far, 0, 0), box, at(far, 0, 1)) == Verdict::touching);
  CHECK(touch(box, at(far, 0, 0), box, at(far, 0, 1), {0, 0, -kTiny}) == Verdict::apart);
  CHECK(touch(box, at(far, 0, 0), box, at(far + 1, 0, 0), {-1e-30, 0, 0}) == Verdict::apart);
  for (const double scale : {0x1p-490, 0x1p490}) {
    const fcl::Boxd scaled(scale, scale, scale);
    const fcl::Sphered ball(scale);
    CHECK(touch(scaled, at(0, 0, 0), scaled, at(scale, 0, 0)) == Verdict::touching);
    CHECK(touch(scaled, at(0, 0, 0), scaled, at(std::nextafter(scale, 2 * scale), 0, 0)) ==
          Verdict::apart);
    CHECK(touch(ball, at(0, 0, 0), ball, at(scale * 1.999999, 0, 0)) == Verdict::touching);
    CHECK(touch(ball, at(0, 0, 0), ball, at(scale * 2.000001, 0, 0)) == Verdict::apart);
  }
}
