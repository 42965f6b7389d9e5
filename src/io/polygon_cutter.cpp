// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "io/polygon_cutter.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fcl_prob::detail {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// Twice the area of a triangle within the unit square, positive if it turns left; 0 if it may well
/// be: coordinates are rounded by up to 1 ε, their differences by 2.5.
double turnOf(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const Eigen::Vector2d u = b - a;
  const Eigen::Vector2d v = c - a;
  const double turn = u.x() * v.y() - u.y() * v.x();
  const bool rounded = std::abs(turn) <= 8.0 * kEpsilon * (u.lpNorm<1>() + v.lpNorm<1>());
  return rounded ? 0.0 : turn;
}

}  // namespace

bool PolygonCutter::cut(const std::vector<std::size_t>& corners,
                        std::vector<fcl::Triangle>& triangles) {
  if (corners.size() > 3) {
    const std::size_t already = triangles.size();
    if (project(corners)) {
      if (clip(corners, triangles)) return true;
      triangles.resize(already);
      return false;
    }
    if (!isOnOneLine()) return false;
  }
  for (std::size_t i = 2; i < corners.size(); ++i) {
    triangles.emplace_back(corners[0], corners[i - 1], corners[i]);
  }
  return true;
}

/// False if the polygon has no area, as far as it is signed.
bool PolygonCutter::project(const std::vector<std::size_t>& corners) {
  const fcl::Vector3d& first = vertices_[corners[0]];
  scaled_.clear();
  double extent = 0.0;
  for (const std::size_t corner : corners) {
    scaled_.emplace_back(vertices_[corner] - first);
    extent = std::max(extent, scaled_.back().cwiseAbs().maxCoeff());
  }
  fcl::Vector3d normal = fcl::Vector3d::Zero();
  if (extent > 0.0) {
    for (fcl::Vector3d& p : scaled_) p /= extent;
    for (std::size_t i = 2; i < scaled_.size(); ++i) normal += scaled_[i - 1].cross(scaled_[i]);
  }
  int axis = 0;
  const double largest = normal.cwiseAbs().maxCoeff(&axis);
  if (largest <= noArea()) return false;
  const int x = (axis + (normal[axis] > 0.0 ? 1 : 2)) % 3;
  const int y = 3 - axis - x;
  points_.clear();
  for (const fcl::Vector3d& p : scaled_) points_.emplace_back(p[x], p[y]);
  return true;
}

/// Twice the area that rounding may leave of a polygon that has none.
double PolygonCutter::noArea() const {
  return 8.0 * kEpsilon * static_cast<double>(scaled_.size());
}

bool PolygonCutter::isOnOneLine() const {
  const auto farthest = std::max_element(
      scaled_.begin(), scaled_.end(),
      [](const auto& a, const auto& b) { return a.squaredNorm() < b.squaredNorm(); });
  return std::all_of(scaled_.begin(), scaled_.end(), [&](const fcl::Vector3d& p) {
    return farthest->cross(p).cwiseAbs().maxCoeff() <= 4.0 * noArea();
  });
}

double PolygonCutter::turn(std::size_t corner) const {
  return turnOf(points_[previous_[corner]], points_[corner], points_[next_[corner]]);
}

void PolygonCutter::link(std::size_t corner_count) {
  next_.resize(corner_count);
  previous_.resize(corner_count);
  for (std::size_t i = 0; i < corner_count; ++i) {
    next_[i] = (i + 1) % corner_count;
    previous_[i] = (i + corner_count - 1) % corner_count;
  }
  reflex_.clear();
  for (std::size_t i = 0; i < corner_count; ++i) {
    if (turn(i) <= 0.0) reflex_.push_back(i);
  }
}

/// Takes a corner out of the ring and returns the one after it.
std::size_t PolygonCutter::remove(std::size_t corner) {
  const std::size_t before = previous_[corner];
  const std::size_t after = next_[corner];
  next_[before] = after;
  previous_[after] = before;
  const auto no_longer = [&](std::size_t i) {
    return i == corner || ((i == before || i == after) && turn(i) > 0.0);
  };
  reflex_.erase(std::remove_if(reflex_.begin(), reflex_.end(), no_longer), reflex_.end());
  for (const std::size_t i : {before, after}) {  // rounding, or an ear that was flat
    if (turn(i) <= 0.0 && std::find(reflex_.begin(), reflex_.end(), i) == reflex_.end()) {
      reflex_.push_back(i);
    }
  }
  return after;
}

/// Where the boundary passes through an ear's own corner, as beside a hole that a double edge ties
/// to the outline: whether it comes from within the angle of that corner.
bool PolygonCutter::isWithinWedge(std::size_t corner, std::size_t touching) const {
  const Point& a = points_[previous_[corner]];
  const Point& b = points_[corner];
  const Point& c = points_[next_[corner]];
  for (const std::size_t i : {previous_[touching], next_[touching]}) {
    if (turnOf(a, b, points_[i]) > 0.0 && turnOf(b, c, points_[i]) > 0.0) return true;
  }
  return false;
}

bool PolygonCutter::isEar(std::size_t corner, Rule rule) const {
  const double area = turn(corner);
  if (rule == Rule::flat) return area == 0.0;
  if (area <= 0.0) return false;
  const std::size_t before = previous_[corner];
  const std::size_t after = next_[corner];
  const Point& a = points_[before];
  const Point& b = points_[corner];
  const Point& c = points_[after];
  // A corner on its border is in the way, unless nothing better is left.
  const auto within = [rule](double turn) {
    return rule == Rule::strict ? turn >= 0.0 : turn > 0.0;
  };
  return std::none_of(reflex_.begin(), reflex_.end(), [&](std::size_t i) {
    if (i == before || i == after) return false;
    const Point& p = points_[i];
    if (p == b) return isWithinWedge(corner, i);
    if (p == a || p == c) return false;
    return within(turnOf(a, b, p)) && within(turnOf(b, c, p)) && within(turnOf(c, a, p));
  });
}

/// An ear of the ring, at `corner` or at one of its neighbours if possible: next to the last ear
/// there often is one, and to look at all others takes time.
std::optional<std::size_t> PolygonCutter::findEar(std::size_t corner, std::size_t left) const {
  // A flat ear is a triangle without area: it keeps a corner on an edge in the surface.
  for (const Rule rule : {Rule::strict, Rule::flat, Rule::touching}) {
    if (isEar(corner, rule)) return corner;
    if (isEar(previous_[corner], rule)) return previous_[corner];
    std::size_t other = next_[corner];
    for (std::size_t i = 2; i < left; ++i, other = next_[other]) {
      if (isEar(other, rule)) return other;
    }
  }
  return std::nullopt;
}

bool PolygonCutter::clip(const std::vector<std::size_t>& corners,
                         std::vector<fcl::Triangle>& triangles) {
  const auto append = [&](std::size_t ear) {
    triangles.emplace_back(corners[previous_[ear]], corners[ear], corners[next_[ear]]);
  };
  link(corners.size());
  std::size_t corner = 1;
  for (std::size_t left = corners.size(); left > 3; --left) {
    const std::optional<std::size_t> ear = findEar(corner, left);
    if (!ear) return false;
    append(*ear);
    corner = remove(*ear);
  }
  if (turn(corner) < 0.0) return false;
  append(corner);
  return true;
}

}  // namespace fcl_prob::detail
