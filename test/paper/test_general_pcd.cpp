// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/general_pcd.h"

#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>

#include <memory>

#include "catch.h"
#include "fcl_prob/exceptions.h"
#include "mesh_shapes.h"
#include "paper/general_pcd_node.h"
#include "random_bodies.h"

namespace {

using namespace fcl_prob_test;
using namespace fcl_prob;

GaussianDisplacement someDisplacement() {
  return GaussianDisplacement::fromStandardDeviations(
      {0.05, 0.1, 0.2}, Eigen::Quaterniond(0.5, 0.1, -0.7, 0.5).normalized());
}

Eigen::Isometry3d at(const Eigen::Vector3d& position) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = position;
  return pose;
}

/// Two bumpy balls with a gap, as models of any bounding volume, and P by plain sampling.
struct SmallScene {
  TriangleMesh a = bumpyMesh(1.0, 8, 12, 1);
  TriangleMesh b = bumpyMesh(0.8, 8, 12, 2);
  Eigen::Isometry3d pose_a = at({0, 0, 0});
  Eigen::Isometry3d pose_b = at({2.0, 0.3, 0.1});
  GaussianDisplacement displacement = someDisplacement();

  double sampledMass(int samples) const {
    const auto model_a = makeModel<fcl::OBBRSSd>(a);
    const auto model_b = makeModel<fcl::OBBRSSd>(b);
    RandomBodies random(101);
    int hits = 0;
    for (int i = 0; i < samples; ++i) {
      const Eigen::Vector3d scaled =
          displacement.standardDeviations().cwiseProduct(random.normalVector());
      Eigen::Isometry3d moved = pose_a;
      moved.translation() += displacement.mean() + displacement.axes() * scaled;
      fcl::CollisionRequestd request;
      fcl::CollisionResultd result;
      hits += fcl::collide(model_a.get(), moved, model_b.get(), pose_b, request, result) > 0;
    }
    return static_cast<double>(hits) / samples;
  }
};

template <typename BV>
void checkBv(const SmallScene& scene, const char* name, double mass) {
  INFO(name);
  const auto a = makeModel<BV>(scene.a);
  const auto b = makeModel<BV>(scene.b);
  GeneralPcdRequest request;
  request.confidence = 0.995;
  const auto run = [&] {
    return generalPcd(*a, scene.pose_a, *b, scene.pose_b, scene.displacement, request);
  };
  const GeneralPcdResult sum = run();
  CHECK(sum.upper >= mass);
  CHECK(sum.upper == std::min(1.0, sum.raw_sum));
  CHECK(sum.complete);
  CHECK(sum.pairs_bounded == 2 * sum.pairs_summed - 1);
  CHECK(sum.leaf_pairs <= sum.pairs_summed);
  request.leaf_bound = LeafBound::triangles;
  const GeneralPcdResult of_triangles = run();
  CHECK(of_triangles.upper >= mass);
  CHECK(of_triangles.raw_sum <= sum.raw_sum * (1 + 1e-12));
  request.variant = GeneralPcdVariant::minimum;
  const GeneralPcdResult minimum = run();
  CHECK(minimum.upper >= mass);
  CHECK(minimum.upper <= std::min(sum.root, of_triangles.raw_sum) * (1 + 1e-12));
  CHECK(minimum.root == sum.root);
  request.max_pairs = 1;
  CHECK(run().upper == Approx(std::min(1.0, sum.root)).epsilon(1e-12));
}

TEST_CASE("every bounding volume bounds P from above, by the sum and by the minimum") {
  const SmallScene scene;
  const int samples = 4000;
  const double sampled = scene.sampledMass(samples);
  REQUIRE(sampled > 0.05);
  REQUIRE(sampled < 0.8);
  const double mass = sampled - 4.0 * std::sqrt(sampled * (1.0 - sampled) / samples);
  checkBv<fcl::AABBd>(scene, "AABB", mass);
  checkBv<fcl::OBBd>(scene, "OBB", mass);
  checkBv<fcl::RSSd>(scene, "RSS", mass);
  checkBv<fcl::OBBRSSd>(scene, "OBBRSS", mass);
  checkBv<fcl::kIOSd>(scene, "kIOS", mass);
  checkBv<fcl::KDOPd<16>>(scene, "KDOP16", mass);
  checkBv<fcl::KDOPd<18>>(scene, "KDOP18", mass);
  checkBv<fcl::KDOPd<24>>(scene, "KDOP24", mass);
  checkBv<SphereBv>(scene, "sphere", mass);
  checkBv<Kdop26>(scene, "26-DOP", mass);

  const ConvexHullTree a(*makeModel<fcl::OBBd>(scene.a));
  const ConvexHullTree b(*makeModel<fcl::AABBd>(scene.b));
  CHECK(a.nodeCount() == 2 * scene.a.triangles.size() - 1);
  GeneralPcdRequest request;
  request.variant = GeneralPcdVariant::minimum;
  const GeneralPcdResult hulls =
      generalPcd(a, scene.pose_a, b, scene.pose_b, scene.displacement, request);
  CHECK(hulls.upper >= mass);
  CHECK(hulls.upper <= 4.0 * sampled);
}

