// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Meshes in memory as their trees visit them, held against FCL's own arrays.
#include "scene/leaf_order.h"

#include <fcl/geometry/bvh/BVH_model.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "catch.h"
#include "geometry/mesh_visitor.h"
#include "mesh_shapes.h"
#include "random_bodies.h"
#include "whitened_meshes.h"

namespace {

using namespace fcl_prob;
using namespace fcl_prob_test;
using detail::PieceTree;

using Model = fcl::BVHModel<fcl::OBBRSSd>;

// Two bodies, one of them open, and a vertex of no triangle in between.
TriangleMesh raggedMesh() {
  TriangleMesh open = bumpyMesh(0.5, 14, 18, 3);
  open.triangles.resize(open.triangles.size() - 5);
  open.vertices.insert(open.vertices.begin(), Eigen::Vector3d(0.1, 0.2, 0.3));
  for (auto& t : open.triangles) t.set(t[0] + 1, t[1] + 1, t[2] + 1);
  const Eigen::Isometry3d aside(Eigen::Translation3d(2.0, 0.3, -0.4));
  return joined(open, transformed(torusMesh(0.4, 0.1, 12, 9), aside));
}

// Of vertices of the tree, in the frame of the geometry.
Eigen::Vector3d placeOf(const PieceTree& tree, const PieceTree::Part& part, int vertex) {
  return tree.vertices[vertex] + part.origin;
}

// Walks FCL's tree and the part's side by side.
void checkTriangles(const PieceTree& tree, const PieceTree::Part& part, const Model& model) {
  REQUIRE(part.triangles.end - part.triangles.begin == model.num_tris);
  std::vector<std::pair<int, int>> stack{{0, part.root}};
  int leaves = 0;
  while (!stack.empty()) {
    const auto& bv = model.getBV(stack.back().first);
    const PieceTree::Node& node = tree.nodes[stack.back().second];
    stack.pop_back();
    REQUIRE(node.isLeaf() == bv.isLeaf());
    if (!node.isLeaf()) {
      stack.emplace_back(bv.leftChild(), node.left);
      stack.emplace_back(bv.rightChild(), node.right);
      continue;
    }
    ++leaves;
    const fcl::Triangle& t = model.tri_indices[bv.primitiveId()];
    for (int k = 0; k < 3; ++k) {
      const int vertex = PieceTree::vertexOf(part, t[k]);
      CHECK(tree.triangles[node.piece][k] == vertex);
      CHECK((placeOf(tree, part, vertex) - model.vertices[t[k]]).norm() < 1e-15);
    }
  }
  CHECK(leaves == model.num_tris);
}

void checkNodes(const PieceTree& tree) {
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const PieceTree::Node& node = tree.nodes[i];
    if (node.isLeaf()) {
      CHECK(node.last_piece == node.piece);
      continue;
    }
    CHECK(std::min(node.left, node.right) > static_cast<int>(i));
    CHECK(node.piece == tree.nodes[node.left].piece);
    CHECK(node.last_piece == tree.nodes[node.right].last_piece);
    CHECK(tree.nodes[node.left].last_piece + 1 == tree.nodes[node.right].piece);
  }
  CHECK(tree.nodes[0].piece == 0);
  CHECK(tree.nodes[0].last_piece == static_cast<int>(tree.triangles.size()) - 1);
}

// Of all triangles under a node, padded by the error.
detail::NodeBox boxOfTriangles(const detail::WhitenedTree& whitened, const PieceTree::Node& node) {
  Eigen::AlignedBox3d box;
  for (int piece = node.piece; piece <= node.last_piece; ++piece) {
    for (const int corner : whitened.tree->triangles[piece]) box.extend(whitened.vertices[corner]);
  }
  return detail::paddedBox(box.min(), box.max(), whitened.error);
}

