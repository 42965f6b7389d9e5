// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Integrals along an edge by bisection of panels until a proven error bound is small enough.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "gaussian/gauss_legendre.h"

namespace fcl_prob::detail {

/// Below all masses that are told from zero.
inline constexpr double kLeastTolerance = 1e-315;

/// Part of an edge, in positions t relative to the foot of the origin on the edge's line.
struct Panel {
  double from = 0.0, to = 0.0;
  bool is_first = false, is_last = false;  ///< whether an end of the edge is an end of the panel

  double centre() const { return 0.5 * (from + to); }
  double half() const { return 0.5 * (to - from); }

  /// Least t² on the panel.
  double leastSquare() const {
    if (from <= 0 && to >= 0) return 0;
    const double t = std::min(std::abs(from), std::abs(to));
    return t * t;
  }
};

/// Least Re z² over the ellipse about `centre`.
inline double leastRealSquare(double centre, const BernsteinEllipse& ellipse) {
  const double a2 = ellipse.real_axis * ellipse.real_axis;
  const double b2 = ellipse.imaginary_axis * ellipse.imaginary_axis;
  const double c = std::abs(centre);
  if (c * ellipse.real_axis >= a2 + b2) return (c - ellipse.real_axis) * (c - ellipse.real_axis);
  return b2 * (c * c / (a2 + b2) - 1);
}

/// Integrates what `Integrand` evaluates. It has
///   Choice                                         how a panel is evaluated
///   double analyticReach(least_square)             how far from the panel it is analytic
///   double maximum(square, least_square, choice&)  bound on |f| where Re z² >= square; infinite if
///   f may
///                                                  be singular there; makes the best choice
///   void evaluate<kPoints>(panel, choice)          adds a Gauss rule's sum
///   void addError(error)                           adds the proven bound on the error of that sum
template <class Integrand>
class PanelQuadrature {
 public:
  PanelQuadrature(Integrand& integrand, double tolerance)
      : integrand_(integrand), tolerance_(tolerance) {}

  /// Over the part of [from, to] with |t| <= reach.
  void integrate(double from, double to, double reach) {
    const double left = std::max(from, -reach);
    const double right = std::min(to, reach);
    if (!(left < right)) return;
    const int count = std::max(1, static_cast<int>(std::ceil((right - left) / kPanelWidth)));
    double begin = left;
    for (int k = 1; k <= count; ++k) {
      const double end = k == count ? right : left + (right - left) * k / count;
      integratePanel({begin, end, k == 1 && left == from, k == count && right == to}, 0);
      begin = end;
    }
  }

 private:
  using Choice = typename Integrand::Choice;

  static constexpr double kPanelWidth = 3.0;
  static constexpr int kMaxDepth = 12;
  static constexpr unsigned kFewPoints = 10;
  static constexpr unsigned kManyPoints = 20;

  struct Plan {
    unsigned points = kFewPoints;
    double error = std::numeric_limits<double>::infinity();
    Choice choice{};
  };

  void integratePanel(const Panel& panel, int depth) {
    const Plan plan = bestPlan(panel);
    if (plan.error > tolerance_ && depth < kMaxDepth) {
      const double middle = panel.centre();
      integratePanel({panel.from, middle, panel.is_first, false}, depth + 1);
      integratePanel({middle, panel.to, false, panel.is_last}, depth + 1);
      return;
    }
    integrand_.addError(plan.error);
    if (plan.points == kFewPoints) {
      integrand_.template evaluate<kFewPoints>(panel, plan.choice);
    } else {
      integrand_.template evaluate<kManyPoints>(panel, plan.choice);
    }
  }

  Plan bestPlan(const Panel& panel) const {
    const double least_square = panel.leastSquare();
    const double reach = integrand_.analyticReach(least_square);
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
    const double ratio = imaginary_axis / panel.half();
    const double rho = ratio + std::sqrt(ratio * ratio + 1);
    const double square = leastRealSquare(panel.centre(), BernsteinEllipse(panel.half(), rho));
    Plan plan;
    plan.points = points;
    const double maximum = integrand_.maximum(square, least_square, plan.choice);
    plan.error = gaussErrorBound(points, panel.half(), rho, maximum);
    return plan;
  }

  Integrand& integrand_;
  double tolerance_;
};

}  // namespace fcl_prob::detail
