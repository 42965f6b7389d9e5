// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Bands around shapes: the certified interval holds for every shape within, and is about as narrow
// as that allows.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/plane.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>

#include <cmath>
#include <random>

#include "catch.h"
#include "fcl_prob/broadphase.h"
#include "fcl_prob/fcl_prob.h"
#include "fcl_prob/normal_mass.h"
#include "high_precision.h"
#include "mesh_shapes.h"
#include "poses.h"
#include "shapes.h"

using namespace fcl_prob;
using namespace fcl_prob_test;
namespace {

ProbabilityRequest banded(double band_a, double band_b) {
  ProbabilityRequest request;
  request.band_a = Band::within(band_a);
  request.band_b = Band::within(band_b);
  return request;
}

struct Pair {
  Geometry a;
  fcl::Transform3d pose_a;
  Geometry b;
  GaussianDisplacement displacement;

  ProbabilityResult ask(const ProbabilityRequest& request) const {
    ProbabilityResult result;
    collisionProbability(a.get(), pose_a, b.get(), fcl::Transform3d::Identity(), displacement,
                         request, result);
    return result;
  }
};

double exactOfSpheres(double radii, double distance, const GaussianDisplacement& displacement) {
  const fcl::Sphered a(0.5 * radii), b(0.5 * radii);
  ProbabilityResult result;
  return collisionProbability(&a, at({distance, 0, 0}), &b, fcl::Transform3d::Identity(),
                              displacement, {}, result);
}

/// The mesh with its vertices moved by no more than `most`: so far, all in one direction for each
/// choice of `towards` other than zero.
TriangleMesh displaced(TriangleMesh mesh, double most, const Eigen::Vector3d& towards,
                       RandomBodies& random) {
  for (Eigen::Vector3d& vertex : mesh.vertices) {
    const bool free = towards.isZero(0.0);
    const Eigen::Vector3d direction = free ? random.direction() : towards;
    vertex += (free ? std::cbrt(random.uniform(0.0, 1.0)) : 0.999999) * most * direction;
  }
  return mesh;
}

}  // namespace

TEST_CASE("with bands spheres are between a smaller and a larger ball", "[band][slow]") {
  RandomBodies random(71);
  for (int i = 0; i < 10; ++i) {
    const double sigma = random.uniform(0.02, 0.3);
    const auto displacement = GaussianDisplacement::fromStandardDeviations(
        Eigen::Vector3d(sigma, random.uniform(0.5, 1.0) * sigma, sigma));
    const double r_a = random.uniform(0.1, 0.4), r_b = random.uniform(0.1, 0.4);
    const double band_a = random.uniform(0.0, 0.03), band_b = random.uniform(0.001, 0.03);
    const double distance = r_a + r_b + random.uniform(-1.0, 1.5) * sigma;
    const Pair pair{std::make_shared<fcl::Sphered>(r_a), at({distance, 0, 0}),
                    std::make_shared<fcl::Sphered>(r_b), displacement};
    const ProbabilityResult result = pair.ask(banded(band_a, band_b));
    const double band = band_a + band_b;
    const double least = exactOfSpheres(r_a + r_b - band, distance, displacement);
    const double most = exactOfSpheres(r_a + r_b + band, distance, displacement);
    CAPTURE(i, least, most, *result.lower, *result.upper, toString(result.status));
    CHECK(*result.lower <= least + 1e-9);
    CHECK(*result.upper >= most - 1e-9);
    const double slack = 0.45 * (most - least) + 0.02 * most;
    CHECK(*result.lower >= least - slack);
    CHECK(*result.upper <= most + slack);
  }
}

