// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cells/smooth_cell.h"

#include "base/left_out.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "base/constants.h"

namespace fcl_prob::detail {

namespace {

// Larger cores, and fronts, are left to planes.
constexpr std::size_t kMostCorePoints = 32;
constexpr std::size_t kMostCores = 64;

// In the ball's frame: larger cells are divided first, and distances stay clear of 0.
constexpr double kLargestRadius = 0.4;
constexpr double kNearestFeature = 0.5;

// Inverses that are not better than this are not used.
constexpr double kWorstInverse = 1e-9;

// Of the mass of the cell: what leaves more open is divided.
constexpr double kWidestMass = 1e-8;

// Claims are about the planes between which the boundary of the quadric is within the cell.
void claimQuadric(const Cell& cell, const SmoothPart& part, ClaimObserver& observer) {
  const QuadricLayer layer = layerOf(cell, part.quadric);
  const double room = 4 * (part.slack + 1e-13) / layer.steepness;
  CoveredPart within;
  within.count = 1;
  within.planes[0] = {-layer.normal, room - layer.inner};
  observer.claim({"within a quadric", true, cell, within});
  within.planes[0] = {layer.normal, layer.outer + room};
  observer.claim({"beyond a quadric", false, cell, within});
}

/// A piece of one of the two objects, by its points and what sweeps them.
struct SweptPoints {
  const Eigen::Matrix3d* semi_axes = nullptr;  ///< null: nothing does
  const std::vector<Eigen::Vector3d>* points = nullptr;
  std::array<Eigen::Vector3d, 3> triangle;  ///< where there are no points
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  bool known = true;

