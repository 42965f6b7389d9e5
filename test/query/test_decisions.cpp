// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// With a threshold only a decision or a limit ends a query, whatever the tolerance, of every kind
// of query.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/sphere.h>

#include <functional>
#include <string>
#include <vector>

#include "catch.h"
#include "fcl_prob/fcl_prob.h"
#include "mesh_shapes.h"
#include "poses.h"
#include "random_bodies.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace decisions {

/// A query that may be asked anything.
struct Scene {
  std::string name;
  std::function<ProbabilityResult(const ProbabilityRequest&)> run;
};

fcl::Transform3d turnedAt(double x, double y, double z) {
  fcl::Transform3d pose = at(x, y, z);
  pose.linear() = Eigen::Quaterniond(0.8, 0.3, -0.2, 0.4).normalized().toRotationMatrix();
  return pose;
}

GaussianDisplacement displacement() {
  return GaussianDisplacement::fromStandardDeviations({0.1, 0.05, 0.08},
                                                      Eigen::Quaterniond(1, 0.2, 0.1, -0.3));
}

using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;

template <typename Displacement>
Scene ofPair(const std::string& name, const Geometry& a, const Geometry& b,
             const fcl::Transform3d& pose, const Displacement& displacement) {
  const auto query = std::make_shared<PreparedQuery>(a, b);
  return {name, [=](const ProbabilityRequest& request) {
            ProbabilityResult result;
            if constexpr (std::is_same_v<Displacement, GaussianDisplacement>) {
              query->collisionProbability(pose, kIdentity, displacement, request, result);
            } else {
              collisionProbability(*query, pose, kIdentity, displacement, request, result);
            }
            return result;
          }};
}

Geometry bumpy() { return makeModel<fcl::OBBRSSd>(bumpyMesh(0.3, 5, 7, 1)); }
Geometry torus() { return makeModel<fcl::OBBRSSd>(torusMesh(0.5, 0.2, 10, 6)); }

Scene ofGroup(const std::string& name, const GroupQuery::Geometries& a,
              const GroupQuery::Geometries& b) {
  const auto query = std::make_shared<GroupQuery>(a, b);
  return {name, [=](const ProbabilityRequest& request) {
            ProbabilityResult result;
            std::vector<fcl::Transform3d> poses_a, poses_b(b.size(), kIdentity);
            for (std::size_t i = 0; i < a.size(); ++i) {
              poses_a.push_back(turnedAt(i % 2 == 0 ? 0.85 : -0.8, 0.1, 0.1));
            }
            query->collisionProbability(poses_a, poses_b, displacement(), request, result);
            return result;
          }};
}

std::vector<Scene> scenes() {
  const Geometry box = std::make_shared<fcl::Boxd>(0.3, 0.4, 0.5);
  const Geometry ball = std::make_shared<fcl::Sphered>(0.25);
  const Geometry cylinder = std::make_shared<fcl::Cylinderd>(0.3, 0.5);
  const Geometry rod = std::make_shared<fcl::Capsuled>(0.1, 0.5);
  const Geometry egg = std::make_shared<fcl::Ellipsoidd>(0.2, 0.3, 0.15);
  const Geometry floor = std::make_shared<fcl::Halfspaced>(Eigen::Vector3d::UnitZ(), -0.35);
  const GaussianDisplacement one = displacement();
  const GaussianMixture mixture({{0.7, one}, {0.3, one.withMean({-0.1, 0.1, 0.05})}});
  const auto plane = GaussianDisplacement::fromStandardDeviations({0.1, 0.05, 0.0});
  return {ofPair("meshes", bumpy(), torus(), turnedAt(0.9, 0.1, 0.1), one),
          ofPair("box beside a mesh", box, torus(), turnedAt(0.9, 0.1, 0.1), one),
          ofPair("boxes", box, box, turnedAt(0.5, 0.1, 0.1), one),
          ofPair("spheres", ball, ball, turnedAt(0.55, 0.1, 0.1), one),
          ofPair("a cylinder and a box", cylinder, box, turnedAt(0.55, 0.1, 0.1), one),
          ofPair("an ellipsoid and a capsule", egg, rod, turnedAt(0.4, 0.1, 0.1), one),
          ofPair("boxes in a plane", box, box, turnedAt(0.5, 0.1, 0.1), plane),
          ofPair("a mesh over a floor", bumpy(), floor, turnedAt(0.1, 0.1, 0.0), one),
          ofPair("a mixture", bumpy(), torus(), turnedAt(0.9, 0.1, 0.1), mixture),
          ofPair("a mixture of boxes", box, box, turnedAt(0.5, 0.1, 0.1), mixture),
          ofPair("truncated", box, torus(), turnedAt(0.9, 0.1, 0.1), TruncatedGaussian(one, 2.0)),
          ofGroup("a group", {bumpy(), box}, {torus()}),
          ofGroup("a group of convex members", {box, rod}, {ball, cylinder})};
}

