// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/polytope_mass.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "base/constants.h"
#include "base/known.h"
#include "base/number_text.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/normal_mass.h"
#include "mass/boundary_mass.h"
#include "mass/polytope_effort.h"
#include "mass/solid_mass.h"

namespace fcl_prob {
namespace {

using detail::FaceFrame;
using detail::kUnderflow;
using detail::MassWithError;
using detail::PolytopeBoundary;

// The wider the margin, the more pieces of a cubature it is worth.
constexpr double kGoodRelativeWidth = 3e-12;
constexpr double kFairRelativeWidth = 1e-11;
constexpr double kPoorRelativeWidth = 9e-11;
constexpr double kSliverRelativeWidth = 1e-3;
constexpr int kMaxPieces = 512;

// Planes of a body that are tried for its narrowest side.
constexpr std::size_t kMostPlanes = 1024;

Bounds widened(const MassWithError& mass, const detail::SlabMass& slabs) {
  const double margin =
      mass.error + 4 * std::numeric_limits<double>::epsilon() * std::abs(mass.value) + kUnderflow;
  return {std::clamp(mass.value - (margin + slabs.loss), 0.0, 1.0),
          std::clamp(mass.value + (margin + slabs.gain), 0.0, 1.0)};
}

// About how many pieces a cubature takes: each spans a few standard deviations, less in the tail,
// where the density changes by e over 1/distance.
double expectedPieces(const ConvexPolytope& polytope, const PolytopeBoundary& boundary) {
  double length = 0, area = 0, volume = 0;
  const Eigen::Vector3d& apex = polytope.vertices.front();
  for (const Eigen::Vector3d& v : polytope.vertices) length = std::max(length, (v - apex).norm());
  for (std::size_t f = 0; f < polytope.faces.size(); ++f) {
    const std::vector<int>& loop = polytope.faces[f].vertices;
    const auto offset = [&](std::size_t k) -> Eigen::Vector3d {
      return polytope.vertices[static_cast<std::size_t>(loop[k])] - apex;
    };
    Eigen::Vector3d area_vector = Eigen::Vector3d::Zero();
    for (std::size_t k = 2; k < loop.size(); ++k) {
      area_vector += 0.5 * (offset(k - 1) - offset(0)).cross(offset(k) - offset(0));
    }
    area += area_vector.norm();
    volume += std::abs(area_vector.dot(offset(0))) / 3;
  }
  if (!(area > 0)) return 1;
  const auto pieces = [&](double extent) {
    return std::clamp(0.5 * (1 + boundary.distance) * extent, 1.0, 50.0);
  };
  return pieces(length) * pieces(0.5 * area / length) * pieces(2 * volume / area);
}

bool isWorthCubature(const ConvexPolytope& polytope, const PolytopeBoundary& boundary,
                     const Bounds& bounds, double enough) {
  const double relative_width = bounds.width() / bounds.upper;
  if (!(relative_width > std::max(enough, kGoodRelativeWidth))) return false;
  const double limit = relative_width > kPoorRelativeWidth   ? 256
                       : relative_width > kFairRelativeWidth ? 32
                                                             : 2;
  return expectedPieces(polytope, boundary) <= limit;
}

// The mass between two parallel planes that hold the body, the least over the faces: what is left
// to say of a sliver that rounding has made of nothing.
double massBetweenPlanes(const ConvexPolytope& polytope, double vertex_error) {
  double least = 1;
  // Some of many faces, or the time would be their number squared.
  const std::size_t step = 1 + polytope.faces.size() / kMostPlanes;
  for (std::size_t f = 0; f < polytope.faces.size(); f += step) {
    const Eigen::Vector3d normal = polytope.faces[f].normal.normalized();
    double lo = std::numeric_limits<double>::infinity(), hi = -lo, reach = 0;
    for (const Eigen::Vector3d& v : polytope.vertices) {
      lo = std::min(lo, normal.dot(v));
      hi = std::max(hi, normal.dot(v));
      reach = std::max(reach, v.norm());
    }
    const double margin = vertex_error + 4 * std::numeric_limits<double>::epsilon() * reach;
    least = std::min(least, normalIntervalMass(lo - margin, hi + margin));
  }
  return least * (1 + kIntervalMassRelativeError) + kUnderflow;
}

double massOfEnclosingBox(const ConvexPolytope& polytope, double vertex_error) {
  Eigen::Vector3d lo = polytope.vertices.front(), hi = lo;
  for (const Eigen::Vector3d& v : polytope.vertices) {
    lo = lo.cwiseMin(v);
    hi = hi.cwiseMax(v);
  }
  const double mass = normalBoxMass(lo.array() - vertex_error, hi.array() + vertex_error);
  return std::min(1.0, mass * (1 + 4 * kIntervalMassRelativeError) + kUnderflow);
}

// A point, a segment or a flat polygon: nothing, but for what the errors of its vertices may hide.
Bounds flatMass(const ConvexPolytope& polytope, double vertex_error) {
  if (polytope.vertices.empty() || vertex_error == 0) return {0, 0};
  return {0, massOfEnclosingBox(polytope, vertex_error)};
}

void requireVertexError(double vertex_error) {
  if (!(vertex_error >= 0) || !std::isfinite(vertex_error)) {
    throw InvalidGeometry("vertex error is not a finite length >= 0: " +
                          detail::numberText(vertex_error));
  }
}

std::optional<Bounds> massByCubature(const ConvexPolytope& polytope, double vertex_error,
                                     PolytopeBoundary& boundary, double lower_bound,
                                     const detail::MassEffort& effort) {
  const auto solid = detail::solidMass(polytope, lower_bound, kMaxPieces, effort);
  if (!solid) return std::nullopt;
  return widened(solid->mass, detail::surfaceSlabMass(boundary, &FaceFrame::unevenness,
                                                      vertex_error + solid->cut_error));
}

Bounds massOfFaces(const ConvexPolytope& polytope, double vertex_error,
                   const detail::MassEffort& effort) {
  PolytopeBoundary boundary = detail::polytopeBoundary(polytope);
  const auto by_boundary = detail::boundaryMass(boundary, effort.interruption);
  if (!by_boundary) return {0, massOfEnclosingBox(polytope, vertex_error)};
  Bounds bounds =
      widened(*by_boundary, detail::surfaceSlabMass(boundary, &FaceFrame::deviation, vertex_error));
  if (isWorthCubature(polytope, boundary, bounds, effort.enough)) {
    const auto by_cubature = massByCubature(polytope, vertex_error, boundary, bounds.lower, effort);
    if (by_cubature) bounds = detail::agreed(bounds, *by_cubature);
  }
  if (bounds.width() > kSliverRelativeWidth * bounds.upper) {
    bounds.upper =
        std::max(bounds.lower, std::min(bounds.upper, massBetweenPlanes(polytope, vertex_error)));
  }
  return bounds;
}

}  // namespace

Bounds detail::polytopeMass(const ConvexPolytope& polytope, double vertex_error,
                            const MassEffort& effort) {
  requireVertexError(vertex_error);
  if (polytope.faces.empty()) return flatMass(polytope, vertex_error);
  return massOfFaces(polytope, vertex_error, effort);
}

Bounds polytopeMass(const ConvexPolytope& polytope, double vertex_error) {
  return detail::polytopeMass(polytope, vertex_error, {});
}

}  // namespace fcl_prob
