// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cells/obstacle_lister.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace fcl_prob::detail {
namespace {

// A node of the mesh's tree is opened in a box if it is this many times larger.
constexpr double kOpenRatio = 2.0;

// A piece is looked at more closely than by the box around it if that is so many times larger.
constexpr double kBesideRatio = 6.0;

// Whether what a cell reaches along a face is above the offset of an obstacle: not a number is.
bool isAbove(double value, double limit, double by) { return !(value <= limit + by); }

// The first face from `face` on whose value is above its limit, or `count`. Most are not: eight are
// asked at once, which compilers do by vectors.
int nextAbove(const double* values, const double* limits, double by, int face, int count) {
  constexpr int kAtOnce = 8;
  for (; face + kAtOnce <= count; face += kAtOnce) {
    int above = 0;
    for (int k = 0; k < kAtOnce; ++k) above |= isAbove(values[face + k], limits[face + k], by);
    if (above != 0) break;
  }
  while (face < count && !isAbove(values[face], limits[face], by)) ++face;
  return face;
}

}  // namespace

ObstacleLister::ObstacleLister(FatMembers& obstacles, ProbabilityStatistics& statistics)
    : obstacles_(obstacles),
      statistics_(statistics),
      face_lo_(static_cast<std::size_t>(obstacles.faceCount())),
      face_hi_(static_cast<std::size_t>(obstacles.faceCount())),
      face_extents_(static_cast<std::size_t>(obstacles.faceCount())) {}

const std::vector<FatNode>& ObstacleLister::nodesIn(const Cell& box,
                                                    const std::vector<FatNode>& from) {
  gatherNodes(box, from, false);
  return gathered_;
}

// Whether the one obstacle that reaches farthest beyond the box, as far as planes of nodes tell,
// covers it: then it need not be divided.
bool ObstacleLister::isCovered(const Cell& box) {
  const WhitenedPolygons& pieces = obstacles_.pieces();
  const Eigen::Vector3d middle = 0.5 * (box.lo + box.hi);
  const Eigen::Vector3d half = 0.5 * (box.hi - box.lo);
  FatNode best{-1, -1};
  float most = 0.0F;
  NodeReach::Heights highest;
  int highest_of = -1;
  for (const FatNode& each : gathered_) {
    if (obstacles_.encloses(each.member)) continue;
    const NodeReach& reach = obstacles_.reachOf(each.member);
    if (highest_of != each.member) highest = reach.highestOf(middle, half);
    highest_of = each.member;
    const float least = reach.leastOver(highest, each.node);
    if (!(least > most)) continue;
    most = least;
    best = each;
  }
  if (best.member < 0) return false;
  const NodeReach& reach = obstacles_.reachOf(best.member);
  if (highest_of != best.member) highest = reach.highestOf(middle, half);
  for (;;) {
    const WhitenedPolygons::Node& node = pieces.nodes()[best.node];
    if (node.piece >= 0 && takesPiece(best.member, node.piece)) {
      ranged_.assign(static_cast<std::size_t>(obstacles_.count()), false);
      return covers(box.box(), {best.member, node.piece});
    }
    const float of_left = reach.leastOver(highest, node.left);
    const float of_right = reach.leastOver(highest, node.right);
    best.node = of_left > of_right ? node.left : node.right;
    if (!(std::max(of_left, of_right) > 0.0F)) return false;
  }
}

bool ObstacleLister::covers(const CellBox& box, FatObstacle obstacle) {
  ++statistics_.pairs_tested;
  rangeFaces(box, obstacle.member);
  FatObstacles& body = obstacles_.of(obstacle.member);
  const double* const face_hi = &face_hi_[obstacles_.firstFace(obstacle.member)];
  const std::vector<double>& offsets = body.faceOffsets(obstacle.piece);
  const int faces = body.faceCount();
  const auto isWithin = [&](double margin) {
    return nextAbove(face_hi, offsets.data(), -margin, 0, faces) == faces;
  };
  if (!isWithin(0.0)) return false;
  const std::vector<ObstaclePlane>& others = body.otherPlanes(obstacle.piece);
  if (body.hasFailed(obstacle.piece) || !isWithin(body.mostMargin(obstacle.piece))) return false;
  const Eigen::Map<const Eigen::Vector3d> middle(box.center);
  const Eigen::Map<const Eigen::Vector3d> half(box.half);
  return std::all_of(others.begin(), others.end(), [&](const ObstaclePlane& plane) {
    return plane.n.dot(middle) + plane.n.cwiseAbs().dot(half) <= plane.inner();
  });
}

