// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "convex/bounding_volumes.h"

#include <Eigen/Geometry>

#include "catch.h"
#include "face_geometry.h"
#include "mesh_shapes.h"
#include "random_bodies.h"

namespace {

using namespace fcl_prob_test;
using namespace fcl_prob::detail;
using fcl_prob::Kdop26;
using fcl_prob::SphereBv;

double outside(const RoundedZonotope& body, const Eigen::Vector3d& p, RandomBodies& random) {
  double largest = -1.0;
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d direction = random.direction();
    largest = std::max(largest, direction.dot(p) - body.core.support(direction) - body.radius);
  }
  return largest;
}

template <typename BV, typename Function>
void forEachContent(const fcl::BVHModel<BV>& model, int node, int root, Function&& function) {
  const auto& bv = model.getBV(node);
  if (bv.isLeaf()) {
    for (int c = 0; c < 3; ++c) {
      function(root, model.vertices[model.tri_indices[bv.primitiveId()][c]]);
    }
    return;
  }
  forEachContent(model, bv.leftChild(), root, function);
  forEachContent(model, bv.rightChild(), root, function);
}

template <typename BV>
void checkRounded() {
  RandomBodies random(21);
  const auto model = makeModel<BV>(bumpyMesh(1.0, 12, 16, 5));
  for (int node = 0; node < model->getNumBVs(); node += 3) {
    const RoundedZonotope body = roundedZonotope(model->getBV(node).bv);
    forEachContent(*model, node, node, [&](int, const Eigen::Vector3d& v) {
      CHECK(outside(body, v, random) <= 1e-14);
    });
  }
}

TEST_CASE("rounded zonotopes contain what FCL's bounding volumes contain") {
  checkRounded<fcl::AABBd>();
  checkRounded<fcl::OBBd>();
  checkRounded<fcl::RSSd>();
  checkRounded<fcl::OBBRSSd>();
  checkRounded<fcl::kIOSd>();
  checkRounded<SphereBv>();
}

TEST_CASE("the smallest sphere of a kIOS contains its contents") {
  const auto model = makeModel<fcl::kIOSd>(bumpyMesh(1.0, 12, 16, 5));
  for (int node = 0; node < model->getNumBVs(); ++node) {
    const RoundedZonotope sphere = smallestSphere(model->getBV(node).bv);
    forEachContent(*model, node, node, [&](int, const Eigen::Vector3d& v) {
      CHECK((v - sphere.core.centre()).norm() <= sphere.radius + 1e-14);
    });
  }
}

template <typename BV>
void checkDops() {
  const auto model = makeModel<BV>(bumpyMesh(1.0, 12, 16, 6));
  RandomBodies random(22);
  for (int node = 0; node < model->getNumBVs(); node += 5) {
    const std::vector<Slab> slabs = slabsOf(model->getBV(node).bv);
    FaceSet faces;
    setToSlabs(slabs, 1e-14, faces);
    CHECK(faces.closed());
    std::vector<Eigen::Vector3d> contents;
    forEachContent(*model, node, node,
                   [&](int, const Eigen::Vector3d& v) { contents.push_back(v); });
    CHECK(excessOver(faces, contents) <= 1e-13);
    for (const Slab& slab : slabs) {  // every slab touches the contents, so its planes are right
      CHECK(supportOf(contents, slab.direction) == Approx(slab.upper).margin(1e-12));
      CHECK(supportOf(contents, -slab.direction) == Approx(-slab.lower).margin(1e-12));
      CHECK(supportOf(faces.vertices(), slab.direction) == Approx(slab.upper).margin(1e-12));
    }
  }
}

TEST_CASE("k-DOPs: FCL's 16, 18 and 24 and our 26 directions") {
  checkDops<fcl::KDOPd<16>>();
  checkDops<fcl::KDOPd<18>>();
  checkDops<fcl::KDOPd<24>>();
  checkDops<Kdop26>();
}

TEST_CASE("a cube cut by the planes of a 26-DOP of a ball") {
  std::vector<Slab> slabs;
  for (const Eigen::Vector3d& d : dopDirections()) slabs.push_back({d, -d.norm(), d.norm()});
  FaceSet faces;
  setToSlabs(slabs, 0.0, faces);
  CHECK(faces.closed());
  CHECK(faces.faceCount() == 26);
  CHECK(volumeOf(faces) > 4.0 / 3.0 * M_PI);
  CHECK(volumeOf(faces) < 1.15 * 4.0 / 3.0 * M_PI);
  Kdop26 dop;
  for (const Eigen::Vector3d& v : faces.vertices()) dop += v;
  for (int k = 0; k < Kdop26::kSlabs; ++k) {
    CHECK(dop.upper(k) == Approx(Kdop26::direction(k).norm()));
    CHECK(dop.lower(k) == Approx(-Kdop26::direction(k).norm()));
  }
}

TEST_CASE("added slabs contain the C-obstacle of two k-DOPs") {
  RandomBodies random(23);
  for (int i = 0; i < 50; ++i) {
    Kdop26 a;
    Kdop26 b;
    const auto points_a = random.cloud(6, 1.0);
    const auto points_b = random.cloud(6, 2.0);
    for (const Eigen::Vector3d& p : points_a) a += p;
    for (const Eigen::Vector3d& p : points_b) b += p;
    std::vector<Slab> slabs = slabsOf(b);
    addReversed(slabsOf(a), slabs);
    FaceSet faces;
    setToSlabs(slabs, 1e-14, faces);
    const ConvexMesh mesh_a = meshOfSlabs(slabsOf(a));
    const ConvexMesh mesh_b = meshOfSlabs(slabsOf(b));
    CHECK(excessOver(faces, allDifferences(mesh_b.vertices, mesh_a.vertices)) <= 1e-12);
  }
}

TEST_CASE("bounding spheres are nearly the smallest") {
  RandomBodies random(24);
  for (int i = 0; i < 50; ++i) {
    // All points on a sphere, half of them near its equator: that sphere is the smallest.
    std::vector<Eigen::Vector3d> points = random.onSphere(200, 2.0);
    const Eigen::Vector3d centre = 10.0 * random.normalVector();
    for (Eigen::Vector3d& p : points) p += centre;
    const SphereBv sphere = SphereBv::around(points);
    CHECK(sphere.radius() <= 1.03 * 2.0);
    CHECK(sphere.radius() >= 0.97 * 2.0);
    for (const Eigen::Vector3d& p : points) {
      CHECK((p - sphere.center()).norm() <= sphere.radius() * (1 + 1e-15));
    }
  }
  SphereBv grown;
  CHECK_FALSE(grown.contain(Eigen::Vector3d::Zero()));
  const auto points = random.cloud(30, 1.0);
  for (const Eigen::Vector3d& p : points) grown += p;
  for (const Eigen::Vector3d& p : points) {
    CHECK((p - grown.center()).norm() <= grown.radius() * (1 + 1e-14));
  }
  CHECK(grown.overlap(grown));
  CHECK((grown + SphereBv()).radius() == grown.radius());
}

}  // namespace
