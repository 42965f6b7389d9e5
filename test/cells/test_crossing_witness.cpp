// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What the proof by topology claims, against fcl::collide at points of the cell; and intervals that
// rest on it.
#include <fcl/narrowphase/collision.h>

#include <algorithm>
#include <cmath>

#include "catch.h"
#include "cells/crossing_witness.h"
#include "fcl_prob/normal_mass.h"
#include "partition_query.h"
#include "random_bodies.h"
#include "sampled_contact.h"
#include "whitened_meshes.h"

namespace {

using namespace fcl_prob_test;
using fcl_prob::GaussianDisplacement;
using fcl_prob::Whitening;
using namespace fcl_prob::detail;

/// The triangles of a mesh whose middle is not below `floor`: open at the bottom.
TriangleMesh cutOpen(const TriangleMesh& mesh, double floor) {
  TriangleMesh open{mesh.vertices, {}};
  for (const fcl::Triangle& t : mesh.triangles) {
    const double sum = mesh.vertices[t[0]].z() + mesh.vertices[t[1]].z() + mesh.vertices[t[2]].z();
    if (sum >= 3 * floor) open.triangles.push_back(t);
  }
  return open;
}

class WitnessCase {
 public:
  WitnessCase(const TriangleMesh& a, const TriangleMesh& b)
      : meshes_(a, b), witness_(meshes_.pair, false) {}

  CrossingWitness& witness() { return witness_; }

  /// Pairs of nodes some levels below the roots that may meet the cell.
  std::vector<FrontPair> near(const Cell& cell) const {
    std::vector<FrontPair> pairs;
    for (int a : level(*meshes_.tree_a)) {
      for (int b : level(*meshes_.tree_b)) {
        const NodeBox box = obstacleBox(meshes_.pair.a.boxOf(a), meshes_.pair.b.boxOf(b));
        if (!isClearOf(box, cell.lo.data(), cell.hi.data()))
          pairs.push_back(FrontPair::ofNodes({a, b}));
      }
    }
    return pairs;
  }

  bool collides(const Eigen::Vector3d& y) const {
    fcl::Transform3d pose = fcl::Transform3d::Identity();
    pose.translation() = meshes_.whitening.unapply(y);
    fcl::CollisionRequestd request;
    fcl::CollisionResultd result;
    return fcl::collide(meshes_.model_a.get(), pose, meshes_.model_b.get(),
                        fcl::Transform3d::Identity(), request, result) > 0;
  }

 private:
  static std::vector<int> level(const PieceTree& tree) {
    std::vector<int> nodes{0};
    while (nodes.size() < 128) {
      std::vector<int> next;
      for (int i : nodes) {
        if (tree.nodes[i].isLeaf()) continue;
        next.push_back(tree.nodes[i].left);
        next.push_back(tree.nodes[i].right);
      }
      nodes.swap(next);
    }
    return nodes;
  }

  WhitenedMeshes meshes_;
  CrossingWitness witness_;
};

struct Tally {
  int covered = 0;
  int layers = 0;
  int behind = 0;             ///< layers with a plane behind which surfaces may have parted
  int uncovered_contact = 0;  ///< cells in contact at their middle, without proof
  int samples = 0;
};

Tally checkClaims(const TriangleMesh& a, const TriangleMesh& b, double reach, unsigned seed) {
  WitnessCase pair(a, b);
  REQUIRE(pair.witness().usable());
  RandomBodies random(seed);
  Tally tally;
  for (int i = 0; i < 1500; ++i) {
    Eigen::Vector3d middle;
    Eigen::Vector3d half;
    for (int k = 0; k < 3; ++k) {
      middle[k] = random.uniform(-reach, reach);
      half[k] = random.logUniform(0.01, 0.4);
    }
    const Cell cell{middle - half, middle + half, 3};
    const auto pointOf = [&] {
      Eigen::Vector3d y;
      for (int k = 0; k < 3; ++k) y[k] = random.uniform(cell.lo[k], cell.hi[k]);
      return y;
    };
    const bool covers = pair.witness().covers(cell);
    const auto layer = pair.witness().layer(cell, pair.near(cell));
    tally.covered += covers;
    tally.layers += layer.has_value();
    tally.behind += layer && layer->to < 1e9;
    tally.uncovered_contact += !covers && !layer && pair.collides(middle);
    if (!covers && !layer) continue;
    for (int j = 0; j < 20; ++j) {
      const Eigen::Vector3d y = pointOf();
      const double height = covers ? 0.0 : layer->m.dot(y);
      if (!covers && !(height >= layer->from && height <= layer->to)) continue;
      ++tally.samples;
      if (!pair.collides(y)) {
        CAPTURE(cell.lo.transpose(), cell.hi.transpose(), y.transpose(), covers);
        CHECK(pair.collides(y));
      }
    }
  }
  return tally;
}

}  // namespace

TEST_CASE("where a witness says so, closed surfaces meet", "[partition]") {
  const Tally tally = checkClaims(bumpyMesh(1.0, 24, 32, 5), torusMesh(1.2, 0.5, 40, 20), 2.5, 301);
  CHECK(tally.covered > 100);
  CHECK(tally.layers > 200);
  CHECK(tally.samples > 3000);
}

