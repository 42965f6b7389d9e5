// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cells/crossing_witness.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "cells/claim_observer.h"
#include "geometry/clipped_triangle.h"
#include "scene/band_margin.h"

namespace fcl_prob::detail {

namespace {

// The constants below only steer; no bound depends on them. Measured on bunnies of 5,110 and of
// 69,451 triangles.

// With fewer triangles an object's own pairs cover what there is to cover.
constexpr std::size_t kFewestTriangles = 500;

// Vertices of each mesh that are tried for a whole cell.
constexpr std::size_t kCandidates = 64;

// Vertices of each mesh near the front that are tried for a plane.
constexpr std::size_t kTriedForPlane = 4;

// A cell in which a swept vertex touches more triangles than this is left to be divided.
constexpr std::size_t kMostTouched = 400;

// A cell is large beside triangles if it is this many times larger than they are on the average: 1
// and 4 take the same time on statues, 16 opens more pairs beside bodies of a hundredth of the
// size.
constexpr double kLargeBesideTriangles = 4.0;

// The least share of a cell's extent that a layer is worth having for.
constexpr double kLeastShareOfLayer = 0.01;

// Directions tried for a layer: the second one is across what the best vertex of the first touches.
constexpr int kRounds = 2;

int leftmostVertex(const PieceTree& tree, int node) {
  while (!tree.nodes[node].isLeaf()) node = tree.nodes[node].left;
  return tree.triangles[tree.nodes[node].piece][0];
}

Eigen::Vector3d meanSizeOfTriangles(const WhitenedTree& mesh) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int count = 0;
  for (std::size_t i = 0; i < mesh.tree->nodes.size(); ++i) {
    if (!mesh.tree->nodes[i].isLeaf()) continue;
    const NodeBox box = mesh.boxOf(static_cast<int>(i));
    for (int k = 0; k < 3; ++k) sum[k] += box.hi[k] - box.lo[k];
    ++count;
  }
  return sum / std::max(count, 1);
}

// One vertex of each of about `count` nodes that share out the mesh.
std::vector<int> spreadVertices(const PieceTree& tree, std::size_t count) {
  std::vector<int> level{0};
  std::vector<int> next;
  while (level.size() < count) {
    next.clear();
    for (int index : level) {
      const PieceTree::Node& node = tree.nodes[index];
      if (node.isLeaf()) continue;
      next.push_back(node.left);
      next.push_back(node.right);
    }
    if (next.empty()) break;
    level.swap(next);
  }
  std::vector<int> vertices;
  for (int node : level) vertices.push_back(leftmostVertex(tree, node));
  return vertices;
}

// The vertex of a node that lies about farthest along m.
int extremeVertex(const WhitenedTree& mesh, int node, const Eigen::Vector3d& m) {
  while (!mesh.tree->nodes[node].isLeaf()) {
    const PieceTree::Node& inner = mesh.tree->nodes[node];
    const bool left =
        mesh.boxOf(inner.left).highestAlong(m) > mesh.boxOf(inner.right).highestAlong(m);
    node = left ? inner.left : inner.right;
  }
  const Eigen::Vector3i& t = mesh.tree->triangles[mesh.tree->nodes[node].piece];
  int best = t[0];
  for (int corner = 1; corner < 3; ++corner) {
    if (m.dot(mesh.vertices[t[corner]]) > m.dot(mesh.vertices[best])) best = t[corner];
  }
  return best;
}

// A few of the inner nodes of pairs, spread over them; those of A if `sign` is that of A.
std::vector<int> someOf(const std::vector<FrontPair>& pairs, double sign) {
  std::vector<int> nodes;
  const std::size_t step = std::max<std::size_t>(pairs.size() / kTriedForPlane, 1);
  for (std::size_t i = step / 2; i < pairs.size(); i += step) {
    nodes.push_back(sign > 0 ? pairs[i].nodes.a : pairs[i].nodes.b);
  }
  return nodes;
}

// Of all vertices of a component the first to leave the other mesh. Where there is one component
// the boxes of nodes lead to them.
std::vector<std::array<int, 6>> extremesOfComponents(const WhitenedTree& mesh) {
  const SurfaceComponents& components = mesh.tree->caps->components;
  std::vector<std::array<int, 6>> extremes(components.count);
  if (components.count == 1) {
    for (int i = 0; i < 6; ++i) {
      const Eigen::Vector3d axis = Eigen::Vector3d::Unit(i / 2);
      extremes[0][i] = extremeVertex(mesh, 0, i % 2 == 0 ? Eigen::Vector3d(-axis) : axis);
    }
    return extremes;
  }
  for (auto& six : extremes) six.fill(-1);
  for (int v = 0; v < static_cast<int>(components.of_vertex.size()); ++v) {
    const int component = components.of_vertex[v];
    if (component < 0) continue;
    for (int k = 0; k < 3; ++k) {
      int& lowest = extremes[component][2 * k];
      int& highest = extremes[component][2 * k + 1];
      if (lowest < 0 || mesh.vertices[v][k] < mesh.vertices[lowest][k]) lowest = v;
      if (highest < 0 || mesh.vertices[v][k] > mesh.vertices[highest][k]) highest = v;
    }
  }
  return extremes;
}

// Every clip rounds a corner by less than 8 epsilon of coordinates like these, axis by axis: its
// distances from a side are differences of two doubles. In a box that is larger by the sum nothing
// is lost.
Eigen::Vector3d clipRounding(const NodeBox& mesh, const Eigen::Vector3d& p) {
  Eigen::Vector3d rounding;
  for (int k = 0; k < 3; ++k) {
    const double largest = std::max(std::fabs(mesh.lo[k]), std::fabs(mesh.hi[k]));
    rounding[k] = 64 * kEpsilon * (largest + std::fabs(p[k]) + kReach);
  }
  return rounding;
}

}  // namespace

