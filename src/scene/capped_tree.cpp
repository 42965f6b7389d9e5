// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene/capped_tree.h"

#include <algorithm>
#include <array>

#include "base/constants.h"
#include "geometry/ray_crossing.h"

namespace fcl_prob::detail {

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
      const int vertex = caps().triangles[t][corner];
      const Eigen::Vector3d& v = mesh_->vertices[vertex];
      const Eigen::Vector3d pad = mesh_->error + mesh_->motionOf(vertex);
      for (int k = 0; k < 3; ++k) {
        box.lo[k] = std::min(box.lo[k], v[k] - pad[k]);
        box.hi[k] = std::max(box.hi[k], v[k] + pad[k]);
      }
    }
  }
  return box;
}

bool CappedTree::isFreeOfMesh(const double* lo, const double* hi) {
  return visitMesh(lo, hi, [](const Eigen::Vector3i&) { return false; });
}

// The vertices are known to `error` only (see ClosedMesh), which is the unit of length here: a ray
// along an axis crosses a triangle or not however the axes are stretched. It goes to the nearer end
// of the mesh; all is mirrored where that is the lower one.
std::optional<bool> CappedTree::isInside(const Eigen::Vector3d& point, int axis) {
  bool odd = false;
  const NodeBox& bounds = mesh_->boxOf(0);
  const bool upwards = bounds.hi[axis] - point[axis] <= point[axis] - bounds.lo[axis];
  const double sign = upwards ? 1.0 : -1.0;
  const auto cross = [&](const Eigen::Vector3i& triangle) {
    std::array<Eigen::Vector3d, 3> corners;
    double reach = point.cwiseAbs().cwiseQuotient(mesh_->error).maxCoeff();
    for (int k = 0; k < 3; ++k) {
      corners[k] = sign * (mesh_->vertices[triangle[k]] - point).cwiseQuotient(mesh_->error);
      reach = std::max(reach, corners[k].cwiseAbs().maxCoeff());
    }
    const auto crossing = rayCrossing(corners, axis, 1.0 + 8 * kEpsilon * reach);
    if (crossing && *crossing != 0) odd = !odd;
    return crossing.has_value();
  };
  double lo[3] = {point[0], point[1], point[2]};
  double hi[3] = {point[0], point[1], point[2]};
  (upwards ? hi : lo)[axis] = sign * kInfinity;
  if (!visitTriangles(lo, hi, cross)) return std::nullopt;
  return odd;
}

}  // namespace fcl_prob::detail
