// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "mass/face_mass.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/constants.h"
#include "gaussian/normal_density.h"
#include "gaussian/panel_quadrature.h"

namespace fcl_prob::detail {
namespace {

// Beyond this distance of the contour from the foot the tail form is used.
constexpr double kTailContour = 1.0;

// exp(-ρ²/2) is below 1e-20 where ρ² exceeds its least value by this.
constexpr double kRangeSquared = 94;

// exp(-ρ²/2) dθ/dt, or (1 - exp(-ρ²/2)) dθ/dt, along one side.
template <bool kIsTail>
class SideIntegrand {
 public:
  struct Choice {};

  explicit SideIntegrand(const EdgeSide& side)
      : side_(side), inset_squared_(side.inset * side.inset) {}

  MassWithError& sum() { return sum_; }
  void addError(double error) { sum_.error += error; }

  double analyticReach(double least_square) const {
    return kIsTail ? std::sqrt(inset_squared_ + least_square)
                   : std::numeric_limits<double>::infinity();
  }

  // |1 - exp(-s/2)| / |s| <= max(1, exp(-Re s/2)) / 2, and <= 2/Re s for Re s > 0.
  double maximum(double square, double /*least_square*/, Choice& /*choice*/) const {
    const double real = inset_squared_ + square;
    const double scale = std::abs(side_.inset);
    if (kIsTail) {
      return real > 0 ? scale * std::exp(-0.5 * real) / real
                      : std::numeric_limits<double>::infinity();
    }
    return real > 4 ? 2 * scale / real : 0.5 * scale * std::max(1.0, std::exp(-0.5 * real));
  }

  template <unsigned kPoints>
  void evaluate(const Panel& panel, const Choice&) {
    forEachGaussNode<kPoints>(panel.centre(), panel.half(), [&](double t, double weight) {
      const double square = inset_squared_ + t * t;
      const double value = weight * integrandPerInset(square);
      sum_.value += side_.inset * value;
      const double relative = (kIsTail ? 16 + 4 * square : 16) * kEpsilon;
      sum_.error += (relative * std::abs(side_.inset) + side_.inset_error) * value;
    });
    if (panel.is_first) addGap(panel.from, side_.from_error);
    if (panel.is_last) addGap(panel.to, side_.to_error);
  }

 private:
  static double integrandPerInset(double square) {
    if (kIsTail) return std::exp(-0.5 * square) / square;
    return square > 0 ? -std::expm1(-0.5 * square) / square : 0.5;
  }

  // Where the ends are off by `gap`, the contour does not quite close.
  void addGap(double t, double gap) {
    sum_.error += gap * std::abs(side_.inset) * integrandPerInset(inset_squared_ + t * t);
  }

  const EdgeSide& side_;
  double inset_squared_;
  MassWithError sum_;
};

MassWithError tailOf(const EdgeSide& side, double least_square) {
  const double scale = std::exp(-0.5 * least_square);
  SideIntegrand<true> integrand(side);
  integrand.addError(M_PI * std::exp(-0.5 * kRangeSquared) * scale);
  const double reach_squared = least_square + kRangeSquared - side.inset * side.inset;
  if (reach_squared > 0 && side.inset != 0) {
    PanelQuadrature(integrand, 1e-18 * scale / (1 + least_square) + kLeastTolerance)
        .integrate(side.t_from, side.t_to, std::sqrt(reach_squared));
  }
  return integrand.sum();
}

MassWithError coreOf(const EdgeSide& side) {
  SideIntegrand<false> integrand(side);
  const double reach = std::sqrt(std::max(0.0, kRangeSquared - side.inset * side.inset));
  if (side.inset != 0) {
    PanelQuadrature(integrand, 1e-18).integrate(side.t_from, side.t_to, reach);
  }
  MassWithError sum = integrand.sum();
  // Beyond, only the angle is left.
  const auto addAngle = [&](double from, double to) {
    if (from < to) sum.value += angleBetween(side.inset, from, to);
  };
  addAngle(side.t_from, std::min(side.t_to, -reach));
  addAngle(std::max(side.t_from, reach), side.t_to);
  sum.error += 2 * M_PI * 16 * kEpsilon * (side.t_from < -reach || side.t_to > reach) + 1e-19;
  return sum;
}

bool isTail(const FaceFrame& face) { return face.contour_distance >= kTailContour; }

MassWithError sideSum(const FaceFrame& face, const EdgeSide& side) {
  if (!isTail(face)) return coreOf(side);
  return tailOf(side, face.contour_distance * face.contour_distance);
}

// Of the sum over its sides.
MassWithError faceMass(const FaceFrame& face, const MassWithError& sides) {
  const double angle = isTail(face) ? face.angle - sides.value : sides.value;
  const double density = normalDensity(face.height);
  MassWithError mass;
  mass.value = density * angle / (2 * M_PI);
  mass.error = density * (1.01 * sides.error + 4 * kEpsilon * face.angle) / (2 * M_PI) +
               (16 + 4 * face.height * face.height) * kEpsilon * std::abs(mass.value);
  return mass;
}

}  // namespace

std::vector<MassWithError> faceMasses(const PolytopeBoundary& boundary) {
  std::vector<MassWithError> masses(boundary.faces.size());
  for (const BoundaryEdge& edge : boundary.edges) {
    for (const EdgeSide& side : edge.sides) {
      const std::size_t face = static_cast<std::size_t>(side.face);
      const MassWithError part = sideSum(boundary.faces[face], side);
      masses[face].value += part.value;
      masses[face].error += part.error;
    }
  }
  for (std::size_t f = 0; f < masses.size(); ++f) {
    masses[f] = faceMass(boundary.faces[f], masses[f]);
  }
  return masses;
}

}  // namespace fcl_prob::detail
