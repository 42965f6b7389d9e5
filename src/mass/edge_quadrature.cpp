// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "mass/edge_quadrature.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/constants.h"
#include "gaussian/panel_quadrature.h"
#include "mass/boundary_kernel.h"

namespace fcl_prob::detail {
namespace {

// Where r²/2 exceeds its least value by this, the tail kernel is below 1e-20 of its largest value.
constexpr double kTailRange = 47;

// Where the tail kernel itself is below 1e-20.
constexpr double kCoreReachSquared = 90;

// Splitting erfc(|h|)/|h| off costs digits where the integrand is far below it.
constexpr double kSplitReachSquared = 2.5;

// A side of the edge with what its integrand needs.
struct Side : EdgeSide {
  double factor = 0.0;  // h e; 0 if there is nothing to integrate
  double inset_squared = 0.0;
  double height = 0.0;     // |h|
  double sign = 1.0;       // of h
  double at_height = 0.0;  // radial kernel
  double deviation = 0.0;
};

template <class Kernel>
Side makeSide(const PolytopeBoundary& boundary, const EdgeSide& side) {
  const FaceFrame& face = boundary.faces[static_cast<std::size_t>(side.face)];
  Side result{side};
  result.factor = face.height * side.inset;
  result.inset_squared = side.inset * side.inset;
  result.height = std::abs(face.height);
  result.sign = face.height < 0 ? -1 : 1;
  result.at_height = Kernel::radial(result.height);
  result.deviation = face.deviation;
  return result;
}

// What is integrated along one edge, for both of its sides: the kernel is the same.
template <class Kernel, bool kIsTail>
class EdgeIntegrand {
 public:
  /// Which sides have their pole at the foot split off.
  using Choice = std::array<bool, 2>;

  EdgeIntegrand(const PolytopeBoundary& boundary, const BoundaryEdge& edge)
      : edge_(edge),
        sides_{makeSide<Kernel>(boundary, edge.sides[0]),
               makeSide<Kernel>(boundary, edge.sides[1])} {}

  const std::array<Side, 2>& sides() const { return sides_; }
  EdgeSum& sum() { return sum_; }
  void addError(double error) { sum_.quadrature_error += error; }

  // The tail kernel is singular at r = 0, and a side whose pole cannot be split off at t = ±i
  // inset.
  double analyticReach(double least_square) const {
    if (!kIsTail) return std::numeric_limits<double>::infinity();
    double reach_squared = edge_.distance_squared + least_square;
    for (const Side& side : sides_) {
      const double pole_squared = side.inset_squared + least_square;
      if (side.factor != 0 && pole_squared > kSplitReachSquared) {
        reach_squared = std::min(reach_squared, pole_squared);
      }
    }
    return std::sqrt(reach_squared);
  }

  double maximum(double square, double least_square, Choice& split) const {
    return sideMaximum(sides_[0], square, least_square, split[0]) +
           sideMaximum(sides_[1], square, least_square, split[1]);
  }

  template <unsigned kPoints>
  void evaluate(const Panel& panel, const Choice& split) {
    forEachGaussNode<kPoints>(panel.centre(), panel.half(), [&](double t, double weight) {
      const double t_squared = t * t;
      const double r_squared = edge_.distance_squared + t_squared;
      const double r = std::sqrt(r_squared);
      const double at_r = Kernel::radial(r);
      addFieldLength(r, r_squared, at_r, weight);
      for (std::size_t k = 0; k < 2; ++k) {
        if (sides_[k].factor != 0) {
          addNode(sides_[k], split[k], weight, t_squared, r, r_squared, at_r);
        }
      }
    });
    for (std::size_t k = 0; k < 2; ++k) {
      if (kIsTail && split[k]) addAngle(panel, sides_[k]);
      if (panel.is_first) addGap(sides_[k], panel.from, sides_[k].from_error, split[k]);
      if (panel.is_last) addGap(sides_[k], panel.to, sides_[k].to_error, split[k]);
    }
  }

 private:
  double sideMaximum(const Side& side, double square, double least_square, bool& split) const {
    const bool may_split = !kIsTail || side.inset_squared + least_square <= kSplitReachSquared;
    if (side.factor == 0) {
      // Nothing to integrate, but the edge may pass through the foot: then it has half the angle.
      split = may_split && side.height > 0;
      return 0;
    }
    const double scale = std::abs(side.factor);
    const double real_square = edge_.distance_squared + square;
    const double smooth_square = std::min(real_square, side.height * side.height);
    if constexpr (kIsTail) {
      double direct = std::numeric_limits<double>::infinity();
      if (!(real_square > 0)) return direct;
      const double pole = side.inset_squared + square;
      if (pole > 0) direct = scale * Kernel::bound(real_square) / pole;
      if (!may_split) return direct;
      const double smooth = scale * Kernel::derivativeBound(smooth_square);
      split = smooth < direct;
      return std::min(smooth, direct);
    } else {
      split = true;
      return scale * Kernel::derivativeBound(smooth_square);
    }
  }

