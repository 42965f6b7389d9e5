// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Balls within meshes and shapes against points of them; displacements that are told to be contacts
// against fcl::collide, one by one; masses against certified intervals.
#include "robot/medial_balls.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>

#include "catch.h"
#include "fcl_prob/collision_probability.h"
#include "geometry/closed_mesh.h"
#include "mesh_shapes.h"
#include "random_bodies.h"

namespace {

using namespace fcl_prob_test;
using namespace fcl_prob;
using namespace fcl_prob::detail;
using Shape = std::shared_ptr<const fcl::CollisionGeometryd>;

const fcl::Transform3d kUnmoved = fcl::Transform3d::Identity();

/// A mesh without a few of its triangles.
TriangleMesh withHole(TriangleMesh mesh) {
  mesh.triangles.resize(mesh.triangles.size() - 3);
  return mesh;
}

/// Thin needles, and vertices far from the origin.
TriangleMesh farNeedle() {
  return transformed(boxMesh({1.0, 1e-7, 0.3}),
                     Eigen::Isometry3d(Eigen::Translation3d(3e4, -1e4, 2e4)));
}

struct Searched {
  explicit Searched(Shape shape)
      : geometry(std::make_shared<PreparedGeometry>(std::move(shape), "it")), balls(*geometry) {}
  explicit Searched(const TriangleMesh& mesh) : Searched(Shape(makeModel<fcl::OBBRSSd>(mesh))) {}

  std::shared_ptr<const PreparedGeometry> geometry;
  MedialBalls balls;
};

/// Closed and open meshes, in one part and in several, and shapes.
std::vector<Searched> searchedOnes() {
  const auto apart = [](double by) { return Eigen::Isometry3d(Eigen::Translation3d(by, 0, 0)); };
  std::vector<Searched> all;
  for (const TriangleMesh& mesh :
       {torusMesh(1.0, 0.15, 40, 12), bumpyMesh(0.6, 16, 24, 5), boxMesh({0.3, 0.5, 1.4}),
        joined(boxMesh({0.4, 0.4, 0.4}), transformed(sphereMesh(0.2, 8, 12), apart(0.1))),
        joined(boxMesh({2.0, 2.0, 0.1}), transformed(torusMesh(0.4, 0.1, 20, 8), apart(1.5))),
        withHole(bumpyMesh(0.6, 12, 16, 3)), withHole(boxMesh({0.2, 0.2, 0.9})), farNeedle()}) {
    all.emplace_back(mesh);
  }
  all.emplace_back(std::make_shared<fcl::Boxd>(0.3, 0.8, 0.1));
  all.emplace_back(std::make_shared<fcl::Sphered>(0.4));
  all.emplace_back(std::make_shared<fcl::Capsuled>(0.1, 0.9));
  all.emplace_back(std::make_shared<fcl::Cylinderd>(0.2, 0.7));
  all.emplace_back(std::make_shared<fcl::Cylinderd>(0.5, 0.1));
  return all;
}

GaussianDisplacement drawnError(RandomBodies& random, int rank) {
  Eigen::Vector3d deviations;
  for (int k = 0; k < 3; ++k) deviations[k] = k < rank ? random.logUniform(0.02, 0.4) : 0.0;
  const Eigen::Matrix3d factor = random.rotation() * deviations.asDiagonal();
  return {0.1 * random.normalVector(), factor * factor.transpose()};
}

/// Beside each other, or in each other.
fcl::Transform3d drawnPose(RandomBodies& random, const Searched& a, const Searched& b) {
  fcl::Transform3d pose = random.pose(0.0);
  const double far = a.balls.around().radius + b.balls.around().radius;
  pose.translation() += b.balls.around().centre - pose.linear() * a.balls.around().centre +
                        random.uniform(0.0, 0.7) * far * random.direction();
  return pose;
}

ProbabilityResult answer(const Searched& a, const fcl::Transform3d& pose, const Searched& b,
                         const GaussianDisplacement& error, const ProbabilityRequest& request) {
  ProbabilityResult result;
  collisionProbability(&a.geometry->geometry(), pose, &b.geometry->geometry(), kUnmoved, error,
                       request, result);
  return result;
}

bool touches(const Searched& a, const fcl::Transform3d& pose, const Searched& b) {
  fcl::CollisionResultd result;
  return fcl::collide(&a.geometry->geometry(), pose, &b.geometry->geometry(), kUnmoved,
                      fcl::CollisionRequestd(), result) > 0;
}

}  // namespace

