// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene/core_cuts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/constants.h"
#include "base/keep_once.h"

namespace fcl_prob::detail {
namespace {

// The more triangles the longer a cut is looked for, and the fewer are tried: a body with many
// dents is given up after some hundredths of a second.
constexpr int kMostCoreCuts = 200;
constexpr int kLeastCoreCuts = 40;
constexpr int kTrianglesTimesCuts = 100'000;

// A triangle that reaches no farther into a half-space than this share of the size is beyond it.
constexpr double kBeyond = 1e-10;

// A cut leaves at least this share of the size around the middle.
constexpr double kLeastLeft = 0.05;

// Of the hull's faces those are tried for a cut that a triangle is nearest to.
constexpr std::size_t kHullFaces = 24;

// Of a triangle's neighbours and theirs, about.
constexpr std::size_t kNeighbours = 64;

class CutSearch {
 public:
  CutSearch(const MeshView& view, const std::vector<Eigen::Vector3d>& vertices,
            const ConvexPolytope& hull)
      : view_(view), vertices_(vertices), hull_(hull), triangles_at_(vertices.size()) {
    for (const Eigen::Vector3d& v : hull.vertices) middle_ += v;
    middle_ /= static_cast<double>(hull.vertices.size());
    for (const Eigen::Vector3d& v : hull.vertices) size_ = std::max(size_, (v - middle_).norm());
    for (int t = 0; t < view.triangle_count; ++t) readTriangle(t);
  }

  std::optional<std::vector<CoreCut>> run() {
    const int most =
        std::clamp(kTrianglesTimesCuts / view_.triangle_count, kLeastCoreCuts, kMostCoreCuts);
    std::vector<int> reaching = trianglesWithin();
    std::vector<CoreCut> cuts;
    for (auto next = reaching.begin(); next != reaching.end(); ++next) {
      const bool done = std::any_of(cuts.begin(), cuts.end(), [&](const CoreCut& cut) {
        return lowest(*next, cut.n) >= cut.offset - kBeyond * size_;
      });
      if (done) continue;
      const auto cut = bestCut(*next);
      if (!cut || static_cast<int>(cuts.size()) == most) return std::nullopt;
      cuts.push_back(*cut);
      dropPointsBeyond(*cut);
    }
    return cuts;
  }

 private:
  /// A part of the surface, as one point.
  struct Point {
    Eigen::Vector3d at;
    double area;
  };

  void readTriangle(int t) {
    const auto corner = [&](int k) { return vertices_[view_.triangles[t][k]]; };
    const Eigen::Vector3d across = (corner(1) - corner(0)).cross(corner(2) - corner(0));
    const double area = 0.5 * across.norm();
    normals_.push_back(area > 0.0 ? Eigen::Vector3d(across.normalized())
                                  : Eigen::Vector3d(Eigen::Vector3d::Zero()));
    points_.push_back({(corner(0) + corner(1) + corner(2)) / 3, area / 4});
    for (int k = 0; k < 3; ++k) {
      points_.push_back({corner(k), area / 4});
      triangles_at_[view_.triangles[t][k]].push_back(t);
    }
  }

  double lowest(int t, const Eigen::Vector3d& n) const {
    const auto& triangle = view_.triangles[t];
    return std::min({n.dot(vertices_[triangle[0]]), n.dot(vertices_[triangle[1]]),
                     n.dot(vertices_[triangle[2]])});
  }

  // Those that are next to no face of the hull, the deepest first.
  std::vector<int> trianglesWithin() const {
    std::vector<std::pair<double, int>> found;
    for (int t = 0; t < view_.triangle_count; ++t) {
      double depth = kInfinity;
      for (const ConvexPolytope::Face& face : hull_.faces) {
        depth = std::min(depth, face.offset - lowest(t, face.normal));
        if (depth <= kBeyond * size_) break;
      }
      if (depth > kBeyond * size_) found.emplace_back(-depth, t);
    }
    std::sort(found.begin(), found.end());
    std::vector<int> triangles;
    for (const auto& [unused, t] : found) triangles.push_back(t);
    return triangles;
  }

  // Its own plane, those of its neighbours and of theirs, and those of the hull above it.
  std::vector<Eigen::Vector3d> candidates(int t) const {
    std::vector<int> around{t};
    for (int ring = 0; ring < 2; ++ring) {
      const std::vector<int> before = around;
      for (const int s : before) {
        for (int k = 0; k < 3; ++k) {
          const auto& more = triangles_at_[view_.triangles[s][k]];
          around.insert(around.end(), more.begin(), more.end());
        }
      }
      keepOnce(around);
    }
    std::vector<Eigen::Vector3d> normals{normals_[t]};
    const std::size_t step = 1 + around.size() / kNeighbours;
    for (std::size_t i = 0; i < around.size(); i += step) normals.push_back(normals_[around[i]]);
    std::vector<std::pair<double, std::size_t>> above;
    for (std::size_t f = 0; f < hull_.faces.size(); ++f) {
      const ConvexPolytope::Face& face = hull_.faces[f];
      above.emplace_back(face.offset - lowest(t, face.normal), f);
    }
    const std::size_t count = std::min(above.size(), kHullFaces);
    std::partial_sort(above.begin(), above.begin() + static_cast<std::ptrdiff_t>(count),
                      above.end());
    for (std::size_t i = 0; i < count; ++i) normals.push_back(hull_.faces[above[i].second].normal);
    return normals;
  }

  // Cuts off the least volume: about the area of what is cut off, times how far it is beyond.
  std::optional<CoreCut> bestCut(int t) const {
    std::optional<CoreCut> best;
    double least = kInfinity;
    for (const Eigen::Vector3d& n : candidates(t)) {
      const double offset = lowest(t, n);
      if (!(offset - n.dot(middle_) > kLeastLeft * size_)) continue;
      double cost = 0.0;
      for (const Point& point : points_) {
        cost += point.area * std::max(0.0, n.dot(point.at) - offset);
        if (cost >= least) break;
      }
      if (cost < least) {
        least = cost;
        best = CoreCut{n, offset};
      }
    }
    return best;
  }

  void dropPointsBeyond(const CoreCut& cut) {
    const auto beyond = [&](const Point& point) { return cut.n.dot(point.at) > cut.offset; };
    points_.erase(std::remove_if(points_.begin(), points_.end(), beyond), points_.end());
  }

  const MeshView view_;
  const std::vector<Eigen::Vector3d>& vertices_;
  const ConvexPolytope& hull_;
  Eigen::Vector3d middle_ = Eigen::Vector3d::Zero();
  double size_ = 0.0;
  std::vector<Eigen::Vector3d> normals_;        // of triangles
  std::vector<std::vector<int>> triangles_at_;  // of every vertex
  std::vector<Point> points_;                   // that no cut has taken off yet
};

}  // namespace

std::optional<std::vector<CoreCut>> findCoreCuts(const MeshView& view,
                                                 const std::vector<Eigen::Vector3d>& vertices,
                                                 const ConvexPolytope& hull) {
  return CutSearch(view, vertices, hull).run();
}

}  // namespace fcl_prob::detail
