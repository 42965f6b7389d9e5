// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "convex/inner_pyramid.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "convex/portal.h"

namespace fcl_prob::detail {
namespace {

// The constants below only steer; no bound depends on them.

// Depth of the apex below the cell relative to that of the obstacle's centre: the first that leads
// to a point of V; and the least one, in widths of the cell.
constexpr std::array<double, 3> kApexShares{0.6, 0.15, 0.04};
constexpr double kLeastDepth = 2.0;
constexpr int kApexSteps = 12;

// How far the rim is aimed beyond the cell, how often the aim is corrected, and by how much.
constexpr double kAim = 1.02;
constexpr double kMiss = 0.01;
constexpr int kAims = 4;
constexpr double kCorrection = 1.6;

// The largest tilt of the rim's directions (about the tangent of an angle), and the tilt that leads
// across a flat side.
constexpr double kLargestTilt = 0.8;
constexpr double kFlatTilt = 0.1;

class InnerPyramid {
 public:
  InnerPyramid(const SupportObstacle& obstacle, const BoundaryCell& cell)
      : obstacle_(obstacle),
        cell_(cell),
        up_(cell.normal[cell.axis] > 0.0 ? 1.0 : -1.0),
        u_((cell.axis + 1) % 3),
        v_((cell.axis + 2) % 3),
        width_(2.0 * cell.half.norm()) {}

  std::optional<double> plane() {
    if (!findApex()) return std::nullopt;
    prepareTilts();
    const auto around_corners = planeOfRim([this](int corner) { return aimAtCorner(corner); });
    if (around_corners) return around_corners;
    return planeOfRim([this](int corner) { return aimAlongTangents(corner); });
  }

 private:
  // Where a rim point is to stand, as its least distances from the middle of the cell along two
  // directions, and the tilt of the normal that is expected to lead there.
  struct Aim {
    Eigen::Vector3d direction[2];
    double distance[2];
    Eigen::Vector3d tilt;
  };

  bool findApex() {
    const Eigen::Vector3d& centre = obstacle_.centre();
    const double above_centre = cell_.normal.dot(cell_.middle - centre);
    const double steepness = std::fabs(cell_.normal[cell_.axis]);
    for (const double share : kApexShares) {
      depth_ = share * above_centre / steepness;
      if (!(depth_ > kLeastDepth * width_)) return false;
      Eigen::Vector3d foot = cell_.middle;
      foot[cell_.axis] -= up_ * depth_;
      if (!reachApex(foot)) continue;
      return cell_.normal.dot(apex_) + cell_.padding < cell_.lowest;
    }
    return false;
  }

  bool reachApex(const Eigen::Vector3d& foot) {
    Portal portal(obstacle_, obstacle_.centre(), foot - obstacle_.centre());
    if (!portal.found()) return false;
    for (int step = 0; !portal.holds(foot, apex_); ++step) {
      if (step == kApexSteps || !portal.refine()) return false;
      if (portal.normal().dot(foot) > obstacle_.supportUpper(portal.normal())) return false;
    }
    return true;
  }

  // Principal directions of curvature in the tangent plane, the radii along them, and how far the
  // cell reaches along them.
  void prepareTilts() {
    const Eigen::Vector3d& n = cell_.normal;
    tangents_.col(0) = n.unitOrthogonal();
    tangents_.col(1) = n.cross(tangents_.col(0));
    const Eigen::Matrix2d derivative =
        tangents_.transpose() * obstacle_.supportDerivative(n) * tangents_;
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver;
    solver.computeDirect(derivative);
    radii_ = solver.eigenvalues();
    tangents_.col(0) = (tangents_ * solver.eigenvectors().col(0)).eval();
    tangents_.col(1) = up_ * n.cross(tangents_.col(0));  // anticlockwise about the axis
    const Eigen::Vector3d touching = obstacle_.supportPoint(n);
    height_ = n.dot(touching);
    off_middle_ = ontoTangentPlane(touching - cell_.middle);
    reach_.setZero();
    for (int corner = 0; corner < 4; ++corner) {
      const Eigen::Vector3d way = ontoTangentPlane(toCorner(corner));
      for (int k = 0; k < 2; ++k) {
        reach_[k] = std::max(reach_[k], std::fabs(tangents_.col(k).dot(way)));
      }
    }
  }

  // Along the axis.
  Eigen::Vector3d ontoTangentPlane(Eigen::Vector3d way) const {
    const Eigen::Vector3d& n = cell_.normal;
    way[cell_.axis] = -(n[u_] * way[u_] + n[v_] * way[v_]) / n[cell_.axis];
    return way;
  }

  // Anticlockwise about the axis.
  static double sideU(int corner) { return corner == 1 || corner == 2 ? 1.0 : -1.0; }
  static double sideV(int corner) { return corner >= 2 ? 1.0 : -1.0; }

  // From the middle of the cell to a corner of its section across the axis, widened so that the
  // pyramid still holds the corner at the cell's lower end.
  Eigen::Vector3d toCorner(int corner) const {
    Eigen::Vector3d offset = cell_.half;
    for (const int k : {u_, v_}) {
      if (k >= cell_.rank) offset[k] = 1e-9 * depth_;
    }
    offset[u_] *= sideU(corner);
    offset[v_] *= sideV(corner);
    offset[cell_.axis] = 0.0;
    const double steepness = std::fabs(cell_.normal[cell_.axis]);
    const double top = (height_ - cell_.normal.dot(cell_.middle + offset)) / steepness;
    const double bottom = -cell_.half[cell_.axis];
    return kAim * (depth_ + std::max(top, bottom)) / (depth_ + bottom) * offset;
  }

