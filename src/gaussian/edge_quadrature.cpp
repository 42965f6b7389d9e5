// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "gaussian/edge_quadrature.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "gaussian/boundary_kernel.h"
#include "gaussian/gauss_legendre.h"

namespace fcl_prob::detail {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// Where r²/2 exceeds its least value by this, the tail kernel is below 1e-20 of its largest value.
constexpr double kTailRange = 47;

// Where the tail kernel itself is below 1e-20.
constexpr double kCoreReachSquared = 90;

// Splitting erfc(|h|)/|h| off costs digits where the integrand is far below it.
constexpr double kSplitReachSquared = 2.5;

// Below all masses that are told from zero.
constexpr double kLeastTolerance = 1e-315;

constexpr int kMaxDepth = 12;

constexpr unsigned kFewPoints = 10;
constexpr unsigned kManyPoints = 20;

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

struct Panel {
  double from, to;
  bool is_first, is_last;  // ends of the edge, where each side has its own position

  double centre() const { return 0.5 * (from + to); }
  double half() const { return 0.5 * (to - from); }
  double sideFrom(const Side& side) const { return is_first ? side.t_from : from; }
  double sideTo(const Side& side) const { return is_last ? side.t_to : to; }
};

// Least Re z² over the ellipse about the panel's centre.
double leastRealSquare(double centre, const BernsteinEllipse& ellipse) {
  const double a2 = ellipse.real_axis * ellipse.real_axis;
  const double b2 = ellipse.imaginary_axis * ellipse.imaginary_axis;
  const double c = std::abs(centre);
  if (c * ellipse.real_axis >= a2 + b2) return (c - ellipse.real_axis) * (c - ellipse.real_axis);
  return b2 * (c * c / (a2 + b2) - 1);
}

// How a panel is integrated: with which rule, and which sides have their pole split off.
struct Plan {
  unsigned points = 0;
  std::array<bool, 2> split{};
  double error = std::numeric_limits<double>::infinity();
};

double rhoOf(double half, double imaginary_axis) {
  const double ratio = imaginary_axis / half;
  return ratio + std::sqrt(ratio * ratio + 1);
}

double leastSquareOf(const Panel& panel) {
  if (panel.from <= 0 && panel.to >= 0) return 0;
  const double t = std::min(std::abs(panel.from), std::abs(panel.to));
  return t * t;
}

// The integrals along one edge, by bisection of panels until the proven error is small enough.
template <class Kernel, bool kIsTail>
class EdgeIntegral {
 public:
  EdgeIntegral(const PolytopeBoundary& boundary, const BoundaryEdge& edge, double tolerance)
      : edge_(edge),
        sides_{makeSide<Kernel>(boundary, edge.sides[0]),
               makeSide<Kernel>(boundary, edge.sides[1])},
        tolerance_(tolerance) {}

  void integrate(const Panel& panel, int depth = 0) {
    const Plan plan = bestPlan(panel);
    if (plan.error > tolerance_ && depth < kMaxDepth) {
      const double middle = panel.centre();
      integrate({panel.from, middle, panel.is_first, false}, depth + 1);
      integrate({middle, panel.to, false, panel.is_last}, depth + 1);
      return;
    }
    sum_.quadrature_error += plan.error;
    if (plan.points == kFewPoints) {
      evaluate<kFewPoints>(panel, plan);
    } else {
      evaluate<kManyPoints>(panel, plan);
    }
    for (std::size_t k = 0; k < 2; ++k) {
      if (kIsTail && plan.split[k]) addAngle(panel, sides_[k]);
      if (panel.is_first) addGap(sides_[k], panel.from, sides_[k].from_error, plan.split[k]);
      if (panel.is_last) addGap(sides_[k], panel.to, sides_[k].to_error, plan.split[k]);
    }
  }

  const std::array<Side, 2>& sides() const { return sides_; }
  EdgeSum& sum() { return sum_; }

 private:
  // How far the integrand is analytic: the tail kernel is singular at r = 0, and a side whose pole
  // cannot be split off at t = ±i inset.
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

  Plan bestPlan(const Panel& panel) const {
    const double least_square = leastSquareOf(panel);
    const double reach = analyticReach(least_square);
    Plan best;
    for (const unsigned points : {kFewPoints, kManyPoints}) {
      // Where exp(b²/2) rho^(-2n) is least for a short panel.
      double imaginary_axis = std::min(0.9 * std::sqrt(2.0 * points), 0.8 * reach);
      for (int attempt = 0; attempt < 3; ++attempt, imaginary_axis *= 0.6) {
        const Plan plan = planWith(panel, points, imaginary_axis, least_square);
        if (plan.error < best.error) best = plan;
        if (best.error <= tolerance_) return best;
      }
    }
    return best;
  }

  Plan planWith(const Panel& panel, unsigned points, double imaginary_axis,
                double least_square) const {
    Plan plan;
    plan.points = points;
    const double rho = rhoOf(panel.half(), imaginary_axis);
    const double square = leastRealSquare(panel.centre(), BernsteinEllipse(panel.half(), rho));
    double maximum = 0;
    for (std::size_t k = 0; k < 2; ++k) {
      maximum += sideMaximum(sides_[k], square, least_square, plan.split[k]);
    }
    plan.error = gaussErrorBound(points, panel.half(), rho, maximum);
    return plan;
  }

