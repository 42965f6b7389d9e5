// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Mixtures and truncated Gaussians against closed forms and rejection sampling.
#include "fcl_prob/mixture.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/plane.h>
#include <fcl/geometry/shape/sphere.h>

#include <cmath>
#include <limits>

#include "catch.h"
#include "fcl_prob/batch.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/normal_mass.h"
#include "geometry/displaced_collider.h"
#include "mesh_shapes.h"
#include "poses.h"
#include "shapes.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

const double kInfinity = std::numeric_limits<double>::infinity();

void checkHolds(const ProbabilityResult& result, double expected, double tolerance) {
  CAPTURE(*result.lower, *result.upper, expected);
  CHECK(*result.lower <= expected * (1 + 1e-12));
  CHECK(*result.upper >= expected * (1 - 1e-12));
  CHECK(*result.upper - *result.lower <= tolerance);
}

/// Mass of { y_1 >= h, |y| <= k } under N(0, I) in three dimensions.
double capMass(double h, double k) {
  return normalIntervalMass(h, k) - (k - h) * 0.39894228040143268 * std::exp(-0.5 * k * k);
}

double ballMassOf(double k) { return normalBallMass(0.0, k).middle(); }

PreparedQuery boxAndWall() {
  return {std::make_shared<fcl::Boxd>(0.2, 0.2, 0.2), std::make_shared<fcl::Boxd>(10, 10, 10)};
}

/// So many deviations of 0.1 m between the two.
fcl::Transform3d wallAt(double deviations) { return at(5.1 + 0.1 * deviations, 0, 0); }

const auto kIsotropic = GaussianDisplacement::fromStandardDeviations({0.1, 0.1, 0.1});

PreparedQuery meshAndTorus() {
  return {makeModel<fcl::OBBRSSd>(bumpyMesh(0.4, 4, 6, 1)),
          makeModel<fcl::OBBRSSd>(torusMesh(0.5, 0.2, 8, 5))};
}

ProbabilityRequest withTolerance(double relative) {
  ProbabilityRequest request;
  request.relative_tolerance = relative;
  request.absolute_tolerance = 0.0;
  return request;
}

}  // namespace

TEST_CASE("a mixture is the sum of its components by weight") {
  RandomBodies random(1);
  const PreparedQuery query = meshAndTorus();
  for (int i = 0; i < 6; ++i) {
    const double w = random.uniform(0.1, 0.5);
    const GaussianMixture mixture({{w, randomDisplacement(random, 0.05, 0.2)},
                                   {0.9 - w, randomDisplacement(random, 0.05, 0.2)},
                                   {0.1, randomDisplacement(random, 0.3, 0.4)}});
    const fcl::Transform3d pose = random.pose(1.0);
    ProbabilityRequest request = withTolerance(0.05);
    request.gradient = i % 2 == 0;
    ProbabilityResult result;
    collisionProbability(query, pose, kIdentity, mixture, request, result);
    CHECK(*result.upper - *result.lower <= 0.05 * *result.upper);
    CHECK(result.gradient.has_value() == request.gradient);
    double lower = 0.0, upper = 0.0;
    Eigen::Vector3d least = Eigen::Vector3d::Zero(), most = least;
    for (const auto& component : mixture.components()) {
      ProbabilityResult one;
      ProbabilityRequest fine = withTolerance(0.02);
      fine.gradient = true;
      query.collisionProbability(pose, kIdentity, component.displacement, fine, one);
      lower += component.weight * *one.lower;
      upper += component.weight * *one.upper;
      least += component.weight * *one.gradient_lower;
      most += component.weight * *one.gradient_upper;
    }
    CHECK(*result.lower <= upper);
    CHECK(*result.upper >= lower);
    if (!request.gradient) continue;
    CHECK((result.gradient_lower->array() <= most.array()).all());
    CHECK((result.gradient_upper->array() >= least.array()).all());
  }
}

