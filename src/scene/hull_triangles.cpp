// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene/hull_triangles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

namespace fcl_prob::detail {
namespace {

// How far points are moved, as a share of their distances: predicates in doubles tell that.
constexpr double kMoved = 1e-11;

// The fractional part of squares times an irrational number, in [-1, 1): what is evenly spaced does
// not stay so.
double offsetOf(std::size_t i) {
  const double share = 0.6180339887498949 * static_cast<double>((i + 1) * (i + 1));
  return 2.0 * (share - std::floor(share)) - 1.0;
}

class HullWrapper {
 public:
  explicit HullWrapper(const std::vector<Eigen::Vector3d>& points) {
    for (const Eigen::Vector3d& point : points) size_ = std::max(size_, (point - points[0]).norm());
    mesh_.vertices.reserve(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Eigen::Vector3d off(offsetOf(3 * i), offsetOf(3 * i + 1), offsetOf(3 * i + 2));
      mesh_.vertices.emplace_back(points[i] - points[0] + kMoved * size_ * off);
    }
  }

  TriangleMesh run() {
    if (mesh_.vertices.size() < 4) return {};
    const std::size_t most = 2 * mesh_.vertices.size() - 4;
    mesh_.triangles.reserve(most);
    is_done_.assign(mesh_.vertices.size() * mesh_.vertices.size(), false);
    open_.reserve(3 * most + 2);
    const Side first = firstEdge();
    open_.push_back(first);
    open_.emplace_back(first.second, first.first);
    while (!open_.empty()) {
      const Side side = open_.back();
      open_.pop_back();
      if (isDone(side)) continue;
      if (mesh_.triangles.size() == most || !add(side, thirdCorner(side))) return {};
    }
    if (mesh_.triangles.size() < 4) return {};
    return std::move(mesh_);
  }

 private:
  using Side = std::pair<std::size_t, std::size_t>;

  const Eigen::Vector3d& at(std::size_t i) const { return mesh_.vertices[i]; }

  // A side of the hull as seen along z, and so one of the hull.
  Side firstEdge() const {
    std::size_t from = 0;
    for (std::size_t i = 1; i < mesh_.vertices.size(); ++i) {
      if (at(i).x() < at(from).x()) from = i;
    }
    std::size_t to = from == 0 ? 1 : 0;
    for (std::size_t i = 0; i < mesh_.vertices.size(); ++i) {
      if (i == from) continue;
      const Eigen::Vector3d one = at(to) - at(from);
      const Eigen::Vector3d other = at(i) - at(from);
      if (one.x() * other.y() - one.y() * other.x() < 0.0) to = i;
    }
    return {from, to};
  }

  std::vector<bool>::reference isDone(const Side& side) {
    return is_done_[side.first * mesh_.vertices.size() + side.second];
  }

  // All points are behind the plane through it.
  std::size_t thirdCorner(const Side& side) const {
    const Eigen::Vector3d along = at(side.second) - at(side.first);
    std::size_t third = mesh_.vertices.size();
    Eigen::Vector3d n;
    for (std::size_t i = 0; i < mesh_.vertices.size(); ++i) {
      if (i == side.first || i == side.second) continue;
      const Eigen::Vector3d to = at(i) - at(side.first);
      if (third < mesh_.vertices.size() && !(n.dot(to) > 0.0)) continue;
      third = i;
      n = along.cross(to);
    }
    return third;
  }

  // The surface closes: what is walked is walked once, and the other way, too. False if it is not.
  bool add(const Side& side, std::size_t third) {
    mesh_.triangles.emplace_back(side.first, side.second, third);
    for (const Side& each : {side, Side{side.second, third}, Side{third, side.first}}) {
      if (isDone(each)) return false;
      isDone(each) = true;
      open_.emplace_back(each.second, each.first);
    }
    return true;
  }

  TriangleMesh mesh_;
  double size_ = 0.0;
  std::vector<Side> open_;
  std::vector<bool> is_done_;  // of every side from one vertex to another
};

}  // namespace

TriangleMesh hullTriangles(const std::vector<Eigen::Vector3d>& points) {
  return HullWrapper(points).run();
}

}  // namespace fcl_prob::detail