CrossingWitness::CrossingWitness(const WhitenedPair& pair, bool solid)
    : solid_(solid),
      moves_(pair.band || !pair.a.node_motions.empty() || !pair.b.node_motions.empty()),
      band_(pair.band) {
  for (const WhitenedTree* one : {&pair.a, &pair.b}) {
    if (!one->tree->caps || one->tree->triangles.size() < kFewestTriangles) return;
  }
  const auto add = [this](const WhitenedTree& inner, const WhitenedTree& outer, double sign) {
    // Certificates know what is inside one surface only.
    if (outer.tree->parts.size() > 1 && claim_observer && claim_observer->needsAll()) return;
    std::vector<Candidate> candidates;
    for (int vertex : spreadVertices(*inner.tree, kCandidates)) candidates.push_back({vertex, {}});
    sides_.push_back({CappedTree(inner), CappedTree(outer), sign, std::move(candidates),
                      extremesOfComponents(inner)});
  };
  add(pair.a, pair.b, 1.0);
  add(pair.b, pair.a, -1.0);
  triangle_size_ = meanSizeOfTriangles(pair.a).cwiseMin(meanSizeOfTriangles(pair.b));
}

bool CrossingWitness::isBesideSmallTriangles(const Cell& cell) const {
  for (int k = 0; k < cell.rank; ++k) {
    if (cell.hi[k] - cell.lo[k] > kLargeBesideTriangles * triangle_size_[k]) return true;
  }
  return false;
}

CrossingWitness::Hint CrossingWitness::hint() const {
  Hint hint{-1, -1};
  for (std::size_t i = 0; i < sides_.size(); ++i) hint[i] = sides_[i].last_found;
  return hint;
}

void CrossingWitness::setHint(const Hint& hint) {
  for (std::size_t i = 0; i < sides_.size(); ++i) sides_[i].last_found = hint[i];
}

bool CrossingWitness::SweptVertex::isWithin(const SweptVertex& other) const {
  for (int k = 0; k < 3; ++k) {
    if (lo[k] < other.lo[k] || hi[k] > other.hi[k]) return false;
  }
  return true;
}

// Padded for the rounding of the sums and of the vertex.
CrossingWitness::SweptVertex CrossingWitness::sweep(const Side& side, int vertex,
                                                    const Cell& cell) {
  SweptVertex swept;
  const Eigen::Vector3d& p = side.inner.mesh().vertices[vertex];
  const Eigen::Vector3d moved = side.inner.mesh().error + side.inner.mesh().motionOf(vertex);
  for (int k = 0; k < 3; ++k) {
    const double lo = side.sign > 0 ? cell.lo[k] : -cell.hi[k];
    const double hi = side.sign > 0 ? cell.hi[k] : -cell.lo[k];
    const double pad = moved[k] + 4 * kEpsilon * (std::fabs(p[k]) + kReach);
    swept.lo[k] = p[k] + lo - pad;
    swept.hi[k] = p[k] + hi + pad;
  }
  return swept;
}

