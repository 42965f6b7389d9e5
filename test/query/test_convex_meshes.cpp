// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Convex meshes by the masses of polytopes, against products of Φ in 50 digits and the partition.
#include "query/convex_meshes.h"

#include "catch.h"
#include "fcl_prob/collision_probability.h"
#include "high_precision.h"
#include "mesh_shapes.h"
#include "random_bodies.h"

namespace {

using namespace fcl_prob;
using namespace fcl_prob_test;

struct BoxMeshes {
  Eigen::Vector3d a, b, offset, sigma;

  // Of C-obstacle, or where one box is within the other one: |offset - x| <= reach.
  HighPrecision massWithin(const Eigen::Vector3d& sides, const Eigen::Vector3d& less) const {
    HighPrecision product = 1;
    for (int k = 0; k < 3; ++k) {
      const HighPrecision reach = (HighPrecision(sides[k]) + less[k]) / 2, at = offset[k];
      if (reach <= 0) return 0;
      product *= trueIntervalMass((at - reach) / sigma[k], (at + reach) / sigma[k]);
    }
    return product;
  }

  HighPrecision truth(ContactMeaning contact) const {
    const HighPrecision all = massWithin(a, b);
    if (contact == ContactMeaning::solid) return all;
    return all - massWithin(a, -b) - massWithin(b, -a);
  }
};

std::shared_ptr<const detail::PreparedGeometry> prepared(const TriangleMesh& mesh) {
  return std::make_shared<const detail::PreparedGeometry>(makeModel<fcl::OBBRSSd>(mesh), "mesh");
}

}  // namespace

TEST_CASE("convex meshes of boxes: the masses of polytopes hold 50 digits") {
  RandomBodies random(41);
  int narrow = 0;
  for (int i = 0; i < 150; ++i) {
    const double scale = std::pow(10.0, random.uniform(-9.0, 6.0));
    const auto three = [&](double lo, double hi) {
      return Eigen::Vector3d(random.uniform(lo, hi), random.uniform(lo, hi),
                             random.uniform(lo, hi));
    };
    BoxMeshes boxes{three(0.2, 1), three(0.2, 1), {}, scale * three(0.3, 1)};
    if (i % 3 == 0) boxes.a *= 0.2;
    for (int k = 0; k < 3; ++k) {
      const double side = i % 2 ? boxes.a[k] + boxes.b[k] : std::abs(boxes.a[k] - boxes.b[k]);
      boxes.offset[k] = (k == i % 3 ? 0.5 * side : 0.4 * random.uniform(-1, 1) * side) +
                        random.uniform(-1, 1) * boxes.sigma[k];
    }
    const auto a = prepared(boxMesh(boxes.a)), b = prepared(boxMesh(boxes.b));
    fcl::Transform3d pose_b = fcl::Transform3d::Identity();
    pose_b.translation() = boxes.offset;
    for (const ContactMeaning contact : {ContactMeaning::fcl, ContactMeaning::solid}) {
      ProbabilityRequest request;
      request.contact = contact;
      request.absolute_tolerance = 0.0;
      const auto result = detail::convexMeshesMass(
          {*a, fcl::Transform3d::Identity(), *b, pose_b},
          GaussianDisplacement::fromStandardDeviations(boxes.sigma), request);
      const HighPrecision truth = boxes.truth(contact);
      REQUIRE(result);
      CAPTURE(i, scale, truth.str(6), *result->lower, *result->upper);
      CHECK(HighPrecision(*result->lower) <= truth);
      CHECK(HighPrecision(*result->upper) >= truth);
      narrow += *result->upper - *result->lower <= 1e-3 * *result->upper;
    }
  }
  CAPTURE(narrow);
  CHECK(narrow > 250);
}

TEST_CASE("convex meshes turned against each other: the partition has no other mass") {
  RandomBodies random(43);
  for (int i = 0; i < 12; ++i) {
    const auto mesh_a = makeModel<fcl::OBBRSSd>(hullMesh(random.onSphere(12, 0.2)));
    const auto mesh_b = makeModel<fcl::OBBRSSd>(hullMesh(random.onSphere(12, 1.0)));
    const fcl::Transform3d pose_a = random.pose(0.7), pose_b = random.pose(0.3);
    const auto displacement =
        GaussianDisplacement::fromStandardDeviations({0.3, 0.2, i % 3 ? 0.4 : 0.0});
    const detail::PreparedGeometry a(mesh_a, "a"), b(mesh_b, "b");
    for (const ContactMeaning contact : {ContactMeaning::fcl, ContactMeaning::solid}) {
      ProbabilityRequest request;
      request.method = ProbabilityMethod::interval;
      request.contact = contact;
      request.relative_tolerance = 0.02;
      const auto by_polytopes =
          detail::convexMeshesMass({a, pose_a, b, pose_b}, displacement, request);
      ProbabilityResult by_cells;
      collisionProbability(mesh_a.get(), pose_a, mesh_b.get(), pose_b, displacement, request,
                           by_cells);
      REQUIRE(by_polytopes);
      CAPTURE(i, *by_polytopes->lower, *by_polytopes->upper, *by_cells.lower, *by_cells.upper);
      CHECK(*by_polytopes->upper - *by_polytopes->lower < 1e-6);
      CHECK(*by_polytopes->lower <= *by_cells.upper);
      CHECK(*by_polytopes->upper >= *by_cells.lower);
    }
  }
}

