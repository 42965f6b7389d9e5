// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Which obstacles may meet a cell, and over which of their planes it sticks out.
#include <algorithm>
#include <cmath>

#include "partition/carving_engine.h"
#include "partition/cell_split.h"

namespace fcl_prob::detail {
namespace {

// A node of the mesh's tree is opened in a box if it is this many times larger.
constexpr double kOpenRatio = 2.0;

}  // namespace

void CarvingEngine::divideBox(CarvedCell&& cell) {
  OpenCell open;
  open.cell = *cell.box;
  const CellSplit at = chooseSplit(open, Eigen::Vector3d::Ones());
  for (const bool upper : {false, true}) {
    CarvedCell half;
    half.box = cell.box;
    (upper ? half.box->lo : half.box->hi)[at.axis] = at.at;
    half.mass = cellMass(*half.box);
    std::vector<int> nodes;
    gatherNodes(*half.box, *cell.nodes, false, nodes);
    if (nodes.empty()) {
      half.body = CellPolytope(*half.box);
      settleFree(half);
      continue;
    }
    half.nodes = std::make_shared<const std::vector<int>>(std::move(nodes));
    push(std::move(half));
  }
}

void CarvingEngine::gatherNodes(const Cell& box, const std::vector<int>& from, bool to_leaves,
                                std::vector<int>& into) const {
  const WhitenedTree& mesh = obstacles_.mesh();
  const double size = (box.hi - box.lo).sum();
  std::vector<int> stack(from.rbegin(), from.rend());
  while (!stack.empty()) {
    const int node = stack.back();
    stack.pop_back();
    ++statistics_.pairs_tested;
    if (isClearOf(obstacles_.obstacleBox(node), box.lo.data(), box.hi.data())) continue;
    const PieceTree::Node& in_tree = mesh.tree->nodes[node];
    if (in_tree.isLeaf() || (!to_leaves && mesh.boxes[node].size() < kOpenRatio * size)) {
      into.push_back(node);
    } else {
      stack.push_back(in_tree.right);
      stack.push_back(in_tree.left);
    }
  }
}

CarvingEngine::Relation CarvingEngine::examine(const CarvedCell& cell, List& into) {
  if (!cell.box) return refine(cell, into);
  std::vector<int> leaves;
  gatherNodes(*cell.box, *cell.nodes, true, leaves);
  std::vector<int> triangles;
  for (const int leaf : leaves) triangles.push_back(obstacles_.mesh().tree->nodes[leaf].piece);
  return listBox(cell, triangles, into);
}

// The most central obstacles first: one of them may cover the box.
CarvingEngine::Relation CarvingEngine::listBox(const CarvedCell& cell,
                                               const std::vector<int>& triangles, List& into) {
  const int faces = obstacles_.faceCount();
  const CellBox box = cell.box->box();
  const Eigen::Map<const Eigen::Vector3d> middle(box.center);
  const Eigen::Map<const Eigen::Vector3d> half(box.half);
  face_lo_.resize(faces);
  face_hi_.resize(faces);
  for (int f = 0; f < faces; ++f) {
    const Eigen::Vector3d& n = obstacles_.faceNormal(f);
    const double at = n.dot(middle);
    const double radius = n.cwiseAbs().dot(half);
    face_lo_[f] = at - radius;
    face_hi_[f] = at + radius;
  }
  std::vector<std::pair<double, int>> order;
  for (const int t : triangles) {
    order.emplace_back((obstacles_.middle(t) - middle).squaredNorm(), t);
  }
  std::sort(order.begin(), order.end());
  for (const auto& [unused, t] : order) {
    if (addFromBox(box, t, into) == Relation::covered) return Relation::covered;
  }
  return into.entries.empty() ? Relation::free : Relation::cut;
}

CarvingEngine::Relation CarvingEngine::addFromBox(const CellBox& box, int triangle, List& into) {
  ++statistics_.pairs_tested;
  const std::vector<double>& offsets = obstacles_.faceOffsets(triangle);
  const double padding = obstacles_.padding(Eigen::Vector3d::Ones());
  const int faces = obstacles_.faceCount();
  for (int f = 0; f < faces; ++f) {
    if (face_lo_[f] > offsets[f] + padding) return Relation::free;
  }
  const std::vector<ObstaclePlane>& others = obstacles_.otherPlanes(triangle);
  const double margin = obstacles_.mostMargin(triangle);
  const Eigen::Map<const Eigen::Vector3d> middle(box.center);
  const Eigen::Map<const Eigen::Vector3d> half(box.half);
  const std::size_t first = into.planes.size();
  for (const ObstaclePlane& plane : others) {
    const double at = plane.n.dot(middle);
    const double radius = plane.n.cwiseAbs().dot(half);
    if (at - radius > plane.outer) {
      into.planes.resize(first);
      return Relation::free;
    }
    if (at + radius > plane.inner()) into.planes.push_back(plane);
  }
  for (int f = 0; f < faces; ++f) {
    if (face_hi_[f] <= offsets[f] - margin) continue;
    const ObstaclePlane plane = obstacles_.facePlane(triangle, f);
    if (face_hi_[f] > plane.inner()) into.planes.push_back(plane);
  }
  if (into.planes.size() == first) return Relation::covered;
  into.entries.push_back({triangle, first, into.planes.size()});
  return Relation::cut;
}

// Obstacles that reach no farther than the one that the cell is outside of do not meet the cell but
// in the layer that was allowed for when it was cut off.
CarvingEngine::Relation CarvingEngine::refine(const CarvedCell& cell, List& into) {
  const List& from = *cell.list;
  const double reach = cell.outside_of < 0 ? 0.0 : obstacles_.extent(cell.outside_of, cell.behind);
  for (const List::Entry& entry : from.entries) {
    ++statistics_.pairs_tested;
    if (cell.outside_of >= 0 && obstacles_.extent(entry.triangle, cell.behind) <= reach) continue;
    const std::size_t first = into.planes.size();
    bool meets = true;
    for (std::size_t i = entry.first; i < entry.last && meets; ++i) {
      const ObstaclePlane& plane = from.planes[i];
      const CellPolytope::Extent extent = cell.body.along(plane.n);
      meets = !(extent.lo > plane.outer);
      if (extent.hi > plane.inner() - 2 * CellPolytope::kSnap) into.planes.push_back(plane);
    }
    if (!meets) {
      into.planes.resize(first);
      continue;
    }
    if (into.planes.size() == first) return Relation::covered;
    into.entries.push_back({entry.triangle, first, into.planes.size()});
  }
  return into.entries.empty() ? Relation::free : Relation::cut;
}

}  // namespace fcl_prob::detail