constexpr ProbabilityMethod kCertified[] = {ProbabilityMethod::automatic,
                                            ProbabilityMethod::interval};

/// P, to more digits than thresholds are told apart from it.
Bounds truthOf(const Scene& scene) {
  ProbabilityRequest request;
  request.relative_tolerance = 2e-4;
  request.absolute_tolerance = 0.0;
  const ProbabilityResult result = scene.run(request);
  REQUIRE(result.lower.value() > 1e-4);
  REQUIRE(result.upper.value() < 0.9999);
  REQUIRE(*result.upper - *result.lower < 1e-3 * *result.upper);
  return {*result.lower, *result.upper};
}

void checkEnding(const ProbabilityResult& result, const ProbabilityRequest& request) {
  CHECK(result.status != ProbabilityStatus::converged);
  const bool below = *result.upper < *request.threshold;
  const bool above = *result.lower > *request.threshold;
  CHECK((result.decision == Decision::below) == below);
  CHECK((result.decision == Decision::above) == above);
  const bool is_exact = result.status == ProbabilityStatus::exact;
  if (!is_exact) CHECK((result.status == ProbabilityStatus::decided) == (below || above));
}

TEST_CASE("a threshold is decided inside of any tolerance", "[query]") {
  for (const Scene& scene : scenes()) {
    const Bounds truth = truthOf(scene);
    for (const ProbabilityMethod method : kCertified) {
      if (scene.name == "a mesh over a floor" && method == ProbabilityMethod::interval) continue;
      for (const double factor : {0.2, 0.98, 0.997, 1.003, 1.02, 5.0}) {
        // As wide as can be, and the default.
        for (const double tolerance : {1.0, 0.01}) {
          ProbabilityRequest request;
          request.method = method;
          request.relative_tolerance = tolerance;
          request.absolute_tolerance = tolerance;
          request.threshold = std::min(1.0, factor * (factor < 1.0 ? truth.lower : truth.upper));
          const ProbabilityResult result = scene.run(request);
          CAPTURE(scene.name, toString(method), factor, tolerance, toString(result.status),
                  *result.lower, *result.upper, truth.lower, truth.upper);
          CHECK(result.decision == (factor < 1.0 ? Decision::above : Decision::below));
          checkEnding(result, request);
        }
      }
    }
  }
}

TEST_CASE("a threshold that P is as close to as can be ends at a limit", "[query]") {
  for (const Scene& scene : scenes()) {
    const Bounds truth = truthOf(scene);
    for (const ProbabilityMethod method : kCertified) {
      ProbabilityRequest request;
      request.method = method;
      request.max_cells = 3'000;
      request.threshold = truth.middle();
      const ProbabilityResult result = scene.run(request);
      CAPTURE(scene.name, toString(method), toString(result.status), *result.lower, *result.upper);
      checkEnding(result, request);
      CHECK(*result.lower <= truth.upper);
      CHECK(*result.upper >= truth.lower);
    }
  }
}

TEST_CASE("exact answers that straddle a threshold say that nothing more can be told", "[query]") {
  RandomBodies random(1);
  int undecided = 0;
  for (int i = 0; i < 30; ++i) {
    const Geometry box = std::make_shared<fcl::Boxd>(random.uniform(0.1, 1), 0.4, 0.5);
    const Geometry ball = std::make_shared<fcl::Sphered>(random.uniform(0.1, 0.5));
    const Geometry rod = std::make_shared<fcl::Capsuled>(0.1, random.uniform(0.1, 1));
    const Geometry& a = i % 2 == 0 ? box : ball;
    const Geometry& b = i % 3 == 0 ? box : i % 3 == 1 ? ball : rod;
    const Scene scene =
        ofPair("pair", a, b, turnedAt(random.uniform(0.4, 0.7), 0.1, 0.1), displacement());
    const ProbabilityResult exact = scene.run(ProbabilityRequest());
    ProbabilityRequest request;
    request.max_cells = 2'000;
    request.threshold = 0.5 * (*exact.lower + *exact.upper);
    const ProbabilityResult result = scene.run(request);
    CAPTURE(i, toString(result.status), *result.lower, *result.upper);
    checkEnding(result, request);
    if (result.decision != Decision::undecided) continue;
    ++undecided;
    CHECK((result.status == ProbabilityStatus::exact ||
           result.status == ProbabilityStatus::resolution_limit ||
           result.status == ProbabilityStatus::cell_limit));
    CHECK(*result.upper - *result.lower <= 1e-3 * *result.upper);
  }
  CHECK(undecided > 10);
}

