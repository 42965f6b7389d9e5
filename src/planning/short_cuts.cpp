// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <algorithm>
#include <random>

#include "planning/shorten_path.h"

namespace fcl_prob::detail {
namespace {

/// Cuts that are tried in vain, one after the other, before the path is taken for short.
constexpr int kMostInVain = 25;

/// A cut that saves less than this, in joint space, is none.
constexpr double kLeastSaved = 1e-3;

/// A point of the path, on the edge that begins at waypoint `edge`.
struct PathPoint {
  std::size_t edge;
  Eigen::VectorXd values;
};

class ShortCuts {
 public:
  ShortCuts(std::vector<Eigen::VectorXd> waypoints, PlanningRun& run)
      : points_(std::move(waypoints)), run_(run), random_(run.request().seed) {}

  std::vector<Eigen::VectorXd> cut() {
    leaveOutWaypoints();
    for (int in_vain = 0; in_vain < kMostInVain && !run_.isStopped(); ++in_vain) {
      if (tryCut()) in_vain = -1;
    }
    leaveOutWaypoints();
    return std::move(points_);
  }

 private:
  /// From each waypoint straight to the last that can be reached.
  void leaveOutWaypoints() {
    for (std::size_t from = 0; from + 2 < points_.size(); ++from) {
      for (std::size_t to = points_.size() - 1; to > from + 1; --to) {
        if (!run_.isMotionAllowed(points_[from], points_[to])) continue;
        points_.erase(at(from + 1), at(to));
        break;
      }
    }
  }

  bool tryCut() {
    double first = uniform() * jointLength(points_), second = uniform() * jointLength(points_);
    if (first > second) std::swap(first, second);
    const PathPoint from = pointAt(first), to = pointAt(second);
    if (second - first - (to.values - from.values).norm() < kLeastSaved) return false;
    const std::vector<Eigen::VectorXd> cut{points_[from.edge], from.values, to.values,
                                           points_[to.edge + 1]};
    if (!run_.isMotionAllowed(cut[1], cut[2]) || !run_.isMotionAllowed(cut[0], cut[1]) ||
        !run_.isMotionAllowed(cut[2], cut[3])) {
      return false;
    }
    const auto position = points_.erase(at(from.edge + 1), at(to.edge + 1));
    points_.insert(position, {from.values, to.values});
    return true;
  }

  PathPoint pointAt(double distance) const {
    for (std::size_t edge = 0;; ++edge) {
      const Eigen::VectorXd along = points_[edge + 1] - points_[edge];
      const double length = along.norm();
      if (distance > length && edge + 2 < points_.size()) {
        distance -= length;
        continue;
      }
      const double part = length > 0.0 ? std::min(1.0, distance / length) : 0.0;
      return {edge, points_[edge] + part * along};
    }
  }

  std::vector<Eigen::VectorXd>::iterator at(std::size_t i) {
    return points_.begin() + static_cast<std::ptrdiff_t>(i);
  }

  // The standard library's distributions differ from one to the next.
  double uniform() { return static_cast<double>(random_() >> 11) * 0x1p-53; }

  std::vector<Eigen::VectorXd> points_;
  PlanningRun& run_;
  std::mt19937_64 random_;
};

}  // namespace

std::vector<Eigen::VectorXd> cutShort(std::vector<Eigen::VectorXd> waypoints, PlanningRun& run) {
  if (waypoints.size() < 3) return waypoints;
  return ShortCuts(std::move(waypoints), run).cut();
}

std::vector<Eigen::VectorXd> shortened(std::vector<Eigen::VectorXd> waypoints, PlanningRun& run) {
  run.beginShortening();
  return pulledTaut(cutShort(std::move(waypoints), run), run);
}

}  // namespace fcl_prob::detail
