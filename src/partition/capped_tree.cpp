// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "partition/capped_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fcl_prob::detail {

namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

int certainSign(double value, double error) { return value > error ? 1 : value < -error ? -1 : 0; }

}  // namespace

CappedTree::CappedTree(const WhitenedTree& mesh) : mesh_(&mesh) {
  for (const MeshCaps::Cap& cap : caps().caps) {
    cap_boxes_.push_back(boxOfCapTriangles(cap.first, cap.last));
    for (int t = cap.first; t < cap.last; ++t) {
      cap_triangle_boxes_.push_back(boxOfCapTriangles(t, t + 1));
    }
  }
}

NodeBox CappedTree::boxOfCapTriangles(int first, int last) const {
  NodeBox box{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
  for (int t = first; t < last; ++t) {
    for (int corner = 0; corner < 3; ++corner) {
      const Eigen::Vector3d& v = mesh_->vertices[caps().triangles[t][corner]];
      for (int k = 0; k < 3; ++k) {
        box.lo[k] = std::min(box.lo[k], v[k] - mesh_->error);
        box.hi[k] = std::max(box.hi[k], v[k] + mesh_->error);
      }
    }
  }
  return box;
}

bool CappedTree::isFreeOfMesh(const double* lo, const double* hi) {
  stack_.assign(1, 0);
  while (!stack_.empty()) {
    const int index = stack_.back();
    stack_.pop_back();
    if (isClearOf(mesh_->boxes[index], lo, hi)) continue;
    const PieceTree::Node& node = mesh_->tree->nodes[index];
    if (node.isLeaf()) return false;
    stack_.push_back(node.left);
    stack_.push_back(node.right);
  }
  return true;
}

// The vertices are known to `error` only: an answer counts only if no move by so much can change a
// sign (see ClosedMesh).
std::optional<bool> CappedTree::isInside(const Eigen::Vector3d& point, int axis) {
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  bool odd = false;
  const auto cross = [&](const Eigen::Vector3i& triangle, const NodeBox& box) {
    Eigen::Vector3d d[3];
    double reach = 0.0;
    for (int k = 0; k < 3; ++k) {
      d[k] = mesh_->vertices[triangle[k]] - point;
      reach = std::max(reach, d[k].cwiseAbs().maxCoeff());
    }
    const double margin = mesh_->error + 4 * kEpsilon * (reach + point.cwiseAbs().maxCoeff());
    int positive = 0;
    int negative = 0;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d& p = d[k];
      const Eigen::Vector3d& q = d[(k + 1) % 3];
      const int sign = certainSign(p[u] * q[v] - p[v] * q[u], 16 * margin * (reach + margin));
      positive += sign > 0;
      negative += sign < 0;
    }
    if (positive > 0 && negative > 0) return true;
    if (positive < 3 && negative < 3) return false;
    if (box.hi[axis] < point[axis]) return true;
    if (box.lo[axis] <= point[axis]) {
      // Which side of the triangle's plane the point is on.
      const double volume = d[0].dot(d[1].cross(d[2]));
      const int ahead = certainSign(volume, 96 * margin * (reach + margin) * (reach + margin));
      if (ahead == 0) return false;
      if (ahead != (positive == 3 ? 1 : -1)) return true;
    }
    odd = !odd;
    return true;
  };
  const double lo[3] = {point[0], point[1], point[2]};
  double hi[3] = {point[0], point[1], point[2]};
  hi[axis] = kInfinity;
  if (!visitTriangles(lo, hi, cross)) return std::nullopt;
  return odd;
}

}  // namespace fcl_prob::detail