// Those of the nodes, and of what is below them, that the box may meet.
void ObstacleLister::gatherNodes(const Cell& box, const std::vector<FatNode>& from,
                                 bool to_leaves) {
  const WhitenedPolygons& pieces = obstacles_.pieces();
  const Eigen::Vector3d middle = 0.5 * (box.lo + box.hi);
  const Eigen::Vector3d half = 0.5 * (box.hi - box.lo);
  const double size = 2.0 * half.sum();
  lowest_.clear();
  for (int member = 0; member < obstacles_.count(); ++member) {
    lowest_.push_back(obstacles_.reachOf(member).lowestOf(middle, half));
  }
  gathered_.clear();
  stack_.assign(from.rbegin(), from.rend());
  while (!stack_.empty()) {
    const auto [member, node] = stack_.back();
    stack_.pop_back();
    ++statistics_.pairs_tested;
    const NodeReach& reach = obstacles_.reachOf(member);
    if (isClearOf(reach.boxOf(node), box.lo.data(), box.hi.data())) continue;
    if (reach.isClearOf(lowest_[member], node)) continue;
    const WhitenedPolygons::Node& in_tree = pieces.nodes()[node];
    const bool is_small = !to_leaves && pieces.box(node).size() < kOpenRatio * size;
    const bool is_large_piece = in_tree.piece >= 0 && pieces.box(node).size() > kBesideRatio * size;
    if (is_large_piece && isBeside(box, {member, in_tree.piece})) continue;
    if (is_small || (in_tree.piece >= 0 && takesPiece(member, in_tree.piece))) {
      gathered_.push_back({member, node});
    } else {
      stack_.push_back({member, in_tree.right});
      stack_.push_back({member, in_tree.left});
    }
  }
}

// A box around what is large, flat and oblique tells little of it.
bool ObstacleLister::isBeside(const Cell& box, FatObstacle obstacle) {
  FatObstacles& body = obstacles_.of(obstacle.member);
  const std::vector<ObstaclePlane>& planes = body.otherPlanes(obstacle.piece);
  const Eigen::Vector3d middle = 0.5 * (box.lo + box.hi);
  const Eigen::Vector3d half = 0.5 * (box.hi - box.lo);
  return std::any_of(planes.begin(), planes.begin() + body.ownPlanes(obstacle.piece),
                     [&](const ObstaclePlane& plane) {
                       const double lowest = plane.n.dot(middle) - plane.n.cwiseAbs().dot(half);
                       return lowest > plane.outer;
                     });
}

bool ObstacleLister::takesPiece(int member, int piece) const {
  return obstacles_.pieces().isTriangle(piece) || obstacles_.of(member).mayTakePolygon(piece);
}

ObstacleLister::Relation ObstacleLister::list(const CarvedCell& cell, List& into) {
  failed_ = false;
  return cell.box ? listBox(cell, into) : refine(cell, into);
}

// Those obstacles first that reach over most of the box: one of them may cover it.
ObstacleLister::Relation ObstacleLister::listBox(const CarvedCell& cell, List& into) {
  gatherNodes(*cell.box, *cell.nodes, true);
  const CellBox box = cell.box->box();
  ranged_.assign(obstacles_.count(), false);
  apart_.assign(obstacles_.count(), 0);
  std::vector<std::tuple<float, int, int>> order;
  for (const auto& [member, leaf] : gathered_) {
    const int t = obstacles_.pieces().nodes()[leaf].piece;
    order.emplace_back(-obstacles_.reachOf(member).leastOver(lowest_[member], leaf), member, t);
  }
  std::sort(order.begin(), order.end());
  for (const auto& [unused, member, t] : order) {
    if (addFromBox(box, {member, t}, into) == Relation::covered) return Relation::covered;
  }
  return into.entries.empty() ? Relation::free : Relation::cut;
}

