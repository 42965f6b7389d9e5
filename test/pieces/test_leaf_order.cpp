// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Meshes in memory as their trees visit them, held against FCL's own arrays.
#include "pieces/leaf_order.h"

#include <fcl/geometry/bvh/BVH_model.h>

#include "catch.h"
#include "geometry/mesh_visitor.h"
#include "mesh_shapes.h"
#include "random_bodies.h"

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

void checkTriangles(const PieceTree& tree, const PieceTree::Part& part, const Model& model) {
  REQUIRE(part.triangles.end - part.triangles.begin == model.num_tris);
  for (int i = 0; i < model.getNumBVs(); ++i) {
    const PieceTree::Node& node = tree.nodes[part.root + i];
    if (!node.isLeaf()) continue;
    const fcl::Triangle& t = model.tri_indices[model.getBV(i).primitiveId()];
    for (int k = 0; k < 3; ++k) {
      const int vertex = PieceTree::vertexOf(part, t[k]);
      CHECK(tree.triangles[node.piece][k] == vertex);
      CHECK((placeOf(tree, part, vertex) - model.vertices[t[k]]).norm() < 1e-15);
    }
  }
}

void checkNodes(const PieceTree& tree) {
  for (const PieceTree::Node& node : tree.nodes) {
    if (node.isLeaf()) {
      CHECK(node.last_piece == node.piece);
      continue;
    }
    CHECK(node.piece == tree.nodes[node.left].piece);
    CHECK(node.last_piece == tree.nodes[node.right].last_piece);
    CHECK(tree.nodes[node.left].last_piece + 1 == tree.nodes[node.right].piece);
  }
  CHECK(tree.nodes[0].piece == 0);
  CHECK(tree.nodes[0].last_piece == static_cast<int>(tree.triangles.size()) - 1);
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
  const auto spans = detail::spansOf(view);
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
