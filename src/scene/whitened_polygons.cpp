// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene/whitened_polygons.h"

#include <Eigen/LU>
#include <algorithm>
#include <set>
#include <tuple>

#include "base/constants.h"

namespace fcl_prob::detail {

WhitenedPolygons::WhitenedPolygons(const WhitenedTree& mesh, const PartitionObject& object,
                                   const Eigen::Matrix3d& matrix, double most_loss)
    : mesh_(mesh), most_loss_(most_loss) {
  nodes_.reserve(mesh.tree->nodes.size());
  boxes_.reserve(mesh.tree->nodes.size());
  for (std::size_t i = 0; i < object.parts.size(); ++i) {
    addPart(object.tree->parts[i], object.parts[i], matrix);
  }
  countMemory();
}

void WhitenedPolygons::addPart(const PieceTree::Part& part, const PlacedPart& placed,
                               const Eigen::Matrix3d& matrix) {
  const MeshPolygons* const polygons = mesh_.tree->polygonsOf(part);
  const auto root = static_cast<int>(nodes_.size());
  const auto of_part = part.triangles.end - part.triangles.begin;
  parts_.push_back({polygons, part.vertices.begin, part.triangles.begin, of_part, pieceCount(),
                    matrix * placed.pose.linear()});
  if (part.root < 0) return;
  roots_.push_back(root);
  if (!polygons) {
    copyNodes(part.root);
    return;
  }
  addPlaces(*polygons);
  for (Node node : polygons->nodes) {
    if (node.left >= 0) {
      node.left += root;
      node.right += root;
    }
    if (node.piece >= 0) node.piece = parts_.back().pieceOf(node.piece);
    nodes_.push_back(node);
  }
  fitBoxes(root);
}

// Of the last part.
void WhitenedPolygons::addPlaces(const MeshPolygons& polygons) {
  const PlacedPolygons& part = parts_.back();
  const Eigen::Matrix3d unturned = part.linear.inverse().transpose();
  for (const FlatPolygon& polygon : polygons.polygons) {
    const Eigen::Vector3d n = (unturned * polygon.normal).normalized();
    places_.push_back({&polygon, parts_.size() - 1, offOf(polygon, part, n), n});
  }
}

// By how much its corners leave a plane across n, and what its triangles may be off their hull
// besides, here.
double WhitenedPolygons::offOf(const FlatPolygon& polygon, const PlacedPolygons& part,
                               const Eigen::Vector3d& n) const {
  const Eigen::Vector3d& from = mesh_.vertices[part.first_vertex + polygon.corners[0]];
  double lowest = 0.0;
  double highest = 0.0;
  double size = 0.0;
  for (const int v : polygon.corners) {
    const Eigen::Vector3d to = mesh_.vertices[part.first_vertex + v] - from;
    lowest = std::min(lowest, n.dot(to));
    highest = std::max(highest, n.dot(to));
    size = std::max(size, to.norm());
  }
  return (highest - lowest) + 16 * kEpsilon * size + part.linear.norm() * polygon.off +
         4 * mesh_.error.norm();
}

// Parts of the same geometry share theirs.
void WhitenedPolygons::countMemory() {
  std::set<const MeshPolygons*> counted{nullptr};
  for (const PlacedPolygons& part : parts_) {
    if (counted.insert(part.polygons).second) memory_of_polygons_ += part.polygons->memory();
  }
}

int WhitenedPolygons::copyNodes(int node) {
  const PieceTree::Node& from = mesh_.tree->nodes[node];
  const auto index = static_cast<int>(nodes_.size());
  nodes_.push_back({-1, -1, from.piece});
  boxes_.push_back(mesh_.boxOf(node));
  if (!from.isLeaf()) {
    const int left = copyNodes(from.left);
    const int right = copyNodes(from.right);
    nodes_[index] = {left, right, -1};
  }
  return index;
}

void WhitenedPolygons::fitBoxes(int root) {
  boxes_.resize(nodes_.size());
  for (auto i = static_cast<int>(nodes_.size()); i-- > root;) {
    const Node& node = nodes_[i];
    if (node.left >= 0) {
      boxes_[i] = boxOfBoth(boxes_[node.left], boxes_[node.right]);
      continue;
    }
    const Eigen::Vector3i& t = mesh_.tree->triangles[node.piece];
    const auto& [a, b, c] =
        std::tie(mesh_.vertices[t[0]], mesh_.vertices[t[1]], mesh_.vertices[t[2]]);
    boxes_[i] = paddedBox(a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c), mesh_.error);
  }
}

WhitenedPolygons::Held WhitenedPolygons::held() const {
  Held held{places_.size(), 0};
  for (const Place& place : places_) held.triangles += place.polygon->triangles.size();
  return held;
}

}  // namespace fcl_prob::detail
