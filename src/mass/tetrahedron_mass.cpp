// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "mass/tetrahedron_mass.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/constants.h"
#include "fcl_prob/normal_mass.h"
#include "gaussian/gauss_legendre.h"
#include "gaussian/narrow_interval.h"
#include "gaussian/normal_density.h"

namespace fcl_prob::detail {
namespace {

using Eigen::Vector3d;

constexpr double kDensityAtOrigin = kInverseSqrtTwoPi * kInverseSqrtTwoPi * kInverseSqrtTwoPi;

constexpr std::array<unsigned, 3> kRules{7, 10, 15};

constexpr std::array<std::pair<int, int>, 6> kEdges{
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

std::pair<int, int> longestEdge(const Tetrahedron& t) {
  return *std::max_element(kEdges.begin(), kEdges.end(), [&](const auto& e, const auto& f) {
    return (t.corner[e.first] - t.corner[e.second]).squaredNorm() <
           (t.corner[f.first] - t.corner[f.second]).squaredNorm();
  });
}

// A direction of the cubature: how far its step goes at most, and how fast |y|²/2 changes along it.
struct Stretch {
  double length_squared = 0.0;
  double slope = 0.0;

  void cover(const Tetrahedron& t, int from, int to) {
    const Vector3d step = t.corner[to] - t.corner[from];
    length_squared = std::max(length_squared, step.squaredNorm());
    for (const Vector3d& corner : t.corner) {
      slope = std::max(slope, std::abs((t.anchor + corner).dot(step)));
    }
  }
};

// Bound on the relative error (of the largest density) of an n-point rule for s^power times the
// density along a step s in [0, 1]: on the Bernstein ellipse |y|²/2 falls by at most slope (A -
// 1/2) beyond the ends and by length² B²/2 off the real axis.
double ruleError(unsigned points, const Stretch& stretch, int power) {
  // Near the least of exp(slope rho/4 + length² rho²/32) rho^(-2n).
  const double quadratic = stretch.length_squared / 16;
  const double linear = stretch.slope / 4;
  const double root = std::sqrt(linear * linear + 8 * points * quadratic);
  const double rho = std::clamp(4.0 * points / (linear + root + 1e-300), 1.05, 1e8);
  const BernsteinEllipse ellipse(0.5, rho);
  const double a = ellipse.real_axis;
  const double b = ellipse.imaginary_axis;
  const double maximum = std::pow(0.5 + a, power) *
                         std::exp(stretch.slope * (a - 0.5) + 0.5 * stretch.length_squared * b * b);
  return gaussErrorBound(points, 0.5, rho, maximum);
}

// Mean of the density over the segment from y along the unit vector `direction`.
double meanDensityAlong(const Vector3d& y, const Vector3d& direction, double length) {
  const double half = 0.5 * length;
  const double middle = y.dot(direction) + half;
  if (isNarrow(middle, half)) {
    const double v = half * half;
    const double u = middle * middle * v;
    const double shape = u + v < 1e-4 ? narrowSeries<4>(u, v) : narrowSeries<kTaylorDegree>(u, v);
    const Vector3d centre = y + half * direction;
    return kDensityAtOrigin * std::exp(-0.5 * centre.squaredNorm()) * shape;
  }
  const double along = y.dot(direction);
  const double across_squared = std::max(0.0, y.squaredNorm() - along * along);
  return kInverseSqrtTwoPi * kInverseSqrtTwoPi * std::exp(-0.5 * across_squared) *
         normalIntervalMass(along, along + length) / length;
}

// y = corner0 + a ((corner1 - corner0) + b ((corner2 - corner1) + c (corner3 - corner2))): volume
// element 6 volume a² b, the mean over c in closed form.
template <unsigned kPoints>
double cubature(const Tetrahedron& t) {
  const Vector3d along = t.corner[3] - t.corner[2];
  const double length = along.norm();
  const Vector3d direction = along / length;
  double sum = 0;
  forEachGaussNode<kPoints>(0.5, 0.5, [&](double a, double a_weight) {
    double inner = 0;
    forEachGaussNode<kPoints>(0.5, 0.5, [&](double b, double b_weight) {
      const Vector3d offset =
          t.corner[0] + a * ((t.corner[1] - t.corner[0]) + b * (t.corner[2] - t.corner[1]));
      inner += b_weight * b * meanDensityAlong(t.anchor + offset, direction, a * b * length);
    });
    sum += a_weight * a * a * inner;
  });
  return 6 * t.volume * sum;
}

}  // namespace

Tetrahedron::Tetrahedron(const Vector3d& anchor_point, const std::array<Vector3d, 4>& corners)
    : anchor(anchor_point), corner(corners) {
  // From the corner with the shortest edges: they carry the least rounding into the determinant.
  const auto edgeProduct = [&](const Vector3d& from) {
    double product = 1;
    for (const Vector3d& to : corner) product *= &to == &from ? 1 : (to - from).norm();
    return product;
  };
  const auto base = std::min_element(
      corner.begin(), corner.end(),
      [&](const auto& p, const auto& q) { return edgeProduct(p) < edgeProduct(q); });
  std::swap(corner[0], *base);
  const Vector3d u = corner[1] - corner[0];
  const Vector3d v = corner[2] - corner[0];
  const Vector3d w = corner[3] - corner[0];
  volume = std::abs(u.dot(v.cross(w))) / 6;
  const Vector3d p = v.cwiseAbs(), q = w.cwiseAbs();
  const Vector3d permanent(p.y() * q.z() + p.z() * q.y(), p.z() * q.x() + p.x() * q.z(),
                           p.x() * q.y() + p.y() * q.x());
  volume_error = 4 * kEpsilon * u.cwiseAbs().dot(permanent) / 6;
  // The closed form is along corners 2 and 3: the longest edge.
  const auto [first, second] = longestEdge(*this);
  if (second != 3) std::swap(corner[second], corner[3]);
  if (first != 2) std::swap(corner[first], corner[2]);
}

double Tetrahedron::densityUpper() const {
  Vector3d centre = Vector3d::Zero();
  for (const Vector3d& c : corner) centre += 0.25 * (anchor + c);
  const double norm = centre.norm();
  if (norm == 0) return kDensityAtOrigin;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vector3d& c : corner) nearest = std::min(nearest, centre.dot(anchor + c) / norm);
  nearest = std::max(0.0, nearest);
  return kDensityAtOrigin * std::exp(-0.5 * nearest * nearest);
}

double Tetrahedron::densityLower() const {
  double farthest = 0;
  for (const Vector3d& c : corner) farthest = std::max(farthest, (anchor + c).squaredNorm());
  return kDensityAtOrigin * std::exp(-0.5 * farthest);
}

CubaturePlan planCubature(const Tetrahedron& t, double tolerance) {
  Stretch outer, inner;
  for (int k = 1; k < 4; ++k) outer.cover(t, 0, k);
  for (int k = 2; k < 4; ++k) inner.cover(t, 1, k);
  const double scale = 6 * t.volume * t.densityUpper();
  for (const unsigned points : kRules) {
    // ∫ b db = 1/2 and the sum of a² over the rule is 1/3.
    const double error =
        scale * (ruleError(points, outer, 2) / 2 + ruleError(points, inner, 1) / 3);
    if (error <= tolerance) return {points, error};
  }
  return {};
}

MassWithError tetrahedronMass(const Tetrahedron& t, const CubaturePlan& plan) {
  MassWithError mass;
  mass.value = plan.points == 7    ? cubature<7>(t)
               : plan.points == 10 ? cubature<10>(t)
                                   : cubature<15>(t);
  double farthest = 0;
  for (const Vector3d& c : t.corner) farthest = std::max(farthest, (t.anchor + c).squaredNorm());
  // All terms are positive. A node y is off by less than 4 ε |y|, which changes exp(-y²/2) by 4 ε
  // y² of itself; 32 ε are for exp, weights and sums.
  const double rounding = (32 + 4 * farthest) * kEpsilon;
  mass.error = plan.error + rounding * mass.value;
  // Relative to the volume, which may be all rounding.
  mass.error +=
      t.volume > 0 ? mass.value * (t.volume_error / t.volume) : t.volume_error * t.densityUpper();
  return mass;
}

}  // namespace fcl_prob::detail
