// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene/patched_mesh.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "base/constants.h"

namespace fcl_prob::detail {
namespace {

// A patch that is known no better than this share of it is left to its triangles.
constexpr double kLargestPatchShare = 1e-6;

// A box is thicker than this share of its distance and the mesh's size: what moving its middle to
// the mesh's own frame rounds is next to nothing of that.
constexpr double kThinnestBox = 1e-6;

}  // namespace

PatchedMesh::PatchedMesh(const WhitenedTree& mesh, const PartitionObject& object,
                         const Eigen::Matrix3d& matrix, PatchUse use)
    : mesh_(mesh), use_(use) {
  nodes_.reserve(mesh.tree->nodes.size());
  boxes_.reserve(mesh.tree->nodes.size());
  for (std::size_t i = 0; i < object.parts.size(); ++i) {
    addPart(object.tree->parts[i], object.parts[i], matrix);
  }
  countMemory();
}

void PatchedMesh::addPart(const PieceTree::Part& part, const PlacedPart& placed,
                          const Eigen::Matrix3d& matrix) {
  const Eigen::Matrix3d linear = matrix * placed.pose.linear();
  const MeshPatches* const patches = use_.taken ? mesh_.tree->patchesOf(part) : nullptr;
  const auto root = static_cast<int>(nodes_.size());
  const auto of_part = part.triangles.end - part.triangles.begin;
  parts_.push_back({patches, placed.solid != nullptr, root, part.vertices.begin,
                    part.triangles.begin, of_part, pieceCount(), linear, linear.inverse()});
  if (part.root < 0) return;
  roots_.push_back(root);
  if (!patches) {
    copyNodes(part.root);
    return;
  }
  addPlaces(*patches);
  for (Node node : patches->nodes) {
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
void PatchedMesh::addPlaces(const MeshPatches& patches) {
  const PlacedPatches& part = parts_.back();
  const Eigen::Matrix3d unturned = part.inverse.transpose();
  for (const FlatPolygon& polygon : patches.polygons) {
    const Eigen::Vector3d n = (unturned * polygon.normal).normalized();
    places_.push_back({nullptr, &polygon, parts_.size() - 1, offOf(polygon, part, n), n});
  }
  for (const MeshPatch& patch : patches.patches) {
    places_.push_back({&patch, nullptr, parts_.size() - 1});
    if (patch.off > 0.0) {
      places_.back().off = part.linear.norm() * patch.off + 4 * mesh_.error.norm();
    }
  }
}

// By how much its corners leave a plane across n, and what its triangles may be off their hull
// besides, here.
double PatchedMesh::offOf(const FlatPolygon& polygon, const PlacedPatches& part,
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
void PatchedMesh::countMemory() {
  std::set<const MeshPatches*> counted{nullptr};
  for (const PlacedPatches& part : parts_) {
    if (counted.insert(part.patches).second) memory_of_patches_ += part.patches->memory();
  }
}

int PatchedMesh::copyNodes(int node) {
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

void PatchedMesh::fitBoxes(int root) {
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

PatchedMesh::Held PatchedMesh::heldByPolygons() const {
  Held held{0, 0};
  for (const Place& place : places_) {
    if (!place.polygon) continue;
    ++held.pieces;
    held.triangles += place.polygon->triangles.size();
  }
  return held;
}

PatchedMesh::Held PatchedMesh::heldByPatches() const {
  Held held{0, 0};
  for (int piece = triangleCount(); piece < pieceCount(); ++piece) {
    if (!isPatch(piece)) continue;
    ++held.pieces;
    visitPieces(piece, [&](int each) {
      held.triangles += isTriangle(each) ? 1 : placeOf(each).polygon->triangles.size();
    });
  }
  return held;
}

// As WhitenedFan has the other object: in the whitened frame a normal n of the fan has the
// direction m with Lᵀm ∥ n; however m was rounded, the offset follows from how far Lᵀm is off n.
WhitenedPatch PatchedMesh::whitened(int patch) const {
  const Place& place = placeOf(patch);
  const ConvexFan& fan = place.patch->fan;
  const Eigen::Matrix3d& linear = parts_[place.part].linear;
  const Eigen::Matrix3d unturned = parts_[place.part].inverse.transpose();
  const double size = linear.cwiseAbs().sum();
  WhitenedPatch whitened{{}, fan.arcs, 0.0};
  double share = 0.0;
  for (std::size_t f = 0; f < fan.normals.size(); ++f) {
    const Eigen::Vector3d n = (unturned * fan.normals[f]).normalized();
    const Eigen::Vector3d back = linear.transpose() * n;
    const double scale = back.dot(fan.normals[f]);
    const double off = (back - scale * fan.normals[f]).norm() * fan.radius +
                       16 * kEpsilon * size * fan.radius + 4 * mesh_.errorAlong(n);
    const double offset = scale * fan.offsets[f] + off;
    const double depth = scale * fan.depths[f] + 2 * off;
    share = std::max(share, scale > 0.0 && offset > depth ? depth / offset : kInfinity);
    whitened.normals.push_back(n);
  }
  // Once for the mesh within K, once for the fan off K.
  share *= 2.5;
  whitened.loss = share < kLargestPatchShare ? share * size * fan.radius : kInfinity;
  return whitened;
}

// No triangle meets the box: any point of it tells, and its middle is one, rounded or not.
bool PatchedMesh::isOutside(std::size_t part, const NodeBox& box) const {
  const PlacedPatches& placed = parts_[part];
  std::vector<int> open{placed.root};
  while (!open.empty()) {
    const int node = open.back();
    open.pop_back();
    if (isClearOf(boxes_[node], box.lo, box.hi)) continue;
    const int piece = nodes_[node].piece;
    if (piece >= 0 && (isTriangle(piece) || isPatch(piece))) return false;
    open.push_back(nodes_[node].right);
    open.push_back(nodes_[node].left);
  }
  const Eigen::Map<const Eigen::Vector3d> lo(box.lo);
  const Eigen::Map<const Eigen::Vector3d> hi(box.hi);
  const Eigen::Vector3d& anchor = mesh_.vertices[placed.first_vertex];
  const Eigen::Vector3d to_middle = 0.5 * (lo + hi) - anchor;
  const double size = to_middle.norm() + anchor.norm() + boxes_[placed.root].size();
  if (!((hi - lo).minCoeff() > kThinnestBox * size)) return false;
  const Eigen::Vector3d point =
      mesh_.tree->vertices[placed.first_vertex] + placed.inverse * to_middle;
  return placed.patches->solid->contains(point) == Containment::outside;
}

}  // namespace fcl_prob::detail
