// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "mass/boundary_mass.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "fcl_prob/normal_mass.h"
#include "gaussian/normal_density.h"
#include "mass/edge_quadrature.h"

namespace fcl_prob::detail {
namespace {

// Rounding of the heights and rectangles of the slabs.
constexpr double kSlabRounding = 1 + 1e-9;

// Thinner layers are as heavy as their density tells, which is a normal double up to this height.
constexpr double kThinLayer = 1e-8;
constexpr double kFarthestLayer = 37.5;

// The parts sgn(h) erfc(|h|/√2) ω of the tail form.
void addFullAngles(const PolytopeBoundary& boundary, EdgeSum& sum) {
  for (const FaceFrame& face : boundary.faces) {
    if (face.angle == 0) continue;
    const double height = std::abs(face.height);
    const double angle = face.angle * std::erfc(height * kInverseSqrtTwo);
    sum.value -= face.height < 0 ? -angle : angle;
    // erfc is wrong by 6 · 2⁻⁵² of itself; an ε of its argument changes it by up to (1 + h²) ε, and
    // the height is a few of them off.
    sum.rounding_error += (16 + 4 * height * height) * kEpsilon * std::abs(angle);
  }
}

MassWithError massOf(const EdgeSum& sum, std::size_t edges) {
  const double summation = static_cast<double>(edges) * kEpsilon * std::abs(sum.value);
  const double error =
      sum.quadrature_error + 1.01 * (sum.rounding_error + sum.field_length) + summation;
  return {sum.value / (4 * M_PI), error / (4 * M_PI)};
}

// Bound on the mass, under N(0, I) in the plane, of what is within `reach` of a face: it is in a
// rectangle, and unless the foot is on the face, beyond a line.
double areaMass(const FaceFrame& face, double reach) {
  const Eigen::Vector2d lo = face.lo.array() - reach;
  const Eigen::Vector2d hi = face.hi.array() + reach;
  const double rectangle = normalIntervalMass(lo.x(), hi.x()) * normalIntervalMass(lo.y(), hi.y());
  if (face.angle != 0) return rectangle;
  return std::min(rectangle, normalTailMass(face.contour_distance - 2 * reach));
}

// Beyond a height and before it, in one dimension.
SlabMass layerMass(double height, double depth) {
  const double farthest = std::abs(height) + depth;
  if (depth < kThinLayer && farthest < kFarthestLayer) {
    // An interval of doubles would be no thinner than they are spaced there.
    const double most = depth * normalDensity(height) * std::exp(farthest * depth);
    return {most, most};
  }
  const double spaced = depth + kEpsilon * std::abs(height);
  return {normalIntervalMass(height, height + spaced), normalIntervalMass(height - spaced, height)};
}

}  // namespace

std::optional<MassWithError> boundaryMass(const PolytopeBoundary& boundary,
                                          const Interruption& interruption) {
  EdgeSum sum;
  const bool core = !(boundary.distance >= kTailDistance);
  for (const BoundaryEdge& edge : boundary.edges) {
    if (isDue(interruption)) return std::nullopt;
    sum += core ? integrateCore(boundary, edge) : integrateTail(boundary, edge);
  }
  if (core) return massOf(sum, boundary.edges.size());
  addFullAngles(boundary, sum);
  MassWithError mass = massOf(sum, boundary.edges.size());
  // The integral is the mass of the body or, around the origin, minus that of what is outside of
  // it: its sign says which, unless it is lost in its own error. Where nothing says it, it is
  // either.
  const bool sign_is_certain = std::abs(mass.value) > 4 * mass.error;
  const std::optional<bool> inside = sign_is_certain ? mass.value < 0 : boundary.origin_inside;
  if (!inside) return MassWithError{mass.value + 0.5, mass.error + 0.5};
  if (*inside) mass.value += 1;
  return mass;
}

SlabMass surfaceSlabMass(const PolytopeBoundary& boundary, double FaceFrame::*distance,
                         double extra) {
  SlabMass sum;
  for (const FaceFrame& face : boundary.faces) {
    const double reach = face.*distance + extra;
    if (reach == 0) continue;
    const double area = kSlabRounding * areaMass(face, reach + face.deviation);
    const SlabMass layer = layerMass(face.height, reach);
    sum.gain += area * layer.gain;
    sum.loss += area * layer.loss;
  }
  return sum;
}

}  // namespace fcl_prob::detail
