// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cells/fan_contact.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"

namespace fcl_prob::detail {
namespace {

// Cuts of a triangle that rounding is allowed for.
constexpr int kMostCuts = 256;

// For each cut: what its corners are rounded by, of the fan's reach.
constexpr double kCutRounding = 16 * kEpsilon;

constexpr double kRadiusRounding = 1.0 + 8 * kEpsilon;

}  // namespace

FanContact::FanContact(const WhitenedFan& fan) : fan_(fan) {
  const double rounding = (kMostCuts + 2) * kCutRounding * fan.reach();
  for (int f = 0; f < fan.faceCount(); ++f) {
    outer_ = std::max(outer_, 2 * fan.facePad(f) + rounding);
    inner_ = std::max(inner_, fan.faceMargin(f) - fan.facePad(f) + rounding);
  }
}

void FanContact::useFirst(std::size_t k) {
  std::rotate(recent_.begin(), recent_.begin() + k, recent_.begin() + k + 1);
}

void FanContact::remember(int face) {
  recent_count_ = std::min(recent_count_ + 1, recent_.size());
  recent_[recent_count_ - 1] = face;
  useFirst(recent_count_ - 1);
}

bool FanContact::isClearOf(const Eigen::Vector3d& middle, const Eigen::Vector3d& half) {
  for (std::size_t k = 0; k < recent_count_; ++k) {
    const Eigen::Vector3d& n = fan_.faceNormal(recent_[k]);
    if (n.dot(middle) - n.cwiseAbs().dot(half) > fan_.faceOffset(recent_[k]) + outer_) {
      useFirst(k);
      return true;
    }
  }
  return false;
}

bool FanContact::anyRecentSeparates(const Eigen::Matrix3d& corners) {
  for (std::size_t k = 0; k < recent_count_; ++k) {
    const Eigen::Vector3d& n = fan_.faceNormal(recent_[k]);
    const double lowest =
        std::min({n.dot(corners.col(0)), n.dot(corners.col(1)), n.dot(corners.col(2))});
    if (lowest > fan_.faceOffset(recent_[k]) + outer_) {
      useFirst(k);
      return true;
    }
  }
  return false;
}

// The first that the middle is higher above than that.
int FanContact::highestFace(double level) const {
  int face = 0;
  while (!(height_[face] > level)) ++face;
  return face;
}

PointContact FanContact::with(const Eigen::Matrix3d& corners) {
  if (anyRecentSeparates(corners)) return PointContact::none;
  const Eigen::Vector3d middle = corners.rowwise().mean();
  const double radius = std::sqrt((corners.colwise() - middle).colwise().squaredNorm().maxCoeff());
  height_ = fan_.heightsAlong(middle) - fan_.offsets();
  const double highest = height_.maxCoeff();
  const double beyond = kRadiusRounding * radius + outer_;
  if (highest > beyond) {
    remember(highestFace(beyond));
    return PointContact::none;
  }
  if (highest < -inner_) return PointContact::touching;
  return clip(corners, kRadiusRounding * radius);
}

// What is left of a triangle within all planes, moved outwards by more than cutting rounds. A
// corner made by a cut is on the edge and the plane up to rounding, wherever on the edge that is.
PointContact FanContact::clip(const Eigen::Matrix3d& corners, double radius) {
  polygon_ = {corners.col(0), corners.col(1), corners.col(2)};
  const double nearest = -radius - std::max(outer_, inner_);
  int cuts = 0;
  for (int f = 0; f < fan_.faceCount(); ++f) {
    if (height_[f] < nearest || !cut(f)) continue;
    if (polygon_.empty()) {
      if (cuts == 0) remember(f);
      return PointContact::none;
    }
    if (++cuts == kMostCuts) return PointContact::unknown;
  }
  return holdsMiddle() ? PointContact::touching : PointContact::unknown;
}

// Whether the plane cuts off anything.
bool FanContact::cut(int face) {
  const Eigen::Vector3d& n = fan_.faceNormal(face);
  const double level = fan_.faceOffset(face) + outer_;
  above_.clear();
  double highest = -kInfinity;
  for (const Eigen::Vector3d& corner : polygon_) {
    above_.push_back(n.dot(corner) - level);
    highest = std::max(highest, above_.back());
  }
  if (!(highest > 0.0)) return false;
  rest_.clear();
  for (std::size_t i = 0; i < polygon_.size(); ++i) {
    const std::size_t next = i + 1 < polygon_.size() ? i + 1 : 0;
    const double here = above_[i];
    const double there = above_[next];
    if (!(here > 0.0)) rest_.push_back(polygon_[i]);
    if ((here > 0.0) == (there > 0.0)) continue;
    rest_.push_back(polygon_[i] + here / (here - there) * (polygon_[next] - polygon_[i]));
  }
  polygon_.swap(rest_);
  return true;
}

// The planes that were not looked at are farther from all of the triangle than P's margins.
bool FanContact::holdsMiddle() {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& corner : polygon_) middle += corner;
  middle /= static_cast<double>(polygon_.size());
  return (fan_.heightsAlong(middle) - fan_.offsets()).maxCoeff() < -inner_;
}

}  // namespace fcl_prob::detail
