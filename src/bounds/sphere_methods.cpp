// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "bounds/sphere_methods.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "base/bisection.h"
#include "base/constants.h"
#include "base/number_text.h"
#include "convex/support_shape.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/prior_methods.h"
#include "geometry/geometry_kind.h"
#include "geometry/length.h"
#include "geometry/mesh_visitor.h"
#include "geometry/validation.h"

namespace fcl_prob {
namespace {

using namespace detail;

using detail::kEpsilon;
constexpr double kTiny = 1e-300;  // what a mass that may have underflowed is rounded up by

// Halvings of the bracket of log λ: more than a double resolves.
constexpr int kHalvings = 70;

/// The Lagrangian's minimum over all x, min_x Σ x_i²/σ_i² + λ (|x - c|² - r²), rounded down; in
/// principal axes. By weak duality it is nowhere above min Σ x_i²/σ_i² over the ball.
double dualValue(double multiplier, const Eigen::Vector3d& centre, double radius,
                 const Eigen::Vector3d& inverse_variances) {
  double sum = 0.0;
  for (int k = 0; k < 3; ++k) {
    // λ c²/(1 + λ σ²), written so that neither of two large numbers overflows.
    sum += centre[k] * centre[k] / (1.0 / multiplier + 1.0 / inverse_variances[k]);
  }
  const double weight = multiplier * radius * radius;
  return sum - weight - 16.0 * kEpsilon * (sum + weight);
}

/// Whether the multiplier is still below the one of the nearest point: that point of the Lagrangian
/// is outside of the ball.
bool tooSmall(double multiplier, const Eigen::Vector3d& centre, double radius,
              const Eigen::Vector3d& inverse_variances) {
  double squared = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double x = centre[k] / (1.0 + multiplier / inverse_variances[k]);
    squared += x * x;
  }
  return squared > radius * radius;
}

/// A number that min Σ x_i²/σ_i² over a ball is not below, and that it is close to.
double leastSquaredDistance(const Eigen::Vector3d& centre, double radius,
                            const Eigen::Vector3d& inverse_variances) {
  const double excess = centre.norm() / radius - 1.0;
  if (!(excess > 0.0)) return 0.0;
  const auto isTooSmall = [&](double logarithm) {
    return tooSmall(std::exp(logarithm), centre, radius, inverse_variances);
  };
  const Bracket found = bisect({std::log(excess * inverse_variances.minCoeff()),
                                std::log(excess * inverse_variances.maxCoeff())},
                               kHalvings, isTooSmall);
  const double best = std::max(dualValue(std::exp(found.holds), centre, radius, inverse_variances),
                               dualValue(std::exp(found.fails), centre, radius, inverse_variances));
  return best > 0.0 ? best : 0.0;  // NaN: overflow
}

struct Logarithm {
  double value;
  double magnitude;  ///< of its terms, which rounding goes by
};

/// log of (2π)^{-3/2} Π 1/σ_i exp(-d²/2) · 4π/3 r³.
Logarithm logDensityTimesVolume(double squared_distance, double radius,
                                const Eigen::Vector3d& inverse_variances) {
  const double constant = std::log(4.0 / 3.0 * M_PI) - 1.5 * std::log(2.0 * M_PI);
  const double size = 3.0 * std::log(radius);
  Logarithm result{constant + size - 0.5 * squared_distance,
                   3.0 + std::abs(size) + 0.5 * squared_distance};
  for (int k = 0; k < 3; ++k) {
    const double term = 0.5 * std::log(inverse_variances[k]);
    result.value += term;
    result.magnitude += std::abs(term);
  }
  return result;
}

PairFrame frameOf(const BoundingSphere& a, const fcl::Transform3d& pose_a, const BoundingSphere& b,
                  const fcl::Transform3d& pose_b, const GaussianDisplacement& displacement) {
  for (const BoundingSphere* sphere : {&a, &b}) {
    if (!(sphere->radius >= 0.0) || !std::isfinite(sphere->radius)) {
      throw InvalidGeometry("radius of a bounding sphere is " + numberText(sphere->radius));
    }
    if (!sphere->centre.allFinite()) {
      throw InvalidGeometry("centre of a bounding sphere is not finite");
    }
  }
  validatePose(pose_a, "pose of A");
  validatePose(pose_b, "pose of B");
  requireDensity(displacement);
  return PairFrame(displacement, pose_a, lengthOf(a.centre) + a.radius, pose_b,
                   lengthOf(b.centre) + b.radius);
}

std::vector<Eigen::Vector3d> usedVertices(const MeshView& mesh) {
  std::vector<char> used(static_cast<std::size_t>(mesh.vertex_count), 0);
  for (int t = 0; t < mesh.triangle_count; ++t) {
    for (int corner = 0; corner < 3; ++corner) used[mesh.triangles[t][corner]] = 1;
  }
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < mesh.vertex_count; ++i) {
    if (used[static_cast<std::size_t>(i)]) points.push_back(mesh.vertices[i]);
  }
  return points;
}

