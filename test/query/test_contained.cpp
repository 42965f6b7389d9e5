// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// P that one object is wholly within the other, against products of normal masses and counting.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/sphere.h>

#include <cmath>
#include <memory>

#include "catch.h"
#include "fcl_prob/convex_polytope.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/fcl_prob.h"
#include "fcl_prob/group.h"
#include "fcl_prob/mixture.h"
#include "fcl_prob/normal_mass.h"
#include "geometry/displaced_collider.h"
#include "mesh_shapes.h"
#include "shapes.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

using Geometry = std::shared_ptr<const fcl::CollisionGeometryd>;

const fcl::Transform3d kAtOrigin = fcl::Transform3d::Identity();

ProbabilityRequest containedRequest(double tolerance = 1e-3) {
  ProbabilityRequest request;
  request.contact = ContactMeaning::contained;
  request.relative_tolerance = tolerance;
  return request;
}

ProbabilityResult contained(const Geometry& a, const fcl::Transform3d& pose_a, const Geometry& b,
                            const fcl::Transform3d& pose_b,
                            const GaussianDisplacement& displacement,
                            const ProbabilityRequest& request = containedRequest()) {
  ProbabilityResult result;
  PreparedQuery(a, b).collisionProbability(pose_a, pose_b, displacement, request, result);
  return result;
}

/// Of what reaches `half` along the axes from its middle, within a box of those half sides around
/// the origin: it may move by what is left.
double withinBox(const Eigen::Vector3d& half, const Eigen::Vector3d& half_of_box,
                 const Eigen::Vector3d& mean, const Eigen::Vector3d& deviations) {
  double p = 1.0;
  for (int k = 0; k < 3; ++k) {
    const double room = half_of_box[k] - half[k];
    if (!(room > 0.0)) return 0.0;
    p *= normalIntervalMass((-room - mean[k]) / deviations[k], (room - mean[k]) / deviations[k]);
  }
  return p;
}

GaussianDisplacement alongAxes(const Eigen::Vector3d& mean, const Eigen::Vector3d& deviations) {
  return GaussianDisplacement(mean, deviations.cwiseAbs2().asDiagonal().toDenseMatrix());
}

/// Whether A, displaced, is within B, surfaces apart: by FCL, without any answer of ours.
class ContainedCollider {
 public:
  ContainedCollider(const Geometry& a, const fcl::Transform3d& pose_a, const Geometry& b,
                    const fcl::Transform3d& pose_b)
      : overlap_(*a, pose_a, *b, pose_b, ContactMeaning::solid),
        touch_(*a, pose_a, *b, pose_b, ContactMeaning::fcl) {}

  bool contains(const Eigen::Vector3d& displacement) const {
    return overlap_.collides(displacement) && !touch_.collides(displacement);
  }

 private:
  detail::DisplacedCollider overlap_, touch_;
};

}  // namespace

TEST_CASE("boxes, spheres and tilted bodies within a box: a product of masses") {
  RandomBodies random(11);
  const Eigen::Vector3d half_of_box(0.5, 0.4, 0.3);
  const auto box = std::make_shared<fcl::Boxd>(2 * half_of_box);
  const auto as_mesh = makeModel<fcl::OBBRSSd>(boxMesh(2 * half_of_box));
  const auto as_convex = convexGeometry(convexHull(boxMesh(2 * half_of_box).vertices));
  for (int i = 0; i < 12; ++i) {
    const Eigen::Vector3d mean(random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), 0.05);
    const Eigen::Vector3d deviations(random.uniform(0.02, 0.2), random.uniform(0.02, 0.2), 0.1);
    const GaussianDisplacement displacement = alongAxes(mean, deviations);
    const auto sphere = std::make_shared<fcl::Sphered>(random.uniform(0.05, 0.28));
    const auto brick = std::make_shared<fcl::Boxd>(0.3, 0.2, 0.1);
    const auto bumpy = makeModel<fcl::OBBRSSd>(bumpyMesh(0.15, 6, 8, 3));
    fcl::Transform3d tilted = random.pose(0.0);
    tilted.translation().setZero();
    Eigen::Vector3d reach = Eigen::Vector3d::Zero();
    const Eigen::Vector3d half_of_brick(0.15, 0.1, 0.05);
    reach = tilted.linear().cwiseAbs() * half_of_brick;
    const Geometry containers[] = {box, as_mesh, as_convex};
    const Geometry& container = containers[i % 3];
    CAPTURE(i);
    const auto check = [&](const ProbabilityResult& result, double truth) {
      CHECK(*result.lower <= truth * (1 + 1e-12));
      CHECK(*result.upper >= truth * (1 - 1e-12));
      CHECK(*result.upper - *result.lower <= std::max(1e-6, 1.0001e-3 * *result.upper));
    };
    check(contained(sphere, kAtOrigin, container, kAtOrigin, displacement),
          withinBox(Eigen::Vector3d::Constant(sphere->radius), half_of_box, mean, deviations));
    check(contained(brick, tilted, container, kAtOrigin, displacement),
          withinBox(reach, half_of_box, mean, deviations));
    Eigen::Vector3d lowest = Eigen::Vector3d::Constant(1e9), highest = -lowest;
    for (int v = 0; v < bumpy->num_vertices; ++v) {
      const Eigen::Vector3d at = tilted.linear() * bumpy->vertices[v];
      lowest = lowest.cwiseMin(at);
      highest = highest.cwiseMax(at);
    }
    check(contained(bumpy, tilted, container, kAtOrigin, displacement),
          withinBox(0.5 * (highest - lowest), half_of_box, mean + 0.5 * (highest + lowest),
                    deviations));
  }
}

