// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Convex meshes that are taken whole: boxes clear of nodes of the other mesh, and estimates.
#include "catch.h"
#include "cells/fat_obstacles.h"
#include "cells/node_reach.h"
#include "partition_query.h"
#include "random_bodies.h"
#include "whitened_meshes.h"

namespace {

using fcl_prob::GaussianDisplacement;
using fcl_prob::ProbabilityMethod;
using fcl_prob::ProbabilityRequest;
using fcl_prob::ProbabilityResult;
using fcl_prob::TriangleMesh;
using namespace fcl_prob::detail;
using fcl_prob_test::bumpyMesh;
using fcl_prob_test::hullMesh;
using fcl_prob_test::PartitionQuery;
using fcl_prob_test::RandomBodies;
using fcl_prob_test::WhitenedMeshes;

bool isWhole(const ProbabilityResult& result) {
  return fcl_prob_test::planMentions(result, "taken whole");
}

}  // namespace

// Of a node that a box is said to be clear of, no point of any triangle put to a vertex of the body
// is in the box; told of many boxes, or the test tells nothing.
TEST_CASE("boxes clear of nodes hold nothing of them", "[whole]") {
  RandomBodies random(7);
  int clear = 0;
  for (int scene = 0; scene < 12; ++scene) {
    const TriangleMesh body = hullMesh(random.onSphere(random.integer(4, 60), 0.4));
    const TriangleMesh other = bumpyMesh(0.5, 8, 10, static_cast<std::uint64_t>(scene));
    const bool body_is_a = scene % 2 == 0;
    const WhitenedMeshes meshes(body_is_a ? body : other, body_is_a ? other : body);
    const auto& tree = body_is_a ? meshes.tree_a : meshes.tree_b;
    const Eigen::Matrix3d& matrix = meshes.whitening.matrix();
    const WhitenedPolygons pieces(body_is_a ? meshes.pair.b : meshes.pair.a,
                                  meshes.objectOf(!body_is_a), matrix);
    const FatObstacles obstacles(meshes.pair, tree->parts[0], *tree->parts[0].fan, body_is_a,
                                 matrix, pieces);
    const NodeReach reach(obstacles, pieces);
    const auto& nodes = pieces.nodes();
    for (int i = 0; i < 40; ++i) {
      const Eigen::Vector3d middle = 0.6 * random.normalVector();
      const Eigen::Vector3d half = Eigen::Vector3d::Constant(random.logUniform(1e-3, 0.3));
      const NodeReach::Heights lowest = reach.lowestOf(middle, half);
      const NodeReach::Heights highest = reach.highestOf(middle, half);
      for (int node = 0; node < static_cast<int>(nodes.size()); ++node) {
        CHECK(reach.leastOver(highest, node) <= reach.leastOver(lowest, node));
        if (!reach.isClearOf(lowest, node)) continue;
        ++clear;
        if (nodes[node].left >= 0) {
          CHECK(reach.isClearOf(lowest, nodes[node].left));
          CHECK(reach.isClearOf(lowest, nodes[node].right));
          continue;
        }
        const Eigen::Matrix3d corners = obstacles.corners(nodes[node].piece);
        bool is_apart = false;
        for (int f = 0; f < obstacles.faceCount(); ++f) {
          const Eigen::Vector3d& n = obstacles.faceNormal(f);
          const double below = n.dot(middle) - n.cwiseAbs().dot(half);
          const double highest = (n.transpose() * corners).maxCoeff() + obstacles.faceOffset(f);
          is_apart = is_apart || below > highest;
        }
        CHECK(is_apart);
      }
    }
  }
  CHECK(clear > 2'000);
}

TEST_CASE("estimates of convex meshes taken whole agree with intervals", "[whole]") {
  RandomBodies random(4);
  int whole = 0;
  for (int scene = 0; scene < 12; ++scene) {
    PartitionQuery query(hullMesh(random.onSphere(random.integer(20, 200), 0.5)),
                         bumpyMesh(0.7, 12, 16, static_cast<std::uint64_t>(scene)));
    query.pose_a.linear() = random.rotation();
    query.pose_a.translation() = random.uniform(1.1, 1.5) * random.direction();
    const auto displacement = GaussianDisplacement::fromStandardDeviations({0.1, 0.2, 0.15});
    const ProbabilityResult interval =
        query.run(displacement, fcl_prob_test::intervalRequest(1e-3));
    ProbabilityRequest request;
    request.method = ProbabilityMethod::estimate;
    request.relative_tolerance = 0.01;
    request.gradient = scene % 2 == 0;
    const ProbabilityResult estimate = query.run(displacement, request);
    whole += isWhole(estimate);
    CAPTURE(scene, *interval.lower, *interval.upper, *estimate.estimate, *estimate.standard_error);
    CHECK(*estimate.estimate <= *interval.upper + 5 * *estimate.standard_error);
    CHECK(*estimate.estimate >= *interval.lower - 5 * *estimate.standard_error);
  }
  // Lines tell no gradient.
  CHECK(whole == 6);
}
