// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Certified intervals over poses against closed forms and counting.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/sphere.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>

#include "catch.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/monte_carlo.h"
#include "mesh_shapes.h"
#include "pose_cases.h"
#include "shapes.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

using Method = ProbabilityMethod;

ProbabilityRequest intervalRequest(double relative_tolerance, std::size_t cells = 300'000) {
  ProbabilityRequest request = poseRequest(Method::interval, relative_tolerance);
  request.max_cells = cells;
  return request;
}

void checkContains(const ProbabilityResult& result, double expected) {
  CAPTURE(*result.lower, *result.upper, expected);
  CHECK(*result.lower <= expected);
  CHECK(*result.upper >= expected);
}

/// Pairs of everything that is bounded, and of closed meshes.
struct RandomScene {
  std::shared_ptr<fcl::CollisionGeometryd> a;
  std::shared_ptr<fcl::CollisionGeometryd> b;
  fcl::Transform3d pose_a;
  fcl::Transform3d pose_b;
  PoseError error;
  ContactMeaning contact = ContactMeaning::fcl;
};

RandomScene randomScene(RandomBodies& random) {
  static const std::vector<NamedGeometry> shapes = boundedShapes();
  static const std::vector<std::shared_ptr<fcl::CollisionGeometryd>> models{
      makeModel<fcl::OBBRSSd>(bumpyMesh(0.5, 4, 6, 1)),
      makeModel<fcl::OBBRSSd>(torusMesh(0.5, 0.2, 8, 5)),
      makeModel<fcl::OBBRSSd>(bumpyMesh(0.15, 3, 4, 2))};
  const auto any = [&](const std::shared_ptr<fcl::CollisionGeometryd>& other) {
    for (;;) {
      std::shared_ptr<fcl::CollisionGeometryd> geometry;
      if (random.integer(0, 1) == 0) {
        geometry =
            shapes[static_cast<std::size_t>(random.integer(0, static_cast<int>(shapes.size()) - 1))]
                .geometry;
      } else {
        geometry = models[static_cast<std::size_t>(random.integer(0, 2))];
      }
      if (!other || fclSupportsPair(*other, *geometry)) return geometry;
    }
  };
  RandomScene scene;
  do {
    scene.a = any(nullptr);
  } while (!fclSupportsPair(*scene.a, *scene.a));
  scene.b = any(scene.a);
  scene.pose_a = random.pose(0.5);
  scene.pose_b = random.pose(0.5);
  scene.pose_b.pretranslate(random.uniform(0.0, 1.3) * random.direction());
  const auto convention = static_cast<PoseConvention>(random.integer(0, 3));
  const int rank = random.integer(0, 3) == 0 ? random.integer(1, 5) : 6;
  scene.error = PoseError(randomPoseCovariance(random, rank, random.logUniform(0.01, 0.3),
                                               random.logUniform(1e-6, 0.5)),
                          convention);
  const bool closed =
      scene.a->getObjectType() == fcl::OT_BVH || scene.b->getObjectType() == fcl::OT_BVH;
  if (closed && random.integer(0, 2) == 0) scene.contact = ContactMeaning::solid;
  return scene;
}

void checkRandomScenes(unsigned seed, int count, std::size_t samples, std::size_t cells) {
  RandomBodies random(seed);
  for (int i = 0; i < count; ++i) {
    const RandomScene scene = randomScene(random);
    const PreparedPoseQuery query(scene.a, scene.b);
    ProbabilityRequest request = intervalRequest(0.1, cells);
    request.absolute_tolerance = 1e-3;
    request.contact = scene.contact;
    const auto interval = answer(query, scene.pose_a, scene.pose_b, scene.error, request);
    ProbabilityRequest counting = poseRequest(Method::monte_carlo, 1e-12);
    counting.absolute_tolerance = 0.0;
    counting.samples = samples;
    counting.contact = scene.contact;
    counting.seed = static_cast<std::uint64_t>(i) + 1000 * seed;
    counting.confidence = 1.0 - 6e-7;
    const auto counted = answer(query, scene.pose_a, scene.pose_b, scene.error, counting);
    CAPTURE(seed, i, *interval.lower, *interval.upper, *counted.estimate, toString(interval.status),
            static_cast<int>(scene.a->getNodeType()), static_cast<int>(scene.b->getNodeType()),
            static_cast<int>(scene.error.convention()), scene.contact == ContactMeaning::solid);
    CHECK(*interval.lower >= 0.0);
    CHECK(*interval.upper <= 1.0);
    CHECK(*interval.lower <= counted.confidence_interval->upper);
    CHECK(*interval.upper >= counted.confidence_interval->lower);
  }
}

}  // namespace

