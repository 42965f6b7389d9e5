// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Products of Gauss-Legendre rules over boxes of a solid part, and how many points they need.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/constants.h"
#include "gaussian/density_kernel.h"
#include "gaussian/gauss_legendre.h"
#include "gaussian/normal_density.h"
#include "mass/solid_part.h"

namespace fcl_prob::detail {

inline constexpr unsigned kMostPartPoints = kMostDensityNodes;
inline constexpr double kDensityScale = kInverseSqrtTwoPi * kInverseSqrtTwoPi * kInverseSqrtTwoPi;

/// Of bounds, for the rounding of what they are made of.
inline constexpr double kBoundSlack = 1.0 + 1e-9;

/// A rule on [-1, 1].
struct PartRule {
  std::vector<double> nodes, weights;
};

double logOfEllipse(std::size_t ellipse);

/// The rule of n points, n up to kMostPartPoints.
const PartRule& partRule(double points);

inline double supremumOf(const PartBound& bound) {
  const double distance = std::max(bound.distance, 0.0);
  return bound.weight * std::exp(0.5 * (bound.growth - distance * distance));
}

inline double volumeOf(const ParameterBox& box) {
  return 8.0 * box.half[0] * box.half[1] * box.half[2];
}

inline double scaleOf(const SolidPart& part) {
  return kDensityScale * (std::abs(part.factor) + part.factor_error);
}

/// The nearest to the origin of a few points of a part, and how far others are from their middle.
struct NearPoint {
  Eigen::Vector3d point;
  double spread;
};

template <class Part>
NearPoint nearPoint(const Part& part, const ParameterBox& box) {
  const double from = box.centre[2] - box.half[2], to = box.centre[2] + box.half[2];
  const auto nearest = [&](double first, double second) -> Eigen::Vector3d {
    const PartLine line =
        part.rowAt(box.centre[1] + second * box.half[1]).at(box.centre[0] + first * box.half[0]);
    const double rho =
        std::clamp(-line.point.dot(line.direction) / line.direction.squaredNorm(), from, to);
    return line.point + rho * line.direction;
  };
  const Eigen::Vector3d middle = nearest(0.0, 0.0);
  NearPoint near{middle, 0.0};
  for (const double first : {-1.0, 1.0}) {
    for (const double second : {-1.0, 1.0}) {
      const Eigen::Vector3d y = nearest(first, second);
      near.spread = std::max(near.spread, (y - middle).squaredNorm());
      if (y.squaredNorm() < near.point.squaredNorm()) near.point = y;
    }
  }
  near.spread = std::sqrt(near.spread);
  return near;
}

inline Eigen::Vector3d directionOf(const Eigen::Vector3d& y) {
  const double length = y.norm();
  return length > 0.0 ? Eigen::Vector3d(y / length) : Eigen::Vector3d::Zero();
}

/// ρ of the Bernstein ellipses that are tried.
inline constexpr std::array<double, 11> kEllipses{1.6, 2.1,  2.7,  3.4,  4.3, 5.5,
                                                  7.5, 11.0, 17.0, 30.0, 70.0};

/// Which of them was best for each parameter the last time: where the next search begins.
using EllipseGuess = std::array<std::size_t, 3>;

/// Number of points with which gaussErrorBound() is `target`, and the error with them rounded up.
struct EllipseChoice {
  double points = kInfinity, error = kInfinity, reach = kInfinity;
};

/// \param log_target  of the error over half of the box's volume
template <class Cell>
EllipseChoice choiceWith(const Cell& cell, const ParameterBox& box, std::size_t k,
                         std::size_t ellipse, double log_target) {
  const double rho = kEllipses[ellipse];
  const BernsteinEllipse axes(box.half[k], rho);
  const PartBound bound =
      cell.bound(ComplexBox(box, static_cast<int>(k), axes.real_axis, axes.imaginary_axis));
  const double distance = std::max(bound.distance, 0.0);
  // gaussErrorBound() but for ρ^(-2n), by logarithms, as the density may be no number.
  const double constant = 64.0 / 15.0 / (1.0 - 1.0 / (rho * rho)) * kBoundSlack;
  const double excess =
      std::log(constant * bound.weight) + 0.5 * (bound.growth - distance * distance) - log_target;
  EllipseChoice choice;
  if (!(excess < kInfinity)) return choice;
  const double decay = 2.0 * logOfEllipse(ellipse);
  choice.points = std::max(1.0, std::ceil(excess / decay));
  choice.error = std::exp(excess - decay * choice.points);  // next to the target
  choice.reach = bound.reach;
  return choice;
}

/// A rule for one parameter: how many points, and the error that its bound leaves.
struct ParameterRule {
  double points = kInfinity, error = kInfinity, moment_error = kInfinity;
};

/// Which rules a box takes; errors are those of the integral without its factor.
struct PartPlan {
  std::array<double, 3> points{};
  double error = 0.0, moment_error = 0.0;

