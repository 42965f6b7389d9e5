// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene/leaf_order.h"

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

bool isAboveClusters(const PieceTree::Node& node) {
  return node.last_piece - node.piece >= MeshClusters::kMostTriangles;
}

enum class Place { above, cluster, below };

/// Of each node, from top to bottom.
std::vector<Place> placesAmongClusters(const PieceTree& mesh) {
  std::vector<Place> places(mesh.nodes.size(), Place::cluster);
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    const PieceTree::Node& node = mesh.nodes[i];
    if (isAboveClusters(node)) {
      places[i] = Place::above;
    } else if (!node.isLeaf()) {
      places[node.left] = Place::below;
      places[node.right] = Place::below;
    }
  }
  return places;
}

/// Otherwise in the order they had: a node still comes before its children.
void orderNodes(PieceTree& mesh) {
  const std::vector<Place> among = placesAmongClusters(mesh);
  const auto countOf = [&](Place place) {
    return static_cast<int>(std::count(among.begin(), among.end(), place));
  };
  MeshClusters& clusters = mesh.clusters.emplace();
  clusters.begin = countOf(Place::above);
  clusters.end = clusters.begin + countOf(Place::cluster);
  int next[] = {0, clusters.begin, clusters.end};
  std::vector<int> places;
  places.reserve(mesh.nodes.size());
  for (const Place place : among) places.push_back(next[static_cast<int>(place)]++);
  std::vector<PieceTree::Node> ordered(mesh.nodes.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    PieceTree::Node& node = ordered[places[i]];
    node = mesh.nodes[i];
    if (node.isLeaf()) continue;
    node.left = places[node.left];
    node.right = places[node.right];
  }
  mesh.nodes.swap(ordered);
}

void tellClusters(PieceTree& mesh) {
  MeshClusters& clusters = *mesh.clusters;
  std::vector<int> of_cluster;
  for (int i = clusters.begin; i < clusters.end; ++i) {
    of_cluster.clear();
    for (int piece = mesh.nodes[i].piece; piece <= mesh.nodes[i].last_piece; ++piece) {
      const Eigen::Vector3i& t = mesh.triangles[piece];
      of_cluster.insert(of_cluster.end(), t.begin(), t.end());
    }
    std::sort(of_cluster.begin(), of_cluster.end());
    const auto end = std::unique(of_cluster.begin(), of_cluster.end());
    clusters.first.push_back(static_cast<int>(clusters.vertices.size()));
    clusters.vertices.insert(clusters.vertices.end(), of_cluster.begin(), end);
  }
  clusters.first.push_back(static_cast<int>(clusters.vertices.size()));
  clusters.vertices.shrink_to_fit();
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
  tellClusters(mesh);
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