/// How far the ellipsoid of a shape reaches from `centre` when it is moved to `point`: by
/// Pythagoras for a disk across the way, else by the triangle inequality.
double reachOf(const SupportShape& shape, const Eigen::Vector3d& centre,
               const Eigen::Vector3d& point) {
  const Eigen::Vector3d way = point - centre;
  const double longest = shape.semi_axes.colwise().norm().maxCoeff();
  const bool across = (shape.semi_axes.transpose() * way).norm() <= 0.0;
  return across ? std::hypot(way.norm(), longest) : way.norm() + longest;
}

BoundingSphere sphereAround(const SupportShape& shape) {
  const SphereBv of_points = SphereBv::around(shape.points);
  BoundingSphere sphere{of_points.center(), of_points.radius()};
  for (int i = 0; i < shape.swept; ++i) {
    sphere.radius = std::max(sphere.radius, reachOf(shape, sphere.centre, shape.points[i]));
  }
  sphere.radius += 8.0 * kEpsilon * (sphere.radius + sphere.centre.norm());
  return sphere;
}

}  // namespace

namespace detail {

void requireDensity(const GaussianDisplacement& displacement) {
  if (displacement.rank() == 3) return;
  throw InvalidDistribution("the displacement has rank " + std::to_string(displacement.rank()) +
                            ", and a density only with rank 3");
}

double centralDensityTimesVolume(const DisplacementBall& ball, const PairFrame& frame) {
  const Eigen::Vector3d centre = frame.principal_axes.transpose() * ball.centre;
  const double squared = centre.cwiseAbs2().dot(frame.inverse_variances);
  return std::exp(logDensityTimesVolume(squared, ball.radius, frame.inverse_variances).value);
}

double largestDensityTimesVolume(const DisplacementBall& ball, const PairFrame& frame) {
  const Eigen::Vector3d centre = frame.principal_axes.transpose() * ball.centre;
  const double radius =
      (ball.radius + frame.error + 8.0 * kEpsilon * centre.norm()) * (1.0 + 4.0 * kEpsilon);
  if (radius == 0.0) return 0.0;
  const double squared = leastSquaredDistance(centre, radius, frame.inverse_variances);
  const Logarithm log = logDensityTimesVolume(squared, radius, frame.inverse_variances);
  const double bound = std::exp(log.value + 16.0 * kEpsilon * log.magnitude) + kTiny;
  return bound >= 0.0 ? bound : std::numeric_limits<double>::infinity();  // NaN: no bound
}

}  // namespace detail

BoundingSphere boundingSphere(const fcl::CollisionGeometryd& geometry) {
  validateGeometry(&geometry, "geometry");
  switch (kindOf(geometry)) {
    case GeometryKind::mesh: {
      const SphereBv sphere = SphereBv::around(usedVertices(meshView(geometry)));
      return {sphere.center(), sphere.radius()};
    }
    case GeometryKind::convex:
      return sphereAround(supportShape(geometry));
    default:
      throw UnsupportedGeometry("a bounding sphere needs a mesh or a bounded convex shape, not a " +
                                nodeTypeName(geometry.getNodeType()));
  }
}

double duToitBurdick(const BoundingSphere& a, const fcl::Transform3d& pose_a,
                     const BoundingSphere& b, const fcl::Transform3d& pose_b,
                     const GaussianDisplacement& displacement) {
  const PairFrame frame = frameOf(a, pose_a, b, pose_b, displacement);
  return centralDensityTimesVolume(obstacleOf(frame, a.centre, a.radius, b.centre, b.radius),
                                   frame);
}

double parkBound(const BoundingSphere& a, const fcl::Transform3d& pose_a, const BoundingSphere& b,
                 const fcl::Transform3d& pose_b, const GaussianDisplacement& displacement) {
  const PairFrame frame = frameOf(a, pose_a, b, pose_b, displacement);
  return largestDensityTimesVolume(obstacleOf(frame, a.centre, a.radius, b.centre, b.radius),
                                   frame);
}

}  // namespace fcl_prob