TEST_CASE("bands around shapes: undecided only where what they leave open says so", "[query]") {
  const Geometry box = std::make_shared<fcl::Boxd>(0.3, 0.4, 0.5);
  const Geometry floor = std::make_shared<fcl::Halfspaced>(Eigen::Vector3d::UnitZ(), -0.35);
  const std::vector<Scene> banded = {
      ofPair("meshes", bumpy(), torus(), turnedAt(0.9, 0.1, 0.1), displacement()),
      ofPair("boxes", box, box, turnedAt(0.5, 0.1, 0.1), displacement()),
      ofPair("a floor", box, floor, turnedAt(0.1, 0.1, 0.0), displacement())};
  for (const Scene& scene : banded) {
    for (const double band : {1e-4, 5e-3}) {
      ProbabilityRequest request;
      request.band_a = {band, band};
      request.max_cells = 50'000;
      request.absolute_tolerance = 1.0;  // ends nothing
      const auto answerAt = [&](double threshold) {
        request.threshold = threshold;
        return scene.run(request);
      };
      request.threshold.reset();
      ProbabilityRequest fine = request;
      fine.absolute_tolerance = 0.0;
      fine.relative_tolerance = 1e-3;
      const ProbabilityResult known = scene.run(fine);
      CAPTURE(scene.name, band, *known.lower, *known.upper);
      const ProbabilityResult within = answerAt(0.5 * (*known.lower + *known.upper));
      CHECK(within.decision == Decision::undecided);
      checkEnding(within, request);
      CHECK((within.status == ProbabilityStatus::band_limit ||
             within.status == ProbabilityStatus::cell_limit));
      CHECK(answerAt(0.97 * *known.lower).decision == Decision::above);
      CHECK(answerAt(std::min(1.0, 1.03 * *known.upper)).decision == Decision::below);
    }
  }
}

TEST_CASE("sampling methods decide or draw all of their samples", "[query]") {
  const Scene scene = ofPair("meshes", bumpy(), torus(), turnedAt(0.9, 0.1, 0.1), displacement());
  const Scene mixture = scenes()[8];
  for (const Scene& one : {scene, mixture}) {
    const Bounds truth = truthOf(one);
    for (const auto method : {ProbabilityMethod::monte_carlo, ProbabilityMethod::rare_event}) {
      for (const double factor : {0.3, 1.0, 3.0}) {
        ProbabilityRequest request;
        request.method = method;
        request.samples = 6'000;
        request.relative_tolerance = 1.0;
        request.absolute_tolerance = 1.0;
        request.threshold = std::min(0.99, factor * truth.middle());
        const ProbabilityResult result = one.run(request);
        CAPTURE(one.name, toString(method), factor, toString(result.status));
        CHECK(result.status != ProbabilityStatus::converged);
        if (factor == 1.0) {
          CHECK(result.decision == Decision::undecided);
          CHECK(result.status == ProbabilityStatus::sampled);
        } else {
          CHECK(result.decision == (factor < 1.0 ? Decision::above : Decision::below));
        }
      }
    }
  }
}

TEST_CASE("an estimate with a threshold ends at its tolerance, or sooner if that is decided",
          "[query]") {
  for (const Scene& scene : scenes()) {
    if (scene.name == "truncated") continue;
    const Bounds truth = truthOf(scene);
    for (const double factor : {0.1, 1.0, 3.0}) {
      ProbabilityRequest request;
      request.method = ProbabilityMethod::estimate;
      request.relative_tolerance = 0.03;
      request.absolute_tolerance = 0.0;
      request.threshold = std::min(0.9999, factor * truth.middle());
      const ProbabilityResult result = scene.run(request);
      CAPTURE(scene.name, factor, toString(result.status));
      REQUIRE(result.estimate);
      const bool decided = *result.upper < *request.threshold || *result.lower > *request.threshold;
      if (!decided) CHECK(*result.standard_error <= 0.03 * *result.estimate);
      CHECK((result.decision == Decision::undecided) == !decided);
    }
  }
}

}  // namespace decisions
