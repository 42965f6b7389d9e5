// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A mesh in many places as one tree, interwoven or not: the same triangles, the same answers.
#include "scene/joined_top.h"

#include <fcl/geometry/bvh/BVH_model.h>

#include <algorithm>
#include <vector>

#include "catch.h"
#include "mesh_shapes.h"
#include "query/partition.h"
#include "random_bodies.h"
#include "shapes.h"

namespace {

using namespace fcl_prob;
using namespace fcl_prob_test;
using detail::PieceTree;

using Trees = std::vector<const PieceTree*>;
using Poses = std::vector<fcl::Transform3d>;

// Along an arc, so closely that neighbours overlap.
Poses placesOf(int count, double way) {
  Poses poses;
  for (int i = 0; i < count; ++i) {
    const double t = i / (count - 1.0);
    fcl::Transform3d pose = fcl::Transform3d::Identity();
    pose.linear() = Eigen::AngleAxisd(t, Eigen::Vector3d(1, 2, 3).normalized()).matrix();
    pose.translation() = way * Eigen::Vector3d(t, t * t, 0.0);
    poses.push_back(pose);
  }
  return poses;
}

// Every triangle once below the root, and parents before their children.
void checkLeaves(const PieceTree& tree) {
  std::vector<int> seen(tree.triangles.size(), 0);
  std::vector<int> stack{0};
  while (!stack.empty()) {
    const int at = stack.back();
    stack.pop_back();
    const PieceTree::Node& node = tree.nodes[at];
    CHECK(node.piece <= node.last_piece);
    if (node.isLeaf()) {
      ++seen[node.piece];
      continue;
    }
    for (const int child : {node.left, node.right}) {
      CHECK(child > at);
      CHECK(tree.nodes[child].piece >= node.piece);
      CHECK(tree.nodes[child].last_piece <= node.last_piece);
      stack.push_back(child);
    }
  }
  CHECK(std::all_of(seen.begin(), seen.end(), [](int times) { return times == 1; }));
}

struct Joined {
  std::shared_ptr<const PieceTree> tree;
  detail::PartitionObject object;

  Joined(const Trees& trees, const Poses& poses, bool interwoven)
      : tree(detail::joinPieceTrees(trees, interwoven ? poses : Poses())), object{tree.get(), {}} {
    for (const fcl::Transform3d& pose : poses) object.parts.push_back({pose, nullptr});
  }
};

ProbabilityResult beside(const PieceTree& other, const detail::PartitionObject& object) {
  ProbabilityRequest request;
  request.relative_tolerance = 0.01;
  const detail::PartitionObject still{&other, {{fcl::Transform3d::Identity(), nullptr}}};
  return detail::partitionProbability(
      object, still, GaussianDisplacement::fromStandardDeviations({0.05, 0.1, 0.07}), request);
}

}  // namespace

TEST_CASE("a mesh in many places, interwoven, has each of its triangles in each place once") {
  const auto mesh = makeModel<fcl::OBBRSSd>(bumpyMesh(0.2, 12, 16, 3));
  const auto other = makeModel<fcl::OBBRSSd>(torusMesh(0.3, 0.1, 16, 12));
  const auto tree = detail::buildPieceTree(*mesh), between = detail::buildPieceTree(*other);
  for (const double way : {0.0, 0.01, 0.3, 30.0}) {
    Trees trees(9, tree.get());
    Poses poses = placesOf(9, way);
    // Another body, and the first one again: rows of nine and of two.
    trees.insert(trees.end(), {between.get(), tree.get(), tree.get()});
    poses.insert(poses.end(), {poses[0], poses[1], poses[2]});
    CAPTURE(way);
    checkLeaves(*detail::joinPieceTrees(trees, poses));
    checkLeaves(*detail::joinPieceTrees(trees));
  }
}

TEST_CASE("a body that is large beside its way is one node in all places, a small one is not") {
  const auto tree = detail::buildPieceTree(*makeModel<fcl::OBBRSSd>(bumpyMesh(0.2, 12, 16, 3)));
  const Trees trees(8, tree.get());
  using Place = detail::JoinedTop::Place;
  const auto first = [&](double way) {
    const Poses poses = placesOf(8, way);
    return detail::JoinedTop(trees, poses).nodes();
  };
  // Its halves in all places, or itself in half of them: then it is whole in single places.
  const auto isOfOnePlace = [](const Place& place) { return place.tree != Place::kTop; };
  const auto near = first(0.01), far = first(30.0);
  CHECK(far.size() == 7);
  CHECK(near.size() > tree->nodes.size());
  CHECK(std::none_of(near.begin(), near.end(), [&](const detail::JoinedTop::Node& node) {
    return isOfOnePlace(node.left) && node.left.node == 0;
  }));
  CHECK(detail::JoinedTop(trees, {}).nodes().size() == 7);
}

TEST_CASE("interwoven or not, the union of a mesh in many places has one probability") {
  const auto tree = detail::buildPieceTree(*makeModel<fcl::OBBRSSd>(bumpyMesh(0.2, 12, 16, 3)));
  const auto other = detail::buildPieceTree(*makeModel<fcl::OBBRSSd>(torusMesh(0.3, 0.1, 16, 12)));
  RandomBodies random(5);
  for (int i = 0; i < 6; ++i) {
    Poses poses = placesOf(12, 0.2);
    const Eigen::Vector3d aside = 0.6 * random.direction();
    for (fcl::Transform3d& pose : poses) pose.translation() += aside;
    const Trees trees(12, tree.get());
    const ProbabilityResult one = beside(*other, Joined(trees, poses, true).object);
    const ProbabilityResult same = beside(*other, Joined(trees, poses, false).object);
    CAPTURE(i, *one.lower, *one.upper, *same.lower, *same.upper);
    CHECK(*one.lower <= *same.upper);
    CHECK(*same.lower <= *one.upper);
    CHECK(one.status == ProbabilityStatus::converged);
  }
}
