// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "given_mass.h"

#include <algorithm>
#include <boost/math/distributions/non_central_chi_squared.hpp>
#include <boost/math/special_functions/owens_t.hpp>
#include <cmath>

namespace fcl_prob_judge {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

double density(double z) { return 0.39894228040143267794 * std::exp(-0.5 * z * z); }

/// P(|m + z| <= r) for three standard normals z.
double massOfUnitBall(double m, double r) {
  // Near m = 0 the closed form cancels; there it is the third of a series in m that counts.
  if (m < 1e-4) {
    const double central = 2.0 * normalCdf(r) - 1.0 - 2.0 * r * density(r);
    return central - m * m * r * r * r * density(r) / 3.0;
  }
  return normalCdf(r - m) - normalCdf(-r - m) - (density(r - m) - density(r + m)) / m;
}

double massOfUnitDisc(double m, double r) {
  // Beyond it boost takes long for a mass of 1e-17.
  if (m - r > 8.6) return 0.0;
  if (r - m > 8.6) return 1.0;
  if (m == 0.0) return -std::expm1(-0.5 * r * r);
  return cdf(boost::math::non_central_chi_squared(2.0, m * m), r * r);
}

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

std::vector<Vector2d> cornersOf(const Rectangle& rectangle, double sign) {
  const Eigen::Rotation2Dd turn(rectangle.angle);
  std::vector<Vector2d> corners;
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    corners.push_back(sign * rectangle.centre +
                      turn * Vector2d(x * rectangle.half.x(), y * rectangle.half.y()));
  }
  return corners;
}

/// Convex hull, counter-clockwise (Andrew's).
std::vector<Vector2d> hullOf(std::vector<Vector2d> points) {
  std::sort(points.begin(), points.end(), [](const Vector2d& a, const Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  std::vector<Vector2d> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t begin = hull.size();
    for (const Vector2d& point : points) {
      while (hull.size() >= begin + 2 &&
             cross(hull.back() - hull[hull.size() - 2], point - hull.back()) <= 0.0) {
        hull.pop_back();
      }
      hull.push_back(point);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

/// Mass of the triangle of the origin, the foot point of a line at distance h, and the point on the
/// line at `along` from there; its sign is that of `along`.
double massToFoot(double h, double along) {
  if (h == 0.0) return 0.0;
  return std::atan2(along, h) / (2.0 * M_PI) - boost::math::owens_t(h, along / h);
}

}  // namespace

double normalCdf(double x) { return 0.5 * std::erfc(-x * 0.70710678118654752440); }

double Translation::sigmaAlong(const Vector3d& direction) const {
  return sigma * within(direction).norm();
}

Vector3d Translation::within(const Vector3d& offset) const {
  Vector3d along = Vector3d::Zero();
  for (int i = 0; i < rank; ++i) along += axes.col(i).dot(offset) * axes.col(i);
  return along;
}

double massBetween(double from, double to, double x, double s) {
  if (s == 0.0) return from <= x && x <= to ? 1.0 : 0.0;
  const double low = (from - x) / s, high = (to - x) / s;
  // Of the two tails the one that does not cancel.
  return low > 0.0 ? normalCdf(-low) - normalCdf(-high) : normalCdf(high) - normalCdf(low);
}

double ballWithin(const Vector3d& offset, double radius, const Translation& translation) {
  return radius * radius - (offset - translation.within(offset)).squaredNorm();
}

double massOfBall(const Vector3d& offset, double radius, const Translation& translation) {
  const double square = ballWithin(offset, radius, translation);
  if (square < 0.0) return 0.0;
  if (translation.rank == 0) return 1.0;
  const double r = std::sqrt(square), s = translation.sigma;
  const double m = translation.within(offset).norm();
  if (translation.rank == 1) return massBetween(-r, r, m, s);
  return translation.rank == 2 ? massOfUnitDisc(m / s, r / s) : massOfUnitBall(m / s, r / s);
}

double massOfPolygon(const std::vector<Vector2d>& corners, double sigma) {
  double total = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector2d a = corners[i] / sigma, b = corners[(i + 1) % corners.size()] / sigma;
    const Vector2d along = (b - a).normalized();
    const double h = cross(a, along);
    total += std::copysign(
        massToFoot(std::fabs(h), b.dot(along)) - massToFoot(std::fabs(h), a.dot(along)), h);
  }
  return total;
}

double massOfRectangles(const Rectangle& first, const Rectangle& second, double sigma) {
  // Displacements that make them meet: the second minus the first.
  std::vector<Vector2d> differences;
  for (const Vector2d& a : cornersOf(first, -1.0)) {
    for (const Vector2d& b : cornersOf(second, 1.0)) differences.push_back(a + b);
  }
  return massOfPolygon(hullOf(differences), sigma);
}

}  // namespace fcl_prob_judge