TEST_CASE("medial balls are within the solid, and what is near is a point of it") {
  RandomBodies random(3);
  std::size_t with_balls = 0;
  for (const Searched& one : searchedOnes()) {
    const bool is_mesh = one.geometry->geometry().getObjectType() == fcl::OT_BVH;
    with_balls += one.balls.hasBalls();
    const double size = one.balls.around().radius;
    std::vector<Ball> balls = one.balls.largest();
    for (int i = 0; i < 50; ++i) {
      const Eigen::Vector3d x = one.balls.around().centre + 0.8 * size * random.normalVector();
      const auto near = one.balls.nearestTo(x);
      CHECK(near.distance <= (near.point - x).norm());
      CHECK((one.balls.farFrom(near) - one.balls.around().centre).norm() <= (1.0 + 1e-9) * size);
      const Shape dot = std::make_shared<fcl::Sphered>(1e-9 * (size + x.norm()));
      CHECK(touches(Searched(dot), fcl::Transform3d(Eigen::Translation3d(near.point)), one));
      if (one.balls.hasBalls()) balls.push_back(one.balls.ballNear(x));
    }
    if (!is_mesh || !one.balls.hasBalls()) continue;
    for (const Ball& ball : balls) {
      if (!(ball.radius > 0.0)) continue;
      for (int i = 0; i < 20; ++i) {
        const Eigen::Vector3d x =
            ball.centre + random.uniform(0.9, 1.0) * ball.radius * random.direction();
        CHECK(one.geometry->solid(ContactMeaning::solid)->contains(x) != Containment::outside);
      }
    }
  }
  CHECK(with_balls >= 9);
}

TEST_CASE("every displacement of a ball of contacts is a contact") {
  RandomBodies random(5);
  const std::vector<Searched> all = searchedOnes();
  int found = 0, by_surface = 0;
  for (int scene = 0; scene < 800; ++scene) {
    const auto draw = [&] {
      return static_cast<std::size_t>(random.integer(0, static_cast<int>(all.size()) - 1));
    };
    const Searched &a = all[draw()], &b = all[draw()];
    const fcl::Transform3d pose = drawnPose(random, a, b);
    const GaussianDisplacement error = drawnError(random, 1 + scene % 3);
    const ContactBall ball =
        contactBall({a.balls, pose}, {b.balls, kUnmoved}, error, ContactMeaning::fcl, 0.1);
    if (!(ball.mass > 0.0)) continue;
    ++found;
    by_surface += a.balls.isSurface(ContactMeaning::fcl) && b.balls.isSurface(ContactMeaning::fcl);
    for (int i = 0; i < 60; ++i) {
      fcl::Transform3d moved = pose;
      const double out = i < 30 ? 1.0 - 1e-6 : random.uniform(0.0, 1.0);
      moved.translation() += error.mean() + ball.centre + out * ball.radius * random.direction();
      CAPTURE(scene, i, ball.radius, ball.mass);
      CHECK(touches(a, moved, b));
    }
  }
  CHECK(found > 300);
  CHECK(by_surface > 100);
}

TEST_CASE("masses by medial balls are not above P") {
  RandomBodies random(7);
  const std::vector<Searched> all = searchedOnes();
  int told = 0, most = 0;
  for (int scene = 0; scene < 150; ++scene) {
    const Searched &a = all[static_cast<std::size_t>(scene) % 5],
                   &b = all[static_cast<std::size_t>(random.integer(0, 12))];
    const fcl::Transform3d pose = drawnPose(random, a, b);
    const GaussianDisplacement error = drawnError(random, 1 + scene % 3);
    const bool both_closed = a.balls.hasBalls() && b.balls.hasBalls();
    for (const ContactMeaning contact : {ContactMeaning::fcl, ContactMeaning::solid}) {
      if (contact == ContactMeaning::solid && !both_closed) continue;
      const double lower =
          lowerByMedialBalls({a.balls, pose}, {b.balls, kUnmoved}, error, contact, 0.05);
      if (!(lower > 0.0)) continue;
      ProbabilityRequest request;
      request.method = ProbabilityMethod::interval;
      request.contact = contact;
      request.relative_tolerance = 0.1;
      request.max_cells = 2'000;
      const ProbabilityResult result = answer(a, pose, b, error, request);
      CAPTURE(scene, lower, *result.lower);
      CHECK(lower <= *result.upper);
      ++told;
      most += lower > 0.5 * *result.lower;
    }
  }
  CHECK(told > 60);
  CHECK(most > 20);
}

TEST_CASE("a ball in a ball has the mass of the ball that both have as C-obstacle") {
  const Searched a(Shape(std::make_shared<fcl::Sphered>(0.3)));
  const Searched b(Shape(std::make_shared<fcl::Sphered>(0.2)));
  const GaussianDisplacement error(Eigen::Vector3d(0.1, 0, 0), 0.04 * Eigen::Matrix3d::Identity());
  fcl::Transform3d pose = kUnmoved;
  pose.translation() = Eigen::Vector3d(-0.1, 0.05, 0);
  const double lower =
      lowerByMedialBalls({a.balls, pose}, {b.balls, kUnmoved}, error, ContactMeaning::fcl, 0.05);
  const ProbabilityResult whole = answer(a, pose, b, error, ProbabilityRequest());
  CHECK(lower <= *whole.upper);
  CHECK(lower > 0.4 * *whole.lower);  // of the larger of the two alone
}
