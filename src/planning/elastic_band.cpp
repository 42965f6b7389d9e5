// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <algorithm>
#include <cmath>

#include "planning/shorten_path.h"

namespace fcl_prob::detail {
namespace {

using Waypoints = std::vector<Eigen::VectorXd>;

/// Rounds at most.
constexpr int kRounds = 8;

/// A round that shortens the path by less than this part of it is the last.
constexpr double kLittle = 2e-3;

/// Of the length of the path: a move that saves less is none.
constexpr double kNothing = 1e-4;

/// Edges that the pulled path has at least.
constexpr double kEdges = 12.0;

class ElasticBand {
 public:
  ElasticBand(Waypoints waypoints, PlanningRun& run)
      : points_(std::move(waypoints)), run_(run), length_(jointLength(points_)) {}

  Waypoints pull() {
    subdivide();
    for (int round = 0; round < kRounds && !run_.isStopped(); ++round) {
      for (std::size_t i = 1; i + 1 < points_.size(); ++i) pullWaypoint(i);
      const double before = length_;
      length_ = jointLength(points_);
      if (before - length_ < kLittle * before) break;
    }
    return std::move(points_);
  }

 private:
  /// Edges whose parts have states between their ends that are not all allowed stay whole.
  void subdivide() {
    const double longest = length_ / kEdges;
    Waypoints finer{points_.front()};
    for (std::size_t i = 1; i < points_.size(); ++i) {
      const Eigen::VectorXd &from = points_[i - 1], &to = points_[i];
      const double pieces = std::ceil((to - from).norm() / longest);
      Waypoints added;
      for (double k = 1.0; k < pieces; k += 1.0) added.push_back(from + k / pieces * (to - from));
      added.push_back(to);
      if (added.size() > 1 && !areEdgesAllowed(from, added)) added = {to};
      finer.insert(finer.end(), added.begin(), added.end());
    }
    points_ = std::move(finer);
  }

  bool areEdgesAllowed(Eigen::VectorXd from, const Waypoints& points) {
    for (const Eigen::VectorXd& point : points) {
      if (!run_.isMotionAllowed(from, point)) return false;
      from = point;
    }
    return true;
  }

  void pullWaypoint(std::size_t i) {
    const Eigen::VectorXd pull = foot(points_[i], points_[i - 1], points_[i + 1]) - points_[i];
    if (tryMoves(i, pull)) return;
    for (Eigen::Index joint = 0; joint < pull.size(); ++joint) {
      Eigen::VectorXd single = Eigen::VectorXd::Zero(pull.size());
      single[joint] = pull[joint];
      tryMoves(i, single);
    }
  }

  /// The point nearest to x between two others.
  static Eigen::VectorXd foot(const Eigen::VectorXd& x, const Eigen::VectorXd& from,
                              const Eigen::VectorXd& to) {
    const Eigen::VectorXd along = to - from;
    const double square = along.squaredNorm();
    if (!(square > 0.0)) return from;
    return from + std::clamp(along.dot(x - from) / square, 0.0, 1.0) * along;
  }

  bool tryMoves(std::size_t i, const Eigen::VectorXd& pull) {
    for (const double part : {1.0, 0.5, 0.25}) {
      if (tryMove(i, points_[i] + part * pull)) return true;
    }
    return false;
  }

  bool tryMove(std::size_t i, const Eigen::VectorXd& moved) {
    const Eigen::VectorXd &before = points_[i - 1], &after = points_[i + 1];
    const double saved = (points_[i] - before).norm() + (after - points_[i]).norm() -
                         (moved - before).norm() - (after - moved).norm();
    if (!(saved > kNothing * length_) || !areEdgesAllowed(before, {moved, after})) return false;
    points_[i] = moved;
    return true;
  }

  Waypoints points_;
  PlanningRun& run_;
  double length_;
};

}  // namespace

Waypoints pulledTaut(Waypoints waypoints, PlanningRun& run) {
  if (waypoints.size() < 3) return waypoints;
  return ElasticBand(std::move(waypoints), run).pull();
}

}  // namespace fcl_prob::detail