TEST_CASE("an estimate of convex meshes far out in the tail has a standard error as asked for") {
  const auto mesh = makeModel<fcl::OBBRSSd>(boxMesh({1.0, 0.7, 0.4}));
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.translation() = Eigen::Vector3d(33.0, 0.1, 0.05);
  ProbabilityRequest request;
  request.method = ProbabilityMethod::estimate;
  request.absolute_tolerance = 1e-303;
  ProbabilityResult result;
  collisionProbability(mesh.get(), fcl::Transform3d::Identity(), mesh.get(), pose,
                       GaussianDisplacement::fromStandardDeviations({1.0, 0.8, 0.6}), request,
                       result);
  CAPTURE(*result.estimate, *result.standard_error, toString(result.status));
  CHECK(result.status == ProbabilityStatus::converged);
  CHECK(*result.estimate < 1e-200);
  CHECK(*result.standard_error <= 0.01 * *result.estimate);
}

TEST_CASE("two convex meshes of few triangles are answered without trees and cells") {
  RandomBodies random(43);
  const BoxMeshes boxes{{0.4, 0.3, 0.5}, {0.6, 0.2, 0.3}, {0.3, -0.1, 0.35}, {0.08, 0.05, 0.1}};
  fcl::Transform3d pose_b = fcl::Transform3d::Identity();
  pose_b.translation() = boxes.offset;
  const auto displacement = GaussianDisplacement::fromStandardDeviations(boxes.sigma);
  const auto ask = [&](const TriangleMesh& a, ProbabilityMethod method, ContactMeaning contact) {
    ProbabilityRequest request;
    request.method = method;
    request.contact = contact;
    request.absolute_tolerance = 0.0;
    ProbabilityResult result;
    const PreparedQuery query(makeModel<fcl::OBBRSSd>(a),
                              makeModel<fcl::OBBRSSd>(boxMesh(boxes.b)));
    query.collisionProbability(fcl::Transform3d::Identity(), pose_b, displacement, request, result);
    return result;
  };
  const auto isWithout = [](const ProbabilityResult& result) {
    return result.statistics.cells == 0 &&
           std::any_of(result.plan.begin(), result.plan.end(), [](const std::string& note) {
             return note.find("trees and cells left out") != std::string::npos;
           });
  };
  for (const ContactMeaning contact : {ContactMeaning::fcl, ContactMeaning::solid}) {
    const HighPrecision truth = boxes.truth(contact);
    const auto known = static_cast<double>(truth);
    const ProbabilityResult automatic =
        ask(boxMesh(boxes.a), ProbabilityMethod::automatic, contact);
    CHECK(isWithout(automatic));
    CHECK(automatic.method == ProbabilityMethod::exact);
    CHECK(HighPrecision(*automatic.lower) <= truth);
    CHECK(HighPrecision(*automatic.upper) >= truth);
    CHECK(*automatic.upper - *automatic.lower < 1e-9 * known);
    const ProbabilityResult estimate = ask(boxMesh(boxes.a), ProbabilityMethod::estimate, contact);
    CHECK(isWithout(estimate));
    CHECK(std::abs(*estimate.estimate - known) <= *estimate.standard_error);
    CHECK(*estimate.standard_error < 1e-9 * known);
    // Cells that are asked for by name are had.
    const ProbabilityResult cells = ask(boxMesh(boxes.a), ProbabilityMethod::interval, contact);
    CHECK(cells.statistics.cells > 0);
    CHECK(*cells.lower <= known);
    CHECK(*cells.upper >= known);
  }
  // A mesh with a dent is no convex one.
  TriangleMesh dented = boxMesh(boxes.a);
  for (Eigen::Vector3d& v : dented.vertices) {
    if (v.minCoeff() > 0.0) v *= 0.5;
  }
  const ProbabilityResult other = ask(dented, ProbabilityMethod::automatic, ContactMeaning::solid);
  CHECK_FALSE(isWithout(other));
  CHECK(*other.upper < boxes.truth(ContactMeaning::solid));
}