TEST_CASE("a mesh within a mesh is as often as counting says") {
  RandomBodies random(12);
  for (int i = 0; i < 3; ++i) {
    const auto outer = makeModel<fcl::OBBRSSd>(bumpyMesh(0.5, 8, 10, 20 + i));
    const auto inner = makeModel<fcl::OBBRSSd>(bumpyMesh(0.12, 6, 8, 40 + i));
    const fcl::Transform3d pose = random.pose(0.15);
    const GaussianDisplacement displacement = randomDisplacement(random, 0.05, 0.15);
    const ProbabilityResult result =
        contained(inner, pose, outer, kAtOrigin, displacement, containedRequest(0.02));
    CHECK(result.status == ProbabilityStatus::converged);
    const ContainedCollider collider(inner, pose, outer, kAtOrigin);
    const Eigen::Matrix3d factor = displacement.covariance().llt().matrixL();
    constexpr int kSamples = 20'000;
    int hits = 0;
    for (int s = 0; s < kSamples; ++s) {
      const Eigen::Vector3d y(random.normal(), random.normal(), random.normal());
      hits += collider.contains(displacement.mean() + factor * y);
    }
    const double counted = static_cast<double>(hits) / kSamples;
    const double error = std::sqrt(std::max(counted, 1e-3) / kSamples);
    CAPTURE(i, counted, *result.lower, *result.upper);
    CHECK(*result.lower <= counted + 5 * error);
    CHECK(*result.upper >= counted - 5 * error);
    CHECK(counted > 0.01);

    ProbabilityRequest request = containedRequest(0.01);
    request.method = ProbabilityMethod::estimate;
    const ProbabilityResult estimate =
        contained(inner, pose, outer, kAtOrigin, displacement, request);
    CHECK(estimate.status == ProbabilityStatus::converged);
    CHECK(*estimate.estimate >= *result.lower - 5 * *estimate.standard_error);
    CHECK(*estimate.estimate <= *result.upper + 5 * *estimate.standard_error);
    for (const double share : {0.5, 1.5}) {
      request = containedRequest();
      request.threshold = std::min(0.999, share * *result.upper);
      const ProbabilityResult decided =
          contained(inner, pose, outer, kAtOrigin, displacement, request);
      CHECK(decided.status == ProbabilityStatus::decided);
      CHECK(decided.decision ==
            (*request.threshold < *result.lower ? Decision::above : Decision::below));
    }
  }
}

TEST_CASE("what is larger is never within, and the other way round is no containment") {
  const auto large = makeModel<fcl::OBBRSSd>(bumpyMesh(0.5, 8, 10, 1));
  const auto small = makeModel<fcl::OBBRSSd>(bumpyMesh(0.1, 6, 8, 2));
  const GaussianDisplacement displacement(1e-4 * Eigen::Matrix3d::Identity());
  const ProbabilityResult never = contained(large, kAtOrigin, small, kAtOrigin, displacement);
  CHECK(never.status == ProbabilityStatus::exact);
  CHECK(*never.upper == 0.0);
  const ProbabilityResult surely = contained(small, kAtOrigin, large, kAtOrigin, displacement);
  CHECK(*surely.lower > 0.999);
}