// What the box reaches along the normals of a member.
void ObstacleLister::rangeFaces(const CellBox& box, int member) {
  if (ranged_[member]) return;
  ranged_[member] = true;
  const FatObstacles& body = obstacles_.of(member);
  const Eigen::Map<const Eigen::Vector3d> middle(box.center);
  const Eigen::Map<const Eigen::Vector3d> half(box.half);
  const int first = obstacles_.firstFace(member);
  Eigen::Map<Eigen::VectorXd> lo(&face_lo_[first], body.faceCount());
  Eigen::Map<Eigen::VectorXd> hi(&face_hi_[first], body.faceCount());
  lo = body.heightsAlong(middle);
  hi = body.radiiOf(half);
  for (Eigen::Index f = 0; f < lo.size(); ++f) {
    const double height = lo[f], radius = hi[f];
    lo[f] = height - radius;
    hi[f] = height + radius;
  }
}

ObstacleLister::Relation ObstacleLister::addFromBox(const CellBox& box, FatObstacle obstacle,
                                                    List& into) {
  ++statistics_.pairs_tested;
  rangeFaces(box, obstacle.member);
  FatObstacles& body = obstacles_.of(obstacle.member);
  const double* const face_lo = &face_lo_[obstacles_.firstFace(obstacle.member)];
  const double* const face_hi = &face_hi_[obstacles_.firstFace(obstacle.member)];
  const std::vector<double>& offsets = body.faceOffsets(obstacle.piece);
  const double padding = body.padding(Eigen::Vector3d::Ones());
  const int faces = body.faceCount();
  int& apart = apart_[obstacle.member];
  const auto isApart = [&](int f) { return face_lo[f] > offsets[f] + padding; };
  if (isApart(apart)) return Relation::free;
  const int above = nextAbove(face_lo, offsets.data(), padding, 0, faces);
  if (above < faces) {
    apart = above;
    if (isApart(above)) return Relation::free;
  }
  const std::vector<ObstaclePlane>& others = body.otherPlanes(obstacle.piece);
  const double margin = body.mostMargin(obstacle.piece);
  if (body.hasFailed(obstacle.piece)) {
    return addPieces(obstacle, [&](FatObstacle each) { return addFromBox(box, each, into); });
  }
  const Eigen::Map<const Eigen::Vector3d> middle(box.center);
  const Eigen::Map<const Eigen::Vector3d> half(box.half);
  const std::size_t first = into.planes.size();
  for (std::size_t i = 0; i < others.size(); ++i) {
    const ObstaclePlane& plane = others[i];
    const double at = plane.n.dot(middle);
    const double radius = plane.n.cwiseAbs().dot(half);
    if (at - radius > plane.outer) {
      into.planes.resize(first);
      return Relation::free;
    }
    if (at + radius > plane.inner()) into.planes.push_back(faces + static_cast<int>(i));
  }
  const FatObstacles::Planes planes = body.planesOf(obstacle.piece);
  const auto next = [&](int from) {
    return nextAbove(face_hi, offsets.data(), -margin, from, faces);
  };
  for (int f = next(0); f < faces; f = next(f + 1)) {
    if (face_hi[f] > planes[f].inner()) into.planes.push_back(f);
  }
  return addEntry(obstacle, first, into);
}

// Of a polygon of which nothing is known those of its triangles; of a triangle there is nothing
// else.
template <typename Add>
ObstacleLister::Relation ObstacleLister::addPieces(FatObstacle obstacle, const Add& add) {
  if (obstacles_.pieces().isTriangle(obstacle.piece)) {
    failed_ = true;
    return Relation::cut;
  }
  Relation relation = Relation::free;
  obstacles_.pieces().visitTriangles(obstacle.piece, [&](int piece) {
    if (relation == Relation::covered) return;
    const Relation of_one = add({obstacle.member, piece});
    if (of_one != Relation::free) relation = of_one;
  });
  return relation;
}

