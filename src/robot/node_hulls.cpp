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

/// Hulls are made of the vertices of the hulls below them, so that what reaches out of one adds up.
void measure(NodeHulls& tree) {
  std::vector<double> slack(tree.nodes.size());
  for (std::size_t i = tree.nodes.size(); i-- > 0;) {
    const NodeHulls::Node& node = tree.nodes[i];
    if (!node.isLeaf()) slack[i] = std::max(slack[node.left], slack[node.right]);
    slack[i] += node.hull.set().slack();
    tree.size = std::max(tree.size, node.hull.set().size());
    tree.slack = std::max(tree.slack, slack[i]);
  }
}

using Points = std::vector<Eigen::Vector3d>;

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

  void divide(int place, int node) {
    const int left = add(model_.getBV(node).leftChild());
    const int right = add(model_.getBV(node).rightChild());
    tree_.nodes[place].left = left;
    tree_.nodes[place].right = right;
  }

  bool isLeaf(int node) const { return counts_[node] <= of_leaf_; }

 private:
  /// Children first: their hulls have fewer vertices than their triangles.
  int add(int node) {
    const int place = static_cast<int>(tree_.nodes.size());
    tree_.nodes.push_back(tree_.nodes[0]);  // has no children until all are made
    if (!isLeaf(node)) divide(place, node);
    const ConvexBody hull = hullOf(place, node);
    tree_.nodes[place].hull = hull;
    tree_.nodes[place].ball = ballOf(hull);
    return place;
  }

  ConvexBody hullOf(int place, int node) const {
    const Points points = isLeaf(node) ? pointsOfTriangles(node) : pointsOfChildren(place);
    return points.size() > kLargestHull ? ConvexBody(model_.getBV(node).bv) : ConvexBody(points);
  }

  Points pointsOfChildren(int place) const {
    Points points;
    for (const int child : {tree_.nodes[place].left, tree_.nodes[place].right}) {
      const Points& of_child = tree_.nodes[child].hull.set().outerMesh().vertices;
      points.insert(points.end(), of_child.begin(), of_child.end());
    }
    return points;
  }

  Points pointsOfTriangles(int node) const {
    std::vector<std::size_t> vertices;
    gather(node, vertices);
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    Points points;
    for (const std::size_t v : vertices) points.push_back(model_.vertices[v]);
    return points;
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
      if (!hulls.isLeaf(0)) hulls.divide(0, 0);
      return 0;
    });
  }
  measure(tree);
  return tree;
}

HullsOfBodies::HullsOfBodies(PreparedGeometries geometries, const HullsOfBodies* before)
    : geometries_(std::move(geometries)) {
  if (before != nullptr) kept_ = before->kept_;
  while (kept_.size() < geometries_.size()) kept_.push_back(std::make_shared<Kept>());
}

const NodeHulls& HullsOfBodies::of(std::size_t body) const {
  Kept& kept = *kept_[body];
  std::call_once(kept.once, [&] {
    const PreparedGeometry& geometry = *geometries_[body];
    kept.hulls =
        std::make_unique<const NodeHulls>(nodeHullsOf(geometry.geometry(), geometry.hull()));
  });
  return *kept.hulls;
}

const MedialBalls& HullsOfBodies::ballsOf(std::size_t body) const {
  Kept& kept = *kept_[body];
  std::call_once(kept.balls_once,
                 [&] { kept.balls = std::make_unique<const MedialBalls>(*geometries_[body]); });
  return *kept.balls;
}

}  // namespace fcl_prob::detail