TEST_CASE("mixtures, truncated and vanishing displacements, and gradients") {
  const Eigen::Vector3d half_of_box(0.5, 0.4, 0.3), half(0.1, 0.1, 0.1);
  const auto box = std::make_shared<fcl::Boxd>(2 * half_of_box);
  const auto ball = std::make_shared<fcl::Sphered>(0.1);
  const Eigen::Vector3d first(0.3, 0, 0), second(0, 0.25, 0.1), deviations(0.1, 0.05, 0.08);
  const GaussianMixture mixture(
      {{0.25, alongAxes(first, deviations)}, {0.75, alongAxes(second, deviations)}});
  ProbabilityResult result;
  const PreparedQuery query(ball, box);
  collisionProbability(query, kAtOrigin, kAtOrigin, mixture, containedRequest(), result);
  const double truth = 0.25 * withinBox(half, half_of_box, first, deviations) +
                       0.75 * withinBox(half, half_of_box, second, deviations);
  CHECK(*result.lower <= truth);
  CHECK(*result.upper >= truth);
  CHECK(*result.upper - *result.lower < 2e-3);

  const TruncatedGaussian truncated(alongAxes(first, deviations), 6.0);
  collisionProbability(query, kAtOrigin, kAtOrigin, truncated, containedRequest(), result);
  const double of_first = withinBox(half, half_of_box, first, deviations);
  CHECK(*result.lower <= of_first + 1e-6);
  CHECK(*result.upper >= of_first - 1e-6);

  const GaussianDisplacement still(Eigen::Vector3d(0.1, 0, 0), Eigen::Matrix3d::Zero());
  CHECK(*contained(ball, kAtOrigin, box, kAtOrigin, still).lower == 1.0);
  const GaussianDisplacement out(Eigen::Vector3d(0.45, 0, 0), Eigen::Matrix3d::Zero());
  CHECK(*contained(ball, kAtOrigin, box, kAtOrigin, out).upper == 0.0);

  ProbabilityRequest request = containedRequest(1e-4);
  request.gradient = true;
  const ProbabilityResult with_gradient =
      contained(ball, kAtOrigin, box, kAtOrigin, alongAxes(first, deviations), request);
  REQUIRE(with_gradient.gradient);
  const double step = 1e-5;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d moved = step * Eigen::Vector3d::Unit(k);
    const double slope = (withinBox(half, half_of_box, first + moved, deviations) -
                          withinBox(half, half_of_box, first - moved, deviations)) /
                         (2 * step);
    CHECK((*with_gradient.gradient)[k] == Approx(slope).margin(0.02));
    CHECK((*with_gradient.gradient_lower)[k] <= slope + 1e-6);
    CHECK((*with_gradient.gradient_upper)[k] >= slope - 1e-6);
  }
}

TEST_CASE("containment is refused by name where it is not told") {
  const auto box = std::make_shared<fcl::Boxd>(1, 1, 1);
  const auto ball = std::make_shared<fcl::Sphered>(0.1);
  const GaussianDisplacement displacement(0.01 * Eigen::Matrix3d::Identity());
  const auto refused = [&](const Geometry& a, const Geometry& b, ProbabilityRequest request) {
    ProbabilityResult result;
    PreparedQuery(a, b).collisionProbability(kAtOrigin, kAtOrigin, displacement, request, result);
  };
  const auto by = [](ProbabilityMethod method) {
    ProbabilityRequest request = containedRequest();
    request.method = method;
    return request;
  };
  CHECK_THROWS_WITH(refused(ball, std::make_shared<fcl::Capsuled>(1, 2), containedRequest()),
                    Catch::Contains("object B is a Capsule"));
  TriangleMesh away = boxMesh({0.1, 0.1, 0.1});
  for (Eigen::Vector3d& v : away.vertices) v.x() += 0.2;
  const auto two = makeModel<fcl::OBBRSSd>(joined(boxMesh({0.1, 0.1, 0.1}), away));
  CHECK_THROWS_WITH(refused(two, box, containedRequest()), Catch::Contains("in 2 pieces"));
  TriangleMesh open = boxMesh({0.1, 0.1, 0.1});
  open.triangles.pop_back();
  CHECK_THROWS_AS(refused(makeModel<fcl::OBBRSSd>(open), box, containedRequest()), OpenMesh);
  CHECK_THROWS_AS(refused(ball, box, by(ProbabilityMethod::monte_carlo)), InvalidRequest);
  CHECK_THROWS_AS(refused(ball, box, by(ProbabilityMethod::general_pcd)), InvalidRequest);
  ProbabilityRequest banded = containedRequest();
  banded.band_a.outward = 0.01;
  CHECK_THROWS_AS(refused(ball, box, banded), InvalidRequest);
  const GroupQuery groups({ball, ball}, {box});
  ProbabilityResult result;
  CHECK_THROWS_WITH(groups.collisionProbability({kAtOrigin, kAtOrigin}, {kAtOrigin}, displacement,
                                                containedRequest(), result),
                    Catch::Contains("of pairs"));
}