template <typename BV>
void checkTurned(const SmallScene& scene) {
  // A rotation in the poses must do the same as one in the vertices, but for how the volumes fit.
  const Eigen::Isometry3d turn(Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, 3).normalized()));
  const auto a = makeModel<BV>(transformed(scene.a, turn.inverse()));
  const auto b = makeModel<BV>(scene.b);
  GeneralPcdRequest request;
  request.confidence = 1.0;  // down to the triangles, where volumes do not matter
  request.leaf_bound = LeafBound::triangles;
  const auto small_a = makeModel<BV>(transformed(boxMesh({1, 1, 1}), turn.inverse()));
  const auto straight_a = makeModel<BV>(boxMesh({1, 1, 1}));
  const auto small_b = makeModel<BV>(boxMesh({1, 2, 1}));
  const Eigen::Isometry3d pose_b = at({1.3, 0.4, 0.2});
  const double turned =
      generalPcd(*small_a, turn, *small_b, pose_b, scene.displacement, request).raw_sum;
  const double straight =
      generalPcd(*straight_a, at({0, 0, 0}), *small_b, pose_b, scene.displacement, request).raw_sum;
  CHECK(turned == Approx(straight).epsilon(0.6));
  CHECK(turned > 0.01);
}

TEST_CASE("poses with a rotation, also for volumes with fixed axes") {
  const SmallScene scene;
  checkTurned<fcl::AABBd>(scene);
  checkTurned<fcl::KDOPd<16>>(scene);
  checkTurned<fcl::KDOPd<24>>(scene);
  checkTurned<Kdop26>(scene);
  checkTurned<fcl::OBBd>(scene);
}

TEST_CASE("FCL's traversal visits what the plain recursion visits") {
  const SmallScene scene;
  const auto a = makeModel<fcl::OBBd>(scene.a);
  const auto b = makeModel<fcl::OBBd>(scene.b);
  GeneralPcdRequest request;
  const GeneralPcdResult by_fcl =
      generalPcd(*a, scene.pose_a, *b, scene.pose_b, scene.displacement, request);
  const detail::ModelTree<fcl::OBBd> tree_a(*a);
  const detail::ModelTree<fcl::OBBd> tree_b(*b);
  const detail::PairFrame frame(scene.displacement, scene.pose_a, tree_a.size(), scene.pose_b,
                                tree_b.size());
  detail::RoundedNodePairs<fcl::OBBd> pairs(tree_a, tree_b, frame);
  detail::PairSum sum(pairs, request);
  detail::sumRecursively(sum, 0, 0);
  CHECK(by_fcl.raw_sum == sum.result().raw_sum);
  CHECK(by_fcl.pairs_bounded == sum.result().pairs_bounded);
  CHECK(by_fcl.leaf_pairs == sum.result().leaf_pairs);
  CHECK(by_fcl.pairs_bounded > 100);
}

TEST_CASE("the confidence decides how far pairs are refined") {
  const SmallScene scene;
  const auto a = makeModel<fcl::OBBRSSd>(scene.a);
  const auto b = makeModel<fcl::OBBRSSd>(scene.b);
  std::size_t before = 0;
  for (const double confidence : {0.0, 0.9, 0.99, 0.999}) {
    GeneralPcdRequest request;
    request.confidence = confidence;
    const std::size_t pairs =
        generalPcd(*a, scene.pose_a, *b, scene.pose_b, scene.displacement, request).pairs_bounded;
    CHECK(pairs > before);
    before = pairs;
  }
  GeneralPcdRequest request;
  request.confidence = 1.0;
  request.max_pairs = 5000;
  const GeneralPcdResult all =
      generalPcd(*a, scene.pose_a, *b, scene.pose_b, scene.displacement, request);
  CHECK_FALSE(all.complete);
  CHECK(all.pairs_bounded >= 5000);
  CHECK(all.pairs_bounded < 5200);
  CHECK(all.upper > 0.0);
}

