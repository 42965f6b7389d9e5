// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "bounds/relaxed_integral.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <limits>

#include "base/constants.h"
#include "fcl_prob/normal_mass.h"
#include "gaussian/normal_density.h"

namespace fcl_prob::detail {
namespace {

constexpr double kFieldFactor = 0.25 / M_PI;

/// Roundings of a triangle's projected area, in units of the product of two of its edges.
constexpr double kAreaRoundings = 8.0 * kEpsilon;

/// Quadrature over the sections of an ellipsoid: from -kFar, at most kPanels panels.
constexpr double kFar = 6.0;
constexpr int kPanels = 40;

struct Extent {
  double least = std::numeric_limits<double>::infinity();
  double largest = -std::numeric_limits<double>::infinity();
  double radius = 0.0;  // around the first vertex
};

Extent extentOf(const std::vector<Eigen::Vector3d>& vertices, const Eigen::Vector3d& n) {
  Extent extent;
  for (const Eigen::Vector3d& v : vertices) {
    const double l = n.dot(v);
    extent.least = std::min(extent.least, l);
    extent.largest = std::max(extent.largest, l);
    extent.radius = std::max(extent.radius, (v - vertices.front()).norm());
  }
  return extent;
}

constexpr double kDensityFactor = kInverseSqrtTwoPi * kInverseSqrtTwoPi;

/// The integral over what may be between V and the faces, by Steiner's formula for the volume.
/// \param over_faces  integral over the faces of the thickness times (an upper bound of) the
/// density \param error       no thickness is larger than this
double shellIntegral(double over_faces, const Extent& extent, double error) {
  // Off the faces n·y is nearer to 0 by up to the error, so the density is higher by this factor
  // (where it is not 0 altogether, below 40).
  const double higher = std::exp(40.0 * error);
  const double nearest = std::max(0.0, extent.least - error);
  const double at_edges = 4.0 * M_PI * error * error * (extent.radius + error);
  return kDensityFactor * (over_faces * higher + at_edges * normalDensity(nearest));
}

/// Upper bound on the mean density of a triangle: the largest, or what the values of n·y, whose own
/// density is a hat of height 2 / spread, can have of it.
double meanDensityBound(const TailValue& a, const TailValue& b, const TailValue& c) {
  const TailValue& nearest = a.l < b.l ? (a.l < c.l ? a : c) : (b.l < c.l ? b : c);
  const double largest = std::max({a.l, b.l, c.l});
  const double by_spread = 2.0 * nearest.tail / (largest - nearest.l);
  if (nearest.l <= 0.0) {
    return std::min(largest < 0.0 ? normalDensity(largest) : kInverseSqrtTwoPi, by_spread);
  }
  return std::min(nearest.density, by_spread);
}

/// Calls function(vector area, product of the edges / 2, corners) for every triangle of a fan over
/// every face.
template <typename Function>
void forEachTriangle(const FaceSet& faces, Function&& function) {
  for (std::size_t face = 0; face < faces.faceCount(); ++face) {
    const int a = faces.corner(face, 0);
    const Eigen::Vector3d& origin = faces.vertices()[a];
    int b = faces.corner(face, 1);
    Eigen::Vector3d to_b = faces.vertices()[b] - origin;
    for (int i = 2; i < faces.cornerCount(face); ++i) {
      const int c = faces.corner(face, i);
      const Eigen::Vector3d to_c = faces.vertices()[c] - origin;
      const double edges = std::sqrt(to_b.squaredNorm() * to_c.squaredNorm());
      function(Eigen::Vector3d(0.5 * to_b.cross(to_c)), 0.5 * edges, a, b, c);
      b = c;
      to_b = to_c;
    }
  }
}

}  // namespace

RelaxedIntegral relaxedIntegral(const FaceSet& faces, const Eigen::Matrix3d& error,
                                const Eigen::Vector3d& n, std::vector<TailValue>& work) {
  if (faces.vertices().empty()) return {};
  const Extent extent = extentOf(faces.vertices(), n);
  const double middle = 0.5 * (extent.least + extent.largest);
  const bool narrow = TailSeries::converges(middle, 0.5 * (extent.largest - extent.least));

  work.clear();
  for (const Eigen::Vector3d& v : faces.vertices()) {
    work.push_back(narrow ? TailValue{} : TailValue(n.dot(v)));
    work.back().l = n.dot(v);
  }
  const TailSeries series(middle);
  const double largest_density = normalDensity(std::max(0.0, extent.least));
  double sum = 0.0;
  double sum_of_sizes = 0.0;
  double shell = 0.0;
  forEachTriangle(faces, [&](const Eigen::Vector3d& area, double size, int a, int b, int c) {
    // A constant may be added to the field: in a narrow body the differences are all that is left.
    const double mean = narrow ? series.meanDifference(work[a].l, work[b].l, work[c].l)
                               : tailMean(work[a], work[b], work[c]);
    sum -= n.dot(area) * mean;
    sum_of_sizes += size * std::abs(mean);
    shell += (error.transpose() * area).norm() *
             (narrow ? largest_density : meanDensityBound(work[a], work[b], work[c]));
  });
  RelaxedIntegral result;
  result.value = kFieldFactor * sum;
  result.margin = kFieldFactor * sum_of_sizes * (kAreaRoundings + tailMeanError(extent.least)) +
                  shellIntegral(1.001 * shell, extent, error.norm());
  return result;
}

RelaxedIntegral relaxedIntegral(const Ellipsoid& ball, const PairFrame& frame,
                                const Eigen::Vector3d& n) {
  using Gauss = boost::math::quadrature::gauss<double, 15>;
  const Eigen::Vector3d centre = frame.whitening * ball.centre;
  const double radius = ball.radius + frame.error;
  const double half_width = radius * (frame.whitening.transpose() * n).norm();
  if (!(half_width > 0.0)) return {};
  const double middle = n.dot(centre);
  const double volume_factor = std::abs(frame.whitening.determinant());
  const double largest_section = M_PI * radius * radius * radius * volume_factor / half_width;
  const auto integrand = [&](double l) {
    const double s = (l - middle) / half_width;
    return normalDensity(l) * std::max(0.0, (1.0 - s) * (1.0 + s));
  };
  // What lies far on the other side of the mean is bounded, and so is what is left after some
  // panels over which the density changes by a moderate factor.
  double from = middle - half_width;
  const double to = middle + half_width;
  double sum = 0.0;
  if (from < -kFar) {
    sum += normalIntervalMass(from, std::min(to, -kFar));
    from = -kFar;
  }
  for (int panel = 0; panel < kPanels && from < to; ++panel) {
    const double step = std::min(to - from, 1.5 / std::max(1.0, std::abs(from)));
    sum += Gauss::integrate(integrand, from, from + step);
    from += step;
  }
  if (from < to) sum += normalIntervalMass(from, to);
  RelaxedIntegral result;
  result.value = largest_section * sum / (2.0 * M_PI);
  result.margin = 1e-12 * result.value;
  return result;
}

}  // namespace fcl_prob::detail