  void addNode(const Side& side, bool split, double weight, double t_squared, double r,
               double r_squared, double at_r) {
    const double difference = side.inset_squared + t_squared;
    // Rounding of r² is amplified by the exponential only in the tail; -k'/k <= 1/2 + 1/s there,
    // and -E'/E <= 1/(2s).
    const double relative = kIsTail ? (16 + 4 * r_squared) * kEpsilon + 1.5 * side.mismatch
                                    : 16 * kEpsilon + side.mismatch * (1 + 1 / r_squared);
    double value, magnitude;
    if (split) {
      const Measured divided = Kernel::divided(at_r, r, side.at_height, side.height, difference);
      value = divided.value;
      magnitude = divided.magnitude;
    } else {
      value = magnitude = at_r / (r * difference);
    }
    const double scale = weight * side.factor;
    sum_.value += kIsTail ? scale * value : -scale * value;
    sum_.rounding_error += relative * std::abs(scale) * magnitude +
                           weight * side.height * side.inset_error * std::abs(value);
  }

  // 4π |F| = (mass beyond r) / r² in the tail, (mass within r) / r² otherwise, from above.
  void addFieldLength(double r, double r_squared, double at_r, double weight) {
    double field;
    if constexpr (kIsTail) {
      field = at_r * (2 + r_squared) / r_squared;  // by Mills' ratio
    } else {
      field = std::min(r / 3, 1 / r_squared);
    }
    sum_.field_length += weight * field * (sides_[0].deviation + sides_[1].deviation);
  }

  // The part erfc(|h|) ∫ dθ that was split off; in the core form it cancels for all edges together.
  void addAngle(const Panel& panel, const Side& side) {
    const double angle = angleBetween(side.inset, panel.is_first ? side.t_from : panel.from,
                                      panel.is_last ? side.t_to : panel.to);
    sum_.value += side.sign * side.at_height * angle;
    sum_.rounding_error +=
        (16 + 4 * side.height * side.height) * kEpsilon * side.at_height * (1 + std::abs(angle));
  }

  // Where the ends of the edge are off by `gap`, the face's contour does not quite close.
  void addGap(const Side& side, double t, double gap, bool split) {
    if (side.factor == 0) return;
    const double r_squared = edge_.distance_squared + t * t;
    const double bound =
        split ? Kernel::derivativeBound(std::min(r_squared, side.height * side.height))
              : Kernel::bound(r_squared) / (side.inset_squared + t * t);
    sum_.rounding_error += gap * std::abs(side.factor) * bound;
  }

  const BoundaryEdge& edge_;
  std::array<Side, 2> sides_;
  EdgeSum sum_;
};

// Beyond the reach of the tail kernel erf(r)/r is 1/r, whose integral is a solid angle.
void addFarPart(const Side& side, double distance_squared, double t_from, double t_to,
                EdgeSum& sum) {
  if (side.factor == 0 || !(t_from < t_to)) return;
  const double inset = std::abs(side.inset);
  const auto solid_angle = [&](double t) {
    return std::atan2(side.height * t, inset * std::sqrt(distance_squared + t * t));
  };
  const double angle = angleBetween(inset, t_from, t_to);
  const double value = side.at_height * angle - (solid_angle(t_to) - solid_angle(t_from));
  sum.value += (side.factor < 0 ? -value : value);
  sum.rounding_error += 16 * kEpsilon * 2 * M_PI;
  sum.quadrature_error += 1e-20 * 2 * M_PI;
}

}  // namespace

EdgeSum& EdgeSum::operator+=(const EdgeSum& other) {
  value += other.value;
  quadrature_error += other.quadrature_error;
  rounding_error += other.rounding_error;
  field_length += other.field_length;
  return *this;
}

EdgeSum integrateTail(const PolytopeBoundary& boundary, const BoundaryEdge& edge) {
  const double nearest_squared = boundary.distance * boundary.distance;
  const double scale = std::exp(-0.5 * nearest_squared);
  const double tolerance =
      1e-18 * scale / ((1 + boundary.distance) * (1 + boundary.distance)) + kLeastTolerance;
  EdgeIntegrand<TailKernel, true> integrand(boundary, edge);
  // |h ∫ k dθ| <= π erfc(r/√2) on either side of what is left out.
  integrand.addError(4 * M_PI * std::exp(-kTailRange) * scale);
  const double reach_squared = nearest_squared + 2 * kTailRange - edge.distance_squared;
  if (reach_squared > 0) {
    PanelQuadrature(integrand, tolerance)
        .integrate(edge.t_from, edge.t_to, std::sqrt(reach_squared));
  }
  return integrand.sum();
}

EdgeSum integrateCore(const PolytopeBoundary& boundary, const BoundaryEdge& edge) {
  EdgeIntegrand<CoreKernel, false> integrand(boundary, edge);
  const double reach = std::sqrt(std::max(0.0, kCoreReachSquared - edge.distance_squared));
  PanelQuadrature(integrand, 1e-18).integrate(edge.t_from, edge.t_to, reach);
  EdgeSum& sum = integrand.sum();
  const double far_field = M_PI / std::sqrt(edge.distance_squared + reach * reach);
  for (const Side& side : integrand.sides()) {
    sum.field_length += far_field * side.deviation;  // ∫ dt/r² over |t| > reach
    addFarPart(side, edge.distance_squared, edge.t_from, std::min(edge.t_to, -reach), sum);
    addFarPart(side, edge.distance_squared, std::max(edge.t_from, reach), edge.t_to, sum);
  }
  return sum;
}

}  // namespace fcl_prob::detail
