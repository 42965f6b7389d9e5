// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cells/crossing_witness.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "scene/band_margin.h"

namespace fcl_prob::detail {

namespace {

// The constants below only steer; no bound depends on them. Measured on bunnies of 5,110 and of
// 69,451 triangles.

// Vertices of each mesh that are tried for a whole cell.
constexpr std::size_t kCandidates = 64;

// Vertices of each mesh near the front that are tried for a plane.
constexpr std::size_t kTriedForPlane = 4;

// A cell in which a swept vertex touches more triangles than this is left to be divided.
constexpr std::size_t kMostTouched = 400;

// Depth of the least plane worth having.
constexpr double kLeastPlaneDepth = 0.98;

int leftmostVertex(const PieceTree& tree, int node) {
  while (!tree.nodes[node].isLeaf()) node = tree.nodes[node].left;
  return tree.triangles[tree.nodes[node].piece][0];
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

// What is left of a triangle within a box: every side adds one corner at most.
struct ClippedTriangle {
  std::array<Eigen::Vector3d, 9> corners;
  int count;

  // Keeps {sign x[axis] <= level}.
  void clip(int axis, double sign, double level);
};

void ClippedTriangle::clip(int axis, double sign, double level) {
  std::array<double, 9> beyond;
  int outside = 0;
  for (int i = 0; i < count; ++i) {
    beyond[i] = sign * corners[i][axis] - level;
    if (beyond[i] > 0) ++outside;
  }
  if (outside == 0) return;
  const ClippedTriangle whole = *this;
  count = 0;
  if (outside == whole.count) return;
  for (int i = 0; i < whole.count; ++i) {
    const int next = i + 1 < whole.count ? i + 1 : 0;
    if (beyond[i] <= 0) corners[count++] = whole.corners[i];
    if ((beyond[i] <= 0) == (beyond[next] <= 0)) continue;
    const double share = beyond[i] / (beyond[i] - beyond[next]);
    corners[count++] = whole.corners[i] + share * (whole.corners[next] - whole.corners[i]);
  }
}

// The largest m·x over the part of a triangle within a box; -inf if there is none.
double highestWithin(const std::array<Eigen::Vector3d, 3>& triangle, const Eigen::Vector3d& lo,
                     const Eigen::Vector3d& hi, const Eigen::Vector3d& m) {
  ClippedTriangle rest;
  std::copy(triangle.begin(), triangle.end(), rest.corners.begin());
  rest.count = 3;
  for (int k = 0; k < 3 && rest.count > 0; ++k) {
    rest.clip(k, 1.0, hi[k]);
    rest.clip(k, -1.0, -lo[k]);
  }
  double highest = -kInfinity;
  for (int i = 0; i < rest.count; ++i) highest = std::max(highest, m.dot(rest.corners[i]));
  return highest;
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
  if (!pair.a.tree->caps || !pair.b.tree->caps) return;
  const auto add = [this](const WhitenedTree& inner, const WhitenedTree& outer, double sign) {
    std::vector<Candidate> candidates;
    for (int vertex : spreadVertices(*inner.tree, kCandidates)) candidates.push_back({vertex, {}});
    sides_.push_back({CappedTree(inner), CappedTree(outer), sign, std::move(candidates),
                      extremesOfComponents(inner)});
  };
  add(pair.a, pair.b, 1.0);
  add(pair.b, pair.a, -1.0);
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
  const auto no = [](const Eigen::Vector3i&) { return false; };
  if (!side.outer.visitTriangles(swept.lo, swept.hi, no)) return false;
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

// Whether a vertex inside means contact, for all displacements of the cell.
bool CrossingWitness::crosses(Side& side, int vertex, const Cell& cell) {
  if (solid_) return true;
  return leaves(side, side.inner.mesh().tree->caps->components.of_vertex[vertex], cell) &&
         avoidsCaps(side, cell);
}

// Some vertex of the component is beyond the outer mesh's bounds for every displacement of the
// cell.
bool CrossingWitness::leaves(const Side& side, int component, const Cell& cell) const {
  const NodeBox& bounds = side.outer.mesh().boxOf(0);
  for (int i = 0; i < 6; ++i) {
    const SweptVertex swept = sweep(side, side.extremes[component][i], cell);
    if (i % 2 == 0 ? swept.hi[i / 2] < bounds.lo[i / 2] : swept.lo[i / 2] > bounds.hi[i / 2]) {
      return true;
    }
  }
  return false;
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

std::optional<CellPlane> CrossingWitness::plane(const Cell& cell,
                                                const std::vector<FrontPair>& near) {
  best_.reset();
  tried_across_.clear();
  for (Side& side : sides_) {
    if (side.last_found >= 0) tryVertex(side, side.last_found, cell, nullptr);
  }
  tryNear(cell, near, nullptr);
  if (!best_) return std::nullopt;
  for (int round = 0; round < 2; ++round) {
    const Eigen::Vector3d m = best_->plane.m;
    tryNear(cell, near, &m);
    if (best_->plane.m == m) break;
  }
  best_->side->last_found = best_->vertex;
  return best_->plane;
}

// Tries vertices of some of the nodes: any, or with a direction m those farthest along it.
void CrossingWitness::tryNear(const Cell& cell, const std::vector<FrontPair>& near,
                              const Eigen::Vector3d* m) {
  tried_along_.clear();
  const std::size_t step = std::max<std::size_t>(near.size() / kTriedForPlane, 1);
  for (Side& side : sides_) {
    for (std::size_t i = step / 2; i < near.size(); i += step) {
      const int node = side.sign > 0 ? near[i].nodes.a : near[i].nodes.b;
      if (!m) {
        tryVertex(side, leftmostVertex(*side.inner.mesh().tree, node), cell, nullptr);
      } else {
        tryVertex(side, extremeVertex(side.inner.mesh(), node, side.sign * *m), cell, m);
      }
    }
  }
}

// With normal m, if given, and with one across what is touched; either once.
void CrossingWitness::tryVertex(Side& side, int vertex, const Cell& cell,
                                const Eigen::Vector3d* m) {
  const auto isNew = [&](Tried& tried) {
    const Tried::value_type one(&side, vertex);
    if (std::find(tried.begin(), tried.end(), one) != tried.end()) return false;
    tried.push_back(one);
    return true;
  };
  const bool along = m && isNew(tried_along_);
  const bool across = isNew(tried_across_);
  if (!along && !across) return;
  const SweptVertex swept = sweep(side, vertex, cell);
  if (!findTouched(side, swept)) return;
  if (along) tryPlane(side, vertex, swept, cell, *m);
  if (across) tryPlane(side, vertex, swept, cell, acrossTouched(side));
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

// Beyond the highest point along m of all that the swept vertex touches nothing is touched.
void CrossingWitness::tryPlane(Side& side, int vertex, const SweptVertex& swept, const Cell& cell,
                               Eigen::Vector3d m) {
  for (int k = cell.rank; k < 3; ++k) m[k] = 0.0;
  const double length = m.norm();
  if (!(length > 0.0)) return;
  m /= length;
  const double least = m.dot(cell.lowestCorner(m));
  const double most = m.dot(cell.lowestCorner(-m));
  const double least_depth = best_ ? best_->depth : kLeastPlaneDepth;
  const double useful = least + 0.5 * (least_depth + 1) * (most - least);
  const double s = std::max(least, highestTouched(side, vertex, swept, touched_, m, useful));
  const double depth = 2 * (s - least) / (most - least) - 1;
  if (!(depth < least_depth)) return;
  const Attempt attempt{&side, vertex, {m, s}, depth};
  if (!certify(side, vertex, {{attempt.plane}, 1}, m, depth, cell)) return;
  best_ = attempt;
}

Eigen::Vector3d CrossingWitness::acrossTouched(const Side& side) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3i& t : touched_) sum += across(side, t);
  return sum;
}

// The inner mesh moves into the outer one against its outward normals.
Eigen::Vector3d CrossingWitness::across(const Side& side, const Eigen::Vector3i& t) {
  const auto& vertices = side.outer.mesh().vertices;
  return -side.sign * (vertices[t[1]] - vertices[t[0]]).cross(vertices[t[2]] - vertices[t[0]]);
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

Eigen::Vector3d CrossingWitness::pointBeyond(const Cell& cell, const Eigen::Vector3d& m,
                                             double depth, int trial) {
  const Eigen::Vector3d corner = cell.lowestCorner(-m);
  const Eigen::Vector3d middle = 0.5 * (cell.lo + cell.hi);
  const double share = 0.02 + 0.05 * trial;
  return corner + share * (1 - depth) * (middle - corner);
}

bool CrossingWitness::isWithin(const CoveredPart& part, const Eigen::Vector3d& y) {
  for (int i = 0; i < part.count; ++i) {
    if (!(part.planes[i].m.dot(y) > part.planes[i].s)) return false;
  }
  return true;
}

// The part is convex and free of the outer mesh, so that one point of it tells of all.
bool CrossingWitness::certify(Side& side, int vertex, const CoveredPart& part,
                              const Eigen::Vector3d& m, double depth, const Cell& cell) {
  for (int trial = 0; trial < kTrials; ++trial) {
    const Eigen::Vector3d y = pointBeyond(cell, m, depth, trial);
    if (!isWithin(part, y)) continue;
    const Eigen::Vector3d point = side.inner.mesh().vertices[vertex] + side.sign * y;
    if (const auto inside = side.outer.isInside(point, trial % 3)) {
      return *inside && crosses(side, vertex, cell);
    }
  }
  return false;
}

}  // namespace fcl_prob::detail
