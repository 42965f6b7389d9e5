// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene/mesh_reach.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "base/constants.h"

namespace fcl_prob::detail {
namespace {

// Planes that separate as well as this, but for rounding, are not improved upon.
constexpr double kLittleReach = 1e-12;

class ReachSearch {
 public:
  /// \param lengths  of the vertices of the view
  ReachSearch(const ConvexFan& fan, const std::vector<Eigen::Vector3d>& normals,
              const MeshView& view, const std::vector<double>& lengths,
              const std::vector<Eigen::Vector3d>& vertices)
      : fan_(fan), view_(view), lengths_(lengths), vertices_(vertices) {
    planes_.reserve(fan.normals.size() + normals.size());
    for (const Eigen::Vector3d& n : fan.normals) planes_.emplace_back(n, height(n));
    for (const Eigen::Vector3d& n : normals) planes_.emplace_back(n, height(n));
  }

  double of(int t) {
    size_ = fan_.radius + fan_.centre.norm();
    for (int k = 0; k < 3; ++k) {
      const std::size_t v = view_.triangles[t][k];
      corners_[k] = vertices_[v] - fan_.centre;
      size_ = std::max(size_, 2 * lengths_[v]);
    }
    best_ = 1.0;
    for (const auto& [n, height] : planes_) {
      if (tryPlane(n, height)) return best_;
    }
    const Eigen::Vector3d across = (corners_[1] - corners_[0]).cross(corners_[2] - corners_[0]);
    if (tryDirection(across)) return best_;
    findDirections();
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d edge = corners_[(k + 1) % 3] - corners_[k];
      for (const Eigen::Vector3d& other : directions_) {
        if (tryDirection(edge.cross(other))) return best_;
      }
    }
    return best_;
  }

 private:
  // Few bodies have a triangle nearby that none of their own planes clears.
  void findDirections() {
    if (!directions_.empty()) return;
    directions_.reserve(fan_.arcs.size());
    for (const auto& [f, g] : fan_.arcs) {
      directions_.push_back(fan_.normals[f].cross(fan_.normals[g]));
    }
  }

  double height(const Eigen::Vector3d& n) const {
    double highest = 0.0;
    for (const Eigen::Vector3d& v : fan_.vertices) highest = std::max(highest, n.dot(v));
    return highest;
  }

  bool tryPlane(const Eigen::Vector3d& n, double height) {
    if (!(height > 0.0)) return false;
    const double lowest = std::min({n.dot(corners_[0]), n.dot(corners_[1]), n.dot(corners_[2])});
    // Both heights are sums of three products of coordinates within size_, relative to a centre
    // that is rounded: less than 32 ε of the size.
    best_ = std::min(best_, 1.0 - (lowest - 32 * kEpsilon * size_) / height);
    return 1.0 - lowest / height <= kLittleReach;
  }

  bool tryDirection(const Eigen::Vector3d& across) {
    const double length = across.norm();
    if (!(length > 0.0)) return false;
    const Eigen::Vector3d n = across / length;
    return tryPlane(n, height(n)) || tryPlane(-n, height(-n));
  }

  const ConvexFan& fan_;
  const MeshView view_;
  const std::vector<double>& lengths_;
  const std::vector<Eigen::Vector3d>& vertices_;
  std::vector<std::pair<Eigen::Vector3d, double>> planes_;  ///< normals, how far P reaches
  std::vector<Eigen::Vector3d> directions_;                 ///< of the edges of P
  Eigen::Vector3d corners_[3];
  double size_ = 0.0;
  double best_ = 1.0;
};

}  // namespace

SurroundingMesh::SurroundingMesh(const MeshView& view, const std::vector<Eigen::Vector3d>& vertices,
                                 const Eigen::Vector3d& moved_by)
    : view_(view), vertices_(vertices), moved_by_(moved_by), solid_(view, "mesh") {
  lengths_.reserve(view.vertex_count);
  for (int v = 0; v < view.vertex_count; ++v) lengths_.push_back(view.vertices[v].norm());
  std::vector<BoxTree::Box> boxes(view.triangle_count);
  for (int t = 0; t < view.triangle_count; ++t) {
    for (int k = 0; k < 3; ++k) {
      const std::size_t v = view.triangles[t][k];
      boxes[t].extend(vertices[v]);
      largest_ = std::max(largest_, lengths_[v]);
    }
  }
  boxes_ = BoxTree(boxes);
}

// The share λ of P that the mesh reaches into; where it is more than kMostReach it means no more
// than that. What is clear of a box around P by more than rounding does not reach into it.
double SurroundingMesh::reachInto(const ConvexFan& fan,
                                  const std::vector<Eigen::Vector3d>& normals) const {
  BoxTree::Box box;
  for (const Eigen::Vector3d& v : fan.vertices) box.extend(fan.centre + v);
  const double rounding = 64 * kEpsilon * (fan.radius + fan.centre.norm() + 2 * largest_);
  const BoxTree::Box around(box.min().array() - rounding, box.max().array() + rounding);
  ReachSearch search(fan, normals, view_, lengths_, vertices_);
  double farthest = 0.0;
  boxes_.visitBox(around, [&](int t) {
    farthest = std::max(farthest, search.of(t));
    return farthest <= kMostReach;
  });
  return farthest;
}

bool SurroundingMesh::surrounds(ConvexFan& fan, const std::vector<Eigen::Vector3d>& normals) const {
  const double reach = reachInto(fan, normals);
  if (!(reach <= kMostReach) || !hasCentreWithin(fan, solid_, moved_by_)) return false;
  for (std::size_t f = 0; f < fan.depths.size(); ++f) {
    fan.depths[f] = std::max(fan.depths[f], reach * fan.offsets[f]);
  }
  return true;
}

}  // namespace fcl_prob::detail
