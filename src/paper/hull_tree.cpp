// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "paper/hull_tree.h"

#include <Eigen/Geometry>

#include "fcl_prob/convex_hull_tree.h"
#include "geometry/mesh_visitor.h"
#include "geometry/validation.h"
#include "paper/bv_volumes.h"

namespace fcl_prob {
namespace detail {
void HullTree::build() {
  // FCL numbers children after their parents, so that backwards they come first.
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    Node& node = nodes_[i];
    ConvexMesh hull = hullOf(node);
    node.volume = volumeOf(hull);
    node.slack = hull.slack;
    if (node.left >= 0) {
      node.slack += std::max(nodes_[node.left].slack, nodes_[node.left + 1].slack);
    }
    slack_ = std::max(slack_, node.slack);
    node.body = makeBody(std::move(hull));
    size_ = std::max(size_, node.body->size());
  }
}

ConvexMesh HullTree::hullOf(const Node& node) const {
  if (node.left < 0) return makeTriangle(node.triangle[0], node.triangle[1], node.triangle[2]);
  std::vector<Eigen::Vector3d> points;
  for (const int child : {node.left, node.left + 1}) {
    const ConvexMesh& mesh = nodes_[child].body->outerMesh();
    points.insert(points.end(), mesh.vertices.begin(), mesh.vertices.end());
  }
  return makeConvexMesh(points);
}

}  // namespace detail

ConvexHullTree::ConvexHullTree(const fcl::CollisionGeometryd& mesh) {
  detail::validateGeometry(&mesh, "mesh of a convex hull tree");
  tree_ = detail::visitMesh(
      mesh, [](const auto& model) { return std::make_shared<const detail::HullTree>(model); });
}

std::size_t ConvexHullTree::nodeCount() const { return tree_->nodeCount(); }

double ConvexHullTree::volume(std::size_t node) const {
  return tree_->volume(static_cast<int>(node));
}

}  // namespace fcl_prob
