// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene/flat_polygon.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <utility>

#include "base/constants.h"
#include "base/keep_once.h"
#include "geometry/surface_caps.h"

namespace fcl_prob::detail {
namespace {

// Each corner is held against each side.
constexpr std::size_t kMostCorners = 64;

// What every vertex may be off by is taken a few times over: it adds up.
constexpr double kMostOff = 8.0;

// A turn is one if its determinant is more than this, of the square of the size.
constexpr double kLeastTurn = 32 * kEpsilon;

double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

Eigen::Vector2d nearestOn(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                          const Eigen::Vector2d& x) {
  const Eigen::Vector2d along = b - a;
  const double length = along.squaredNorm();
  return a + (length > 0.0 ? std::clamp((x - a).dot(along) / length, 0.0, 1.0) : 0.0) * along;
}

class PolygonFit {
 public:
  PolygonFit(const TriangleMesh& mesh, const std::vector<int>& welded,
             const std::vector<int>& triangles, double tolerance)
      : mesh_(mesh), tolerance_(tolerance) {
    for (const int t : triangles) {
      std::array<int, 3> corners = weldedCorners(welded, mesh.triangles[t]);
      std::sort(corners.begin(), corners.end());
      corners_.push_back(corners);
    }
    keepOnce(corners_);
  }

  std::optional<FlatPolygon> run() {
    if (!walkBoundary() || !placePlane()) return std::nullopt;
    chooseCorners();
    if (!isConvex()) return std::nullopt;
    FlatPolygon found{{}, {}, normal_, 2 * farthest()};
    if (!(found.off <= kMostOff * tolerance_)) return std::nullopt;
    for (const std::size_t i : chosen_) found.corners.push_back(loop_[i]);
    return found;
  }

 private:
  const Eigen::Vector3d& at(int vertex) const { return mesh_.vertices[vertex]; }

  // The sides of an odd number of triangles, if they are one loop that meets no vertex twice.
  bool walkBoundary() {
    using Side = std::pair<int, int>;
    std::vector<Side> all;
    for (const auto& [a, b, c] : corners_) {
      for (const Side& side : {Side{a, b}, Side{b, c}, Side{a, c}}) {
        if (side.first != side.second) all.push_back(side);
      }
    }
    std::sort(all.begin(), all.end());
    std::vector<Side> sides;
    for (std::size_t first = 0, last = 0; first < all.size(); first = last) {
      while (last < all.size() && all[last] == all[first]) ++last;
      if ((last - first) % 2 == 0) continue;
      sides.push_back(all[first]);
      sides.emplace_back(all[first].second, all[first].first);
    }
    std::sort(sides.begin(), sides.end());
    for (std::size_t i = 0; i < sides.size(); ++i) {
      if (sides[i].first != sides[i ^ 1U].first) return false;
      if (i >= 2 && sides[i].first == sides[i - 2].first) return false;
    }
    if (sides.size() < 6) return false;
    int before = sides[1].second;
    int here = sides[0].first;
    do {
      loop_.push_back(here);
      const auto side = std::lower_bound(sides.begin(), sides.end(), Side{here, -1});
      const int next = side->second == before ? (side + 1)->second : side->second;
      before = std::exchange(here, next);
    } while (here != loop_.front());
    return 2 * loop_.size() == sides.size();
  }

  // Across what the loop encloses, halfway between the outermost vertices.
  bool placePlane() {
    for (const auto& corners : corners_) {
      vertices_.insert(vertices_.end(), corners.begin(), corners.end());
    }
    keepOnce(vertices_);
    origin_ = at(loop_[0]);
    Eigen::Vector3d area = Eigen::Vector3d::Zero();
    for (std::size_t i = 2; i < loop_.size(); ++i) {
      area += (at(loop_[i - 1]) - origin_).cross(at(loop_[i]) - origin_);
    }
    if (!(area.norm() > 0.0)) return false;
    normal_ = area.normalized();
    axes_.col(0) = normal_.unitOrthogonal();
    axes_.col(1) = normal_.cross(axes_.col(0));
    double lowest = 0.0;
    double highest = 0.0;
    for (const int v : vertices_) {
      const double height = normal_.dot(at(v) - origin_);
      lowest = std::min(lowest, height);
      highest = std::max(highest, height);
      size_ = std::max(size_, (at(v) - origin_).norm());
    }
    origin_ += 0.5 * (lowest + highest) * normal_;
    size_ += highest - lowest;
    for (const int v : loop_) flat_.push_back(inPlane(v));
    return highest - lowest <= kMostOff * tolerance_;
  }

