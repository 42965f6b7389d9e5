// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// One piece tree of many.
#include <algorithm>
#include <vector>

#include "scene/leaf_order.h"

namespace fcl_prob::detail {

namespace {

class TreeJoiner {
 public:
  explicit TreeJoiner(const std::vector<const PieceTree*>& trees) : trees_(trees) {
    for (const PieceTree* tree : trees) triangles_ += static_cast<int>(tree->triangles.size());
  }

  PieceTree run() {
    std::vector<int> roots = partRoots();
    if (!roots.empty()) addUpperNodes(roots, 0, roots.size());
    const bool capped = std::all_of(trees_.begin(), trees_.end(),
                                    [](const PieceTree* tree) { return tree->caps.has_value(); });
    if (capped) joined_.caps.emplace();
    for (const PieceTree* tree : trees_) append(*tree);
    if (joined_.isMesh()) tellTriangles(joined_);
    return std::move(joined_);
  }

 private:
  // Where the roots of the trees will be, behind one node less than there are roots.
  std::vector<int> partRoots() const {
    std::vector<int> roots;
    int next = -1;
    for (const PieceTree* tree : trees_) next += tree->isEmpty() ? 0 : 1;
    for (const PieceTree* tree : trees_) {
      if (!tree->isEmpty()) roots.push_back(next);
      next += static_cast<int>(tree->nodes.size());
    }
    return roots;
  }

  // Halves of the list, since neighbours in it (the links of an arm) are mostly neighbours in
  // space. A node comes before its children.
  int addUpperNodes(const std::vector<int>& roots, std::size_t first, std::size_t last) {
    if (last - first == 1) return roots[first];
    const std::size_t middle = (first + last) / 2;
    const std::size_t node = joined_.nodes.size();
    joined_.nodes.emplace_back();
    const int left = addUpperNodes(roots, first, middle);
    const int right = addUpperNodes(roots, middle, last);
    joined_.nodes[node].left = left;
    joined_.nodes[node].right = right;
    return static_cast<int>(node);
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
  int triangles_ = 0;  ///< of all trees
  PieceTree joined_;
};

}  // namespace

std::shared_ptr<const PieceTree> joinPieceTrees(const std::vector<const PieceTree*>& trees) {
  return std::make_shared<const PieceTree>(TreeJoiner(trees).run());
}

}  // namespace fcl_prob::detail