TEST_CASE("stopping when the sum exceeds 1") {
  const SmallScene scene;
  const auto a = makeModel<fcl::AABBd>(scene.a);
  const auto b = makeModel<fcl::AABBd>(scene.b);
  GeneralPcdRequest request;
  const GeneralPcdResult whole =
      generalPcd(*a, scene.pose_a, *b, scene.pose_b, scene.displacement, request);
  REQUIRE(whole.raw_sum > 2.0);
  request.stop_at_one = true;
  const GeneralPcdResult stopped =
      generalPcd(*a, scene.pose_a, *b, scene.pose_b, scene.displacement, request);
  CHECK(stopped.upper == 1.0);
  CHECK_FALSE(stopped.complete);
  CHECK(stopped.pairs_bounded < whole.pairs_bounded);
}

TEST_CASE("a mesh against a convex shape, and two convex shapes") {
  const SmallScene scene;
  const auto mesh = makeModel<fcl::OBBRSSd>(scene.a);
  const auto dops = makeModel<fcl::KDOPd<18>>(scene.a);
  const fcl::Cylinderd cylinder(0.5, 1.0);
  const fcl::Sphered sphere(0.5);
  GeneralPcdRequest request;
  request.variant = GeneralPcdVariant::minimum;
  const Eigen::Isometry3d pose = at({1.9, 0.2, 0.1});
  const double far =
      generalPcd(*mesh, at({0, 0, 0}), cylinder, at({30, 0, 0}), scene.displacement, request).upper;
  CHECK(far < 1e-200);
  for (const fcl::CollisionGeometryd* shape :
       {static_cast<const fcl::CollisionGeometryd*>(&cylinder),
        static_cast<const fcl::CollisionGeometryd*>(&sphere)}) {
    const GeneralPcdResult ab =
        generalPcd(*mesh, at({0, 0, 0}), *shape, pose, scene.displacement, request);
    const GeneralPcdResult ba =
        generalPcd(*shape, pose, *mesh, at({0, 0, 0}), scene.displacement, request);
    const GeneralPcdResult of_dops =
        generalPcd(*dops, at({0, 0, 0}), *shape, pose, scene.displacement, request);
    CHECK(ab.upper == Approx(ba.upper).epsilon(1e-6));
    CHECK(ab.pairs_bounded > 2);
    // The deviation in which the two come closer decides: somewhere between nothing and everything.
    CHECK(ab.upper > 1e-4);
    CHECK(of_dops.upper > 1e-4);
    CHECK(of_dops.upper < 1.0);
  }
  CHECK(generalPcd(sphere, at({0, 0, 0}), cylinder, pose, scene.displacement, request)
            .pairs_bounded == 1);
}

TEST_CASE("what GeneralPCD cannot do is refused") {
  const SmallScene scene;
  const auto obb = makeModel<fcl::OBBd>(scene.a);
  const auto aabb = makeModel<fcl::AABBd>(scene.b);
  const GaussianDisplacement none;
  const Eigen::Isometry3d pose = at({0, 0, 0});
  CHECK_THROWS_AS(generalPcd(*obb, pose, *aabb, pose, none), UnsupportedGeometry);
  CHECK_THROWS_AS(generalPcd(*obb, pose, fcl::Halfspaced(Eigen::Vector3d::UnitX(), 0), pose, none),
                  UnsupportedGeometry);
  CHECK_THROWS_AS(generalPcd(*obb, pose, fcl::BVHModel<fcl::OBBd>(), pose, none), InvalidGeometry);
  CHECK_THROWS_AS(
      generalPcd(fcl::BVHModel<SphereBv>(), pose, fcl::BVHModel<SphereBv>(), pose, none),
      InvalidGeometry);
  Eigen::Isometry3d bad = pose;
  bad.linear() *= 2.0;
  CHECK_THROWS_AS(generalPcd(*obb, bad, *obb, pose, none), InvalidPose);
  GeneralPcdRequest request;
  request.confidence = 1.5;
  CHECK_THROWS_AS(generalPcd(*obb, pose, *obb, pose, none, request), InvalidRequest);
  request = {};
  request.max_pairs = 0;
  CHECK_THROWS_AS(generalPcd(*obb, pose, *obb, pose, none, request), InvalidRequest);
}

TEST_CASE("no motion at all: 1 if the volumes touch, 0 if they do not") {
  const SmallScene scene;
  const auto a = makeModel<fcl::OBBd>(scene.a);
  const auto b = makeModel<fcl::OBBd>(scene.b);
  const GaussianDisplacement none;
  CHECK(generalPcd(*a, at({0, 0, 0}), *b, at({0.5, 0, 0}), none).upper == 1.0);
  CHECK(generalPcd(*a, at({0, 0, 0}), *b, at({5, 0, 0}), none).upper == 0.0);
}

}  // namespace