  Eigen::Vector2d inPlane(int vertex) const { return axes_.transpose() * (at(vertex) - origin_); }

  // Around the loop from the vertex that is farthest from its middle: those that are not on the way
  // from the last one to the next.
  void chooseCorners() {
    const std::size_t count = loop_.size();
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    for (const Eigen::Vector2d& x : flat_) middle += x / static_cast<double>(count);
    std::size_t first = 0;
    for (std::size_t i = 1; i < count; ++i) {
      if ((flat_[i] - middle).norm() > (flat_[first] - middle).norm()) first = i;
    }
    std::rotate(loop_.begin(), loop_.begin() + first, loop_.end());
    std::rotate(flat_.begin(), flat_.begin() + first, flat_.end());
    chosen_ = {0};
    for (std::size_t i = 1; i < count; ++i) {
      const Eigen::Vector2d& last = flat_[chosen_.back()];
      const Eigen::Vector2d on_way = nearestOn(last, flat_[(i + 1) % count], flat_[i]);
      if ((flat_[i] - on_way).norm() > tolerance_) chosen_.push_back(i);
    }
  }

  const Eigen::Vector2d& corner(std::size_t i) const { return flat_[chosen_[i % chosen_.size()]]; }

  // All other corners are to the left of every side.
  bool isConvex() const {
    const std::size_t count = chosen_.size();
    if (count < 3 || count > kMostCorners) return false;
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 2; j < count; ++j) {
        if (!(turn(corner(i), corner(i + 1), corner(i + j)) > kLeastTurn * size_ * size_)) {
          return false;
        }
      }
    }
    return true;
  }

  double distance(int vertex, const Eigen::Vector2d& x) const {
    const double rounding = 32 * kEpsilon * (origin_.norm() + size_);
    return (at(vertex) - origin_ - axes_ * x).norm() + rounding;
  }

  // With every vertex moved into the polygon H, those of the loop to their side of it, the
  // triangles have the boundary of H modulo 2. In a plane only H has that boundary, so that they
  // cover each of its points an odd number of times: every point of H is within farthest() of a
  // triangle, every triangle of H. The corners, too, are off H by that, which is why `off` is twice
  // as much.
  //
  // How far a vertex has to be moved, at the most: those of the loop to their side of the polygon,
  // the others into it.
  double farthest() const {
    double most = 0.0;
    std::vector<int> on_loop = loop_;
    std::sort(on_loop.begin(), on_loop.end());
    for (const int v : vertices_) {
      if (std::binary_search(on_loop.begin(), on_loop.end(), v)) continue;
      most = std::max(most, distance(v, nearestWithin(inPlane(v))));
    }
    std::size_t side = 0;
    for (std::size_t i = 0; i < loop_.size(); ++i) {
      if (side + 1 < chosen_.size() && chosen_[side + 1] == i) ++side;
      const Eigen::Vector2d x = nearestOn(corner(side), corner(side + 1), flat_[i]);
      most = std::max(most, distance(loop_[i], x));
    }
    return most;
  }

  Eigen::Vector2d nearestWithin(const Eigen::Vector2d& x) const {
    bool is_within = true;
    Eigen::Vector2d nearest = corner(0);
    for (std::size_t i = 0; i < chosen_.size(); ++i) {
      is_within = is_within && turn(corner(i), corner(i + 1), x) > kLeastTurn * size_ * size_;
      const Eigen::Vector2d on_side = nearestOn(corner(i), corner(i + 1), x);
      if ((x - on_side).norm() < (x - nearest).norm()) nearest = on_side;
    }
    return is_within ? x : nearest;
  }

  const TriangleMesh& mesh_;
  double tolerance_;
  std::vector<std::array<int, 3>> corners_;  // of the triangles, each once
  std::vector<int> loop_;
  std::vector<int> vertices_;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();  // of the plane
  Eigen::Vector3d normal_ = Eigen::Vector3d::Zero();
  Eigen::Matrix<double, 3, 2> axes_;
  double size_ = 0.0;
  std::vector<Eigen::Vector2d> flat_;  // of the loop, in the plane
  std::vector<std::size_t> chosen_;    // of the loop: the corners
};

}  // namespace

std::optional<FlatPolygon> flatPolygonOf(const TriangleMesh& mesh, const std::vector<int>& welded,
                                         std::vector<int> triangles, double tolerance) {
  std::optional<FlatPolygon> found = PolygonFit(mesh, welded, triangles, tolerance).run();
  if (found) found->triangles = std::move(triangles);
  return found;
}

}  // namespace fcl_prob::detail