TEST_CASE("intervals over random poses contain what counting finds") {
  checkRandomScenes(1, 40, 500, 1'000);
}

TEST_CASE("intervals over 2,000 random poses contain what counting finds", "[long]") {
  for (unsigned seed = 2; seed < 22; ++seed) checkRandomScenes(seed, 100, 10'000, 20'000);
}

TEST_CASE("a sphere that turns about its centre has the interval of one that does not") {
  const auto sphere = std::make_shared<fcl::Sphered>(0.3);
  const auto box = std::make_shared<fcl::Boxd>(1, 1, 1);
  const PreparedPoseQuery query(sphere, box);
  const auto translation = GaussianDisplacement::fromStandardDeviations({0.1, 0.05, 0.08});
  const fcl::Transform3d pose_a = at(0.9, 0.1, 0.0);
  ProbabilityResult exact;
  collisionProbability(sphere.get(), pose_a, box.get(), kIdentity, translation,
                       intervalRequest(1e-5), exact);
  for (const double sigma : {1e-6, 1e-3, 0.02, 0.5}) {
    const auto error =
        PoseError::fromIndependent(translation, sigma * sigma * Eigen::Matrix3d::Identity());
    const auto result = answer(query, pose_a, kIdentity, error, intervalRequest(0.1));
    CAPTURE(sigma);
    CHECK(result.status == ProbabilityStatus::converged);
    checkContains(result, exact.probability());
  }
}

TEST_CASE("a sphere on a lever before a wall: the interval contains the closed form", "[slow]") {
  const double lever = 0.7, radius = 0.1, sigma = 0.05, gap = 0.06;
  const PreparedPoseQuery query(std::make_shared<fcl::Sphered>(radius),
                                std::make_shared<fcl::Boxd>(4.0, 2.0, 4.0));
  for (const double angle : {1e-4, 0.02, 0.1, 0.4}) {
    const auto error = PoseError::fromStandardDeviations({sigma, sigma, sigma}, {0, 0, angle},
                                                         PoseConvention::world_exponential);
    const double expected = gaussianMean(angle, [&](double theta) {
      const double shrunk = std::fabs(theta) < 1e-6 ? 1.0 : std::sin(0.5 * theta) / (0.5 * theta);
      return normalCdf((lever * std::sin(theta) - gap) / (sigma * shrunk));
    });
    const auto result = answer(query, at(lever, 0, 0), at(lever, gap + radius + 1.0, 0), error,
                               intervalRequest(0.02, 60'000));
    CAPTURE(angle);
    // Each rotation asks for the interval of a curved pair: their cells come first.
    const bool converged = result.status == ProbabilityStatus::converged;
    CHECK((converged || (angle > 1e-3 && result.status == ProbabilityStatus::cell_limit)));
    checkContains(result, expected);
    CHECK(*result.upper - *result.lower <= (converged ? 0.02 * *result.upper : 0.2));
  }
}

TEST_CASE("one axis and no translation: rotations are all there is") {
  // As in the test of the estimate: the box reaches x = 0.53 between two angles.
  const auto error = PoseError::fromStandardDeviations({0, 0, 0}, {0, 0, 0.2});
  const PreparedPoseQuery query(std::make_shared<fcl::Boxd>(1.0, 0.4, 0.2),
                                std::make_shared<fcl::Boxd>(2.0, 4.0, 4.0));
  const double corner = std::hypot(0.5, 0.2), direction = std::atan2(0.2, 0.5);
  const double touching = direction - std::acos(0.53 / corner);
  const double other = direction + std::acos(0.53 / corner);
  const double expected = 2.0 * (normalCdf(other / 0.2) - normalCdf(touching / 0.2));
  const auto result = answer(query, kIdentity, at(1.53, 0, 0), error, intervalRequest(0.01));
  CHECK(result.status == ProbabilityStatus::converged);
  checkContains(result, expected);
}

TEST_CASE("boxes that turn by a degree: a narrow interval is reached") {
  const PreparedPoseQuery query = boxes();
  const auto error =
      PoseError::fromStandardDeviations({0.05, 0.05, 0.05}, {0.0175, 0.0175, 0.0175});
  const auto result =
      answer(query, kIdentity, at(0.82, 0.1, 0.1), error, intervalRequest(0.25, 2'000'000));
  CHECK(result.status == ProbabilityStatus::converged);
  ProbabilityRequest counting = poseRequest(Method::monte_carlo, 1e-12);
  counting.samples = 5'000;
  const auto counted = answer(query, kIdentity, at(0.82, 0.1, 0.1), error, counting);
  CHECK(*result.lower <= *counted.estimate + 5.0 * *counted.standard_error);
  CHECK(*result.upper >= *counted.estimate - 5.0 * *counted.standard_error);
}

TEST_CASE("an interval over poses is valid wherever it stops, whatever the number of threads") {
  const PreparedPoseQuery query = boxes();
  const auto error = PoseError::fromStandardDeviations({0.1, 0.1, 0.1}, {0.05, 0.05, 0.05});
  const fcl::Transform3d pose_b = at(0.9, 0, 0);
  const double p =
      answer(query, kIdentity, pose_b, error, poseRequest(Method::estimate)).probability();
  const auto one = answer(query, kIdentity, pose_b, error, intervalRequest(1e-3, 3'000));
  CHECK(one.status == ProbabilityStatus::cell_limit);
  checkContains(one, p);
  ProbabilityRequest request = intervalRequest(1e-3, 3'000);
  request.threads = 3;
  const auto three = answer(query, kIdentity, pose_b, error, request);
  CHECK(*one.lower == *three.lower);
  CHECK(*one.upper == *three.upper);

  request = intervalRequest(1e-3);
  request.time_limit = 0.05;
  auto result = answer(query, kIdentity, pose_b, error, request);
  CHECK(result.status == ProbabilityStatus::time_limit);
  checkContains(result, p);
  request.time_limit.reset();
  int calls = 0;
  request.on_progress = [&](const ProbabilityProgress& progress) {
    CHECK(progress.interval.lower <= p);
    CHECK(progress.interval.upper >= p);
    return ++calls < 40;
  };
  result = answer(query, kIdentity, pose_b, error, request);
  CHECK(result.status == ProbabilityStatus::cancelled);
  checkContains(result, p);
  request.on_progress = nullptr;
  request.threshold = 0.2 * p;
  result = answer(query, kIdentity, pose_b, error, request);
  CHECK(result.status == ProbabilityStatus::decided);
  CHECK(result.decision == Decision::above);
}

TEST_CASE("an interval over poses refuses what is unbounded") {
  const PreparedPoseQuery query(std::make_shared<fcl::Boxd>(1.0, 0.4, 0.2),
                                std::make_shared<fcl::Halfspaced>(Eigen::Vector3d(-1, 0, 0), 0.0));
  ProbabilityResult result;
  CHECK_THROWS_AS(
      query.collisionProbability(kIdentity, kIdentity,
                                 PoseError::fromStandardDeviations({0, 0, 0}, {0, 0, 0.2}),
                                 intervalRequest(0.1), result),
      UnsupportedGeometry);
}
