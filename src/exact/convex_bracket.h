// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The minimum of a convex function of one variable between two points.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

namespace fcl_prob::detail {

/// Where a convex function falls and where it rises, or one point twice where it does neither.
/// `Sample` has t, value and slope (any subgradient).
template <class Sample>
struct ConvexBracket {
  Sample lower, upper;

  /// Weight of the lower one in the convex combination that has no slope.
  double share() const {
    const double sum = upper.slope - lower.slope;
    return sum > 0.0 ? upper.slope / sum : 1.0;
  }

  /// Where the tangents of both meet.
  double crossing() const {
    const double sum = upper.slope - lower.slope;
    return lower.t + ((upper.value - lower.value) - upper.slope * (upper.t - lower.t)) / -sum;
  }

  const Sample& lowest() const { return lower.value <= upper.value ? lower : upper; }
  const Sample& flattest() const { return -lower.slope <= upper.slope ? lower : upper; }

  /// The least value that is known is no farther above the minimum, up to rounding.
  double gap() const {
    const double bottom = lower.value + lower.slope * (crossing() - lower.t);
    return lower.t < upper.t ? lowest().value - bottom : 0.0;
  }
};

/// Brackets the minimum by evaluating `at(t)`, until the gap is below a tolerance times 1 + |t| or
/// doubles give no more: what a bracket says holds in any case. Steps alternate between a little
/// more than the secant's (smooth functions: from both sides), where tangents meet (kinks) and
/// halves. \param bend  about the second derivative, or 0 \return nothing if it falls as far as |t|
/// = kFarthest
template <class Sample>
class BracketSearch {
 public:
  using Bracket = ConvexBracket<Sample>;

  template <class Evaluate>
  static std::optional<Bracket> run(const Evaluate& at, double guess, double bend,
                                    double tolerance) {
    std::optional<Bracket> bracket = enclose(at, guess, bend);
    if (bracket) refine(at, tolerance, *bracket);
    return bracket;
  }

 private:
  static constexpr double kFarthest = 1e9;
  static constexpr double kFirstStep = 0.1;
  static constexpr double kLeastStep = 1e-12;
  static constexpr int kMostSteps = 80;
  enum class Step { secant, tangents, half };

  static Step after(Step step) {
    if (step == Step::secant) return Step::tangents;
    return step == Step::tangents ? Step::half : Step::secant;
  }

  template <class Evaluate>
  static std::optional<Bracket> enclose(const Evaluate& at, double guess, double bend) {
    Sample near = at(guess);
    double step = bend > 0.0 ? 2.0 * std::abs(near.slope) / bend : kFirstStep;
    step = std::clamp(step, kLeastStep, kFirstStep) * (1.0 + std::abs(guess));
    const bool rises = near.slope > 0.0;
    while (near.slope != 0.0 && std::abs(near.t) < kFarthest) {
      const Sample next = at(near.t + (rises ? -step : step));
      if (rises ? next.slope <= 0.0 : next.slope >= 0.0) {
        return rises ? Bracket{next, near} : Bracket{near, next};
      }
      near = next;
      step *= 4.0;
    }
    if (near.slope != 0.0) return std::nullopt;
    return Bracket{near, near};
  }

  static double proposal(const Bracket& bracket, Step step) {
    const double width = bracket.upper.t - bracket.lower.t;
    if (step == Step::half) return bracket.lower.t + 0.5 * width;
    if (step == Step::tangents) return bracket.crossing();
    const double rise = (bracket.upper.slope - bracket.lower.slope) / width;
    const Sample& flat = bracket.flattest();
    const double steepest = std::max(-bracket.lower.slope, bracket.upper.slope);
    const double beyond = std::abs(flat.slope) < 0.1 * steepest ? 2.0 : 1.0;
    return flat.t - beyond * flat.slope / rise;
  }

  template <class Evaluate>
  static void refine(const Evaluate& at, double tolerance, Bracket& bracket) {
    const auto isOpen = [&] {
      return bracket.gap() > tolerance * (1.0 + std::abs(bracket.lowest().t));
    };
    Step step = Step::secant;
    for (int k = 0; k < kMostSteps && isOpen(); ++k) {
      double t = proposal(bracket, step);
      const auto isWithin = [&] { return bracket.lower.t < t && t < bracket.upper.t; };
      if (!isWithin()) t = proposal(bracket, Step::half);
      if (!isWithin()) return;
      const double width = bracket.upper.t - bracket.lower.t;
      const Sample sample = at(t);
      if (sample.slope <= 0.0) bracket.lower = sample;
      if (sample.slope >= 0.0) bracket.upper = sample;
      const bool is_poor = bracket.upper.t - bracket.lower.t > 0.3 * width;
      step = is_poor ? after(step) : Step::secant;
    }
  }
};

}  // namespace fcl_prob::detail
