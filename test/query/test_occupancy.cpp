// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Geometries that fcl::collide leaves out: cost_density, threshold_occupied, threshold_free.
#include <fcl/geometry/octree/octree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>

#include <limits>

#include "catch.h"
#include "fcl_prob/collision_probability.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/group.h"
#include "fcl_prob/mixture.h"
#include "fcl_prob/monte_carlo.h"
#include "geometry/geometry_kind.h"
#include "geometry/occupancy.h"
#include "mesh_shapes.h"
#include "poses.h"
#include "shapes.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

using MutableGeometry = std::shared_ptr<fcl::CollisionGeometryd>;

TriangleMesh triangleMesh() {
  TriangleMesh mesh;
  mesh.vertices = {{-1, -1, 0.01}, {1, -1, 0.02}, {0, 1, 0.03}};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

/// An octree of one cell.
MutableGeometry singleCell() {
  const auto tree = std::make_shared<octomap::OcTree>(0.5);
  tree->setNodeValue(0.25, 0.25, 0.25, 1.0F);
  return std::make_shared<fcl::OcTreed>(std::shared_ptr<const octomap::OcTree>(tree));
}

std::vector<NamedGeometry> everyKind() {
  std::vector<NamedGeometry> all = boundedShapes();
  for (const NamedGeometry& mesh : meshes()) all.push_back(mesh);
  all.push_back({"triangle mesh", makeModel<fcl::OBBRSSd>(triangleMesh())});
  all.push_back({"OcTree", randomOcTree(200, 0.1, 0.5, 1)});
  all.push_back({"single cell", singleCell()});
  all.push_back({"Halfspace", std::make_shared<fcl::Halfspaced>(Eigen::Vector3d::UnitZ(), 0.1)});
  return all;
}

void setFields(fcl::CollisionGeometryd& geometry, double cost, double occupied, double free) {
  geometry.cost_density = cost;
  geometry.threshold_occupied = occupied;
  geometry.threshold_free = free;
}

void randomizeFields(RandomBodies& random, fcl::CollisionGeometryd& geometry) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double values[] = {-1.0, 0.0, 0.3, 0.5, 1.0, 2.0, nan};
  const auto value = [&] { return values[random.integer(0, 20) % 7]; };
  setFields(geometry, value(), value(), value());
}

/// FCL calls a null function for a Halfspace and most kinds of meshes.
bool crashesFcl(const fcl::CollisionGeometryd& a, const fcl::CollisionGeometryd& b) {
  const auto is = [](const fcl::CollisionGeometryd& geometry, detail::GeometryKind kind) {
    return detail::kindOf(geometry) == kind;
  };
  using detail::GeometryKind;
  return (is(a, GeometryKind::mesh) && is(b, GeometryKind::unbounded)) ||
         (is(b, GeometryKind::mesh) && is(a, GeometryKind::unbounded));
}

bool hit(const MutableGeometry& a, const MutableGeometry& b) {
  fcl::CollisionResultd result;
  return fcl::collide(a.get(), kIdentity, b.get(), kIdentity, fcl::CollisionRequestd(), result) > 0;
}

const GaussianDisplacement& someDisplacement() {
  static const auto displacement = GaussianDisplacement::fromStandardDeviations({0.1, 0.2, 0.05});
  return displacement;
}

ProbabilityResult answer(const MutableGeometry& a, const MutableGeometry& b,
                         const ProbabilityRequest& request,
                         const GaussianDisplacement& displacement = someDisplacement()) {
  ProbabilityResult result;
  collisionProbability(a.get(), kIdentity, b.get(), kIdentity, displacement, request, result);
  return result;
}

}  // namespace

