// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "mass/polygon_mass.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/constants.h"
#include "gaussian/gauss_rule.h"
#include "gaussian/normal_density.h"

namespace fcl_prob::detail {
namespace {

using Eigen::Vector2d;

/// Beyond, nothing weighs as much as the smallest double.
constexpr double kFarthestOfSides = 39.0;
constexpr double kSideUnderflow = 1e-306;

/// A side is halved until this is no less than half its length times (1 + its distance).
constexpr double kLongestHalf = 1.0;

/// -log of what the error of a rule is next to its bound on the integrand.
constexpr double kRuleDecay = 30.0;

/// ρ of the Bernstein ellipses.
constexpr double kLargestEllipse = 1e4;

/// Of a term: nodes, exp, erfc, weights, and of the sum.
constexpr double kSideRounding = 64.0 * kEpsilon;
constexpr double kSideRoundingOfSquare = 8.0 * kEpsilon;

/// What turning a corner and halving sides round, next to the farthest corner.
constexpr double kTurnRounding = 8.0 * kEpsilon;

/// Another direction than the nearest point's has to be worth its while.
constexpr double kMuchLessFlux = 0.5, kHardlyMoreFlux = 1.5;

/// The point of a segment that is nearest to the origin.
Vector2d nearestOfSide(const Vector2d& from, const Vector2d& to) {
  const Vector2d way = to - from;
  const double square = way.squaredNorm();
  if (!(square > 0.0)) return from;
  return from + std::clamp(-from.dot(way) / square, 0.0, 1.0) * way;
}

/// Of a half-plane n·x >= d with n_b >= 0 that a side is in, about the largest d >= 0.
double distanceOfSide(const Vector2d& from, const Vector2d& to) {
  const Vector2d nearest = nearestOfSide(from, to);
  double distance = 0.0;
  if (nearest.y() >= 0.0) {
    const double length = nearest.norm();
    if (length > 0.0) distance = std::min(nearest.dot(from), nearest.dot(to)) / length;
  } else if (from.x() * to.x() > 0.0) {
    distance = std::min(std::abs(from.x()), std::abs(to.x()));
  }
  return std::max(0.0, distance * (1.0 - 8.0 * kEpsilon) - 8.0 * kEpsilon);
}

class PolygonFlux {
 public:
  /// \param displacement  of corners, along two axes
  explicit PolygonFlux(const Vector2d& displacement) : displacement_(displacement) {}

  // With ρ = 4 / x, x the half length h times 1 + d, points of the ellipse are no farther than
  // hρ/2 = 2 / (1 + d) off the side, along it or in imaginary direction: there |F| is at most
  // exp(2 - d²/2) / √2π. Far behind the origin F changes with x alone, and so does the side's h.
  /// \param moved  how far the side may be, along its normal
  void addSide(const Vector2d& from, const Vector2d& to, double moved) {
    const double distance = distanceOfSide(from, to);
    if (distance > kFarthestOfSides) {
      error_ += kSideUnderflow;
      return;
    }
    const double length = (to - from).norm();
    const bool behind = std::max(from.y(), to.y()) < -kFarthestOfSides;
    const double bend = 0.5 * (behind ? std::abs(to.x() - from.x()) : length) * (1.0 + distance);
    if (bend > kLongestHalf) {
      const Vector2d middle = 0.5 * (from + to);
      addSide(from, middle, moved);
      addSide(middle, to, moved);
      return;
    }
    const double density = std::exp(-0.5 * distance * distance);
    const double log_ellipse = std::log(std::min(4.0 / bend, kLargestEllipse));
    const int points = std::clamp(static_cast<int>(std::ceil(0.5 * kRuleDecay / log_ellipse)),
                                  GaussRule::kFewest, GaussRule::kMost);
    error_ += 7.0 * std::abs(to.x() - from.x()) * density * std::exp(-2.0 * points * log_ellipse);
    addRule(from, to, GaussRule::ofSize(points));
    addLayer(behind ? kFarthestOfSides : distance, length, moved);
  }

  Bounds mass() const {
    const double error = error_ * (1.0 + 1e-9) + kUnderflow;
    return {sum_ - error, sum_ + error};
  }

 private:
  void addRule(const Vector2d& from, const Vector2d& to, const GaussRule& rule) {
    const Vector2d middle = 0.5 * (from + to), half = 0.5 * (to - from);
    for (std::size_t k = 0; k < rule.node.size() && rule.weight[k] > 0.0; ++k) {
      const Vector2d x = middle + rule.node[k] * half;
      const double field = rule.weight[k] * gaussianExp(x.x()) * std::erfc(x.y() * kInverseSqrtTwo);
      const double term = 0.5 * kInverseSqrtTwoPi * half.x() * field;
      sum_ += term;
      // For y < 0 the relative slope of erfc(y) is below that of exp(-x²/2) at 1.
      const double square = x.x() * x.x() + std::pow(std::max(0.0, x.y()), 2);
      error_ += std::abs(term) * (kSideRounding + kSideRoundingOfSquare * (1.0 + square)) +
                kSideUnderflow;
    }
  }