TEST_CASE("a mesh that may be inside another one is no witness", "[partition]") {
  const Tally tally = checkClaims(sphereMesh(0.5, 20, 30), bumpyMesh(1.6, 24, 32, 7), 1.5, 302);
  CHECK(tally.samples > 300);
  CHECK(tally.behind > 30);
}

TEST_CASE("a witness does not take a hole for a surface", "[partition]") {
  // Bowls over a ball and over a bowl, both of which may pass through the openings.
  const TriangleMesh bowl = cutOpen(bumpyMesh(1.2, 30, 40, 9), -0.3);
  const TriangleMesh ball = bumpyMesh(0.7, 20, 30, 11);
  const Tally with_ball = checkClaims(ball, bowl, 2.0, 303);
  CHECK(with_ball.samples > 300);
  const Tally with_bowl = checkClaims(
      transformed(bowl, Eigen::Isometry3d(Eigen::AngleAxisd(2.0, Eigen::Vector3d::UnitX()))), bowl,
      2.0, 304);
  CHECK(with_bowl.samples > 1000);
}

TEST_CASE("several parts and meshes inside out are witnesses part by part", "[partition]") {
  Eigen::Isometry3d aside = Eigen::Isometry3d::Identity();
  aside.translation() = Eigen::Vector3d(1.8, 0.2, 0.0);
  const TriangleMesh twins =
      joined(bumpyMesh(0.8, 20, 30, 13), transformed(bumpyMesh(0.6, 20, 30, 15), aside));
  const Tally tally = checkClaims(reversed(twins), reversed(torusMesh(1.0, 0.4, 40, 20)), 2.5, 305);
  CHECK(tally.samples > 1000);
}

TEST_CASE("fine balls: the interval agrees with the mass of a ball", "[partition]") {
  constexpr double kRadius = 0.5;
  const TriangleMesh mesh = sphereMesh(kRadius, 30, 45);
  // Every facet is within the sphere and at least so far from its middle.
  const double inner = kRadius * std::cos(M_PI / 30) * std::cos(M_PI / 45);
  for (const double sigma : {0.05, 0.1, 0.3}) {
    const GaussianDisplacement displacement(Eigen::Vector3d(1.1, 0.0, 0.0),
                                            sigma * sigma * Eigen::Matrix3d::Identity());
    const PartitionQuery query(mesh, mesh);
    const auto result = query.run(displacement, intervalRequest(0.05));
    const double distance = 1.1 / sigma;
    CHECK(result.status == fcl_prob::ProbabilityStatus::converged);
    CHECK(*result.lower <= fcl_prob::normalBallMass(distance, 2 * kRadius / sigma).upper);
    CHECK(*result.upper >= fcl_prob::normalBallMass(distance, 2 * inner / sigma).lower);
  }
}

TEST_CASE("the interval of a bowl and a ball holds a Monte Carlo estimate", "[partition][slow]") {
  const TriangleMesh bowl = cutOpen(bumpyMesh(1.2, 30, 40, 9), -0.3);
  const TriangleMesh ball = bumpyMesh(0.7, 20, 30, 11);
  const GaussianDisplacement displacement(Eigen::Vector3d(0.4, -0.2, -0.9),
                                          0.02 * Eigen::Matrix3d::Identity());
  const PartitionQuery query(ball, bowl);
  const auto result = query.run(displacement, intervalRequest(0.05));
  RandomBodies random(306);
  constexpr int kSamples = 20000;
  int hits = 0;
  for (int i = 0; i < kSamples; ++i) {
    fcl::Transform3d pose = query.pose_a;
    pose.translation() += displacement.mean() + std::sqrt(0.02) * random.normalVector();
    fcl::CollisionRequestd request;
    fcl::CollisionResultd contact;
    hits += fcl::collide(query.model_a.get(), pose, query.model_b.get(), query.pose_b, request,
                         contact) > 0;
  }
  const double estimate = static_cast<double>(hits) / kSamples;
  const double standard_error = std::sqrt(estimate * (1 - estimate) / kSamples);
  CHECK(result.status == fcl_prob::ProbabilityStatus::converged);
  CHECK(*result.lower <= estimate + 5 * standard_error);
  CHECK(*result.upper >= estimate - 5 * standard_error);
  CHECK(estimate > 0.2);
  CHECK(estimate < 0.9);
}

TEST_CASE(
    "a small body beside a large one: the interval holds a Monte Carlo estimate, in few cells",
    "[partition][slow]") {
  const TriangleMesh large = bumpyMesh(1.0, 48, 64, 21);
  const GaussianDisplacement displacement(Eigen::Vector3d(0.9, 0.3, 0.1),
                                          Eigen::Vector3d(0.04, 0.02, 0.01).asDiagonal() * 1.0);
  for (const double size : {0.05, 0.2}) {
    const TriangleMesh small = bumpyMesh(size, 24, 32, 23);
    for (const bool solid : {false, true}) {
      CAPTURE(size, solid);
      PartitionQuery query(small, large);
      if (solid) query.makeSolid();
      const auto request = intervalRequest(0.2);
      const auto result = query.run(displacement, request);
      CHECK(result.status == fcl_prob::ProbabilityStatus::converged);
      CHECK(result.statistics.cells < (size < 0.1 ? 50'000 : 5'000));
      RandomBodies random(307);
      constexpr int kSamples = 20'000;
      const double p = sampledContact(query, small, large, displacement, solid, kSamples, random);
      checkHoldsSampled(result, p, kSamples);
    }
  }
}