bool CrossingWitness::covers(const Cell& cell) {
  for (Side& side : sides_) {
    Candidate last{side.last_found, {}};
    if (last.vertex >= 0 && coversBy(side, last, cell)) return true;
  }
  for (Side& side : sides_) {
    for (Candidate& candidate : side.candidates) {
      if (candidate.vertex != side.last_found && coversBy(side, candidate, cell)) return true;
    }
  }
  return false;
}

bool CrossingWitness::coversBy(Side& side, Candidate& candidate, const Cell& cell) {
  const SweptVertex swept = sweep(side, candidate.vertex, cell);
  const NodeBox& bounds = side.outer.mesh().boxOf(0);
  for (int k = 0; k < 3; ++k) {
    if (swept.lo[k] < bounds.lo[k] || swept.hi[k] > bounds.hi[k]) return false;
  }
  if (candidate.outside && swept.isWithin(*candidate.outside)) return false;
  if (!side.outer.isFree(swept.lo, swept.hi)) return false;
  const std::optional<bool> inside = isInside(side, swept);
  if (inside == false) candidate.outside = swept;
  if (inside != true || !crosses(side, candidate.vertex, cell)) return false;
  side.last_found = candidate.vertex;
  return true;
}

// The same for all of the swept vertex's box, which is free of triangles: any point of it will do.
std::optional<bool> CrossingWitness::isInside(Side& side, const SweptVertex& swept) {
  for (int trial = 0; trial < kTrials; ++trial) {
    Eigen::Vector3d point;
    for (int k = 0; k < 3; ++k) {
      const double share = 0.5 + 0.0206 * trial * (k + 1);
      point[k] = swept.lo[k] + share * (swept.hi[k] - swept.lo[k]);
    }
    if (const auto inside = side.outer.isInside(point, trial % 3)) return inside;
  }
  return std::nullopt;
}

// Whether a vertex inside means contact, for all displacements of the cell: of surfaces that
// another one of the same component is outside.
bool CrossingWitness::crosses(Side& side, int vertex, const Cell& cell) {
  proof_ = {side.sign > 0, vertex, -1};
  if (solid_) return true;
  proof_.outside = staysOutside(side, side.inner.componentOf(vertex), cell);
  return proof_.outside >= 0 && avoidsCaps(side, cell);
}

// A vertex of the component that is outside for all displacements of the cell, at which it touches
// nothing; -1 if none is found.
int CrossingWitness::staysOutside(Side& side, int component, const Cell& cell) {
  const auto& six = side.extremes[component];
  const auto found = std::find_if(six.begin(), six.end(), [&](int vertex) {
    const SweptVertex swept = sweep(side, vertex, cell);
    return side.outer.isFree(swept.lo, swept.hi) && isInside(side, swept) == false;
  });
  return found == six.end() ? -1 : *found;
}

// No triangle of the inner mesh meets a cap of the outer one for any displacement of the cell.
bool CrossingWitness::avoidsCaps(Side& side, const Cell& cell) {
  for (const NodeBox& cap : side.outer.capBoxes()) {
    double lo[3];
    double hi[3];
    for (int k = 0; k < 3; ++k) {
      const double pad = 4 * kEpsilon * (std::fabs(cap.lo[k]) + std::fabs(cap.hi[k]) + kReach);
      lo[k] = cap.lo[k] - (side.sign > 0 ? cell.hi[k] : -cell.lo[k]) - pad;
      hi[k] = cap.hi[k] - (side.sign > 0 ? cell.lo[k] : -cell.hi[k]) + pad;
    }
    if (!side.inner.isFreeOfMesh(lo, hi)) return false;
  }
  return true;
}

std::optional<CrossingLayer> CrossingWitness::layer(const Cell& cell,
                                                    const std::vector<FrontPair>& near) {
  best_.reset();
  for (Side& side : sides_) trySide(side, cell, near);
  if (!best_) return std::nullopt;
  best_->side->last_found = best_->layer.proof.inside;
  return best_->layer;
}

// Across what a vertex touches; then once more, across what the best one does.
void CrossingWitness::trySide(Side& side, const Cell& cell, const std::vector<FrontPair>& near) {
  Eigen::Vector3d m = inwardsNear(side, cell, near);
  for (int round = 0; round < kRounds && !m.isZero(0.0); ++round) {
    tryAlong(side, cell, near, m);
    if (!best_ || best_->side != &side) return;
    if (!findTouched(side, sweep(side, best_->layer.proof.inside, cell))) return;
    m = acrossTouched(side);
  }
}