  std::size_t size() const { return points ? points->size() : 3; }
  Eigen::Vector3d at(std::size_t i) const {
    return points ? Eigen::Vector3d((*points)[i] + position) : triangle[i];
  }
};

SweptPoints pointsOf(const WhitenedTree& tree, int node) {
  SweptPoints result;
  const int piece = tree.tree->nodes[node].piece;
  if (tree.tree->isTriangle(piece)) {
    const Eigen::Vector3i& t = tree.tree->triangles[piece];
    result.triangle = {tree.vertices[t[0]], tree.vertices[t[1]], tree.vertices[t[2]]};
    return result;
  }
  const int body = tree.tree->bodyOf(piece);
  const SupportShape& shape = tree.shapes[tree.tree->bodies[body].shape].body;
  result.points = &shape.points;
  result.position = tree.positions[body];
  if (shape.curved()) {
    result.semi_axes = &shape.semi_axes;
    result.known = static_cast<std::size_t>(shape.swept) == shape.points.size();
  }
  return result;
}

}  // namespace

SmoothCell::SmoothCell(const WhitenedPair& pair, const ObstacleTable& obstacles)
    : pair_(pair), obstacles_(obstacles), semi_axes_(Eigen::Matrix3d::Zero()) {}

std::optional<Bounds> SmoothCell::massOf(const Cell& cell, const std::vector<CuttingPair>& cutting,
                                         double accuracy, ClaimObserver* observer) {
  if (isLeftOut("quadrics")) return std::nullopt;
  const std::optional<SmoothPart> part = quadricOf(cell, cutting);
  if (!part) return std::nullopt;
  const std::optional<Bounds> mass = cellQuadricMass(cell, part->quadric, part->slack, accuracy);
  if (!mass || mass->upper - mass->lower > kWidestMass * cellMass(cell).upper) return std::nullopt;
  if (observer) claimQuadric(cell, *part, *observer);
  return mass;
}

std::optional<SmoothPart> SmoothCell::quadricOf(const Cell& cell,
                                                const std::vector<CuttingPair>& cutting) {
  if (cell.rank != 3 || cutting.empty() || cutting.size() > kMostCores || pair_.band ||
      pair_.turning) {
    return std::nullopt;
  }
  middle_ = 0.5 * (cell.lo + cell.hi);
  half_ = 0.5 * (cell.hi - cell.lo);
  used_ = 0;
  slack_ = 0.0;
  nearer_ = 0.0;
  for (const CuttingPair& pair : cutting) {
    if (!addCore(pair.pair)) return std::nullopt;
  }
  const auto nearer = [](const Core& x, const Core& y) {
    return x.nearest.distance < y.nearest.distance;
  };
  const auto end = cores_.begin() + static_cast<std::ptrdiff_t>(used_);
  const Core& first = *std::min_element(cores_.begin(), end, nearer);
  if (!setFeature(first) || !endsWithin(first) || !isBehindFeature(first)) return std::nullopt;
  for (auto core = cores_.begin(); core != end; ++core) {
    if (&*core != &first && !isDominated(*core)) return std::nullopt;
  }
  // What distances are rounded by, and what the axes are not the inverse of each other.
  slack_ += 4 * inverse_error_ + (16 * kEpsilon + projection_error_) * reach_ + nearer_;
  return SmoothPart{{across_ * to_ball_, middle_, off_}, slack_};
}

bool SmoothCell::setFrame(const Eigen::Matrix3d& semi_axes) {
  if (semi_axes == semi_axes_) return true;
  const Eigen::Matrix3d inverse = semi_axes.inverse();
  const Eigen::Matrix3d rest = inverse * semi_axes - Eigen::Matrix3d::Identity();
  const double error =
      rest.norm() + 4 * kEpsilon * (inverse.cwiseAbs() * semi_axes.cwiseAbs()).norm();
  if (!(error <= kWorstInverse)) return false;
  semi_axes_ = semi_axes;
  to_ball_ = inverse;
  inverse_error_ = error;
  return true;
}

// False for a pair that has no such core, or another ellipsoid than those before.
bool SmoothCell::addCore(const FrontPair& pair) {
  if (pair.isHalfSpace()) return false;
  const SweptPoints a = pointsOf(pair_.a, pair.nodes.a);
  const SweptPoints b = pointsOf(pair_.b, pair.nodes.b);
  const Eigen::Matrix3d* const semi_axes = a.semi_axes ? a.semi_axes : b.semi_axes;
  const bool one_is_swept = (a.semi_axes == nullptr) != (b.semi_axes == nullptr);
  if (!one_is_swept || !a.known || !b.known || a.size() * b.size() > kMostCorePoints) return false;
  if (used_ > 0 ? *semi_axes != semi_axes_ : !setFrame(*semi_axes)) return false;
  if (used_ == 0) {
    for (int i = 0; i < 8; ++i) {
      const Eigen::Vector3d signs(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
      corners_.col(i) = to_ball_ * half_.cwiseProduct(signs);
    }
    radius_ = corners_.colwise().norm().maxCoeff();
    if (!(radius_ <= kLargestRadius)) return false;
  }
  if (cores_.size() == used_) cores_.emplace_back();
  Core& core = cores_[used_++];
  core.points.clear();
  Eigen::Vector3d error;
  const SupportObstacle obstacle = obstacles_.support(pair.nodes);
  for (int k = 0; k < 3; ++k) error[k] = obstacle.errorAlong(Eigen::Vector3d::Unit(k));
  const Eigen::Matrix3d sizes = to_ball_.cwiseAbs();
  Eigen::Vector3d largest = middle_.cwiseAbs();
  for (std::size_t i = 0; i < b.size(); ++i) {
    for (std::size_t j = 0; j < a.size(); ++j) {
      const Eigen::Vector3d point = b.at(i) - a.at(j);
      largest = largest.cwiseMax(point.cwiseAbs());
      core.points.push_back(to_ball_ * (point - middle_));
    }
  }
  // That of the shapes, and the rounding of the points here.
  slack_ = std::max(slack_, (sizes * (error + 16 * kEpsilon * largest)).norm() * (1 + 1e-9));
  core.nearest = nearestFeature(core.points, Eigen::Vector3d::Zero());
  return true;
}

// The nearest feature of a core as a quadric.
bool SmoothCell::setFeature(const Core& core) {
  const NearestFeature& nearest = core.nearest;
  const auto& points = core.points;
  if (std::fabs(nearest.distance - 1.0) > radius_ + 1e-9) return false;
  corner_ = points[nearest.points[0]];
  across_.setIdentity();
  projection_error_ = 0.0;
  if (nearest.count == 2) {
    const Eigen::Vector3d along = (points[nearest.points[1]] - corner_).normalized();
    across_ -= along * along.transpose();
    projection_error_ = 16 * kEpsilon;
  } else if (nearest.count == 3) {
    const Eigen::Vector3d p = points[nearest.points[1]] - corner_;
    const Eigen::Vector3d q = points[nearest.points[2]] - corner_;
    const Eigen::Vector3d normal = p.cross(q);
    const Eigen::Vector3d n = normal.normalized();
    across_ = n * n.transpose();
    projection_error_ = 16 * kEpsilon * (1.0 + p.norm() * q.norm() / normal.norm());
  }
  reach_ = corner_.norm() + radius_;
  off_ = -(across_ * corner_);
  return projection_error_ * reach_ < 1e-9 && off_.norm() - radius_ >= kNearestFeature;
}

// Whether the feet of all points of the cell on the feature's line or plane are in the core.
bool SmoothCell::endsWithin(const Core& core) {
  if (core.nearest.count == 1) return true;
  for (int i = 0; i < 8; ++i) {
    if (!footWithin(core, corners_.col(i))) return false;
  }
  return true;
}

// By an edge, or by any triangle of points of the face: the feet of the cell are between those of
// its corners.
bool SmoothCell::footWithin(const Core& core, const Eigen::Vector3d& point) {
  const auto& points = core.points;
  const Eigen::Vector3d off = point - corner_;
  if (core.nearest.count == 2) {
    const Eigen::Vector3d edge = points[core.nearest.points[1]] - corner_;
    const double length = edge.norm();
    const double along = edge.dot(off) / length;
    const double rounding = 32 * kEpsilon * reach_;
    return along >= rounding && along <= length - rounding;
  }
  const Eigen::Vector3d p = points[core.nearest.points[1]] - corner_;
  const Eigen::Vector3d q = points[core.nearest.points[2]] - corner_;
  const Eigen::Vector3d normal = p.cross(q);
  const double area = normal.squaredNorm();
  const double of_p = off.cross(q).dot(normal) / area;
  const double of_q = p.cross(off).dot(normal) / area;
  const double rounding =
      64 * kEpsilon * (reach_ + 1.0) * std::max(p.norm(), q.norm()) / std::sqrt(area) + 1e-12;
  return of_p >= rounding && of_q >= rounding && of_p + of_q <= 1.0 - rounding;
}

double SmoothCell::distanceAt(int corner) const {
  return (across_ * corners_.col(corner) + off_).norm();
}

// Whether, for every point of the cell, all of a core lies beyond the plane through its foot on the
// feature across the line between: then nothing of it is nearer than the foot.
bool SmoothCell::isBehindFeature(const Core& core) {
  const Eigen::Matrix3d projected = across_ * to_ball_;
  double nearer = 0.0;
  for (const Eigen::Vector3d& point : core.points) {
    const Eigen::Vector3d from = point - corner_;
    if (from.isZero(0.0)) continue;
    const double value = from.dot(off_) + (from.transpose() * projected).cwiseAbs().dot(half_);
    const double rounding =
        from.norm() * (32 * kEpsilon * (off_.norm() + radius_) + projection_error_ * reach_);
    if (value > rounding) return false;
    nearer = std::max(nearer, value + rounding);
  }
  // By at most that over the distance, which is kNearestFeature at least.
  nearer_ = std::max(nearer_, nearer / kNearestFeature);
  return true;
}

// Whether a plane across `direction` between the cell and a core shows that no point of the cell is
// nearer to the core than to the feature, or that none is within 1 of it. Distances from the
// feature are convex, those from the plane linear.
bool SmoothCell::separates(const Core& core, const Eigen::Vector3d& direction) {
  double height = -kInfinity;
  double size = radius_;
  for (const Eigen::Vector3d& point : core.points) {
    height = std::max(height, direction.dot(point));
    size = std::max(size, point.norm());
  }
  const double rounding = (32 * kEpsilon + projection_error_) * (size + reach_);
  bool farther = true;
  bool clear = true;
  for (int i = 0; i < 8; ++i) {
    const double distance = direction.dot(corners_.col(i)) - height;
    clear = clear && distance > 1.0 + 4 * (slack_ + rounding);
    farther = farther && distance >= distanceAt(i) - rounding;
  }
  if (farther) nearer_ = std::max(nearer_, 2 * rounding);
  return farther || clear;
}

bool SmoothCell::isDominated(const Core& core) {
  if (core.nearest.distance > 0.0 &&
      separates(core, -core.nearest.nearest / core.nearest.distance)) {
    return true;
  }
  return isBehindFeature(core) || separates(core, off_.normalized());
}

}  // namespace fcl_prob::detail
