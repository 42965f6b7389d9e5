// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "pieces/patched_mesh.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>
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

NodeBox boxOfBoth(const NodeBox& one, const NodeBox& other) {
  NodeBox box;
  for (int k = 0; k < 3; ++k) {
    box.lo[k] = std::min(one.lo[k], other.lo[k]);
    box.hi[k] = std::max(one.hi[k], other.hi[k]);
  }
  return box;
}

}  // namespace

PatchedMesh::PatchedMesh(const WhitenedTree& mesh, const PartitionObject& object,
                         const Eigen::Matrix3d& matrix, PatchUse use)
    : mesh_(mesh) {
  nodes_.reserve(mesh.tree->nodes.size());
  boxes_.reserve(mesh.tree->nodes.size());
  for (std::size_t i = 0; i < object.parts.size(); ++i) {
    addPart(object.tree->parts[i], object.parts[i], matrix, use);
  }
  countMemory();
}

void PatchedMesh::addPart(const PieceTree::Part& part, const PlacedPart& placed,
                          const Eigen::Matrix3d& matrix, PatchUse use) {
  const Eigen::Matrix3d linear = matrix * placed.pose.linear();
  const MeshPatches* const patches =
      use == PatchUse::taken ? mesh_.tree->patchesOf(part) : nullptr;
  const auto root = static_cast<int>(nodes_.size());
  parts_.push_back({patches, placed.solid != nullptr, root, part.vertices.begin,
                    part.triangles.begin, linear, linear.inverse()});
  if (part.root < 0) return;
  roots_.push_back(root);
  if (!patches) {
    copyNodes(part.root);
    return;
  }
  const auto of_part = part.triangles.end - part.triangles.begin;
  const int first_patch = pieceCount();
  for (const MeshPatch& patch : patches->patches) {
    patches_.push_back({&patch, parts_.size() - 1});
  }
  for (Node node : patches->nodes) {
    if (node.left >= 0) {
      node.left += root;
      node.right += root;
    }
    if (node.piece >= of_part) {
      node.piece += first_patch - of_part;
    } else if (node.piece >= 0) {
      node.piece += part.triangles.begin;
    }
    nodes_.push_back(node);
  }
  fitBoxes(root);
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
  boxes_.push_back(mesh_.boxes[node]);
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

std::size_t PatchedMesh::trianglesOfPatches() const {
  return std::accumulate(
      patches_.begin(), patches_.end(), std::size_t{0},
      [](std::size_t sum, const Place& place) { return sum + place.patch->triangles.size(); });
}

// As WhitenedFan has the other object: in the whitened frame a normal n of the fan has the
// direction m with Lᵀm ∥ n; however m was rounded, the offset follows from how far Lᵀm is off n.
WhitenedPatch PatchedMesh::whitened(int patch) const {
  const auto& [of, part] = placeOf(patch);
  const ConvexFan& fan = of->fan;
  const Eigen::Matrix3d& linear = parts_[part].linear;
  const Eigen::Matrix3d unturned = parts_[part].inverse.transpose();
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
    if (nodes_[node].piece >= 0) return false;
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
  return placed.patches->solid.contains(point) == Containment::outside;
}

}  // namespace fcl_prob::detail
