// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The plan of an answer: which rungs were climbed and which were left out, and why.
#include <fcl/geometry/octree/octree.h>
#include <fcl/geometry/shape/box.h>

#include <algorithm>

#include "base/left_out.h"
#include "catch.h"
#include "fcl_prob/collision_probability.h"
#include "fcl_prob/group.h"
#include "mesh_shapes.h"
#include "shapes.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

// Named: files of a room may be compiled as one.
namespace plan_test {
namespace {

using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;

ProbabilityResult ask(const Geometry& a, const Geometry& b, const ProbabilityRequest& request,
                      const Eigen::Vector3d& deviations = {0.1, 0.1, 0.1}) {
  ProbabilityResult result;
  PreparedQuery(a, b).collisionProbability(
      fcl::Transform3d::Identity(), fcl::Transform3d(Eigen::Translation3d(1.1, 0.1, 0.0)),
      GaussianDisplacement::fromStandardDeviations(deviations), request, result);
  return result;
}

const RungRecord& rung(const ProbabilityResult& result, const std::string& name) {
  const auto& rungs = result.statistics.rungs;
  const auto found = std::find_if(rungs.begin(), rungs.end(),
                                  [&](const RungRecord& each) { return each.name == name; });
  REQUIRE(found != rungs.end());
  return *found;
}

bool hasLine(const ProbabilityResult& result, const std::string& begin) {
  return std::any_of(result.plan.begin(), result.plan.end(),
                     [&](const std::string& line) { return line.rfind(begin, 0) == 0; });
}

const Geometry bumpy = makeModel<fcl::OBBRSSd>(bumpyMesh(0.5, 8, 12, 1));
const Geometry cube = makeModel<fcl::OBBRSSd>(boxMesh({0.6, 0.6, 0.6}));

}  // namespace

TEST_CASE("a plan says which rungs were climbed, and why others were left out") {
  ProbabilityRequest request;
  request.method = ProbabilityMethod::interval;
  const ProbabilityResult bumps = ask(bumpy, bumpy, request);
  CHECK(rung(bumps, "boxes").answered == 1);
  CHECK(rung(bumps, "polytope cells").times == 0);
  CHECK(hasLine(bumps, "root volumes: their bound decides nothing"));
  CHECK(hasLine(bumps, "polytope cells: left out, no object is convex"));
  CHECK(hasLine(bumps, "boxes: partition of the displacement space into "));
  CHECK_FALSE(hasLine(bumps, "columns"));  // nobody asked for a decision
  const ProbabilityResult convex = ask(cube, bumpy, request);
  CHECK(rung(convex, "polytope cells").answered == 1);
  CHECK(hasLine(convex, "polytope cells: partition of the displacement space along"));
  CHECK_FALSE(hasLine(convex, "boxes"));
  // What a line tells is what is known after it.
  CHECK(rung(convex, "polytope cells").known.lower == *convex.lower);
  CHECK(rung(convex, "polytope cells").known.upper == *convex.upper);
}

TEST_CASE("what is left out by a test is told, and what the request rules out") {
  ProbabilityRequest request;
  request.method = ProbabilityMethod::interval;
  detail::leftOut() = {"polytope cells"};
  const ProbabilityResult without = ask(cube, bumpy, request);
  detail::leftOut().clear();
  CHECK(rung(without, "polytope cells").times == 0);
  CHECK(hasLine(without, "polytope cells: left out, as was asked"));
  CHECK(rung(without, "boxes").answered == 1);
  request.gradient = true;
  const ProbabilityResult gradient = ask(cube, bumpy, request);
  CHECK(hasLine(gradient, "root volumes: left out, a bound from above has no gradient"));
  CHECK(rung(gradient, "polytope cells").times == 0);
  request.gradient = false;
  const ProbabilityResult in_plane = ask(cube, bumpy, request, {0.1, 0.1, 0.0});
  CHECK(hasLine(in_plane, "whitening: covariance of rank 2, 1 axes left out"));
}

TEST_CASE("plans of groups begin with what they are") {
  const GroupQuery query({bumpy, cube}, {bumpy});
  const fcl::Transform3d here = fcl::Transform3d::Identity();
  ProbabilityRequest request;
  request.threshold = 0.2;
  ProbabilityResult result;
  query.collisionProbability({here, here}, {fcl::Transform3d(Eigen::Translation3d(1.1, 0.1, 0.0))},
                             GaussianDisplacement::fromStandardDeviations({0.1, 0.1, 0.1}), request,
                             result);
  CHECK(result.plan[0] == "groups of 2 and 1");
  CHECK(hasLine(result, "pairs: left out, not all members are convex"));
  CHECK(hasLine(result, "partition: one for the union of their pairs"));
  CHECK(rung(result, "partition").times == 1);
}

TEST_CASE("plans of what has nothing to meet say so") {
  const auto tree = std::make_shared<octomap::OcTree>(0.1);
  tree->updateNode(octomap::point3d(0, 0, 0), false);
  const GroupQuery query({bumpy, cube}, {std::make_shared<fcl::OcTreed>(tree)});
  const fcl::Transform3d here = fcl::Transform3d::Identity();
  ProbabilityResult result;
  query.collisionProbability({here, here}, {here},
                             GaussianDisplacement::fromStandardDeviations({0.1, 0.1, 0.1}), {},
                             result);
  CHECK(*result.upper == 0.0);
  CHECK(std::any_of(result.plan.begin(), result.plan.end(), [](const std::string& line) {
    return line.find("without occupied cells") != std::string::npos;
  }));
}

}  // namespace plan_test