  /// What a side at that distance or more may sweep when its corners move, and what sums are
  /// rounded by.
  void addLayer(double distance, double length, double moved) {
    const double near = std::max(0.0, distance - displacement_.norm());
    const double area = 2.2 * (length * moved + 2.0 * displacement_.x() * displacement_.y());
    error_ += kInverseSqrtTwoPi * kInverseSqrtTwoPi * std::exp(-0.5 * near * near) * area +
              kEpsilon * std::abs(sum_);
  }

  Vector2d displacement_;
  double sum_ = 0.0, error_ = 0.0;
};

/// Whether the origin is to the left of all sides.
bool holdsOrigin(const Polygon2& corners) {
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vector2d &p = corners[k], &q = corners[(k + 1) % corners.size()];
    if (p.x() * q.y() - p.y() * q.x() < 0.0) return false;
  }
  return true;
}

/// Towards the nearest point or, from within, the first corner.
Vector2d nearestDirection(const Polygon2& corners) {
  Vector2d nearest = corners.front();
  if (!holdsOrigin(corners)) {
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vector2d point = nearestOfSide(corners[k], corners[(k + 1) % corners.size()]);
      if (point.squaredNorm() < nearest.squaredNorm()) nearest = point;
    }
  }
  const double length = nearest.stableNorm();
  return length > 0.0 ? Vector2d(nearest / length) : Vector2d(Vector2d::UnitY());
}

Vector2d longestSide(const Polygon2& corners) {
  Vector2d longest = Vector2d::Zero();
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vector2d side = corners[(k + 1) % corners.size()] - corners[k];
    if (side.squaredNorm() > longest.squaredNorm()) longest = side;
  }
  return longest.stableNormalized();
}

Vector2d turnedTo(const Vector2d& b, const Vector2d& p) {
  return {b.y() * p.x() - b.x() * p.y(), b.dot(p)};
}

/// About how much goes through the sides, before it cancels.
double grossFlux(const Polygon2& corners, const Vector2d& b) {
  double sum = 0.0;
  Vector2d from = turnedTo(b, corners.back());
  for (const Vector2d& corner : corners) {
    const Vector2d to = turnedTo(b, corner);
    const double distance = distanceOfSide(from, to);
    sum += std::abs(to.x() - from.x()) * std::exp(-0.5 * distance * distance);
    from = to;
  }
  return sum;
}

/// Towards the nearest point or, of thin polygons, along them: little goes through their sides.
/// Best are the axes, which no corner has to be turned for.
Vector2d fieldDirection(const Polygon2& corners) {
  Vector2d best = nearestDirection(corners);
  double least = grossFlux(corners, best);
  const auto prefer = [&](const Vector2d& b, double factor) {
    const double flux = grossFlux(corners, b);
    if (!(flux < factor * least)) return;
    least = flux;
    best = b;
  };
  const Vector2d along = longestSide(corners);
  prefer(along, kMuchLessFlux);
  prefer(-along, kMuchLessFlux);
  for (const Vector2d& axis : {Vector2d(1.0, 0.0), Vector2d(0.0, 1.0)}) {
    prefer(axis, kHardlyMoreFlux);
    prefer(-axis, kHardlyMoreFlux);
  }
  return best;
}

Vector2d reachOf(const Polygon2& corners) {
  Vector2d reach = Vector2d::Zero();
  for (const Vector2d& p : corners) reach = reach.cwiseMax(p.cwiseAbs());
  return reach;
}

/// How far turned corners and halves of sides are from where they are, along each axis.
Vector2d turnRounding(const Polygon2& corners, const Vector2d& b) {
  const Vector2d reach = reachOf(corners);
  const bool is_axis = b.x() == 0.0 || b.y() == 0.0;
  return kTurnRounding * (is_axis ? reach : Vector2d(Vector2d::Constant(reach.norm())));
}

}  // namespace

Bounds polygonMass(const Polygon2& corners, const Vector2d& displacement) {
  if (corners.size() < 3) return {0.0, 0.0};
  const Vector2d b = fieldDirection(corners);
  const Vector2d moved = displacement + turnRounding(corners, b);
  PolygonFlux flux(moved);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vector2d &from = corners[k], &to = corners[(k + 1) % corners.size()];
    const Vector2d side = (to - from).cwiseAbs();
    const double length = side.norm();
    const double along_normal =
        length > 0.0 ? (side.y() * moved.x() + side.x() * moved.y()) / length : moved.norm();
    flux.addSide(turnedTo(b, from), turnedTo(b, to), along_normal);
  }
  return flux.mass();
}

}  // namespace fcl_prob::detail
