// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene/piece_slabs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/constants.h"

namespace fcl_prob::detail {

namespace {

// A triangle of the vertices as they are.
ConvexPiece trianglePiece(const WhitenedTree& tree, int triangle) {
  const Eigen::Vector3i& t = tree.tree->triangles[triangle];
  const std::array<Eigen::Vector3d, 3> v{tree.vertices[t[0]], tree.vertices[t[1]],
                                         tree.vertices[t[2]]};
  ConvexPiece piece{{{v[0], v[1], v[2]}, 0}, {}, {}};
  piece.addFace(v[1] - v[0], v[2] - v[0]);
  piece.addEdge(v[1] - v[0]);
  piece.addEdge(v[2] - v[0]);
  piece.addEdge(v[2] - v[1]);
  return piece;
}

// At its position.
ConvexPiece pieceAt(const WhitenedTree& tree, int index) {
  if (tree.tree->isTriangle(index)) return trianglePiece(tree, index);
  const int body = tree.tree->bodyOf(index);
  ConvexPiece piece = tree.shapes[tree.tree->bodies[body].shape];
  for (Eigen::Vector3d& point : piece.body.points) point += tree.positions[body];
  return piece;
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

Eigen::Vector3d largestCoordinates(const std::vector<Eigen::Vector3d>& vertices) {
  Eigen::Vector3d largest = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& v : vertices) largest = largest.cwiseMax(v.cwiseAbs());
  return largest;
}

// The factors of the normals p × q of all slabs, in the layout that the kernel reads.
class Factors {
 public:
  explicit Factors(std::size_t used)
      : count_(std::max<std::size_t>(4, (used + 3) / 4 * 4)), p_(3 * count_), q_(3 * count_) {}

  void add(const PieceEdge& p, const PieceEdge& q) {
    for (std::size_t k = 0; k < 3; ++k) {
      p_[k * count_ + turns_.size()] = p.along[static_cast<int>(k)];
      q_[k * count_ + turns_.size()] = q.along[static_cast<int>(k)];
    }
    Eigen::Vector3d turn;
    for (int k = 0; k < 3; ++k) {
      const int u = (k + 1) % 3, v = (k + 2) % 3;
      turn[k] = p.magnitude[u] * q.magnitude[v] + p.magnitude[v] * q.magnitude[u];
    }
    turns_.push_back(turn / p.along.cross(q.along).norm());
  }

  // The margins pay for the rounding of edges, too: 8 ε of their magnitudes.
  PieceSlabs planes(const SlabExtent& extent) const {
    PieceSlabs slabs;
    slabs.count = static_cast<int>(count_);
    slabs.data.assign(count_ * kSlabFields, 0.0);
    slabKernels().planes(p_.data(), q_.data(), slabs.count, extent, slabs.data.data());
    for (std::size_t i = 0; i < turns_.size(); ++i) {
      const double turned = turns_[i].dot(Eigen::Map<const Eigen::Vector3d>(extent.reach));
      const bool left_out = slabs.data[4 * count_ + i] >= kUnbounded;
      if (!left_out) slabs.data[5 * count_ + i] += 32 * kEpsilon * turned;
    }
    return slabs;
  }

 private:
  std::size_t count_;
  std::vector<double> p_;
  std::vector<double> q_;
  std::vector<Eigen::Vector3d> turns_;
};

// Of slabs with the same normal, or the opposite one, one is enough, with the largest margin: a box
// in line with another one would have each of its faces four times.
void mergeEqualNormals(PieceSlabs& slabs) {
  double* out = slabs.data.data();
  const int count = slabs.count;
  const auto normal = [&](int i) {
    return Eigen::Vector3d(out[i], out[count + i], out[2 * count + i]);
  };
  for (int i = 1; i < count; ++i) {
    const Eigen::Vector3d n = normal(i);
    if (n.isZero(0.0)) continue;
    for (int j = 0; j < i; ++j) {
      if (normal(j) != n && normal(j) != -n) continue;
      out[5 * count + j] = std::max(out[5 * count + j], out[5 * count + i]);
      for (int k = 0; k < 3; ++k) out[k * count + i] = 0.0;
      out[3 * count + i] = -kUnbounded;
      out[4 * count + i] = kUnbounded;
      out[5 * count + i] = 0.0;
      break;
    }
  }
}

SlabExtent extentOf(const ConvexPiece& a, const ConvexPiece& b, const Eigen::Vector3d& error) {
  Eigen::Vector3d width = Eigen::Vector3d::Zero();
  for (const ConvexPiece* piece : {&a, &b}) {
    for (const PieceEdge& edge : piece->edges) width = width.cwiseMax(edge.along.cwiseAbs());
  }
  const Eigen::Vector3d size =
      largestCoordinates(a.body.points) + largestCoordinates(b.body.points);
  SlabExtent extent;
  for (int k = 0; k < 3; ++k) {
    extent.width[k] = width[k];
    extent.reach[k] = 3 * size[k] + kReach;
    extent.error[k] = error[k];
  }
  return extent;
}

}  // namespace

PieceSlabs pieceSlabs(const WhitenedPair& pair, NodePair leaves) {
  const ConvexPiece first = pieceAt(pair.a, pair.a.tree->nodes[leaves.a].piece);
  const ConvexPiece second = pieceAt(pair.b, pair.b.tree->nodes[leaves.b].piece);
  Factors factors(first.faces.size() + second.faces.size() +
                  first.edges.size() * second.edges.size());
  for (const auto& [p, q] : first.faces) factors.add(p, q);
  for (const auto& [p, q] : second.faces) factors.add(p, q);
  for (const PieceEdge& p : first.edges) {
    for (const PieceEdge& q : second.edges) factors.add(p, q);
  }
  PieceSlabs slabs = factors.planes(extentOf(first, second, slabError(pair, leaves)));
  mergeEqualNormals(slabs);
  double* out = slabs.data.data();
  for (int i = 0; i < slabs.count; ++i) {
    const Eigen::Vector3d n(out[i], out[slabs.count + i], out[2 * slabs.count + i]);
    const Extent of_a = extentAlong(first.body.points, n);
    const Extent of_b = extentAlong(second.body.points, n);
    out[3 * slabs.count + i] += of_b.lo - of_a.hi;
    out[4 * slabs.count + i] += of_b.hi - of_a.lo;
  }
  return slabs;
}

}  // namespace fcl_prob::detail