void checkBox(const detail::WhitenedTree& whitened, int node) {
  const detail::NodeBox expected = boxOfTriangles(whitened, whitened.tree->nodes[node]);
  const detail::NodeBox& box = whitened.boxOf(node);
  for (int k = 0; k < 3; ++k) {
    CHECK(box.lo[k] == expected.lo[k]);
    CHECK(box.hi[k] == expected.hi[k]);
  }
}

std::vector<int> nodesOf(const PieceTree& tree) {
  std::vector<int> nodes(tree.nodes.size());
  std::iota(nodes.begin(), nodes.end(), 0);
  return nodes;
}

}  // namespace

TEST_CASE("triangles follow each other as the leaves do, and mean what they meant") {
  const auto model = makeModel<fcl::OBBRSSd>(raggedMesh());
  const auto tree = detail::buildPieceTree(*model);
  const PieceTree::Part& part = tree->parts[0];
  checkTriangles(*tree, part, *model);
  checkNodes(*tree);

  // What is told of vertices goes with them.
  const detail::MeshView view = detail::meshView(*model);
  const auto components = detail::componentsOf(view, detail::weldVertices(view));
  REQUIRE(tree->caps);
  REQUIRE(tree->caps->caps.size() == 1);
  std::size_t unused = 0;
  for (int v = 0; v < view.vertex_count; ++v) {
    CHECK(tree->caps->components.of_vertex[PieceTree::vertexOf(part, v)] ==
          components.of_vertex[v]);
    unused += components.of_vertex[v] < 0 ? 1 : 0;
  }
  CHECK(unused == 1);
  const auto spans = detail::spansOf(view, components);
  REQUIRE(part.spans.size() == spans.size());
  for (std::size_t i = 0; i < spans.size(); ++i) {
    CHECK(part.spans[i].first == PieceTree::vertexOf(part, spans[i].first));
    CHECK(part.spans[i].second == PieceTree::vertexOf(part, spans[i].second));
  }
  // A cap closes the mesh: every edge of its rim is one of some triangle, the other way round.
  for (const Eigen::Vector3i& cap : tree->caps->triangles) {
    int found = 0;
    for (const Eigen::Vector3i& t : tree->triangles) {
      for (int k = 0; k < 3; ++k) {
        const std::pair<int, int> edge{t[k], t[(k + 1) % 3]};
        found += edge == std::pair<int, int>{cap[0], cap[1]} ? 1 : 0;
        found += edge == std::pair<int, int>{cap[1], cap[0]} ? 1 : 0;
      }
    }
    CHECK(found == 1);
  }
}

TEST_CASE("nodes above clusters come first, those below last") {
  const auto model = makeModel<fcl::OBBRSSd>(raggedMesh());
  const auto tree = detail::buildPieceTree(*model);
  REQUIRE(tree->clusters);
  const detail::MeshClusters& clusters = *tree->clusters;
  const int count = static_cast<int>(tree->nodes.size());
  REQUIRE(clusters.begin > 0);
  REQUIRE(clusters.end < count);
  const auto trianglesOf = [&](int node) {
    return tree->nodes[node].last_piece - tree->nodes[node].piece + 1;
  };
  int in_clusters = 0;
  for (int i = 0; i < count; ++i) {
    CHECK((trianglesOf(i) > detail::MeshClusters::kMostTriangles) == (i < clusters.begin));
    if (i >= clusters.begin && i < clusters.end) in_clusters += trianglesOf(i);
    if (tree->nodes[i].isLeaf()) continue;
    for (const int child : {tree->nodes[i].left, tree->nodes[i].right}) {
      CHECK((child >= clusters.end) == (i >= clusters.begin));
    }
  }
  CHECK(in_clusters == static_cast<int>(tree->triangles.size()));
  CHECK(!detail::joinPieceTrees({tree.get(), tree.get()})->clusters);
}

TEST_CASE("a mesh of few triangles is one cluster") {
  const auto model = makeModel<fcl::OBBRSSd>(boxMesh({1, 1, 1}));
  const auto tree = detail::buildPieceTree(*model);
  REQUIRE(tree->clusters);
  CHECK(tree->clusters->begin == 0);
  CHECK(tree->clusters->end == 1);
  CHECK(tree->clusters->vertices.size() == 8);
}