TEST_CASE("a mixture in the tail holds the sum of two tails; one Gaussian is itself") {
  const PreparedQuery query = boxAndWall();
  const GaussianMixture two(
      {{0.75, kIsotropic}, {0.25, kIsotropic.withMean(Eigen::Vector3d(0.2, 0, 0))}});
  ProbabilityResult result, single;
  collisionProbability(query, kIdentity, wallAt(6.0), two, withTolerance(1e-3), result);
  checkHolds(result, 0.75 * normalTailMass(6.0) + 0.25 * normalTailMass(4.0), 1e-8);
  collisionProbability(query, kIdentity, wallAt(2.0), GaussianMixture({{1.0, kIsotropic}}), {},
                       result);
  query.collisionProbability(kIdentity, wallAt(2.0), kIsotropic, {}, single);
  CHECK(*result.lower == Approx(*single.lower).epsilon(1e-14));
  CHECK(*result.upper == Approx(*single.upper).epsilon(1e-14));
  CHECK(result.status == single.status);
}

TEST_CASE("a mixture has converged only where its sum is within the tolerance") {
  const PreparedQuery query = boxAndWall();
  ProbabilityRequest request;
  request.method = ProbabilityMethod::interval;
  request.absolute_tolerance = 0.0;
  request.relative_tolerance = 0.3;
  int beyond = 0;
  for (double deviations = 30.0; deviations < 44.0; deviations += 0.5) {
    const GaussianMixture mixture({{0.5, kIsotropic}, {0.5, kIsotropic}});
    ProbabilityResult result;
    collisionProbability(query, kIdentity, wallAt(deviations), mixture, request, result);
    CAPTURE(deviations, *result.lower, *result.upper);
    const bool within = *result.upper - *result.lower <= 0.3 * *result.upper;
    const bool converged = result.status == ProbabilityStatus::converged;
    CHECK((within || !converged));
    beyond += *result.lower == 0.0;
  }
  CHECK(beyond > 0);
}

TEST_CASE("a threshold is decided by some of the components; a query can be cancelled") {
  const PreparedQuery query = meshAndTorus();
  const GaussianMixture mixture(
      {{0.9, kIsotropic}, {0.1, kIsotropic.withMean(Eigen::Vector3d(0.3, 0, 0))}});
  ProbabilityRequest request;
  request.threshold = 0.5;
  ProbabilityResult result;
  collisionProbability(query, at(0.6, 0, 0), kIdentity, mixture, request, result);
  CHECK(result.decision == Decision::above);
  CHECK(result.status == ProbabilityStatus::decided);
  CHECK(*result.lower > 0.5);
  request.threshold.reset();
  request.on_progress = [](const ProbabilityProgress&) { return false; };
  collisionProbability(query, at(0.6, 0, 0), kIdentity, mixture, request, result);
  CHECK(result.status == ProbabilityStatus::cancelled);
}

TEST_CASE("mixtures refuse weights that are no distribution") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(GaussianMixture({}), InvalidDistribution);
  CHECK_THROWS_AS(GaussianMixture({{0.5, kIsotropic}}), InvalidDistribution);
  CHECK_THROWS_AS(GaussianMixture({{1.5, kIsotropic}, {-0.5, kIsotropic}}), InvalidDistribution);
  CHECK_THROWS_AS(GaussianMixture({{nan, kIsotropic}}), InvalidDistribution);
  for (const double wrong : {0.0, -1.0, nan}) {
    CHECK_THROWS_AS(TruncatedGaussian(kIsotropic, wrong), InvalidDistribution);
  }
}

