// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "pieces/leaf_order.h"

#include <algorithm>

namespace fcl_prob::detail {
namespace {

/// New numbers of vertices, given as they are asked for.
class VertexOrder {
 public:
  explicit VertexOrder(std::size_t count) : place_(count, -1) {}

  int placeOf(int vertex) {
    if (place_[vertex] < 0) {
      place_[vertex] = static_cast<int>(order_.size());
      order_.push_back(vertex);
    }
    return place_[vertex];
  }

  Eigen::Vector3i placesOf(const Eigen::Vector3i& t) {
    const int first = placeOf(t[0]);
    const int second = placeOf(t[1]);
    return {first, second, placeOf(t[2])};
  }

  /// Those that nobody asked for come last, as they were.
  void placeRest() {
    for (std::size_t v = 0; v < place_.size(); ++v) placeOf(static_cast<int>(v));
  }

  const std::vector<int>& places() const { return place_; }

  template <typename T>
  void apply(std::vector<T>& of_vertices) const {
    std::vector<T> moved;
    moved.reserve(of_vertices.size());
    for (const int v : order_) moved.push_back(of_vertices[v]);
    of_vertices.swap(moved);
  }

 private:
  std::vector<int> place_;  ///< the new number of each
  std::vector<int> order_;  ///< the old numbers
};

/// Of all triangles, by their leaves. Renumbers those.
std::vector<Eigen::Vector3i> inOrderOfLeaves(PieceTree& mesh) {
  std::vector<Eigen::Vector3i> triangles;
  triangles.reserve(mesh.triangles.size());
  std::vector<int> stack{0};
  while (!stack.empty()) {
    PieceTree::Node& node = mesh.nodes[stack.back()];
    stack.pop_back();
    if (!node.isLeaf()) {
      stack.push_back(node.right);
      stack.push_back(node.left);
      continue;
    }
    triangles.push_back(mesh.triangles[node.piece]);
    node.piece = static_cast<int>(triangles.size()) - 1;
  }
  return triangles;
}

bool isLarge(const PieceTree::Node& node) {
  return node.last_piece - node.piece >= PieceTree::kFewTriangles;
}

/// Nodes of few triangles last, otherwise in the order they had: a node still comes before its
/// children, which have no more triangles.
void orderNodes(PieceTree& mesh) {
  const std::size_t large = std::count_if(mesh.nodes.begin(), mesh.nodes.end(), isLarge);
  std::vector<int> places;
  places.reserve(mesh.nodes.size());
  int next_large = 0;
  int next_small = static_cast<int>(large);
  for (const PieceTree::Node& node : mesh.nodes) {
    places.push_back(isLarge(node) ? next_large++ : next_small++);
  }
  std::vector<PieceTree::Node> ordered(mesh.nodes.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    PieceTree::Node& node = ordered[places[i]];
    node = mesh.nodes[i];
    if (node.isLeaf()) continue;
    node.left = places[node.left];
    node.right = places[node.right];
  }
  mesh.nodes.swap(ordered);
  mesh.nodes_of_many = large;
}

}  // namespace

void tellTriangles(PieceTree& meshes) {
  for (std::size_t i = meshes.nodes.size(); i-- > 0;) {
    PieceTree::Node& node = meshes.nodes[i];
    if (!node.isLeaf()) node.piece = meshes.nodes[node.left].piece;
    node.last_piece = node.isLeaf() ? node.piece : meshes.nodes[node.right].last_piece;
  }
}

void orderByLeaves(PieceTree& mesh) {
  mesh.triangles = inOrderOfLeaves(mesh);
  tellTriangles(mesh);
  orderNodes(mesh);
  VertexOrder order(mesh.vertices.size());
  for (Eigen::Vector3i& t : mesh.triangles) t = order.placesOf(t);
  order.placeRest();
  order.apply(mesh.vertices);
  mesh.parts[0].places = order.places();
  for (auto& [from, to] : mesh.parts[0].spans) {
    if (from < 0) continue;
    from = order.placeOf(from);
    to = order.placeOf(to);
  }
  if (!mesh.caps) return;
  for (Eigen::Vector3i& t : mesh.caps->triangles) t = order.placesOf(t);
  // Apexes are vertices of the tree, but not of the mesh.
  std::vector<int>& components = mesh.caps->components.of_vertex;
  components.resize(mesh.vertices.size(), -1);
  order.apply(components);
}

}  // namespace fcl_prob::detail
