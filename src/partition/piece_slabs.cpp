// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "partition/piece_slabs.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fcl_prob::detail {

namespace {

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

  void add(const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
    for (std::size_t k = 0; k < 3; ++k) {
      p_[k * count_ + used_] = p[static_cast<int>(k)];
      q_[k * count_ + used_] = q[static_cast<int>(k)];
    }
    ++used_;
  }

  PieceSlabs planes(const SlabExtent& extent) const {
    PieceSlabs slabs;
    slabs.count = static_cast<int>(count_);
    slabs.data.assign(count_ * kSlabFields, 0.0);
    slabKernels().planes(p_.data(), q_.data(), slabs.count, extent, slabs.data.data());
    return slabs;
  }

 private:
  std::size_t count_;
  std::size_t used_ = 0;
  std::vector<double> p_;
  std::vector<double> q_;
};

SlabExtent extentOf(const WhitenedPiece& a, const WhitenedPiece& b, const Eigen::Vector3d& error) {
  Eigen::Vector3d width = Eigen::Vector3d::Zero();
  for (const WhitenedPiece* piece : {&a, &b}) {
    for (const Eigen::Vector3d& edge : piece->edges) width = width.cwiseMax(edge.cwiseAbs());
  }
  const Eigen::Vector3d size = largestCoordinates(a.vertices) + largestCoordinates(b.vertices);
  SlabExtent extent;
  for (int k = 0; k < 3; ++k) {
    extent.width[k] = width[k];
    extent.reach[k] = 3 * size[k] + kReach;
    extent.error[k] = error[k];
    extent.edge_error[k] = error[k];  // edges of shapes are whitened by themselves
  }
  return extent;
}

}  // namespace

PieceSlabs pieceSlabs(const WhitenedTree& a, int piece_a, const WhitenedTree& b, int piece_b) {
  const WhitenedPiece first = whitenedPiece(a, piece_a);
  const WhitenedPiece second = whitenedPiece(b, piece_b);
  Factors factors(first.faces.size() + second.faces.size() +
                  first.edges.size() * second.edges.size());
  for (const auto& [p, q] : first.faces) factors.add(p, q);
  for (const auto& [p, q] : second.faces) factors.add(p, q);
  for (const Eigen::Vector3d& p : first.edges) {
    for (const Eigen::Vector3d& q : second.edges) factors.add(p, q);
  }
  PieceSlabs slabs = factors.planes(extentOf(first, second, a.error + b.error));
  double* out = slabs.data.data();
  for (int i = 0; i < slabs.count; ++i) {
    const Eigen::Vector3d n(out[i], out[slabs.count + i], out[2 * slabs.count + i]);
    const Extent of_a = extentAlong(first.vertices, n);
    const Extent of_b = extentAlong(second.vertices, n);
    out[3 * slabs.count + i] += of_b.lo - of_a.hi;
    out[4 * slabs.count + i] += of_b.hi - of_a.lo;
  }
  return slabs;
}

}  // namespace fcl_prob::detail