// With the planes of the list from `first` on: those over which the cell sticks out.
ObstacleLister::Relation ObstacleLister::addEntry(FatObstacle obstacle, std::size_t first,
                                                  List& into) const {
  const bool within = into.planes.size() == first;
  if (within && !obstacles_.encloses(obstacle.member)) return Relation::covered;
  into.entries.push_back({obstacle, first, into.planes.size()});
  return Relation::cut;
}

// Obstacles of the same member that reach no farther than the one that the cell is outside of do
// not meet the cell but in the layer that was allowed for when it was cut off.
ObstacleLister::Relation ObstacleLister::refine(const CarvedCell& cell, List& into) {
  const List& from = *cell.list;
  const auto [member, piece] = cell.outside_of;
  const FatObstacles* const body = member < 0 ? nullptr : &obstacles_.of(member);
  const double reach = body ? body->extent(piece, cell.behind) : 0.0;
  ++bodies_;
  for (const List::Entry& entry : from.entries) {
    ++statistics_.pairs_tested;
    const bool may_be_behind = body && entry.obstacle.member == member;
    if (may_be_behind && body->extent(entry.obstacle.piece, cell.behind) <= reach) continue;
    const std::size_t first = into.planes.size();
    const FatObstacles::Planes planes = obstacles_.planesOf(entry.obstacle);
    bool meets = true;
    for (std::size_t i = entry.first; i < entry.last && meets; ++i) {
      const int index = from.planes[i];
      meets = addPlane(cell.body, entry.obstacle, index, planes[index], into);
    }
    if (!meets) {
      into.planes.resize(first);
      continue;
    }
    if (addEntry(entry.obstacle, first, into) == Relation::covered) return Relation::covered;
  }
  return into.entries.empty() ? Relation::free : Relation::cut;
}

// A plane of an obstacle over which the body that is looked at sticks out. False if all of it does:
// the two are apart.
bool ObstacleLister::addPlane(const CellPolytope& body, FatObstacle obstacle, int index,
                              const ObstaclePlane& plane, List& into) {
  CellPolytope::Extent extent;
  if (index < obstacles_.of(obstacle.member).faceCount()) {
    FaceExtent& known = face_extents_[obstacles_.firstFace(obstacle.member) + index];
    if (known.asked != bodies_) known = {bodies_, body.along(plane.n)};
    extent = known.extent;
  } else {
    extent = body.along(plane.n);
  }
  if (extent.lo > plane.outer) return false;
  if (extent.hi > plane.inner() - 2 * CellPolytope::kSnap) into.planes.push_back(index);
  return true;
}

bool ObstacleLister::isClear(FatObstacle obstacle, const Cell& box) const {
  const NodeBox around = obstacles_.of(obstacle.member).obstacleBoxOf(obstacle.piece);
  return isClearOf(around, box.lo.data(), box.hi.data());
}

// With a box around the body.
ObstacleLister::Relation ObstacleLister::addFromBody(const CellPolytope& body, const Cell& box,
                                                     FatObstacle obstacle, List& into) {
  FatObstacles& member = obstacles_.of(obstacle.member);
  if (isClear(obstacle, box)) return Relation::free;
  ++statistics_.pairs_tested;
  const std::size_t first = into.planes.size();
  const auto others = static_cast<int>(member.otherPlanes(obstacle.piece).size());
  if (member.hasFailed(obstacle.piece)) {
    return addPieces(obstacle,
                     [&](FatObstacle each) { return addFromBody(body, box, each, into); });
  }
  const FatObstacles::Planes planes = member.planesOf(obstacle.piece);
  bool may_meet = true;
  for (int i = member.faceCount() + others; i-- > 0 && may_meet;) {
    may_meet = addPlane(body, obstacle, i, planes[i], into);
  }
  if (may_meet) return addEntry(obstacle, first, into);
  into.planes.resize(first);
  return Relation::free;
}

}  // namespace fcl_prob::detail
