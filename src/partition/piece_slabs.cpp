// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "partition/piece_slabs.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fcl_prob::detail {

namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kUnbounded = 1e300;
// As for triangles: edges closer to parallel than this are treated as parallel.
constexpr double kParallelSine = 3e-8;

struct WhitenedPiece {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> faces;
  std::vector<Eigen::Vector3d> edges;
};

WhitenedPiece whitenedTriangle(const WhitenedTree& tree, int triangle) {
  const Eigen::Vector3i& t = tree.tree->triangles[triangle];
  const Eigen::Vector3d& v0 = tree.vertices[t[0]];
  const Eigen::Vector3d& v1 = tree.vertices[t[1]];
  const Eigen::Vector3d& v2 = tree.vertices[t[2]];
  return {{v0, v1, v2}, {{v1 - v0, v2 - v0}}, {v1 - v0, v2 - v0, v2 - v1}};
}

WhitenedPiece whitenedPiece(const WhitenedTree& tree, int index) {
  if (tree.tree->isTriangle(index)) return whitenedTriangle(tree, index);
  const int body = tree.tree->bodyOf(index);
  const PieceShape& shape = tree.shapes[tree.tree->bodies[body].shape].shape;
  WhitenedPiece result{shape.body.points, shape.faces, shape.edges};
  for (Eigen::Vector3d& point : result.vertices) point += tree.positions[body];
  return result;
}

struct Extent {
  double lo;
  double hi;
};

Extent extentAlong(const std::vector<Eigen::Vector3d>& vertices, const Eigen::Vector3d& n) {
  Extent extent{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Eigen::Vector3d& v : vertices) {
    const double along = n.dot(v);
    extent.lo = std::min(extent.lo, along);
    extent.hi = std::max(extent.hi, along);
  }
  return extent;
}

double largestCoordinate(const std::vector<Eigen::Vector3d>& vertices) {
  double largest = 0.0;
  for (const Eigen::Vector3d& v : vertices) largest = std::max(largest, v.cwiseAbs().maxCoeff());
  return largest;
}

// Collects normals p × q; the parallel ones are only counted, by the angle they might be off.
class NormalCollector {
 public:
  void add(const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
    const Eigen::Vector3d n = p.cross(q);
    const double sine = n.norm() / std::max(p.norm() * q.norm(), 1e-300);
    if (sine >= kParallelSine) {
      normals.push_back(n.normalized());
      sines.push_back(sine);
    } else {
      dropped_angle += sine == sine ? sine + 4 * kEpsilon : kParallelSine;
    }
  }

  std::vector<Eigen::Vector3d> normals;
  std::vector<double> sines;
  double dropped_angle = 0.0;
};

}  // namespace

PieceSlabs pieceSlabs(const WhitenedTree& a, int piece_a, const WhitenedTree& b, int piece_b) {
  const WhitenedPiece first = whitenedPiece(a, piece_a);
  const WhitenedPiece second = whitenedPiece(b, piece_b);
  NormalCollector collector;
  for (const auto& [p, q] : first.faces) collector.add(p, q);
  for (const auto& [p, q] : second.faces) collector.add(p, q);
  for (const Eigen::Vector3d& p : first.edges) {
    for (const Eigen::Vector3d& q : second.edges) collector.add(p, q);
  }
  const double reach =
      6 * (largestCoordinate(first.vertices) + largestCoordinate(second.vertices)) + 1.8 * kReach;
  const double pad = 4 * (a.error + b.error) + 32 * kEpsilon * reach;

  PieceSlabs slabs;
  const int used = static_cast<int>(collector.normals.size());
  slabs.count = std::max(4, (used + 3) / 4 * 4);
  slabs.data.assign(static_cast<std::size_t>(slabs.count) * kSlabFields, 0.0);
  double* out = slabs.data.data();
  for (int i = 0; i < slabs.count; ++i) {
    out[3 * slabs.count + i] = -kUnbounded;
    out[4 * slabs.count + i] = kUnbounded;
    if (i >= used) continue;
    const Eigen::Vector3d& n = collector.normals[i];
    for (int k = 0; k < 3; ++k) out[k * slabs.count + i] = n[k];
    const Extent of_a = extentAlong(first.vertices, n);
    const Extent of_b = extentAlong(second.vertices, n);
    out[3 * slabs.count + i] = of_b.lo - of_a.hi - pad;
    out[4 * slabs.count + i] = of_b.hi - of_a.lo + pad;
    out[5 * slabs.count + i] =
        2 * pad + 2 * reach * (8 * kEpsilon + 4 * collector.dropped_angle) / collector.sines[i];
  }
  // All edges parallel: V has no inside, which a margin without end says.
  if (used == 0) out[5 * slabs.count] = 4 * kUnbounded;
  return slabs;
}

}  // namespace fcl_prob::detail
