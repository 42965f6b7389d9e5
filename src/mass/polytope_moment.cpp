// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "fcl_prob/normal_mass.h"
#include "fcl_prob/polytope_mass.h"
#include "gaussian/normal_density.h"
#include "mass/boundary_mass.h"
#include "mass/face_mass.h"
#include "mass/polytope_effort.h"

namespace fcl_prob {
namespace {

using detail::FaceFrame;
using detail::PolytopeBoundary;

using detail::kEpsilon;
using detail::kUnderflow;

// No mass that a double can tell from zero is farther from the origin.
constexpr double kFarthestMass = 40;

double farthestVertex(const ConvexPolytope& polytope) {
  double farthest = 0;
  for (const Eigen::Vector3d& v : polytope.vertices) farthest = std::max(farthest, v.norm());
  return farthest;
}

// The moment changes by at most |y| φ(y) over what a moving surface sweeps.
double surfaceError(const ConvexPolytope& polytope, const PolytopeBoundary& boundary,
                    double vertex_error) {
  const detail::SlabMass slabs =
      detail::surfaceSlabMass(boundary, &FaceFrame::deviation, vertex_error);
  return std::min(farthestVertex(polytope) + vertex_error, kFarthestMass) *
         (slabs.gain + slabs.loss);
}

// Where faces do not quite meet: ∫ φ along each edge for each unit of the gap.
double gapError(const PolytopeBoundary& boundary) {
  double error = 0;
  for (const detail::BoundaryEdge& edge : boundary.edges) {
    const double density = detail::kInverseSqrtTwoPi * detail::kInverseSqrtTwoPi *
                           std::exp(-0.5 * edge.distance_squared) *
                           normalIntervalMass(edge.t_from, edge.t_to);
    for (const detail::EdgeSide& side : edge.sides) {
      error += density * boundary.faces[static_cast<std::size_t>(side.face)].deviation;
    }
  }
  return 1.01 * error;
}

VectorBounds around(const Eigen::Vector3d& middle, double error) {
  return {middle.array() - error, middle.array() + error};
}

VectorBounds momentOf(const ConvexPolytope& polytope, const PolytopeBoundary& boundary,
                      double vertex_error) {
  const std::vector<detail::MassWithError> masses = detail::faceMasses(boundary);
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  double error = kUnderflow;
  for (std::size_t f = 0; f < masses.size(); ++f) {
    moment -= boundary.faces[f].normal * masses[f].value;
    const double summation = static_cast<double>(masses.size() + 4) * kEpsilon;
    error += masses[f].error + summation * std::abs(masses[f].value);
  }
  return around(moment,
                error + gapError(boundary) + surfaceError(polytope, boundary, vertex_error));
}

}  // namespace

VectorBounds polytopeMoment(const ConvexPolytope& polytope, double vertex_error) {
  if (polytope.faces.empty()) {
    const double most = std::min(farthestVertex(polytope) + vertex_error, kFarthestMass);
    return around(Eigen::Vector3d::Zero(), most * polytopeMass(polytope, vertex_error).upper);
  }
  return momentOf(polytope, detail::polytopeBoundary(polytope), vertex_error);
}

}  // namespace fcl_prob