  // Bound on a side's integrand where Re z² >= square.
  double sideMaximum(const Side& side, double square, double least_square, bool& split) const {
    if (side.factor == 0) {
      // Nothing to integrate, but the edge may pass through the foot: then it has half the angle.
      split = kIsTail && side.height > 0 && side.inset_squared + least_square <= kSplitReachSquared;
      return 0;
    }
    const double scale = std::abs(side.factor);
    const double real_square = edge_.distance_squared + square;
    const double height_squared = side.height * side.height;
    if constexpr (kIsTail) {
      double direct = std::numeric_limits<double>::infinity();
      if (!(real_square > 0)) return direct;
      const double pole = side.inset_squared + square;
      if (pole > 0) direct = scale * Kernel::bound(real_square) / pole;
      if (side.inset_squared + least_square > kSplitReachSquared) return direct;
      const double smooth = scale * Kernel::derivativeBound(std::min(real_square, height_squared));
      split = smooth < direct;
      return std::min(smooth, direct);
    } else {
      split = true;
      return scale * Kernel::derivativeBound(std::min(real_square, height_squared));
    }
  }

  template <unsigned kPoints>
  void evaluate(const Panel& panel, const Plan& plan) {
    forEachGaussNode<kPoints>(panel.centre(), panel.half(), [&](double t, double weight) {
      const double t_squared = t * t;
      const double r_squared = edge_.distance_squared + t_squared;
      const double r = std::sqrt(r_squared);
      const double at_r = Kernel::radial(r);
      addFieldLength(r, r_squared, at_r, weight);
      for (std::size_t k = 0; k < 2; ++k) {
        if (sides_[k].factor != 0) {
          addNode(sides_[k], plan.split[k], weight, t_squared, r, r_squared, at_r);
        }
      }
    });
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
    const double angle = angleBetween(side.inset, panel.sideFrom(side), panel.sideTo(side));
    sum_.value += side.sign * side.at_height * angle;
    sum_.rounding_error +=
        (16 + 4 * side.height * side.height) * kEpsilon * side.at_height * (1 + std::abs(angle));
  }

  // Where the ends of the edge are off by `gap`, the face's contour does not quite close.
  void addGap(const Side& side, double t, double gap, bool split) {
    const double r_squared = edge_.distance_squared + t * t;
    const double bound =
        split ? Kernel::derivativeBound(std::min(r_squared, side.height * side.height))
              : Kernel::bound(r_squared) / (side.inset_squared + t * t);
    if (side.factor != 0) sum_.rounding_error += gap * std::abs(side.factor) * bound;
  }

  const BoundaryEdge& edge_;
  std::array<Side, 2> sides_;
  double tolerance_;
  EdgeSum sum_;
};

// Runs the quadrature over the part of the edge with |t| <= reach, in panels of a few units.
template <class Integral>
void integrateWithin(Integral& integral, const BoundaryEdge& edge, double reach) {
  const double from = std::max(edge.t_from, -reach);
  const double to = std::min(edge.t_to, reach);
  if (!(from < to)) return;
  constexpr double kPanelWidth = 3.0;
  const int count = std::max(1, static_cast<int>(std::ceil((to - from) / kPanelWidth)));
  for (int k = 0; k < count; ++k) {
    const double left = from + (to - from) * k / count;
    const double right = k + 1 == count ? to : from + (to - from) * (k + 1) / count;
    integral.integrate(
        {left, right, k == 0 && from == edge.t_from, k + 1 == count && to == edge.t_to});
  }
}

// Beyond the reach of the tail kernel erf(r)/r is 1/r, whose integral is the angle ψ.
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
  const double tolerance = std::max(
      1e-18 * scale / ((1 + boundary.distance) * (1 + boundary.distance)), kLeastTolerance);
  EdgeIntegral<TailKernel, true> integral(boundary, edge, tolerance);
  const double reach_squared = nearest_squared + 2 * kTailRange - edge.distance_squared;
  // |h ∫ k dθ| <= π erfc(r/√2) on either side of what is left out.
  integral.sum().quadrature_error += 4 * M_PI * std::exp(-kTailRange) * scale;
  if (reach_squared > 0) integrateWithin(integral, edge, std::sqrt(reach_squared));
  return integral.sum();
}

EdgeSum integrateCore(const PolytopeBoundary& boundary, const BoundaryEdge& edge) {
  EdgeIntegral<CoreKernel, false> integral(boundary, edge, 1e-18);
  const double reach = std::sqrt(std::max(0.0, kCoreReachSquared - edge.distance_squared));
  integrateWithin(integral, edge, reach);
  const double far_field = M_PI / std::sqrt(edge.distance_squared + reach * reach);
  for (const Side& side : integral.sides()) {
    integral.sum().field_length += far_field * side.deviation;  // ∫ dt/r² over |t| > reach
    addFarPart(side, edge.distance_squared, edge.t_from, std::min(edge.t_to, -reach),
               integral.sum());
    addFarPart(side, edge.distance_squared, std::max(edge.t_from, reach), edge.t_to,
               integral.sum());
  }
  return integral.sum();
}

}  // namespace fcl_prob::detail
