// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Slabs of pairs of triangles that turn at random against those of the turned triangles.
#include <Eigen/Geometry>

#include "catch.h"
#include "mesh_shapes.h"
#include "random_bodies.h"
#include "scene/obstacle_table.h"
#include "scene/scene.h"

using namespace fcl_prob;
using namespace fcl_prob::detail;
using namespace fcl_prob_test;

namespace {

/// A motion of first order by random turns, and one of the rotations and shifts that are in it.
struct RandomMotion {
  PointMotion set;
  fcl::Transform3d one = fcl::Transform3d::Identity();

  RandomMotion(RandomBodies& random, double angle) {
    set.centre = 0.3 * random.normalVector();
    Eigen::Vector3d turn = Eigen::Vector3d::Zero(), shift = Eigen::Vector3d::Zero();
    for (int j = 0; j < 3; ++j) {
      set.turns.push_back(angle * random.normalVector());
      set.shifts.push_back(0.2 * angle * random.normalVector());
      // Corners of the set more often than not.
      turn += (random.integer(0, 1) == 0 ? 1.0 : -1.0) * set.turns.back();
      shift += (random.integer(0, 1) == 0 ? 1.0 : -1.0) * set.shifts.back();
    }
    set.remainder = 0.5 * turn.squaredNorm();  // |exp(ω) x - x - ω × x| <= ½ |ω|² |x|
    const Eigen::Matrix3d rotation =
        turn.isZero(0) ? Eigen::Matrix3d::Identity().eval()
                       : Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
    one.linear() = rotation;
    one.translation() = set.centre - rotation * set.centre + shift;
  }
};

}  // namespace

TEST_CASE(
    "slabs of turning triangles contain the C-obstacle of every turn, and their insides are in "
    "it") {
  RandomBodies random(21);
  const auto model_a = makeModel<fcl::OBBRSSd>(bumpyMesh(0.4, 4, 6, 1));
  const auto model_b = makeModel<fcl::OBBRSSd>(torusMesh(0.5, 0.2, 8, 5));
  const auto tree_a = buildPieceTree(*model_a), tree_b = buildPieceTree(*model_b);
  int inside = 0, near = 0;
  for (int scene = 0; scene < 40; ++scene) {
    const RandomMotion motion(random, scene % 2 == 0 ? 0.02 : 0.002);
    const fcl::Transform3d pose_a(random.pose(0.2)), pose_b(random.pose(0.2));
    const auto displacement = GaussianDisplacement::fromStandardDeviations(
        {0.01, 0.03, 0.05}, random.quaternion(), 0.1 * random.normalVector());
    const PartitionObject b{tree_b.get(), {{pose_b, nullptr}}};
    const PartitionObject turning{tree_a.get(), {{pose_a, nullptr}}, &motion.set};
    const ProbabilityRequest request;
    const QueryScene frame(turning, b, displacement, request);
    REQUIRE(frame.pair().turning);
    const PartitionObject turned{tree_a.get(), {{motion.one * pose_a, nullptr}}};
    const WhitenedPair at_once = whiten(turned, b, frame.whitening());
    ObstacleTable of_set(frame.pair()), of_one(at_once);
    for (int i = 0; i < 200; ++i) {
      const auto leafOf = [&](const PieceTree& tree) {
        int node = 0;
        while (!tree.nodes[node].isLeaf()) {
          node = random.integer(0, 1) == 0 ? tree.nodes[node].left : tree.nodes[node].right;
        }
        return node;
      };
      const NodePair leaves{leafOf(*tree_a), leafOf(*tree_b)};
      const SlabArrays wide = of_set.slabs(of_set.find(leaves));
      const auto cornerOf = [&](const WhitenedTree& tree, int leaf) {
        return tree
            .vertices[tree.tree->triangles[tree.tree->nodes[leaf].piece][random.integer(0, 2)]];
      };
      // A corner of the C-obstacle of the turned triangle, and points around it.
      const Eigen::Vector3d corner = cornerOf(at_once.b, leaves.b) - cornerOf(at_once.a, leaves.a);
      CHECK(slabKernels().classifyPoint(wide, corner.data()) != CellRelation::outside);
      const NodeBox box = obstacleBox(frame.pair(), leaves);
      for (int k = 0; k < 3; ++k) {
        CHECK(corner[k] >= box.lo[k]);
        CHECK(corner[k] <= box.hi[k]);
      }
      const SlabArrays exact = of_one.slabs(of_one.find(leaves));
      for (int j = 0; j < 20; ++j) {
        Eigen::Vector3d y;
        for (int k = 0; k < 3; ++k) y[k] = random.uniform(box.lo[k], box.hi[k]);
        const CellRelation of_all = slabKernels().classifyPoint(wide, y.data());
        const CellRelation of_turned = slabKernels().classifyPoint(exact, y.data());
        if (of_all == CellRelation::inside) CHECK(of_turned != CellRelation::outside);
        if (of_turned == CellRelation::inside) CHECK(of_all != CellRelation::outside);
        inside += of_all == CellRelation::inside ? 1 : 0;
        near += of_turned == CellRelation::inside ? 1 : 0;
      }
    }
  }
  CHECK(inside > 1000);
  CHECK(near > inside);
}