TEST_CASE("of geometries that are free or uncertain fcl::collide leaves out what we say") {
  RandomBodies random(71);
  const auto first = everyKind();
  const auto second = everyKind();
  int pairs = 0, left_out = 0;
  for (const NamedGeometry& a : first) {
    for (const NamedGeometry& b : second) {
      if (!fclSupportsPair(*a.geometry, *b.geometry)) continue;
      if (crashesFcl(*a.geometry, *b.geometry)) continue;
      setFields(*a.geometry, 1, 1, 0);
      setFields(*b.geometry, 1, 1, 0);
      if (!hit(a.geometry, b.geometry)) continue;
      ++pairs;
      for (int i = 0; i < 40; ++i) {
        randomizeFields(random, *a.geometry);
        if (i % 2 == 0) randomizeFields(random, *b.geometry);
        const auto why = detail::whyNeverInContact(*a.geometry, *b.geometry);
        INFO(a.name << " and " << b.name << ": " << why.value_or("may meet"));
        CHECK(hit(a.geometry, b.geometry) == !why);
        left_out += why.has_value();
      }
    }
  }
  CHECK(pairs > 100);
  CHECK(left_out > 1000);
}

TEST_CASE("a pair that fcl::collide leaves out has probability 0 by every method") {
  for (const NamedGeometry& of_free : everyKind()) {
    for (const NamedGeometry& other : everyKind()) {
      if (of_free.name == "OcTree" || of_free.name == "single cell") continue;
      if (!fclSupportsPair(*of_free.geometry, *other.geometry)) continue;
      INFO(of_free.name << " and " << other.name);
      of_free.geometry->cost_density = 0.5;  // uncertain
      for (const auto method : {ProbabilityMethod::automatic, ProbabilityMethod::interval,
                                ProbabilityMethod::estimate}) {
        ProbabilityRequest request;
        request.method = method;
        request.gradient = method == ProbabilityMethod::interval;
        request.threshold = 0.1;
        for (const auto& result :
             {answer(of_free.geometry, other.geometry, request),
              answer(other.geometry, of_free.geometry, request),
              answer(of_free.geometry, other.geometry, request, GaussianDisplacement())}) {
          CHECK(*result.lower == 0.0);
          CHECK(*result.upper == 0.0);
          CHECK(result.probability() == 0.0);
          CHECK(result.decision == Decision::below);
          CHECK_THAT(result.plan.back(), Catch::Matchers::Contains("not occupied"));
          if (result.gradient) CHECK(result.gradient->isZero(0.0));
        }
      }
    }
  }
}

TEST_CASE("free space for methods of few kinds, mixtures, truncations and solids") {
  const MutableGeometry ball = std::make_shared<fcl::Sphered>(0.5);
  const MutableGeometry box = std::make_shared<fcl::Boxd>(1, 1, 1);
  const MutableGeometry outer = makeModel<fcl::OBBRSSd>(boxMesh({4, 4, 4}));
  const MutableGeometry inner = makeModel<fcl::OBBRSSd>(boxMesh({1, 1, 1}));
  box->cost_density = inner->cost_density = 0.0;
  for (const auto method : {ProbabilityMethod::exact, ProbabilityMethod::convex_pcd}) {
    ProbabilityRequest request;
    request.method = method;
    CHECK(*answer(ball, box, request).upper == 0.0);
  }
  for (const auto method : {ProbabilityMethod::general_pcd, ProbabilityMethod::general_pcd_min}) {
    ProbabilityRequest request;
    request.method = method;
    CHECK(*answer(outer, inner, request).upper == 0.0);
  }
  for (const auto method : {ProbabilityMethod::automatic, ProbabilityMethod::estimate,
                            ProbabilityMethod::monte_carlo, ProbabilityMethod::rare_event}) {
    ProbabilityRequest request;
    request.method = method;
    request.contact = ContactMeaning::solid;
    request.samples = 100;
    CHECK(answer(outer, inner, request).probability() == 0.0);
    CHECK(answer(outer, inner, request, GaussianDisplacement()).probability() == 0.0);
  }
  const PreparedQuery query(ball, box);
  ProbabilityResult result;
  collisionProbability(query, kIdentity, kIdentity, TruncatedGaussian(someDisplacement(), 2.0), {},
                       result);
  CHECK(*result.upper == 0.0);
  collisionProbability(query, kIdentity, kIdentity,
                       GaussianMixture({{0.5, someDisplacement()}, {0.5, someDisplacement()}}), {},
                       result);
  CHECK(*result.upper < 1e-300);
}