  // The tilt by which the touching point moves along a principal direction.
  double tiltAlong(int k, double way) const {
    if (radii_[k] > 1e-9 * depth_) return way / radii_[k];
    return kFlatTilt * way / (depth_ + std::fabs(way));
  }

  // Where the boundary is curved in both directions.
  Aim aimAtCorner(int corner) const {
    const Eigen::Vector3d target = toCorner(corner);
    const Eigen::Vector3d way = ontoTangentPlane(target) - off_middle_;
    Aim aim{{sideU(corner) * Eigen::Vector3d::Unit(u_), sideV(corner) * Eigen::Vector3d::Unit(v_)},
            {std::fabs(target[u_]), std::fabs(target[v_])},
            Eigen::Vector3d::Zero()};
    for (int k = 0; k < 2; ++k) {
      aim.tilt += tiltAlong(k, tangents_.col(k).dot(way)) * tangents_.col(k);
    }
    return aim;
  }

  // Where the boundary is flat or straight in a direction, the touching point jumps along it to
  // either end, and the rim must keep to the principal directions.
  Aim aimAlongTangents(int corner) const {
    const double sides[2] = {sideU(corner), sideV(corner)};
    Aim aim;
    aim.tilt.setZero();
    for (int k = 0; k < 2; ++k) {
      aim.direction[k] = sides[k] * tangents_.col(k);
      aim.distance[k] = reach_[k];
      const double off = tangents_.col(k).dot(off_middle_);
      const double way = sides[k] * reach_[k] - (std::fabs(off) < width_ ? off : 0.0);
      aim.tilt += tiltAlong(k, way) * tangents_.col(k);
    }
    return aim;
  }

  template <typename AimAt>
  std::optional<double> planeOfRim(const AimAt& aim_at) {
    for (int corner = 0; corner < 4; ++corner) {
      if (!findRimPoint(aim_at(corner), rim_[corner])) return std::nullopt;
    }
    double height = cell_.normal.dot(rim_[0]);
    for (const Eigen::Vector3d& point : rim_) height = std::min(height, cell_.normal.dot(point));
    height -= cell_.padding;
    if (!(height > cell_.lowest) || !containsCellBelow(height)) return std::nullopt;
    return height;
  }

  bool findRimPoint(Aim aim, Eigen::Vector3d& point) const {
    for (int attempt = 0; attempt < kAims; ++attempt) {
      if (aim.tilt.norm() > kLargestTilt) aim.tilt *= kLargestTilt / aim.tilt.norm();
      point = obstacle_.supportPoint(cell_.normal + aim.tilt);
      const Eigen::Vector3d way = ontoTangentPlane(point - cell_.middle);
      if (aim.direction[0].dot(way) >= (1.0 - kMiss) * aim.distance[0] &&
          aim.direction[1].dot(way) >= (1.0 - kMiss) * aim.distance[1]) {
        return true;
      }
      aim.tilt *= kCorrection;
    }
    return false;
  }

  // The part of the cell below the plane is the hull of where the cell's columns along the axis
  // end: at the plane, and at the cell's own end if that is lower.
  bool containsCellBelow(double height) const {
    const double end = cell_.middle[cell_.axis] - up_ * cell_.half[cell_.axis];
    for (int corner = 0; corner < 4; ++corner) {
      Eigen::Vector3d top = cell_.middle;
      top[u_] += sideU(corner) * cell_.half[u_];
      top[v_] += sideV(corner) * cell_.half[v_];
      Eigen::Vector3d bottom = top;
      top[cell_.axis] += (height - cell_.normal.dot(top)) / cell_.normal[cell_.axis];
      bottom[cell_.axis] = up_ * (top[cell_.axis] - end) > 0.0 ? end : top[cell_.axis];
      if (!isWithinSides(top) || !isWithinSides(bottom)) return false;
    }
    return true;
  }

  // Points that are to the left of every edge of a closed polygon are in its hull: here of the
  // pyramid's section with a plane n·y = const, seen from the apex.
  bool isWithinSides(const Eigen::Vector3d& point) const {
    for (int corner = 0; corner < 4; ++corner) {
      const Eigen::Vector3d side = (rim_[corner] - apex_).cross(rim_[(corner + 1) % 4] - apex_);
      if (!(up_ * side.dot(point - apex_) >= 2.0 * cell_.padding * side.norm())) return false;
    }
    return true;
  }

  const SupportObstacle& obstacle_;
  const BoundaryCell& cell_;
  double up_;
  int u_;
  int v_;
  double width_;
  double depth_ = 0.0;
  Eigen::Vector3d apex_ = Eigen::Vector3d::Zero();
  double height_ = 0.0;         // of the touching point
  Eigen::Vector3d off_middle_;  // touching point from the cell's middle, in the tangent plane
  Eigen::Matrix<double, 3, 2> tangents_;
  Eigen::Vector2d radii_;
  Eigen::Vector2d reach_;
  std::array<Eigen::Vector3d, 4> rim_;
};

}  // namespace

std::optional<double> innerPlane(const SupportObstacle& obstacle, const BoundaryCell& cell) {
  return InnerPyramid(obstacle, cell).plane();
}

}  // namespace fcl_prob::detail
