// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// One piece tree of many.
#include <algorithm>
#include <vector>

#include "scene/joined_top.h"
#include "scene/leaf_order.h"

namespace fcl_prob::detail {

namespace {

class TreeJoiner {
 public:
  TreeJoiner(const std::vector<const PieceTree*>& trees, const std::vector<fcl::Transform3d>& poses)
      : trees_(trees), top_(trees, poses) {
    for (const PieceTree* tree : trees) triangles_ += static_cast<int>(tree->triangles.size());
  }

  PieceTree run() {
    addTop();
    const bool capped = std::all_of(trees_.begin(), trees_.end(),
                                    [](const PieceTree* tree) { return tree->caps.has_value(); });
    if (capped) joined_.caps.emplace();
    for (const PieceTree* tree : trees_) append(*tree);
    if (joined_.isMesh()) tellTriangles(joined_);
    return std::move(joined_);
  }

 private:
  void addTop() {
    std::vector<int> first;  // node of each tree
    int next = static_cast<int>(top_.nodes().size());
    for (const PieceTree* tree : trees_) {
      first.push_back(next);
      next += static_cast<int>(tree->nodes.size());
    }
    const auto indexOf = [&first](const JoinedTop::Place& place) {
      return place.tree == JoinedTop::Place::kTop ? place.node : first[place.tree] + place.node;
    };
    for (const JoinedTop::Node& node : top_.nodes()) {
      joined_.nodes.emplace_back();
      joined_.nodes.back().left = indexOf(node.left);
      joined_.nodes.back().right = indexOf(node.right);
    }
  }

  void append(const PieceTree& tree) {
    const Offsets at{
        static_cast<int>(joined_.nodes.size()), static_cast<int>(joined_.vertices.size()),
        static_cast<int>(joined_.triangles.size()), static_cast<int>(joined_.bodies.size()),
        static_cast<int>(joined_.shapes.size())};
    for (const PieceTree::Part& part : tree.parts) joined_.parts.push_back(moved(part, at));
    for (const PieceTree::Node& node : tree.nodes) joined_.nodes.push_back(moved(node, tree, at));
    const Eigen::Vector3i first_vertex = Eigen::Vector3i::Constant(at.vertices);
    for (const Eigen::Vector3i& t : tree.triangles) joined_.triangles.push_back(t + first_vertex);
    for (const PieceTree::Body& body : tree.bodies) {
      joined_.bodies.push_back({body.position, body.shape + at.shapes});
    }
    if (joined_.caps) append(*tree.caps, first_vertex);
    joined_.vertices.insert(joined_.vertices.end(), tree.vertices.begin(), tree.vertices.end());
    joined_.shapes.insert(joined_.shapes.end(), tree.shapes.begin(), tree.shapes.end());
  }

  // What closes each of the meshes closes all of them: at every edge there is an even number of
  // triangles still.
  void append(const MeshCaps& caps, const Eigen::Vector3i& first_vertex) {
    MeshCaps& all = *joined_.caps;
    const int first_triangle = static_cast<int>(all.triangles.size());
    for (const MeshCaps::Cap& cap : caps.caps) {
      all.caps.push_back({cap.first + first_triangle, cap.last + first_triangle});
    }
    for (const Eigen::Vector3i& t : caps.triangles) all.triangles.push_back(t + first_vertex);
    for (const int component : caps.components.of_vertex) {
      all.components.of_vertex.push_back(component < 0 ? -1 : component + all.components.count);
    }
    all.components.count += caps.components.count;
  }

  struct Offsets {
    int nodes, vertices, triangles, bodies, shapes;
  };

  static PieceTree::Part moved(PieceTree::Part part, const Offsets& at) {
    const auto move = [](PieceTree::Range& range, int by) {
      range.begin += by;
      range.end += by;
    };
    if (part.root >= 0) part.root += at.nodes;
    move(part.vertices, at.vertices);
    move(part.triangles, at.triangles);
    move(part.bodies, at.bodies);
    move(part.shapes, at.shapes);
    for (auto& [from, to] : part.spans) {
      if (from < 0) continue;
      from += at.vertices;
      to += at.vertices;
    }
    return part;
  }

  PieceTree::Node moved(PieceTree::Node node, const PieceTree& tree, const Offsets& at) const {
    if (!node.isLeaf()) {
      node.left += at.nodes;
      node.right += at.nodes;
    } else if (tree.isTriangle(node.piece)) {
      node.piece += at.triangles;
    } else {
      node.piece = triangles_ + at.bodies + tree.bodyOf(node.piece);
    }
    return node;
  }

  const std::vector<const PieceTree*>& trees_;
  JoinedTop top_;
  int triangles_ = 0;  ///< of all trees
  PieceTree joined_;
};

}  // namespace

std::shared_ptr<const PieceTree> joinPieceTrees(const std::vector<const PieceTree*>& trees,
                                                const std::vector<fcl::Transform3d>& poses) {
  return std::make_shared<const PieceTree>(TreeJoiner(trees, poses).run());
}

}  // namespace fcl_prob::detail
