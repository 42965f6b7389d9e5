// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/node_hulls.h"

#include <fcl/geometry/shape/box.h>

#include "catch.h"
#include "convex/convex_set.h"
#include "mesh_shapes.h"
#include "random_bodies.h"

namespace {

using namespace fcl_prob_test;
using fcl_prob::ConvexBody;
using fcl_prob::detail::NodeHulls;
using fcl_prob::detail::nodeHullsOf;

/// How far a point is beyond the hull in the worst of some directions, metres.
double beyond(const ConvexBody& hull, const Eigen::Vector3d& point,
              const std::vector<Eigen::Vector3d>& directions) {
  double most = -1.0;
  for (const Eigen::Vector3d& n : directions) {
    most = std::max(most, n.dot(point - hull.supportPoint(n)));
  }
  return most;
}

}  // namespace

TEST_CASE("every triangle of a mesh is within the hull of a leaf, every leaf within its parents") {
  RandomBodies random(3);
  std::vector<Eigen::Vector3d> directions;
  for (int i = 0; i < 200; ++i) directions.push_back(random.direction());
  const auto mesh = torusMesh(0.5, 0.1, 60, 24);
  const auto model = makeModel<fcl::OBBRSSd>(mesh);
  const ConvexBody whole(mesh.vertices);
  const NodeHulls hulls = nodeHullsOf(*model, whole);
  REQUIRE(hulls.nodes.size() > 60);
  for (const fcl::Triangle& t : mesh.triangles) {
    int held = 0;
    for (const NodeHulls::Node& node : hulls.nodes) {
      if (!node.isLeaf()) continue;
      bool all = true;
      for (int k = 0; k < 3; ++k) {
        all = all && beyond(node.hull, mesh.vertices[t[k]], directions) <= 1e-12;
      }
      held += all;
    }
    REQUIRE(held >= 1);
  }
  for (const NodeHulls::Node& node : hulls.nodes) {
    CHECK(node.ball.radius > 0.0);
    CHECK(node.hull.set().size() <= hulls.size);
    CHECK(node.hull.set().slack() <= hulls.slack);
    if (node.isLeaf()) continue;
    for (const int child : {node.left, node.right}) {
      for (const Eigen::Vector3d& n : directions) {
        const NodeHulls::Node& below = hulls.nodes[static_cast<std::size_t>(child)];
        CHECK(n.dot(below.hull.supportPoint(n)) <= n.dot(node.hull.supportPoint(n)) + 1e-12);
      }
    }
  }
}

TEST_CASE("what is no mesh, few triangles or about convex has one hull") {
  const auto ball = sphereMesh(1.0, 20, 40);
  CHECK(nodeHullsOf(*makeModel<fcl::OBBd>(ball), ConvexBody(ball.vertices)).nodes.size() == 1);
  const fcl::Boxd box(1.0, 2.0, 3.0);
  CHECK(nodeHullsOf(box, ConvexBody(box)).nodes.size() == 1);
  CHECK(nodeHullsOf(box, ConvexBody(box)).nodes[0].ball.radius == Approx(0.5 * std::sqrt(14.0)));
  const auto mesh = boxMesh({1.0, 2.0, 3.0});
  CHECK(nodeHullsOf(*makeModel<fcl::AABBd>(mesh), ConvexBody(mesh.vertices)).nodes.size() == 1);
}
