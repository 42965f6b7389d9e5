// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What a build without any method wing answers (FCL_PROB_WITH_EXACT=OFF and so on).
#include <fcl/geometry/shape/cylinder.h>

#include <cmath>

#include "base/wings.h"
#include "catch.h"
#include "fcl_prob/collision_probability.h"
#include "fcl_prob/group.h"
#include "fcl_prob/normal_mass.h"
#include "mesh_shapes.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

const Eigen::Vector3d kSides(0.1, 0.2, 0.3), kOtherSides(0.2, 0.1, 0.1), kApart(0.17, 0.02, 0.05),
    kSigma(0.02, 0.05, 0.03);

fcl::Transform3d moved(const Eigen::Vector3d& by) {
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.translation() = by;
  return pose;
}

GaussianDisplacement error() { return GaussianDisplacement::fromStandardDeviations(kSigma); }

/// Solid boxes along the axes: a product of three masses.
double trueMass() {
  double mass = 1.0;
  for (int k = 0; k < 3; ++k) {
    const double half = 0.5 * (kSides[k] + kOtherSides[k]);
    mass *= 0.5 * (std::erf((kApart[k] + half) / (kSigma[k] * std::sqrt(2.0))) -
                   std::erf((kApart[k] - half) / (kSigma[k] * std::sqrt(2.0))));
  }
  return mass;
}

ProbabilityResult answerOf(const ProbabilityRequest& request) {
  const PreparedQuery query(makeModel<fcl::OBBRSSd>(boxMesh(kSides)),
                            makeModel<fcl::OBBRSSd>(boxMesh(kOtherSides)));
  ProbabilityResult result;
  query.collisionProbability(moved({0.0, 0.0, 0.0}), moved(kApart), error(), request, result);
  return result;
}

}  // namespace

TEST_CASE("meshes have intervals, estimates and decisions without any wing") {
  ProbabilityRequest request;
  request.contact = ContactMeaning::solid;
  request.relative_tolerance = 0.01;
  const double p = trueMass();
  for (const ProbabilityMethod method :
       {ProbabilityMethod::automatic, ProbabilityMethod::interval, ProbabilityMethod::estimate}) {
    request.method = method;
    const ProbabilityResult result = answerOf(request);
    CHECK(*result.lower <= p);
    CHECK(*result.upper >= p);
    if (result.estimate) CHECK(std::fabs(*result.estimate - p) <= 5.0 * *result.standard_error);
    if (!result.estimate) CHECK(*result.upper - *result.lower <= 0.01 * *result.upper);
  }
  request.method = ProbabilityMethod::automatic;
  for (const double factor : {0.5, 0.9, 1.1, 2.0}) {
    request.threshold = factor * p;
    CHECK(answerOf(request).decision == (factor < 1.0 ? Decision::above : Decision::below));
  }
}

TEST_CASE("groups of meshes and shapes are united without any wing") {
  const GroupQuery query(
      {makeModel<fcl::OBBRSSd>(boxMesh(kSides))},
      {makeModel<fcl::OBBRSSd>(boxMesh(kOtherSides)), std::make_shared<fcl::Cylinderd>(0.02, 0.1)});
  ProbabilityRequest request;
  request.contact = ContactMeaning::solid;
  request.relative_tolerance = 0.05;
  ProbabilityResult result;
  query.collisionProbability({moved({0.0, 0.0, 0.0})}, {moved(kApart), moved({0.0, 0.3, 0.0})},
                             error(), request, result);
  CHECK(*result.upper >= trueMass());
  CHECK(*result.upper - *result.lower <= 0.05 * *result.upper);
}

TEST_CASE("methods that are left out are refused by name") {
  ProbabilityRequest request;
  const auto refused = [&](ProbabilityMethod method, const std::string& wing) {
    request.method = method;
    CHECK_THROWS_WITH(answerOf(request), Catch::Contains("FCL_PROB_WITH_" + wing) &&
                                             Catch::Contains(toString(method)));
  };
  if (!detail::kHasExact) refused(ProbabilityMethod::exact, "EXACT");
  if (!detail::kHasPaper) refused(ProbabilityMethod::general_pcd, "PAPER");
  if (!detail::kHasSampling) refused(ProbabilityMethod::monte_carlo, "SAMPLING");
  if (!detail::kHasSampling) refused(ProbabilityMethod::rare_event, "SAMPLING");
}
