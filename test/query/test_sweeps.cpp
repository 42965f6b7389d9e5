// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Sweeps of parts: above what each of the motions collides with, and hardly above where a closed
// form knows it. The lower end is that of all that they may fill.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/narrowphase/collision.h>

#include <cmath>

#include "catch.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/fcl_prob.h"
#include "mesh_shapes.h"
#include "query/partition.h"
#include "random_bodies.h"
#include "shapes.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

using Geometry = std::shared_ptr<const fcl::CollisionGeometryd>;

fcl::Transform3d posedAt(const Eigen::Vector3d& position) {
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.translation() = position;
  return pose;
}

/// A at `pose`, swept, against B at the origin.
ProbabilityResult swept(const fcl::CollisionGeometryd& a, const fcl::Transform3d& pose,
                        const detail::PointMotion& sweep, const fcl::CollisionGeometryd& b,
                        const GaussianDisplacement& displacement,
                        const ProbabilityRequest& request) {
  const auto tree_a = detail::buildPieceTree(a);
  const auto tree_b = detail::buildPieceTree(b);
  return detail::partitionProbability({tree_a.get(), {{pose, nullptr, &sweep}}},
                                      {tree_b.get(), {{posedAt(Eigen::Vector3d::Zero()), nullptr}}},
                                      displacement, request);
}

double exactOf(const fcl::CollisionGeometryd& a, const fcl::Transform3d& pose,
               const fcl::CollisionGeometryd& b, const GaussianDisplacement& displacement) {
  ProbabilityRequest request;
  request.method = ProbabilityMethod::exact;
  ProbabilityResult result;
  return collisionProbability(&a, pose, &b, posedAt(Eigen::Vector3d::Zero()), displacement, request,
                              result);
}

}  // namespace

TEST_CASE("a box swept along its edge is a longer box") {
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.02, 0.03, 0.05});
  const fcl::Boxd b(0.2, 0.3, 0.4);
  detail::PointMotion sweep;
  sweep.shifts = {Eigen::Vector3d(0.0, 0.03, 0.0)};
  sweep.turns = {Eigen::Vector3d::Zero()};
  ProbabilityRequest request;
  request.relative_tolerance = 0.002;
  for (const Eigen::Vector3d& position :
       {Eigen::Vector3d(0.17, 0.05, 0.1), Eigen::Vector3d(0.05, 0.31, 0.0)}) {
    const fcl::Boxd a(0.1, 0.2, 0.3), longer(0.1, 0.26, 0.3);
    const fcl::Transform3d pose = posedAt(position);
    sweep.centre = position;
    const double moved = exactOf(longer, pose, b, displacement);
    const ProbabilityResult shape = swept(a, pose, sweep, b, displacement, request);
    CAPTURE(moved, *shape.lower, *shape.upper, toString(shape.status));
    CHECK(*shape.lower <= moved);
    CHECK(*shape.lower >= 0.99 * moved - 1e-6);
    CHECK(*shape.upper >= moved);
    CHECK(*shape.upper <= 1.01 * moved + 1e-6);
    const auto mesh_a = makeModel<fcl::OBBRSSd>(boxMesh(Eigen::Vector3d(0.1, 0.2, 0.3)));
    const auto mesh_b = makeModel<fcl::OBBRSSd>(boxMesh(Eigen::Vector3d(0.2, 0.3, 0.4)));
    const ProbabilityResult mesh = swept(*mesh_a, pose, sweep, *mesh_b, displacement, request);
    CAPTURE(*mesh.lower, *mesh.upper, toString(mesh.status));
    CHECK(*mesh.lower <= 1.01 * moved);
    CHECK(*mesh.lower >= 0.98 * moved - 1e-6);
    CHECK(*mesh.upper >= 0.999 * moved);
    CHECK(*mesh.upper <= 1.02 * moved + 1e-6);
  }
}

TEST_CASE("a turning cylinder stays below its sweep at every angle, and that below a ball's") {
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.02, 0.03, 0.02});
  const fcl::Cylinderd a(0.05, 0.4);
  const fcl::Boxd b(0.2, 0.2, 0.2);
  constexpr double kAngle = 0.1;
  RandomBodies random(77);
  for (int i = 0; i < 4; ++i) {
    fcl::Transform3d pose = posedAt(0.22 * random.direction());
    pose.linear() = random.rotation();
    const Eigen::Vector3d axis = random.direction();
    detail::PointMotion sweep;
    sweep.centre = pose.translation();
    sweep.turns = {kAngle * axis};
    // Off the line of its velocity by no more than angle² / 2 times the lever arm.
    sweep.ball = 0.5 * kAngle * kAngle * 0.21;
    ProbabilityRequest request;
    request.relative_tolerance = 0.01;
    const ProbabilityResult result = swept(a, pose, sweep, b, displacement, request);
    ProbabilityResult banded;
    ProbabilityRequest with_band = request;
    with_band.band_a.outward = kAngle * 0.21 + sweep.ball;
    collisionProbability(&a, pose, &b, posedAt(Eigen::Vector3d::Zero()), displacement, with_band,
                         banded);
    CHECK(*result.upper <= *banded.upper * 1.01);
    int hits = 0;
    constexpr int kDraws = 1'000;
    for (int draw = 0; draw < kDraws; ++draw) {
      Eigen::Vector3d moved;
      for (int k = 0; k < 3; ++k) moved[k] = random.normal() * displacement.standardDeviations()[k];
      moved = displacement.axes() * moved;
      bool hit = false;
      for (int step = -10; step <= 10 && !hit; ++step) {
        fcl::Transform3d turned = pose;
        turned.linear() = Eigen::AngleAxisd(0.1 * step * kAngle, axis) * pose.linear();
        turned.translation() += moved;
        fcl::CollisionResultd contacts;
        hit = fcl::collide(&a, turned, &b, posedAt(Eigen::Vector3d::Zero()),
                           fcl::CollisionRequestd(), contacts) > 0;
      }
      hits += hit;
    }
    const double share = static_cast<double>(hits) / kDraws;
    const double error = 5.0 * std::sqrt(share * (1.0 - share) / kDraws) + 5.0 / kDraws;
    CAPTURE(i, share, *result.lower, *result.upper, *banded.upper);
    CHECK(*result.upper >= share - error);
    CHECK(*result.lower >= exactOf(a, pose, b, displacement) * 0.98);
  }
}

TEST_CASE("sweeps of parts and bands around shapes are not mixed") {
  const fcl::Boxd box(1, 1, 1);
  ProbabilityRequest request;
  request.band_a = Band::within(0.1);
  const auto displacement = GaussianDisplacement::fromStandardDeviations({1, 1, 1});
  CHECK_THROWS_AS(swept(box, posedAt({1, 0, 0}), {}, box, displacement, request), InvalidRequest);
}