TEST_CASE("with bands boxes are between products of normal distributions", "[band]") {
  const Eigen::Vector3d sigma(0.03, 0.05, 0.04), half(0.2, 0.15, 0.3), position(0.22, 0.1, 0.05);
  const double band = 0.01;
  const Pair pair{std::make_shared<fcl::Boxd>(half), at(position),
                  std::make_shared<fcl::Boxd>(half),
                  GaussianDisplacement::fromStandardDeviations(sigma)};
  const auto product = [&](double grown) {
    double mass = 1.0;
    for (int k = 0; k < 3; ++k) {
      mass *= normalIntervalMass((-half[k] - grown - position[k]) / sigma[k],
                                 (half[k] + grown - position[k]) / sigma[k]);
    }
    return mass;
  };
  const ProbabilityResult result = pair.ask(banded(0.4 * band, 0.6 * band));
  CHECK(*result.lower <= product(-band) + 1e-9);
  CHECK(*result.lower >= product(-band) - 0.2 * (product(band) - product(-band)));
  CHECK(*result.upper <= product(band) + 0.2 * (product(band) - product(-band)));
  // A face of the boxes moved outwards touches earlier by the whole band.
  CHECK(*result.upper >= product(0.0));
  CHECK(result.status == ProbabilityStatus::band_limit);

  ProbabilityRequest outward_only;
  outward_only.band_a.outward = band;
  const ProbabilityResult one_sided = pair.ask(outward_only);
  CHECK(*one_sided.lower <= product(0.0) + 1e-9);
  CHECK(*one_sided.lower >= product(0.0) - 0.15 * (product(band) - product(0.0)));
}

TEST_CASE("bands hold for meshes whose vertices are displaced within them", "[band][slow]") {
  RandomBodies random(5);
  int certain = 0;
  for (int scene = 0; scene < 12; ++scene) {
    const bool torus = scene % 3 == 0;
    const TriangleMesh mesh_a = torus ? torusMesh(0.3, 0.12, 9, 6) : bumpyMesh(0.4, 6, 8, scene);
    const TriangleMesh mesh_b = bumpyMesh(0.4, 7, 9, 100 + scene);
    const double band = random.logUniform(0.002, 0.05);
    const auto contact = scene % 2 == 0 ? ContactMeaning::fcl : ContactMeaning::solid;
    const auto displacement = randomDisplacement(random, 0.02, 0.3);
    const Eigen::Vector3d direction = random.direction();
    const Pair pair{makeModel<fcl::OBBRSSd>(mesh_a), at(random.uniform(0.4, 1.0) * direction),
                    makeModel<fcl::OBBRSSd>(mesh_b), displacement};
    ProbabilityRequest request = banded(band, 0.5 * band);
    request.contact = contact;
    const ProbabilityResult result = pair.ask(request);
    certain += *result.lower > 0.0;
    for (int field = 0; field < 6; ++field) {
      const Eigen::Vector3d towards = field == 0   ? direction
                                      : field == 1 ? Eigen::Vector3d(-direction)
                                                   : Eigen::Vector3d(0, 0, 0);
      const Pair true_pair{
          makeModel<fcl::OBBRSSd>(displaced(mesh_a, band, towards, random)), pair.pose_a,
          makeModel<fcl::OBBRSSd>(displaced(mesh_b, 0.5 * band, -towards, random)), displacement};
      ProbabilityRequest plain;
      plain.contact = contact;
      const ProbabilityResult truth = true_pair.ask(plain);
      CAPTURE(scene, field, band, *result.lower, *result.upper, *truth.lower, *truth.upper);
      CHECK(*result.lower <= *truth.upper);
      CHECK(*result.upper >= *truth.lower);
    }
  }
  CHECK(certain >= 8);  // or it would be no test of the lower end
}

TEST_CASE("bands hold for fcl::collide of displaced meshes, displacement by displacement",
          "[band]") {
  // A covariance of zero asks about one displacement: what is certain must be so of all shapes.
  RandomBodies random(17);
  int touching = 0, clear = 0;
  for (int scene = 0; scene < 150; ++scene) {
    const TriangleMesh mesh_a = bumpyMesh(0.4, 6, 8, scene), mesh_b = torusMesh(0.4, 0.15, 9, 6);
    const double band = random.logUniform(0.001, 0.03);
    const Pair pair{makeModel<fcl::OBBRSSd>(mesh_a), random.pose(0.9),
                    makeModel<fcl::OBBRSSd>(mesh_b), GaussianDisplacement()};
    const ProbabilityResult result = pair.ask(banded(band, band));
    touching += *result.lower > 0.5;
    clear += *result.upper < 0.5;
    for (int field = 0; field < 5; ++field) {
      const auto a = makeModel<fcl::OBBRSSd>(displaced(mesh_a, band, {0, 0, 0}, random));
      const auto b = makeModel<fcl::OBBRSSd>(displaced(mesh_b, band, {0, 0, 0}, random));
      fcl::CollisionResultd collision;
      fcl::collide<double>(a.get(), pair.pose_a, b.get(), fcl::Transform3d::Identity(), {},
                           collision);
      CAPTURE(scene, field, band);
      CHECK((collision.isCollision() ? 1.0 : 0.0) >= *result.lower);
      CHECK((collision.isCollision() ? 1.0 : 0.0) <= *result.upper);
    }
  }
  CHECK(touching > 30);
  CHECK(clear > 8);
}