TEST_CASE("truncated: a wall cuts a cap off the ball") {
  const PreparedQuery query = boxAndWall();
  for (const double k : {1.0, 2.5, 4.0, 8.0}) {
    for (const double h : {-0.5 * k, 0.0, 0.4 * k, 0.9 * k}) {
      CAPTURE(k, h);
      ProbabilityResult result;
      collisionProbability(query, kIdentity, wallAt(h), TruncatedGaussian(kIsotropic, k),
                           withTolerance(0.01), result);
      const double expected = capMass(h, k) / ballMassOf(k);
      checkHolds(result, expected, 0.01 * *result.upper);
      CHECK(result.status == ProbabilityStatus::converged);
    }
    ProbabilityResult beyond;
    collisionProbability(query, kIdentity, wallAt(1.01 * k), TruncatedGaussian(kIsotropic, k), {},
                         beyond);
    CHECK(*beyond.upper < 1e-300);
  }
}

TEST_CASE("truncated in fewer directions, and not at all") {
  const PreparedQuery query = boxAndWall();
  const auto line = GaussianDisplacement::fromStandardDeviations({0.1, 0.0, 0.0});
  ProbabilityResult result;
  collisionProbability(query, kIdentity, wallAt(1.0), TruncatedGaussian(line, 2.0),
                       withTolerance(1e-4), result);
  checkHolds(result, normalIntervalMass(1.0, 2.0) / normalIntervalMass(-2.0, 2.0), 1e-4);
  const auto plane = GaussianDisplacement::fromStandardDeviations({0.1, 0.1, 0.0});
  collisionProbability(query, kIdentity, wallAt(0.0), TruncatedGaussian(plane, 2.0),
                       withTolerance(1e-2), result);
  checkHolds(result, 0.5, 1e-2);
  collisionProbability(query, kIdentity, wallAt(3.0), TruncatedGaussian(kIsotropic, kInfinity), {},
                       result);
  checkHolds(result, normalTailMass(3.0), 1e-6);
  collisionProbability(query, kIdentity, wallAt(-0.1), TruncatedGaussian({}, 1.0), {}, result);
  CHECK(*result.lower == Approx(1.0).epsilon(1e-12));
}

TEST_CASE("truncated: half-spaces and planes as far as they can be reached") {
  const PreparedQuery query(std::make_shared<fcl::Sphered>(0.2),
                            std::make_shared<fcl::Halfspaced>(Eigen::Vector3d::UnitZ(), 0.0));
  const TruncatedGaussian truncated(kIsotropic, 2.0);
  ProbabilityResult result;
  collisionProbability(query, at(4, 0, 0.3), kIdentity, truncated, withTolerance(0.01), result);
  checkHolds(result, capMass(1.0, 2.0) / ballMassOf(2.0), 0.01 * *result.upper);
  const PreparedQuery both(std::make_shared<fcl::Planed>(Eigen::Vector3d::UnitZ(), 0.0),
                           std::make_shared<fcl::Halfspaced>(Eigen::Vector3d::UnitZ(), 0.0));
  collisionProbability(both, at(4, 0, 0.1), kIdentity, truncated, {}, result);
  const double expected = capMass(1.0, 2.0) / ballMassOf(2.0);
  CHECK(*result.lower <= expected);
  CHECK(*result.upper >= expected);
}

