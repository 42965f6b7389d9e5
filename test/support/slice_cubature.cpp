// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "slice_cubature.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>

#include "fcl_prob/convex_polytope.h"
#include "fcl_prob/normal_mass.h"

namespace fcl_prob_test {
namespace {

using fcl_prob::ConvexPolytope;

double density(double t) { return std::exp(-0.5 * t * t) / std::sqrt(2.0 * M_PI); }

template <typename Function>
double integratePanel(Function&& f, double from, double to) {
  using boost::math::quadrature::gauss;
  const double steepness = (to - from) * std::max(1.0, std::abs(from));
  if (steepness < 0.3) return gauss<double, 3>::integrate(f, from, to);
  if (steepness < 1.0) return gauss<double, 5>::integrate(f, from, to);
  return gauss<double, 7>::integrate(f, from, to);
}

/// ∫ φ(t) f(t) dt over [first break, last break] where that is positive, with f smooth between
/// breaks and 0 <= f <= 1. Goes outwards until what is left is negligible beside `known` and what
/// it has found.
template <typename Function>
double integrateOutwards(const std::vector<double>& breaks, double known, Function&& f) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    double from = std::max(0.0, breaks[i]);
    const double to = breaks[i + 1];
    while (from < to) {
      if (from > 40.0 || density(from) < 1e-8 * (sum + known)) return sum;
      const double step = std::min(1.0, 2.0 / std::max(1.0, from));
      const double end = to - from < 1.3 * step ? to : from + step;
      sum += integratePanel([&](double t) { return density(t) * f(t); }, from, end);
      from = end;
    }
  }
  return sum;
}

/// The same on both sides of 0.
template <typename Function>
double integrate(std::vector<double> breaks, Function&& f) {
  std::sort(breaks.begin(), breaks.end());
  const double positive = integrateOutwards(breaks, 0.0, f);
  std::reverse(breaks.begin(), breaks.end());
  for (double& t : breaks) t = -t;
  return positive + integrateOutwards(breaks, positive, [&](double t) { return f(-t); });
}

struct Segment {
  Eigen::Vector2d from;
  Eigen::Vector2d to;
};

/// Mass of a convex polygon given by its sides in any order.
double polygonMass(const std::vector<Segment>& sides) {
  std::vector<double> breaks;
  for (const Segment& side : sides) breaks.push_back(side.from.y());
  for (const Segment& side : sides) breaks.push_back(side.to.y());
  return integrate(breaks, [&](double y) {
    double lower = std::numeric_limits<double>::infinity();
    double upper = -lower;
    for (const Segment& side : sides) {
      const double below = y - side.from.y();
      const double above = side.to.y() - y;
      if (below * above < 0.0 || below + above == 0.0) continue;
      const double x = (side.from.x() * above + side.to.x() * below) / (below + above);
      lower = std::min(lower, x);
      upper = std::max(upper, x);
    }
    return fcl_prob::normalIntervalMass(lower, upper);
  });
}

/// Sections of a polytope with planes of constant third coordinate, in rotated axes.
class Sections {
 public:
  Sections(const ConvexPolytope& hull, const Eigen::Matrix3d& axes) : faces_(hull.faces) {
    for (const Eigen::Vector3d& v : hull.vertices) vertices_.push_back(axes.transpose() * v);
  }

  std::vector<double> heights() const {
    std::vector<double> heights;
    for (const Eigen::Vector3d& v : vertices_) heights.push_back(v.z());
    return heights;
  }

  double massAt(double z) {
    sides_.clear();
    for (const auto& face : faces_) {
      Segment side;
      int ends = 0;
      const std::size_t count = face.vertices.size();
      for (std::size_t i = 0; i < count; ++i) {
        const Eigen::Vector3d& a = vertices_[face.vertices[i]];
        const Eigen::Vector3d& b = vertices_[face.vertices[(i + 1) % count]];
        if ((a.z() > z) == (b.z() > z)) continue;
        const Eigen::Vector3d p = a + (z - a.z()) / (b.z() - a.z()) * (b - a);
        (ends++ == 0 ? side.from : side.to) = p.head<2>();
      }
      if (ends == 2) sides_.push_back(side);
    }
    return polygonMass(sides_);
  }

 private:
  const std::vector<ConvexPolytope::Face>& faces_;
  std::vector<Eigen::Vector3d> vertices_;
  std::vector<Segment> sides_;
};

/// Axes as columns: the third against the face that the origin sees from farthest.
Eigen::Matrix3d axesFor(const ConvexPolytope& hull) {
  const auto face =
      std::min_element(hull.faces.begin(), hull.faces.end(),
                       [](const auto& a, const auto& b) { return a.offset < b.offset; });
  Eigen::Matrix3d axes;
  axes.col(2) = face->normal;
  axes.col(0) = face->normal.unitOrthogonal();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

}  // namespace

double massBySlices(const std::vector<Eigen::Vector3d>& points) {
  const ConvexPolytope hull = fcl_prob::convexHull(points);
  if (hull.faces.empty()) return 0.0;
  Sections sections(hull, axesFor(hull));
  return integrate(sections.heights(), [&](double z) { return sections.massAt(z); });
}

}  // namespace fcl_prob_test