TEST_CASE("bands widen the interval of every shape", "[band][slow]") {
  RandomBodies random(9);
  std::vector<NamedGeometry> all = boundedShapes();
  all.push_back({"OcTree", randomOcTree(20, 0.2, 0.5, 5)});
  all.push_back({"Halfspace",
                 std::make_shared<fcl::Halfspaced>(Eigen::Vector3d(1, 2, -1).normalized(), 0.1)});
  all.push_back(
      {"Plane", std::make_shared<fcl::Planed>(Eigen::Vector3d(-1, 1, 3).normalized(), -0.1)});
  const Geometry mesh = makeModel<fcl::OBBRSSd>(bumpyMesh(0.4, 5, 7, 3));
  for (const NamedGeometry& other : all) {
    const Pair pair{other.geometry, at(0.8 * random.direction()), mesh,
                    GaussianDisplacement::fromStandardDeviations({0.2, 0.15, 0.1})};
    ProbabilityRequest plain;
    plain.relative_tolerance = 0.02;
    const ProbabilityResult without = pair.ask(plain);
    ProbabilityRequest request = banded(0.01, 0.0);
    request.relative_tolerance = 0.02;
    const ProbabilityResult with = pair.ask(request);
    CAPTURE(other.name, *without.lower, *without.upper, *with.lower, *with.upper);
    CHECK(*with.lower <= *without.upper);
    CHECK(*with.upper >= *without.lower);
    CHECK(*with.upper <= *without.upper + 0.15);
    // Mirrored: the other one has the band.
    ProbabilityRequest of_b = banded(0.0, 0.01);
    const ProbabilityResult mirrored = pair.ask(of_b);
    CHECK(*mirrored.upper >= *without.lower);
    CHECK(std::fabs(*mirrored.upper - *with.upper) < 0.03);
  }
}

TEST_CASE("half-spaces with bands are closed forms", "[band]") {
  const Pair pair{std::make_shared<fcl::Sphered>(0.1), at({0, 0, 0.3}),
                  std::make_shared<fcl::Halfspaced>(Eigen::Vector3d::UnitZ(), 0.0),
                  GaussianDisplacement::fromStandardDeviations({0.1, 0.1, 0.1})};
  const ProbabilityResult result = pair.ask(banded(0.01, 0.02));
  CHECK(*result.upper == Catch::Detail::Approx(normalIntervalMass(-INFINITY, -1.7)).epsilon(1e-9));
  CHECK(*result.lower == Catch::Detail::Approx(normalIntervalMass(-INFINITY, -2.3)).epsilon(1e-9));
  CHECK(result.status == ProbabilityStatus::band_limit);
}