TEST_CASE("members of groups that are not occupied are left out") {
  const auto ball = std::make_shared<fcl::Sphered>(0.5);
  const auto near = std::make_shared<fcl::Boxd>(1, 1, 1);
  const auto ground = std::make_shared<fcl::Halfspaced>(Eigen::Vector3d::UnitZ(), 0.0);
  const auto wall = std::make_shared<fcl::Boxd>(0.1, 3, 3);
  near->cost_density = ground->cost_density = 0.0;
  const auto at = [](double x) {
    fcl::Transform3d pose = kIdentity;
    pose.translation().x() = x;
    return pose;
  };
  const auto ask = [&](const GroupQuery::Geometries& a, const GroupQuery::Geometries& b,
                       const std::vector<fcl::Transform3d>& poses_a,
                       const std::vector<fcl::Transform3d>& poses_b,
                       const ProbabilityRequest& request = {}) {
    ProbabilityResult result;
    GroupQuery(a, b).collisionProbability(poses_a, poses_b, someDisplacement(), request, result);
    return result;
  };
  const auto with =
      ask({ball, ball}, {near, wall, ground}, {at(0), at(0.2)}, {at(0), at(1), at(0)});
  const auto without = ask({ball, ball}, {wall}, {at(0), at(0.2)}, {at(1)});
  CHECK(*with.lower == *without.lower);
  CHECK(*with.upper == *without.upper);
  CHECK(*with.upper < 0.1);
  CHECK_THAT(with.plan.front(), Catch::Matchers::Contains("2 left out"));

  ProbabilityRequest decision;
  decision.threshold = 0.5 * *ask({ball}, {wall}, {at(0)}, {at(1)}).lower;
  const auto decided =
      ask({ball, ball}, {near, wall, wall}, {at(0), at(0)}, {at(0), at(1), at(1)}, decision);
  CHECK(decided.decision == fcl_prob::Decision::above);
  CHECK_THAT(decided.plan.front(), Catch::Matchers::Contains("1 left out"));
  CHECK_THAT(decided.plan.back(), Catch::Matchers::Contains("Bonferroni"));
  const auto nothing = ask({ball, ball}, {near, ground}, {at(0), at(0.2)}, {at(0), at(0)});
  CHECK(*nothing.upper == 0.0);

  // What is occupied and free at once meets all but octrees: no one group of pieces can say that.
  const auto both = std::make_shared<fcl::Boxd>(1, 1, 1);
  both->threshold_free = 1.0;
  const MutableGeometry octree = randomOcTree(50, 0.1, 0.5, 1);
  CHECK_THROWS_AS(GroupQuery({both, ball}, {octree, ball}), UnsupportedGeometry);
  CHECK_NOTHROW(GroupQuery({both, ball}, {ball, ball}));
}

TEST_CASE("two octrees with cells both occupied and free are refused") {
  const auto treeOf = [](float log_odds) {
    const auto tree = std::make_shared<octomap::OcTree>(0.1);
    tree->setNodeValue(0.05, 0.05, 0.05, 1.0F);
    tree->setNodeValue(0.15, 0.05, 0.05, log_odds);  // of the same parent
    return std::make_shared<fcl::OcTreed>(std::shared_ptr<const octomap::OcTree>(tree));
  };
  const MutableGeometry doubtful =
      treeOf(0.0F);  // at or above one threshold, at or below the other
  const MutableGeometry clear = treeOf(0.5F);
  CHECK_THROWS_AS(answer(doubtful, clear, {}), UnsupportedGeometry);
  CHECK_THROWS_AS(answer(clear, doubtful, {}), UnsupportedGeometry);
  CHECK_NOTHROW(answer(clear, clear, {}));
  const MutableGeometry box = std::make_shared<fcl::Boxd>(1, 1, 1);
  CHECK_NOTHROW(answer(doubtful, box, {}));
}
