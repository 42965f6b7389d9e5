// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/node_hulls.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "convex/convex_set.h"
#include "geometry/enclosed_volume.h"
#include "geometry/mesh_visitor.h"

namespace fcl_prob::detail {
namespace {

/// With more vertices a node's bounding volume has to do: every face of a hull is held against
/// every point.
constexpr std::size_t kLargestHull = 10'000;

/// A node is a leaf with this share of the triangles, or so few: finer hulls say more of how much a
/// mesh is not convex, and take longer to make, once a mesh.
constexpr int kLeaves = 64, kFewTriangles = 16;

/// What has so much of its hull's volume is not divided: its parts' hulls say little more.
constexpr double kConvexShare = 0.9;

TriangleMesh surfaceOf(const ConvexMesh& hull) {
  TriangleMesh surface{hull.vertices, {}};
  for (const ConvexMesh::Face& face : hull.faces) {
    const int* const corners = &hull.corners[static_cast<std::size_t>(face.first)];
    for (int k = 2; k < face.count; ++k) {
      surface.triangles.emplace_back(corners[0], corners[k - 1], corners[k]);
    }
  }
  return surface;
}

bool isAboutConvex(const MeshView& mesh, const ConvexBody& whole) {
  const double of_hull = enclosedVolume(surfaceOf(whole.set().outerMesh()));
  return enclosedVolume(triangleMesh(mesh)) > kConvexShare * of_hull;
}

/// Around a box around it.
Ball ballOf(const ConvexBody& body) {
  Eigen::AlignedBox3d box;
  for (int k = 0; k < 3; ++k) {
    box.extend(body.supportPoint(Eigen::Vector3d::Unit(k)));
    box.extend(body.supportPoint(-Eigen::Vector3d::Unit(k)));
  }
  return {box.center(), 0.5 * box.sizes().norm()};
}

void measure(NodeHulls& tree) {
  for (const NodeHulls::Node& node : tree.nodes) {
    tree.size = std::max(tree.size, node.hull.set().size());
    tree.slack = std::max(tree.slack, node.hull.set().slack());
  }
}

template <typename BV>
class HullsOfModel {
 public:
  HullsOfModel(const fcl::BVHModel<BV>& model, NodeHulls& tree)
      : model_(model),
        tree_(tree),
        of_leaf_(std::max(model.num_tris / kLeaves, kFewTriangles)),
        counts_(static_cast<std::size_t>(model.getNumBVs())) {
    for (int i = model.getNumBVs() - 1; i >= 0; --i) {
      const auto& node = model.getBV(i);
      counts_[i] = node.isLeaf() ? 1 : counts_[node.leftChild()] + counts_[node.rightChild()];
    }
  }

  void divide(std::size_t place, int node) {
    if (counts_[node] <= of_leaf_) return;
    const int children[] = {model_.getBV(node).leftChild(), model_.getBV(node).rightChild()};
    tree_.nodes[place].left = add(children[0]);
    tree_.nodes[place].right = add(children[1]);
    divide(tree_.nodes[place].left, children[0]);
    divide(tree_.nodes[place].right, children[1]);
  }

 private:
  int add(int node) {
    const ConvexBody hull = hullOf(node);
    tree_.nodes.push_back({hull, ballOf(hull)});
    return static_cast<int>(tree_.nodes.size()) - 1;
  }

  ConvexBody hullOf(int node) const {
    std::vector<std::size_t> vertices;
    gather(node, vertices);
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    if (vertices.size() > kLargestHull) return ConvexBody(model_.getBV(node).bv);
    std::vector<Eigen::Vector3d> points;
    for (const std::size_t v : vertices) points.push_back(model_.vertices[v]);
    return ConvexBody(points);
  }

  void gather(int node, std::vector<std::size_t>& vertices) const {
    const auto& of = model_.getBV(node);
    if (of.isLeaf()) {
      const fcl::Triangle& triangle = model_.tri_indices[of.primitiveId()];
      for (int k = 0; k < 3; ++k) vertices.push_back(triangle[k]);
      return;
    }
    gather(of.leftChild(), vertices);
    gather(of.rightChild(), vertices);
  }

  const fcl::BVHModel<BV>& model_;
  NodeHulls& tree_;
  int of_leaf_;
  std::vector<int> counts_;  ///< triangles of FCL's nodes
};

}  // namespace

NodeHulls nodeHullsOf(const fcl::CollisionGeometryd& geometry, const ConvexBody& whole) {
  NodeHulls tree;
  tree.nodes.push_back({whole, ballOf(whole)});
  if (kindOf(geometry) == GeometryKind::mesh && !isAboutConvex(meshView(geometry), whole)) {
    visitMesh(geometry, [&tree](const auto& model) {
      HullsOfModel hulls(model, tree);
      hulls.divide(0, 0);
      return 0;
    });
  }
  measure(tree);
  return tree;
}

HullsOfBodies::HullsOfBodies(PreparedGeometries geometries)
    : geometries_(std::move(geometries)), kept_(geometries_.size()) {}

const NodeHulls& HullsOfBodies::of(std::size_t body) const {
  Kept& kept = kept_[body];
  std::call_once(kept.once, [&] {
    const PreparedGeometry& geometry = *geometries_[body];
    kept.hulls =
        std::make_unique<const NodeHulls>(nodeHullsOf(geometry.geometry(), geometry.hull()));
  });
  return *kept.hulls;
}

}  // namespace fcl_prob::detail