TEST_CASE("truncated: random scenes of meshes hold what rejection sampling counts") {
  RandomBodies random(3);
  const auto mesh_a = makeModel<fcl::OBBRSSd>(bumpyMesh(0.4, 4, 6, 1));
  const auto mesh_b = makeModel<fcl::OBBRSSd>(torusMesh(0.5, 0.2, 8, 5));
  const PreparedQuery query(mesh_a, mesh_b);
  int between = 0;
  for (int i = 0; i < 10; ++i) {
    const auto gaussian = randomDisplacement(random, 0.05, 0.3).withMean(0.1 * random.direction());
    const double k = random.uniform(0.7, 3.0);
    const fcl::Transform3d pose = random.pose(1.2);
    ProbabilityRequest request = withTolerance(0.05);
    request.contact = i % 2 == 0 ? ContactMeaning::solid : ContactMeaning::fcl;
    ProbabilityResult result;
    collisionProbability(query, pose, kIdentity, TruncatedGaussian(gaussian, k), request, result);
    const detail::DisplacedCollider collider(*mesh_a, pose, *mesh_b, kIdentity, request.contact);
    const Eigen::Matrix3d factor = gaussian.axes() * gaussian.standardDeviations().asDiagonal();
    constexpr int kSamples = 1000;
    int hits = 0;
    for (int drawn = 0; drawn < kSamples;) {
      const Eigen::Vector3d y = random.normalVector();
      if (y.norm() > k) continue;
      ++drawn;
      hits += collider.collides(gaussian.mean() + factor * y);
    }
    const auto deviation = [](double p) { return 5 * std::sqrt(p * (1 - p) * kSamples) + 5; };
    CAPTURE(i, k, *result.lower, *result.upper, hits);
    CHECK(hits >= *result.lower * kSamples - deviation(*result.lower));
    CHECK(hits <= *result.upper * kSamples + deviation(*result.upper));
    CHECK(*result.upper - *result.lower <= 0.05 * *result.upper);
    between += hits > 10 && hits < kSamples - 10;
  }
  CHECK(between > 3);
}

TEST_CASE("truncated: thresholds are those of the conditional probability; some are refused") {
  const PreparedQuery query = boxAndWall();
  const TruncatedGaussian truncated(kIsotropic, 1.0);
  const double p = capMass(0.0, 1.0) / ballMassOf(1.0);
  CHECK(p == Approx(0.5));
  ProbabilityResult result;
  ProbabilityRequest request;
  request.threshold = 0.45;
  collisionProbability(query, kIdentity, wallAt(0.0), truncated, request, result);
  CHECK(result.decision == Decision::above);
  request.threshold = 0.55;
  collisionProbability(query, kIdentity, wallAt(0.0), truncated, request, result);
  CHECK(result.decision == Decision::below);
  request.gradient = true;
  CHECK_THROWS_AS(collisionProbability(query, kIdentity, kIdentity, truncated, request, result),
                  InvalidRequest);
  request.gradient = false;
  request.method = ProbabilityMethod::monte_carlo;
  CHECK_THROWS_AS(collisionProbability(query, kIdentity, kIdentity, truncated, request, result),
                  UnsupportedGeometry);
}

TEST_CASE("sampled mixtures have confidence intervals that cover P as often as they say",
          "[slow]") {
  const PreparedQuery query = boxAndWall();
  const GaussianMixture three({{0.6, kIsotropic},
                               {0.3, kIsotropic.withMean(Eigen::Vector3d(0.15, 0, 0))},
                               {0.1, GaussianDisplacement()}});
  const double truth = 0.6 * normalTailMass(2.0) + 0.3 * normalTailMass(0.5);
  for (const ProbabilityMethod method :
       {ProbabilityMethod::monte_carlo, ProbabilityMethod::rare_event}) {
    ProbabilityRequest request;
    request.method = method;
    request.samples = 600;
    request.confidence = 0.8;
    request.relative_tolerance = 1e-6;
    constexpr int kSeeds = 200;
    int covered = 0;
    double width = 0.0;
    for (int seed = 1; seed <= kSeeds; ++seed) {
      request.seed = static_cast<std::uint64_t>(seed);
      ProbabilityResult result;
      collisionProbability(query, kIdentity, wallAt(2.0), three, request, result);
      REQUIRE(result.confidence_interval);
      CHECK_FALSE(result.lower);
      CHECK(std::fabs(*result.estimate - truth) <= 5.5 * *result.standard_error);
      covered +=
          result.confidence_interval->lower <= truth && truth <= result.confidence_interval->upper;
      width += result.confidence_interval->width() / kSeeds;
    }
    CAPTURE(toString(method), covered, width);
    CHECK(covered >= 0.8 * kSeeds - 3 * std::sqrt(0.16 * kSeeds));
    CHECK(width < truth);
  }
}

