// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Which obstacles may meet a cell, and over which of their planes it sticks out.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "carving/cell_carver.h"
#include "cells/cell_split.h"

namespace fcl_prob::detail {
namespace {

// A node of the mesh's tree is opened in a box if it is this many times larger.
constexpr double kOpenRatio = 2.0;

// A plane of an obstacle over which a body sticks out. False if all of it does: the two are apart.
bool addPlane(const CellPolytope& body, const ObstaclePlane& plane, ObstacleList& into) {
  const CellPolytope::Extent extent = body.along(plane.n);
  if (extent.lo > plane.outer) return false;
  if (extent.hi > plane.inner() - 2 * CellPolytope::kSnap) into.planes.push_back(plane);
  return true;
}

// The first face from `from` on whose value is not at most limits[f] + `by`, or `count`. Sixteen
// are looked at at once, since few are above. (The sign of a difference is exact.)
int firstAbove(const double* values, const double* limits, double by, int from, int count) {
  constexpr int kAtOnce = 16;
  using Values = Eigen::Map<const Eigen::Array<double, kAtOnce, 1>>;
  int face = from;
  for (; face + kAtOnce <= count; face += kAtOnce) {
    const auto above = Values(values + face) - (Values(limits + face) + by);
    if (!(above.maxCoeff<Eigen::PropagateNaN>() <= 0.0)) break;
  }
  while (face < count && values[face] <= limits[face] + by) ++face;
  return face;
}

}  // namespace

void CellCarver::divideBox(CarvedCell&& cell) {
  const CellSplit at = chooseSplit(*cell.box, Eigen::Vector3d::Ones());
  for (const bool upper : {false, true}) {
    CarvedCell half;
    half.box = cell.box;
    (upper ? half.box->lo : half.box->hi)[at.axis] = at.at;
    half.mass = cellMass(*half.box);
    std::vector<FatNode> nodes;
    gatherNodes(*half.box, *cell.nodes, false, nodes);
    if (nodes.empty()) {
      half.body = CellPolytope(*half.box);
      settleFree(half);
      continue;
    }
    half.nodes = std::make_shared<const std::vector<FatNode>>(std::move(nodes));
    push(std::move(half));
  }
}

void CellCarver::gatherNodes(const Cell& box, const std::vector<FatNode>& from, bool to_leaves,
                             std::vector<FatNode>& into) const {
  const WhitenedTree& mesh = obstacles_.mesh();
  const double size = (box.hi - box.lo).sum();
  std::vector<FatNode> stack(from.rbegin(), from.rend());
  while (!stack.empty()) {
    const auto [member, node] = stack.back();
    stack.pop_back();
    ++statistics_.pairs_tested;
    const NodeBox around = obstacles_.of(member).obstacleBox(node);
    if (isClearOf(around, box.lo.data(), box.hi.data())) continue;
    const PieceTree::Node& in_tree = mesh.tree->nodes[node];
    if (in_tree.isLeaf() || (!to_leaves && mesh.boxes[node].size() < kOpenRatio * size)) {
      into.push_back({member, node});
    } else {
      stack.push_back({member, in_tree.right});
      stack.push_back({member, in_tree.left});
    }
  }
}

CellCarver::Relation CellCarver::examine(const CarvedCell& cell, List& into) {
  if (cell.opens_hulls) return openHulls(cell, into);
  if (!cell.box) return refine(cell, into);
  std::vector<FatNode> leaves;
  gatherNodes(*cell.box, *cell.nodes, true, leaves);
  std::vector<FatObstacle> obstacles;
  for (const auto& [member, leaf] : leaves) {
    obstacles.push_back({member, obstacles_.mesh().tree->nodes[leaf].piece});
  }
  return listBox(cell, obstacles, into);
}

// The most central obstacles first: one of them may cover the box.
CellCarver::Relation CellCarver::listBox(const CarvedCell& cell,
                                         const std::vector<FatObstacle>& obstacles, List& into) {
  const CellBox box = cell.box->box();
  const Eigen::Map<const Eigen::Vector3d> middle(box.center);
  face_lo_.resize(obstacles_.faceCount());
  face_hi_.resize(obstacles_.faceCount());
  ranged_.assign(obstacles_.count(), false);
  apart_.assign(obstacles_.count(), 0);
  std::vector<std::tuple<double, int, int>> order;
  for (const auto& [member, t] : obstacles) {
    order.emplace_back((obstacles_.of(member).middle(t) - middle).squaredNorm(), member, t);
  }
  std::sort(order.begin(), order.end());
  for (const auto& [unused, member, t] : order) {
    if (addFromBox(box, {member, t}, into) == Relation::covered) return Relation::covered;
  }
  return into.entries.empty() ? Relation::free : Relation::cut;
}

// What the box reaches along the normals of a member.
void CellCarver::rangeFaces(const CellBox& box, int member) {
  if (ranged_[member]) return;
  ranged_[member] = true;
  const FatObstacles& body = obstacles_.of(member);
  const Eigen::Map<const Eigen::Vector3d> middle(box.center);
  const Eigen::Map<const Eigen::Vector3d> half(box.half);
  const int first = obstacles_.firstFace(member);
  for (int f = 0; f < body.faceCount(); ++f) {
    const Eigen::Vector3d& n = body.faceNormal(f);
    const double at = n.dot(middle);
    const double radius = n.cwiseAbs().dot(half);
    face_lo_[first + f] = at - radius;
    face_hi_[first + f] = at + radius;
  }
}

CellCarver::Relation CellCarver::addFromBox(const CellBox& box, FatObstacle obstacle, List& into) {
  ++statistics_.pairs_tested;
  rangeFaces(box, obstacle.member);
  FatObstacles& body = obstacles_.of(obstacle.member);
  const double* const face_lo = &face_lo_[obstacles_.firstFace(obstacle.member)];
  const double* const face_hi = &face_hi_[obstacles_.firstFace(obstacle.member)];
  const std::vector<double>& offsets = body.faceOffsets(obstacle.triangle);
  const double padding = body.padding(Eigen::Vector3d::Ones());
  const int faces = body.faceCount();
  int& apart = apart_[obstacle.member];
  const auto isApart = [&](int f) { return face_lo[f] > offsets[f] + padding; };
  if (isApart(apart)) return Relation::free;
  if (const int f = firstAbove(face_lo, offsets.data(), padding, 0, faces); f < faces) {
    apart = f;
    if (isApart(f)) return Relation::free;
  }
  const std::vector<ObstaclePlane>& others = body.otherPlanes(obstacle.triangle);
  const double margin = body.mostMargin(obstacle.triangle);
  failed_ = failed_ || body.hasFailed(obstacle.triangle);
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
  const auto firstCut = [&](int from) {
    return firstAbove(face_hi, offsets.data(), -margin, from, faces);
  };
  for (int f = firstCut(0); f < faces; f = firstCut(f + 1)) {
    const ObstaclePlane plane = body.facePlane(obstacle.triangle, f);
    if (face_hi[f] > plane.inner()) into.planes.push_back(plane);
  }
  return addEntry(obstacle, first, into);
}

// With the planes of the list from `first` on: those over which the cell sticks out.
CellCarver::Relation CellCarver::addEntry(FatObstacle obstacle, std::size_t first,
                                          List& into) const {
  const bool within = into.planes.size() == first;
  if (within && !obstacles_.encloses(obstacle.member)) return Relation::covered;
  into.entries.push_back({obstacle, first, into.planes.size()});
  return Relation::cut;
}

// Obstacles of the same member that reach no farther than the one that the cell is outside of do
// not meet the cell but in the layer that was allowed for when it was cut off.
CellCarver::Relation CellCarver::refine(const CarvedCell& cell, List& into) {
  const List& from = *cell.list;
  const auto [member, triangle] = cell.outside_of;
  const FatObstacles* const body = member < 0 ? nullptr : &obstacles_.of(member);
  const double reach = body ? body->extent(triangle, cell.behind) : 0.0;
  for (const List::Entry& entry : from.entries) {
    ++statistics_.pairs_tested;
    const bool may_be_behind = body && entry.obstacle.member == member;
    if (may_be_behind && body->extent(entry.obstacle.triangle, cell.behind) <= reach) continue;
    const std::size_t first = into.planes.size();
    bool meets = true;
    for (std::size_t i = entry.first; i < entry.last && meets; ++i) {
      meets = addPlane(cell.body, from.planes[i], into);
    }
    if (!meets) {
      into.planes.resize(first);
      continue;
    }
    if (addEntry(entry.obstacle, first, into) == Relation::covered) return Relation::covered;
  }
  return into.entries.empty() ? Relation::free : Relation::cut;
}

// All obstacles of the list are hulls: no core meets the cell.
CellCarver::Relation CellCarver::openHulls(const CarvedCell& cell, List& into) {
  for (const List::Entry& hull : cell.list->entries) {
    for (const int piece : obstacles_.piecesWithin(hull.obstacle.member)) {
      const FatObstacle obstacle{piece, hull.obstacle.triangle};
      if (addFromBody(cell.body, obstacle, into) == Relation::covered) return Relation::covered;
    }
  }
  return into.entries.empty() ? Relation::free : Relation::cut;
}

CellCarver::Relation CellCarver::addFromBody(const CellPolytope& body, FatObstacle obstacle,
                                             List& into) {
  FatObstacles& member = obstacles_.of(obstacle.member);
  const NodeBox around = member.obstacleBoxOf(obstacle.triangle);
  const Cell box = body.box();
  if (isClearOf(around, box.lo.data(), box.hi.data())) return Relation::free;
  ++statistics_.pairs_tested;
  const std::size_t first = into.planes.size();
  const auto meets = [&](const ObstaclePlane& plane) { return addPlane(body, plane, into); };
  member.faceOffsets(obstacle.triangle);
  const std::vector<ObstaclePlane>& others = member.otherPlanes(obstacle.triangle);
  failed_ = failed_ || member.hasFailed(obstacle.triangle);
  bool may_meet = std::all_of(others.begin(), others.end(), meets);
  for (int f = 0; f < member.faceCount() && may_meet; ++f) {
    may_meet = meets(member.facePlane(obstacle.triangle, f));
  }
  if (may_meet) return addEntry(obstacle, first, into);
  into.planes.resize(first);
  return Relation::free;
}

}  // namespace fcl_prob::detail