TEST_CASE("a ball and a half-space with bands on one side hold 50 digits", "[band]") {
  RandomBodies random(83);
  for (int i = 0; i < 3000; ++i) {
    const double radius = random.logUniform(1e-3, 10.0),
                 sigma = radius * random.logUniform(1e-9, 10.0);
    const double height = radius + sigma * random.uniform(-30.0, 30.0);
    const double band = sigma * random.logUniform(1e-12, 3.0);
    const Pair pair{std::make_shared<fcl::Sphered>(radius), at({0, 0, height}),
                    std::make_shared<fcl::Halfspaced>(Eigen::Vector3d::UnitZ(), 0.0),
                    GaussianDisplacement::fromStandardDeviations({sigma, sigma, sigma})};
    const auto truth = [&](double by) {
      return trueTail((HighPrecision(height) - radius - by) / sigma);
    };
    ProbabilityRequest request;
    (i % 2 ? request.band_a : request.band_b).outward = band;
    const ProbabilityResult outwards = pair.ask(request);
    request.band_a = request.band_b = {0.0, band};
    const ProbabilityResult inwards = pair.ask(request);
    CAPTURE(i, radius, sigma, height, band);
    CHECK(HighPrecision(*outwards.lower) <= truth(0.0));
    CHECK(HighPrecision(*outwards.upper) >= truth(band));
    CHECK(HighPrecision(*inwards.lower) <= truth(-2.0 * band));
    CHECK(HighPrecision(*inwards.upper) >= truth(0.0));
  }
}

TEST_CASE("bands decide thresholds, in groups, mixtures and truncated Gaussians", "[band]") {
  const Geometry box = std::make_shared<fcl::Boxd>(0.2, 0.2, 0.2);
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.05, 0.05, 0.05});
  const Pair pair{box, at({0.3, 0, 0}), box, displacement};
  ProbabilityRequest request = banded(0.01, 0.01);
  request.threshold = 0.5;
  CHECK(pair.ask(request).decision == Decision::below);
  request.threshold = 0.001;
  CHECK(pair.ask(request).decision == Decision::above);
  request.threshold.reset();

  const ProbabilityResult single = pair.ask(request);
  ProbabilityResult group;
  GroupQuery({box, box}, {box})
      .collisionProbability({at({0.3, 0, 0}), at({-0.9, 0, 0})}, {at({0, 0, 0})}, displacement,
                            request, group);
  CHECK(*group.upper == Catch::Detail::Approx(*single.upper).epsilon(0.1));
  CHECK(*group.upper >= *single.lower);
  ProbabilityResult mixed;
  const GaussianMixture mixture({{0.5, displacement}, {0.5, displacement}});
  fcl::CollisionObjectd a(std::make_shared<fcl::Boxd>(0.2, 0.2, 0.2), pair.pose_a);
  fcl::CollisionObjectd b(std::make_shared<fcl::Boxd>(0.2, 0.2, 0.2));
  collisionProbability(&a, &b, mixture, request, mixed);
  CHECK(*mixed.upper == Catch::Detail::Approx(*single.upper).epsilon(0.05));
  ProbabilityResult truncated;
  collisionProbability(&a, &b, TruncatedGaussian(displacement, 6.0), request, truncated);
  CHECK(*truncated.upper == Catch::Detail::Approx(*single.upper).epsilon(0.1));
}

TEST_CASE("what knows no bands refuses them", "[band]") {
  const Geometry box = std::make_shared<fcl::Boxd>(0.2, 0.2, 0.2);
  const Pair pair{box, at({0.3, 0, 0}), box,
                  GaussianDisplacement::fromStandardDeviations({0.05, 0.05, 0.05})};
  for (const ProbabilityMethod method :
       {ProbabilityMethod::estimate, ProbabilityMethod::exact, ProbabilityMethod::convex_pcd,
        ProbabilityMethod::general_pcd, ProbabilityMethod::monte_carlo}) {
    ProbabilityRequest request = banded(0.01, 0.0);
    request.method = method;
    CHECK_THROWS_AS(pair.ask(request), InvalidRequest);
  }
  for (const double bad : {-0.001, std::nan(""), std::numeric_limits<double>::infinity()}) {
    ProbabilityRequest request;
    request.band_b.inward = bad;
    CHECK_THROWS_AS(pair.ask(request), InvalidRequest);
  }
  ProbabilityResult result;
  PoseError::Vector6 sigma;
  sigma << 0.01, 0.01, 0.01, 0.01, 0.01, 0.01;
  CHECK_THROWS_AS(
      collisionProbability(box.get(), pair.pose_a, box.get(), fcl::Transform3d::Identity(),
                           PoseError(PoseError::Matrix6(sigma.cwiseAbs2().asDiagonal())),
                           banded(0.01, 0.0), result),
      InvalidRequest);
}