TEST_CASE("groups and batches answer mixtures and truncated Gaussians as pairs do") {
  RandomBodies random(5);
  const auto mesh = makeModel<fcl::OBBRSSd>(bumpyMesh(0.4, 4, 6, 1));
  const auto torus = makeModel<fcl::OBBRSSd>(torusMesh(0.5, 0.2, 8, 5));
  const auto floor = std::make_shared<fcl::Halfspaced>(Eigen::Vector3d::UnitZ(), -0.7);
  const PreparedQuery pair(mesh, torus);
  // A member twice, and one that is out of reach, change nothing.
  const GroupQuery same({mesh, mesh}, {torus, torus});
  const GroupQuery with_floor({mesh, mesh}, {torus, floor});
  const ProbabilityRequest request = withTolerance(0.03);
  for (int i = 0; i < 4; ++i) {
    const fcl::Transform3d pose = random.pose(1.0);
    const std::vector<fcl::Transform3d> poses_a{pose, pose}, poses_b{kIdentity, at(300, 0, 0)};
    const GaussianDisplacement one = randomDisplacement(random, 0.05, 0.2);
    const GaussianMixture mixture({{0.4, one}, {0.6, randomDisplacement(random, 0.05, 0.2)}});
    const TruncatedGaussian cut(one, random.uniform(0.5, 2.5));
    Waypoint of_mixture, of_cut;
    of_mixture.pose_a = of_cut.pose_a = pose;
    of_mixture.displacement = mixture;
    of_cut.displacement = cut;
    BatchRequest batch;
    batch.query = request;
    batch.query.threads = 2;
    const BatchResult answers = collisionProbabilities(pair, {of_mixture, of_cut}, batch);
    REQUIRE(answers.done == 2);
    const auto check = [&](const auto& displacement, const ProbabilityResult& of_batch) {
      ProbabilityResult alone, group, floored;
      collisionProbability(pair, pose, kIdentity, displacement, request, alone);
      collisionProbability(same, poses_a, poses_b, displacement, request, group);
      CHECK(*of_batch.lower == *alone.lower);
      CHECK(*of_batch.upper == *alone.upper);
      CHECK(*group.lower <= *alone.upper);
      CHECK(*group.upper >= *alone.lower);
      CHECK(*group.upper - *group.lower <= 0.03 * *group.upper + 1e-300);
      collisionProbability(with_floor, poses_a, {kIdentity, kIdentity}, displacement, request,
                           floored);
      CHECK(*floored.upper >= *alone.lower);
    };
    check(mixture, *answers.waypoints[0]);
    check(cut, *answers.waypoints[1]);
  }
}

TEST_CASE("a truncated group holds the closed form, and leaves out what is beyond the ellipsoid") {
  const auto box = std::make_shared<fcl::Boxd>(0.2, 0.2, 0.2);
  const auto wall = std::make_shared<fcl::Boxd>(10, 10, 10);
  const GroupQuery query({box, box}, {wall});
  for (const double k : {0.5, 1.0, 2.5, 4.0}) {
    const TruncatedGaussian cut(kIsotropic, k);
    ProbabilityResult result;
    // One box reaches the wall at half the radius; the other is behind it.
    collisionProbability(query, {kIdentity, at(-0.5, 0, 0)}, {wallAt(0.5 * k)}, cut,
                         withTolerance(1e-3), result);
    checkHolds(result, capMass(0.5 * k, k) / ballMassOf(k), 2e-3);
  }
  ProbabilityRequest request;
  request.method = ProbabilityMethod::estimate;
  ProbabilityResult result;
  CHECK_THROWS_AS(collisionProbability(query, {kIdentity, kIdentity}, {kIdentity},
                                       TruncatedGaussian(kIsotropic, 1.0), request, result),
                  UnsupportedGeometry);
}