TEST_CASE("clusters have every vertex of their triangles once") {
  const auto model = makeModel<fcl::OBBRSSd>(raggedMesh());
  const auto tree = detail::buildPieceTree(*model);
  const detail::MeshClusters& clusters = *tree->clusters;
  REQUIRE(clusters.first.size() == static_cast<std::size_t>(clusters.end - clusters.begin + 1));
  for (int i = clusters.begin; i < clusters.end; ++i) {
    std::set<int> expected;
    for (int piece = tree->nodes[i].piece; piece <= tree->nodes[i].last_piece; ++piece) {
      for (const int corner : tree->triangles[piece]) expected.insert(corner);
    }
    const auto begin = clusters.vertices.begin() + clusters.first[i - clusters.begin];
    const auto end = clusters.vertices.begin() + clusters.first[i - clusters.begin + 1];
    CHECK(std::vector<int>(begin, end) == std::vector<int>(expected.begin(), expected.end()));
  }
}

TEST_CASE("boxes are those of all triangles, to the bit, in whatever order they are asked for") {
  const TriangleMesh mesh = raggedMesh();
  const std::vector<int> upwards = nodesOf(*WhitenedMeshes(mesh, mesh).tree_a);
  std::vector<int> shuffled = upwards;
  std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(5));
  const std::vector<int> downwards(upwards.rbegin(), upwards.rend());
  for (const std::vector<int>& order : {upwards, downwards, shuffled}) {
    const WhitenedMeshes meshes(mesh, mesh);
    for (const int node : order) checkBox(meshes.pair.a, node);
  }
}

TEST_CASE("boxes are made anew when a tree is whitened anew") {
  WhitenedMeshes meshes(raggedMesh(), bumpyMesh(0.5, 8, 9, 5));
  const int last = static_cast<int>(meshes.tree_a->nodes.size()) - 1;
  checkBox(meshes.pair.a, last);
  const Whitening other(GaussianDisplacement::fromStandardDeviations({0.1, 0.2, 0.3}), 1.0);
  detail::whiten(meshes.objectOf(true), meshes.objectOf(false), other, meshes.pair);
  for (int i = 0; i <= last; ++i) checkBox(meshes.pair.a, i);
}

TEST_CASE("boxes of moving triangles contain their motions") {
  const WhitenedMeshes meshes(raggedMesh(), bumpyMesh(0.5, 8, 9, 5));
  detail::PartitionObject moving = meshes.objectOf(true);
  detail::PointMotion motion;
  motion.ball = 0.01;
  moving.motion = &motion;
  const detail::WhitenedPair pair =
      detail::whiten(moving, meshes.objectOf(false), meshes.whitening);
  for (std::size_t i = 0; i < meshes.tree_a->nodes.size(); ++i) {
    const detail::NodeBox still = boxOfTriangles(meshes.pair.a, meshes.tree_a->nodes[i]);
    const detail::NodeBox& box = pair.a.boxOf(static_cast<int>(i));
    for (int k = 0; k < 3; ++k) {
      CHECK(box.lo[k] <= still.lo[k] - 0.0099);
      CHECK(box.hi[k] >= still.hi[k] + 0.0099);
    }
  }
}

TEST_CASE("joined trees have their triangles one part after the other") {
  const auto first = makeModel<fcl::OBBRSSd>(bumpyMesh(0.5, 8, 9, 5));
  const auto second = makeModel<fcl::OBBRSSd>(raggedMesh());
  const auto a = detail::buildPieceTree(*first), b = detail::buildPieceTree(*second);
  const auto both = detail::joinPieceTrees({a.get(), b.get(), a.get()});
  checkNodes(*both);
  checkTriangles(*both, both->parts[0], *first);
  checkTriangles(*both, both->parts[1], *second);
  checkTriangles(*both, both->parts[2], *first);
}
