// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "convex/cell_section.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "convex/inner_pyramid.h"
#include "convex/portal.h"

namespace fcl_prob::detail {
namespace {

// The constants below only steer; no bound depends on them.
constexpr int kMostRefinements = 60;

// The direction of the planes is refined until the obstacle bulges out of the portal by less than
// this share of what it would if the cell were a cap of a ball as large as the obstacle.
constexpr double kNormalShare = 0.03;

// The columns' upper ends are refined until this share of the gap between the planes is left.
constexpr double kHeightShare = 0.1;

// The columns stand around the cell at this distance, relative to its width, so that their points
// may be off by rounding.
constexpr double kColumnMargin = 1e-3;

// A steeper plane than this is not bounded from inside.
constexpr double kLeastSlope = 1e-3;

class SectionFinder {
 public:
  SectionFinder(const SupportObstacle& obstacle, const Eigen::Vector3d& lo,
                const Eigen::Vector3d& hi, int rank)
      : obstacle_(obstacle), rank_(rank), middle_(0.5 * (lo + hi)), half_(0.5 * (hi - lo)) {
    width_ = 2.0 * half_.norm();
    scale_ = std::max((middle_ - obstacle_.centre()).norm(), width_);
  }

  CellSection run() {
    if (!findNormal()) return section_;
    const double along = section_.normal.dot(middle_);
    const double radius = section_.normal.cwiseAbs().dot(half_);
    const double rounding = 16 * kEpsilon * (std::fabs(along) + radius + middle_.norm());
    lowest_ = along - radius - rounding;
    highest_ = along + radius + rounding;
    section_.inner = lowest_ - 1.0;
    section_.outer = obstacle_.supportUpper(section_.normal);
    if (section_.outer < lowest_) {
      section_.relation = CellSection::Relation::outside;
    } else {
      findInnerPlane();
      if (section_.inner >= highest_) section_.relation = CellSection::Relation::inside;
    }
    return section_;
  }

 private:
  // From the obstacle's centre through the middle of the cell to the boundary.
  bool findNormal() {
    Eigen::Vector3d direction = middle_ - obstacle_.centre();
    if (!(direction.norm() > 1e-9 * width_)) direction = Eigen::Vector3d::UnitX();
    Portal portal(obstacle_, obstacle_.centre(), direction);
    if (!portal.found()) return false;
    for (int step = 0; step < kMostRefinements && portal.refine(); ++step) {
      if (portal.slack() <= kNormalShare * width_ * width_ / scale_) break;
    }
    section_.normal = portal.normal();
    return true;
  }

  // The cell, cut by the plane, lies in a prism: four columns parallel to the axis across which the
  // plane is steepest, around the cell. If points of V on the columns below the cell and above the
  // plane are known, the prism between them is within V.
  void findInnerPlane() {
    int axis = 0;
    for (int k = 1; k < rank_; ++k) {
      if (std::fabs(section_.normal[k]) > std::fabs(section_.normal[axis])) axis = k;
    }
    if (!(std::fabs(section_.normal[axis]) > kLeastSlope)) return;
    const BoundaryCell cell{middle_, half_, rank_, section_.normal, lowest_, axis, padding()};
    if (const auto plane = innerPlane(obstacle_, cell)) {
      section_.inner = *plane;
      return;
    }
    double inner = highest_ + width_;
    for (int corner = 0; corner < 4; ++corner) {
      if (!lowerByColumn(axis, corner, inner)) return;
    }
    section_.inner = inner;
  }

  bool lowerByColumn(int axis, int corner, double& inner) {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    Eigen::Vector3d foot = middle_;
    const double side_u = corner % 2 == 0 ? -1.0 : 1.0;
    const double side_v = corner / 2 == 0 ? -1.0 : 1.0;
    foot[u] += side_u * (half_[u] + margin(u));
    foot[v] += side_v * (half_[v] + margin(v));
    const Eigen::Vector3d& n = section_.normal;
    const double below = lowest_ - kColumnMargin * width_;
    foot[axis] += (below - n.dot(foot)) / n[axis];

    Eigen::Vector3d base;
    if (!reach(foot, base)) return false;
    if (!standsAround(base, foot, u, v) || !(n.dot(base) + padding() <= lowest_)) return false;

    Eigen::Vector3d up = Eigen::Vector3d::Zero();
    up[axis] = n[axis] > 0.0 ? 1.0 : -1.0;
    Portal portal(obstacle_, base, up);
    if (!portal.found()) return false;
    Eigen::Vector3d top = portal.piercedPoint();
    for (int step = 0; step < kMostRefinements; ++step) {
      const double height = n.dot(top);
      if (height - padding() > std::min(highest_, inner)) break;
      if (portal.slack() <= kHeightShare * (section_.outer - height)) break;
      if (!portal.refine()) break;
      top = portal.piercedPoint();
    }
    if (!standsAround(top, foot, u, v)) return false;
    inner = std::min(inner, n.dot(top) - padding());
    return inner > lowest_;
  }

  // A point of V that is `foot` but for rounding.
  bool reach(const Eigen::Vector3d& foot, Eigen::Vector3d& point) const {
    Portal portal(obstacle_, obstacle_.centre(), foot - obstacle_.centre());
    if (!portal.found()) return false;
    for (int step = 0; step < kMostRefinements; ++step) {
      if (portal.holds(foot, point)) return true;
      if (!portal.refine() || portal.normal().dot(foot) > obstacle_.supportUpper(portal.normal())) {
        return false;
      }
    }
    return false;
  }

  // How far outside of the cell the columns stand. Along an axis that does not move the cell is
  // flat, and rounding is relative to the obstacle.
  double margin(int axis) const {
    return axis < rank_ ? kColumnMargin * 2.0 * half_[axis] : 1e-9 * scale_;
  }

  // Rounding of the points of V and of their combinations.
  double padding() const { return 2.0 * obstacle_.error() + 64 * kEpsilon * scale_; }

  // The hull of four such points covers the cell, with the room that rounding needs.
  bool standsAround(const Eigen::Vector3d& point, const Eigen::Vector3d& foot, int u, int v) const {
    return std::fabs(point[u] - foot[u]) + padding() <= 0.5 * margin(u) &&
           std::fabs(point[v] - foot[v]) + padding() <= 0.5 * margin(v);
  }

  const SupportObstacle& obstacle_;
  int rank_;
  Eigen::Vector3d middle_;
  Eigen::Vector3d half_;
  double width_;
  double scale_;
  double lowest_ = 0.0;
  double highest_ = 0.0;
  CellSection section_;
};

}  // namespace

CellSection sectionOf(const SupportObstacle& obstacle, const Eigen::Vector3d& lo,
                      const Eigen::Vector3d& hi, int rank) {
  return SectionFinder(obstacle, lo, hi, rank).run();
}

bool contains(const SupportObstacle& obstacle, const Eigen::Vector3d& point) {
  Portal portal(obstacle, obstacle.centre(), point - obstacle.centre());
  if (!portal.found()) return (point - obstacle.centre()).isZero(0.0);
  Eigen::Vector3d combination;
  for (int step = 0; step < 4 * kMostRefinements; ++step) {
    if (portal.holds(point, combination)) return true;
    if (portal.normal().dot(point) > obstacle.supportUpper(portal.normal())) return false;
    if (!portal.refine()) return false;
  }
  return false;
}

}  // namespace fcl_prob::detail