// Across what one of a few vertices touches; 0 if none touches anything.
Eigen::Vector3d CrossingWitness::inwardsNear(Side& side, const Cell& cell,
                                             const std::vector<FrontPair>& near) {
  if (side.last_found >= 0 && findTouched(side, sweep(side, side.last_found, cell))) {
    return acrossTouched(side);
  }
  for (const int node : someOf(near, side.sign)) {
    const int vertex = leftmostVertex(*side.inner.mesh().tree, node);
    if (findTouched(side, sweep(side, vertex, cell))) return acrossTouched(side);
  }
  return Eigen::Vector3d::Zero();
}

// Vertices about farthest along m: of all, and of some of the nodes.
std::vector<int> CrossingWitness::farthestAlong(const Side& side,
                                                const std::vector<FrontPair>& near,
                                                const Eigen::Vector3d& m) const {
  const WhitenedTree& mesh = side.inner.mesh();
  std::vector<int> found{extremeVertex(mesh, 0, side.sign * m)};
  for (const int node : someOf(near, side.sign)) {
    const int vertex = extremeVertex(mesh, node, side.sign * m);
    if (std::find(found.begin(), found.end(), vertex) == found.end()) found.push_back(vertex);
  }
  return found;
}

// Between the first level above which a vertex is inside, and the last one below which another one
// of its component is outside.
void CrossingWitness::tryAlong(Side& side, const Cell& cell, const std::vector<FrontPair>& near,
                               Eigen::Vector3d m) {
  for (int k = cell.rank; k < 3; ++k) m[k] = 0.0;
  const double length = m.norm();
  if (!(length > 0.0)) return;
  m /= length;
  const double least = m.dot(cell.lowestCorner(m));
  const double most = m.dot(cell.lowestCorner(-m));
  double known_from = most;
  for (const int vertex : farthestAlong(side, near, m)) {
    const double from = sideFrom(side, vertex, cell, m, true, known_from);
    if (!(from < known_from)) continue;
    known_from = from;
    CrossingProof proof{side.sign > 0, vertex, -1};
    if (!solid_ && !avoidsCaps(side, cell)) return;
    const double to = solid_ ? kInfinity : outsideTo(side, proof, cell, m, from);
    const double share = (std::min(to, most) - from) / (most - least);
    if (!(share > (best_ ? best_->share : kLeastShareOfLayer))) continue;
    // A plane that only touches the cell is none.
    const double below = from > least ? from : -kInfinity, above = to < most ? to : kInfinity;
    best_ = Attempt{&side, {m, below, above, proof}, share};
  }
}

// The least m·y above which the vertex touches nothing within the cell and is on that side of the
// outer mesh; infinite if that is above `most`.
double CrossingWitness::sideFrom(Side& side, int vertex, const Cell& cell, const Eigen::Vector3d& m,
                                 bool inside, double most) {
  const SweptVertex swept = sweep(side, vertex, cell);
  const NodeBox& bounds = side.outer.mesh().boxOf(0);
  double from = m.dot(cell.lowestCorner(m));
  if (isClearOf(bounds, swept.lo, swept.hi)) return inside ? kInfinity : from;
  if (findTouched(side, swept)) {
    from = std::max(from, highestTouched(side, vertex, swept, touched_, m, most));
  } else if (!touched_.empty()) {
    return kInfinity;
  }
  if (!(from < most) || !isBeyond(side, vertex, {m, from}, inside, cell)) return kInfinity;
  return from;
}

// The highest m·y below which some vertex of the component touches nothing and is outside; -inf if
// that is not above `from`.
double CrossingWitness::outsideTo(Side& side, CrossingProof& proof, const Cell& cell,
                                  const Eigen::Vector3d& m, double from) {
  const int component = side.inner.componentOf(proof.inside);
  std::vector<int> vertices(side.extremes[component].begin(), side.extremes[component].end());
  const int farthest = extremeVertex(side.inner.mesh(), 0, -side.sign * m);
  if (side.inner.componentOf(farthest) == component) vertices.insert(vertices.begin(), farthest);
  const double most = m.dot(cell.lowestCorner(-m));
  double to = -kInfinity;
  for (const int vertex : vertices) {
    const double outside = -sideFrom(side, vertex, cell, -m, false, -std::max(from, to));
    if (outside > to) {
      to = outside;
      proof.outside = vertex;
    }
    if (to >= most) break;
  }
  return to;
}

