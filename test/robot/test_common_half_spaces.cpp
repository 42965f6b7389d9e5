// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Bounds by half-spaces that many pairs have in common, against counting and closed forms.
#include "robot/common_half_spaces.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/narrowphase/collision.h>

#include "bounds/convex_bound.h"
#include "catch.h"
#include "fcl_prob/normal_mass.h"
#include "mesh_shapes.h"
#include "random_bodies.h"

namespace {

using namespace fcl_prob_test;
using fcl_prob::ConvexBody;
using fcl_prob::GaussianDisplacement;
using fcl_prob::detail::CommonHalfSpaces;
using fcl_prob::detail::halfSpaceUpper;
using fcl_prob::detail::NodeHulls;
using fcl_prob::detail::nodeHullsOf;
using Model = std::shared_ptr<fcl::BVHModel<fcl::OBBRSSd>>;

struct Body {
  Model model;
  NodeHulls hulls;
};

Body bodyOf(const fcl_prob::TriangleMesh& mesh) {
  const Model model = makeModel<fcl::OBBRSSd>(mesh);
  return {model, nodeHullsOf(*model, ConvexBody(mesh.vertices))};
}

NodeHulls boxHulls(double side) {
  const fcl::Boxd box(side, side, side);
  return nodeHullsOf(box, ConvexBody(box));
}

const fcl::Transform3d kStill = fcl::Transform3d::Identity();

fcl::Transform3d placedAt(double x, double y, double z) {
  return fcl::Transform3d(Eigen::Translation3d(x, y, z));
}

const GaussianDisplacement kUnit(Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity());

}  // namespace

TEST_CASE("half-spaces that bodies have in common bound P that any touches") {
  RandomBodies random(11);
  std::vector<Body> kinds{bodyOf(torusMesh(1.2, 0.1, 80, 16)), bodyOf(bumpyMesh(0.4, 24, 40, 5)),
                          bodyOf(boxMesh({0.3, 0.5, 0.9}))};
  int decided = 0, only_together = 0, below = 0;
  for (int scene = 0; scene < 60; ++scene) {
    const Body& obstacle = kinds[static_cast<std::size_t>(scene % 2)];
    const Eigen::Vector3d deviations{random.logUniform(0.02, 0.2), random.logUniform(0.02, 0.2),
                                     random.logUniform(0.02, 0.2)};
    const Eigen::Matrix3d factor = random.rotation() * deviations.asDiagonal();
    const GaussianDisplacement error(0.1 * random.normalVector(), factor * factor.transpose());
    CommonHalfSpaces common(error);
    std::vector<std::pair<const Body*, fcl::Transform3d>> placed;
    double sum = 0.0;
    for (int i = 0; i < 1 + scene % 4; ++i) {
      const Body& body = kinds[static_cast<std::size_t>(random.integer(0, 2))];
      fcl::Transform3d pose = random.pose(0.0);
      pose.translation() = random.uniform(0.0, 1.8) * random.direction();
      placed.emplace_back(&body, pose);
      common.add(body.hulls, pose, obstacle.hulls, kStill, 0);
      sum += halfSpaceUpper(body.hulls.nodes[0].hull, pose, obstacle.hulls.nodes[0].hull, kStill,
                            error);
    }
    const double enough = scene % 3 == 0 ? 0.02 : scene % 3 == 1 ? 0.1 : 0.5;
    const double upper = common.upper(enough);
    CHECK(upper <= sum * (1.0 + 1e-6));
    constexpr int kDraws = 2'000;
    int hits = 0;
    for (int draw = 0; draw < kDraws; ++draw) {
      const Eigen::Vector3d moved = error.mean() + factor * random.normalVector();
      bool touches = false;
      for (const auto& [body, pose] : placed) {
        fcl::Transform3d at = pose;
        at.translation() += moved;
        fcl::CollisionResultd result;
        touches = touches ||
                  fcl::collide(body->model.get(), at, obstacle.model.get(), kStill, {}, result) > 0;
      }
      hits += touches;
    }
    const double share = static_cast<double>(hits) / kDraws;
    CAPTURE(scene, upper, share);
    CHECK(share <= upper + 5.0 * std::sqrt(upper * (1.0 - std::min(upper, 1.0)) / kDraws) + 1e-9);
    decided += upper < enough;
    only_together += upper < enough && sum >= enough;
    below += share < 0.8 * enough;
  }
  CAPTURE(decided, only_together, below);
  CHECK(decided > 0.8 * below);
  CHECK(only_together >= 5);
}

TEST_CASE("bodies behind one plane count once") {
  const NodeHulls small = boxHulls(0.1), large = boxHulls(2.0);
  CommonHalfSpaces common(kUnit);
  for (int i = 0; i < 5; ++i)
    common.add(small, placedAt(3.05, 0.2 * i - 0.4, 0.0), large, kStill, 0);
  CHECK(common.upper(0.03) == Approx(fcl_prob::normalTailMass(2.0)).epsilon(1e-6));
}

TEST_CASE("bodies on both sides count twice, far ones for next to nothing") {
  const NodeHulls small = boxHulls(0.1), large = boxHulls(2.0);
  CommonHalfSpaces common(kUnit);
  common.add(small, placedAt(3.05, 0.0, 0.0), large, kStill, 0);
  common.add(small, placedAt(-3.05, 0.0, 0.0), large, kStill, 0);
  CHECK(common.upper(0.03) == Approx(2.0 * fcl_prob::normalTailMass(2.0)).epsilon(1e-6));
  CommonHalfSpaces far(kUnit);
  far.add(small, placedAt(31.05, 0.0, 0.0), large, kStill, 0);
  CHECK(far.upper(0.0) == Approx(fcl_prob::normalTailMass(30.0)).epsilon(1e-4));
}

TEST_CASE("no more is told of bodies that touch, or of errors that leave an axis out, than 1") {
  const NodeHulls small = boxHulls(0.1), large = boxHulls(2.0);
  CommonHalfSpaces touching(kUnit);
  touching.add(small, placedAt(0.5, 0.0, 0.0), large, kStill, 0);
  CHECK(touching.upper(0.0) == 1.0);
  CommonHalfSpaces flat(
      GaussianDisplacement(Eigen::Vector3d::Zero(), Eigen::Vector3d(1.0, 1.0, 0.0).asDiagonal()));
  flat.add(small, placedAt(3.05, 0.0, 0.0), large, kStill, 0);
  CHECK(flat.upper(0.0) == 1.0);
  CommonHalfSpaces stiff(
      GaussianDisplacement(Eigen::Vector3d::Zero(), 1e-160 * Eigen::Matrix3d::Identity()));
  stiff.add(small, placedAt(3.05, 0.0, 0.0), large, kStill, 0);
  CHECK(stiff.upper(0.5) == 1.0);
}

TEST_CASE("a ring around a ball needs half-spaces all around") {
  const Body ring = bodyOf(torusMesh(1.0, 0.1, 80, 16));
  const Body ball = bodyOf(sphereMesh(0.3, 10, 16));
  const GaussianDisplacement error(Eigen::Vector3d::Zero(), 0.04 * Eigen::Matrix3d::Identity());
  CommonHalfSpaces common(error);
  common.add(ball.hulls, kStill, ring.hulls, kStill, 0);
  // The hulls overlap; what is between them is 0.6 wide, 3 deviations.
  const double around = std::exp(-4.5);
  const double upper = common.upper(0.1);
  CHECK(upper > 0.5 * around);
  CHECK(upper < 0.1);
}
