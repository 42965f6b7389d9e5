// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "decomposition/surface_piece.h"

#include <algorithm>
#include <limits>
#include <map>

#include "base/keep_once.h"

namespace fcl_prob::detail {
namespace {

/// Copies vertices and makes new ones on sides that cross the plane, each once.
class Clip {
 public:
  Clip(const std::vector<Eigen::Vector3d>& vertices, const CutPlane& plane,
       std::vector<Eigen::Vector3d>& kept)
      : vertices_(vertices), kept_(kept), index_(vertices.size(), -1) {
    heights_.reserve(vertices.size());
    for (const Eigen::Vector3d& v : vertices) heights_.push_back(plane.height(v));
  }

  double height(int vertex) const { return heights_[vertex]; }

  int keep(int vertex) {
    if (index_[vertex] < 0) index_[vertex] = add(vertices_[vertex]);
    return index_[vertex];
  }

  int cross(int from, int to) {
    // In the order of their numbers, so that both sides of the plane get the same point.
    const int a = std::min(from, to);
    const int b = std::max(from, to);
    const auto [position, is_new] = crossings_.try_emplace({a, b}, -1);
    if (is_new) {
      position->second = add(crossingPoint(vertices_[a], heights_[a], vertices_[b], heights_[b]));
    }
    return position->second;
  }

 private:
  int add(const Eigen::Vector3d& point) {
    kept_.push_back(point);
    return static_cast<int>(kept_.size()) - 1;
  }

  const std::vector<Eigen::Vector3d>& vertices_;
  std::vector<Eigen::Vector3d>& kept_;
  std::vector<double> heights_;
  std::vector<int> index_;
  std::map<std::pair<int, int>, int> crossings_;
};

}  // namespace

SurfacePiece::SurfacePiece(const TriangleMesh& mesh)
    : vertices_(mesh.vertices.begin(), mesh.vertices.end()) {
  for (const fcl::Triangle& triangle : mesh.triangles) {
    first_.push_back(static_cast<int>(corners_.size()));
    for (int c = 0; c < 3; ++c) corners_.push_back(static_cast<int>(triangle[c]));
  }
  findEdges();
}

SurfacePiece SurfacePiece::below(const CutPlane& plane, bool keep_coplanar) const {
  SurfacePiece result;
  Clip clip(vertices_, plane, result.vertices_);
  std::vector<int> polygon;
  for (std::size_t p = 0; p < first_.size(); ++p) {
    polygon.clear();
    const int count = polygonEnd(p) - first_[p];
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    for (int i = 0; i < count; ++i) {
      lowest = std::min(lowest, clip.height(corners_[first_[p] + i]));
      highest = std::max(highest, clip.height(corners_[first_[p] + i]));
    }
    if (lowest > 0.0 || (lowest == 0.0 && !(keep_coplanar && highest == 0.0))) continue;
    for (int i = 0; i < count; ++i) {
      const int from = corners_[first_[p] + i];
      const int to = corners_[first_[p] + (i + 1) % count];
      const double before = clip.height(from);
      const double after = clip.height(to);
      if (before <= 0.0) polygon.push_back(clip.keep(from));
      if (std::min(before, after) < 0.0 && std::max(before, after) > 0.0) {
        polygon.push_back(clip.cross(from, to));
      }
    }
    result.first_.push_back(static_cast<int>(result.corners_.size()));
    result.corners_.insert(result.corners_.end(), polygon.begin(), polygon.end());
  }
  result.findEdges();
  return result;
}

void SurfacePiece::findEdges() {
  for (std::size_t p = 0; p < first_.size(); ++p) {
    const int count = polygonEnd(p) - first_[p];
    for (int i = 0; i < count; ++i) {
      edges_.push_back(std::minmax(corners_[first_[p] + i], corners_[first_[p] + (i + 1) % count]));
    }
  }
  keepOnce(edges_);
}

}  // namespace fcl_prob::detail