// Whether the swept vertex touches some triangles, and not too many.
bool CrossingWitness::findTouched(Side& side, const SweptVertex& swept) {
  touched_.clear();
  if (isClearOf(side.outer.mesh().boxOf(0), swept.lo, swept.hi)) return false;
  const auto collect = [this](const Eigen::Vector3i& triangle) {
    touched_.push_back(triangle);
    return touched_.size() < kMostTouched;
  };
  return side.outer.visitTriangles(swept.lo, swept.hi, collect) && !touched_.empty();
}

// The inner mesh moves into the outer one against its outward normals.
Eigen::Vector3d CrossingWitness::acrossTouched(const Side& side) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const auto& vertices = side.outer.mesh().vertices;
  for (const Eigen::Vector3i& t : touched_) {
    sum += (vertices[t[1]] - vertices[t[0]]).cross(vertices[t[2]] - vertices[t[0]]);
  }
  return -side.sign * sum;
}

// Upper bound of m·y over the displacements y at which the vertex touches one of the triangles, of
// which only what it sweeps matters; infinite if that is above `most`, -inf if it touches none.
double CrossingWitness::highestTouched(const Side& side, int vertex, const SweptVertex& swept,
                                       const std::vector<Eigen::Vector3i>& touched,
                                       const Eigen::Vector3d& m, double most) const {
  const WhitenedTree& outer = side.outer.mesh();
  const Eigen::Vector3d& p = side.inner.mesh().vertices[vertex];
  const Eigen::Vector3d upwards = side.sign * m;
  const Eigen::Vector3d rounding = clipRounding(outer.boxOf(0), p);
  double highest = -kInfinity;
  for (const Eigen::Vector3i& t : touched) {
    std::array<Eigen::Vector3d, 3> triangle;
    double of_corners = -kInfinity;
    Eigen::Vector3d motion = Eigen::Vector3d::Zero();
    for (int corner = 0; corner < 3; ++corner) {
      triangle[corner] = outer.vertices[t[corner]];
      of_corners = std::max(of_corners, upwards.dot(triangle[corner] - p));
      motion = motion.cwiseMax(outer.motionOf(t[corner]));
    }
    // A band counts once, at the end.
    const double moved = band_ ? 0.0 : m.cwiseAbs().dot(motion);
    if (of_corners + moved <= highest) continue;
    const Eigen::Vector3d pad = outer.error + motion + rounding;
    const Eigen::Vector3d lo = Eigen::Map<const Eigen::Vector3d>(swept.lo) - pad;
    const Eigen::Vector3d hi = Eigen::Map<const Eigen::Vector3d>(swept.hi) + pad;
    const double within = highestWithin(triangle, lo, hi, upwards) - upwards.dot(p);
    highest = std::max(highest, std::min(of_corners, within) + moved);
    if (highest > most) return kInfinity;
  }
  return highest + 4 * (side.inner.mesh().errorAlong(m) + outer.errorAlong(m)) +
         (band_ ? band_->inwardAlong(m) : m.cwiseAbs().dot(side.inner.mesh().motionOf(vertex))) +
         m.cwiseAbs().dot(rounding) + 64 * kEpsilon * (kReach + m.cwiseAbs().dot(p.cwiseAbs()));
}

// Whether the vertex is on that side of the outer mesh wherever in the cell it is beyond the plane,
// where it touches nothing: that part is convex, so that one point of it tells of all. Points near
// the corner that lies farthest along m are tried.
bool CrossingWitness::isBeyond(Side& side, int vertex, const CellPlane& plane, bool inside,
                               const Cell& cell) {
  const Eigen::Vector3d corner = cell.lowestCorner(-plane.m);
  const Eigen::Vector3d middle = 0.5 * (cell.lo + cell.hi);
  const double room = (plane.m.dot(corner) - plane.s) / plane.m.dot(corner - middle);
  for (int trial = 0; trial < kTrials; ++trial) {
    const double share = std::min(1.0, (0.02 + 0.05 * trial) * room);
    const Eigen::Vector3d y = corner + share * (middle - corner);
    if (!(plane.m.dot(y) > plane.s)) continue;
    const Eigen::Vector3d point = side.inner.mesh().vertices[vertex] + side.sign * y;
    if (const auto found = side.outer.isInside(point, trial % 3)) return *found == inside;
  }
  return false;
}

}  // namespace fcl_prob::detail