  std::size_t worst() const {
    return static_cast<std::size_t>(std::max_element(points.begin(), points.end()) -
                                    points.begin());
  }
  bool exists() const { return points[worst()] <= kMostPartPoints; }
};

/// The fewest points with which the bound is `target`: their number falls and then grows with the
/// ellipse; what is found on the way holds in any case.
template <class Cell>
ParameterRule fewestPoints(const Cell& cell, const ParameterBox& box, std::size_t k, double target,
                           std::size_t& guess) {
  const double log_target = std::log(target / (0.5 * volumeOf(box)));
  std::size_t at = guess;
  EllipseChoice best = choiceWith(cell, box, k, at, log_target);
  const auto improve = [&](std::size_t ellipse) {
    const EllipseChoice choice = choiceWith(cell, box, k, ellipse, log_target);
    const double fewer = best.points - choice.points;
    if (!(fewer > 0.0)) return false;
    best = choice;
    at = ellipse;
    // One point less is about what it costs to look on.
    return fewer > 1.0;
  };
  if (at > 0 && !(best.points < kInfinity)) {
    // What is unbounded on the least ellipse is so on all.
    improve(0);
    if (!(best.points < kInfinity)) return {};
  }
  const std::size_t start = at;
  while (at + 1 < kEllipses.size() && improve(at + 1)) {
  }
  while (at <= start && at > 0 && improve(at - 1)) {
  }
  guess = at;
  return {best.points, best.error * target, best.error * target * best.reach};
}

template <class Cell>
PartPlan planBox(const Cell& cell, const ParameterBox& box, double target, EllipseGuess& guess) {
  PartPlan plan;
  for (std::size_t k = 0; k < 3; ++k) {
    const ParameterRule rule = fewestPoints(cell, box, k, target, guess[k]);
    plan.points[k] = rule.points;
    plan.error += rule.error;
    plan.moment_error += rule.moment_error;
  }
  return plan;
}

/// A box cut in two across what asks for the most points or, where nothing is known of several,
/// across the longest of those.
inline std::array<ParameterBox, 2> halves(const ParameterBox& box, const PartPlan& plan) {
  std::size_t worst = plan.worst();
  for (std::size_t k = 0; k < 2; ++k) {
    if (plan.points[k] == kInfinity && box.half[k] > box.half[worst]) worst = k;
  }
  ParameterBox half = box;
  half.half[worst] *= 0.5;
  std::array<ParameterBox, 2> both{half, half};
  both[0].centre[worst] = box.centre[worst] - half.half[worst];
  both[1].centre[worst] = box.centre[worst] + half.half[worst];
  return both;
}

/// The nodes of a rule for the distance.
template <class Part>
DensityNodes distanceNodes(const ParameterBox& box, const PartRule& rule) {
  DensityNodes nodes;
  for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
    const double rho = box.centre[2] + box.half[2] * rule.nodes[k];
    double weight = box.half[2] * rule.weights[k];
    for (int power = 0; power < Part::kPowerOfDistance; ++power) weight *= rho;
    nodes.rho[k] = rho;
    nodes.weight[k] = weight;
  }
  nodes.count = static_cast<int>(rule.nodes.size());
  return nodes;
}

inline void addLine(const PartLine& line, double weight, DensityLines& lines) {
  for (int axis = 0; axis < 3; ++axis) {
    lines.point[axis][lines.count] = line.point[axis];
    lines.direction[axis][lines.count] = line.direction[axis];
  }
  lines.weight[lines.count++] = weight;
}

/// The lines of two rules for the other parameters.
template <class Part>
void addLines(const Part& part, const ParameterBox& box, const PartRule& first,
              const PartRule& second, DensityLines& lines) {
  for (std::size_t j = 0; j < second.nodes.size(); ++j) {
    const auto row = part.rowAt(box.centre[1] + box.half[1] * second.nodes[j]);
    const double weight = box.half[0] * box.half[1] * second.weights[j];
    for (std::size_t i = 0; i < first.nodes.size(); ++i) {
      const PartLine line = row.at(box.centre[0] + box.half[0] * first.nodes[i]);
      addLine(line, weight * first.weights[i] * line.weight, lines);
    }
  }
  const PartLine nothing{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 0.0};
  while (lines.count % 4 != 0) addLine(nothing, 0.0, lines);
}

/// What the rules make of a box, without the factor.
template <class Part>
DensitySums evaluateBox(const Part& part, const ParameterBox& box, const PartPlan& plan) {
  DensityLines lines;
  addLines(part, box, partRule(plan.points[0]), partRule(plan.points[1]), lines);
  return densityOfLines(lines, distanceNodes<Part>(box, partRule(plan.points[2])));
}

}  // namespace fcl_prob::detail
