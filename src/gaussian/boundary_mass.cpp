// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "gaussian/boundary_mass.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "fcl_prob/normal_mass.h"
#include "gaussian/edge_quadrature.h"
#include "gaussian/normal_density.h"

namespace fcl_prob::detail {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// Rounding of the heights and rectangles of the slabs.
constexpr double kSlabRounding = 1 + 1e-9;

// The parts sgn(h) erfc(|h|/√2) ω of the tail form.
void addFullAngles(const PolytopeBoundary& boundary, EdgeSum& sum) {
  for (const FaceFrame& face : boundary.faces) {
    if (face.angle == 0) continue;
    const double height = std::abs(face.height);
    const double angle = face.angle * std::erfc(height * kInverseSqrtTwo);
    sum.value -= face.height < 0 ? -angle : angle;
    sum.rounding_error += (16 + 4 * height * height) * kEpsilon * std::abs(angle);
  }
}

MassWithError massOf(const EdgeSum& sum, std::size_t edges) {
  const double summation = static_cast<double>(edges) * kEpsilon * std::abs(sum.value);
  const double error =
      sum.quadrature_error + 1.01 * (sum.rounding_error + sum.field_length) + summation;
  return {sum.value / (4 * M_PI), error / (4 * M_PI)};
}

// Distance of every face, within its plane, from the foot of the origin.
std::vector<double> distancesFromFoot(const PolytopeBoundary& boundary) {
  std::vector<double> distances(boundary.faces.size(), std::numeric_limits<double>::infinity());
  for (const BoundaryEdge& edge : boundary.edges) {
    for (const EdgeSide& side : edge.sides) {
      const bool beside = (side.t_from < 0) == (side.t_to < 0);
      const double along = beside ? std::min(std::abs(side.t_from), std::abs(side.t_to)) : 0.0;
      double& distance = distances[static_cast<std::size_t>(side.face)];
      distance = std::min(distance, std::hypot(side.inset, along));
    }
  }
  for (std::size_t f = 0; f < distances.size(); ++f) {
    if (boundary.faces[f].angle != 0) distances[f] = 0.0;
  }
  return distances;
}

// Mass under N(0, I) in the plane of what is at least so far from its origin.
double massBeyond(double distance) { return std::exp(-0.5 * distance * distance); }

}  // namespace

MassWithError boundaryMass(const PolytopeBoundary& boundary) {
  EdgeSum sum;
  if (!(boundary.distance >= kTailDistance)) {
    for (const BoundaryEdge& edge : boundary.edges) sum += integrateCore(boundary, edge);
    return massOf(sum, boundary.edges.size());
  }
  for (const BoundaryEdge& edge : boundary.edges) sum += integrateTail(boundary, edge);
  addFullAngles(boundary, sum);
  MassWithError mass = massOf(sum, boundary.edges.size());
  if (boundary.origin_inside) mass.value += 1;
  return mass;
}

SlabMass surfaceSlabMass(const PolytopeBoundary& boundary, double FaceFrame::*distance,
                         double extra) {
  SlabMass sum;
  const std::vector<double> distances = distancesFromFoot(boundary);
  for (std::size_t f = 0; f < boundary.faces.size(); ++f) {
    const FaceFrame& face = boundary.faces[f];
    const double reach = face.*distance + extra;
    if (reach == 0) continue;
    const Eigen::Vector2d lo = face.lo.array() - reach;
    const Eigen::Vector2d hi = face.hi.array() + reach;
    // A face that lies obliquely to its frame comes less close than its rectangle does.
    const double nearest = std::max(0.0, (1 - 1e-12) * distances[f] - 2 * reach);
    const double area = kSlabRounding * std::min(normalIntervalMass(lo.x(), hi.x()) *
                                                     normalIntervalMass(lo.y(), hi.y()),
                                                 massBeyond(nearest));
    sum.gain += area * normalIntervalMass(face.height, face.height + reach);
    sum.loss += area * normalIntervalMass(face.height - reach, face.height);
  }
  return sum;
}

}  // namespace fcl_prob::detail
