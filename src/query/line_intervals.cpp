// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "query/line_intervals.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/constants.h"
#include "fcl_prob/normal_mass.h"
#include "gaussian/normal_density.h"

namespace fcl_prob::detail {
namespace {

constexpr double kLargestDensity = 0.4;  // 1/sqrt(2 pi), rounded up

// Widens by what rounding may have left out of a sum of masses.
Bounds widened(double lower, double upper, std::size_t terms) {
  const double error = (4.0 + static_cast<double>(terms)) * kIntervalMassRelativeError;
  return {std::clamp(lower * (1.0 - error) - kUnderflow, 0.0, 1.0),
          std::clamp(upper * (1.0 + error) + std::numeric_limits<double>::min(), 0.0, 1.0)};
}

}  // namespace

DisplacementAlong::DisplacementAlong(const GaussianDisplacement& displacement,
                                     const Eigen::Vector3d& direction)
    : mean_(direction.dot(displacement.mean())) {
  const Eigen::Vector3d& deviations = displacement.standardDeviations();
  deviation_ = deviations.cwiseProduct(displacement.axes().transpose() * direction).stableNorm();
  // Three components, each a sum of three products that is scaled and squared: the deviation is off
  // by less than 16 ε of the largest one, the mean by less than 8 ε of its terms.
  deviation_error_ = 16 * kEpsilon * deviations.maxCoeff();
  mean_error_ = 8 * kEpsilon * direction.cwiseAbs().dot(displacement.mean().cwiseAbs());
}

// Bounds on (end - mean) / deviation.
Bounds DisplacementAlong::standardised(double end, double error) const {
  const double distance = end - mean_;
  if (std::isinf(distance)) return {distance, distance};
  const double margin = error + mean_error_ + 2 * kEpsilon * (std::fabs(end) + std::fabs(mean_));
  const double most = deviation_ + deviation_error_;
  const double least = std::max(deviation_ - deviation_error_, 0.0);
  // Without motion a distance is infinitely many deviations; `away` rounds outwards.
  const auto divided = [](double x, double by, double away) {
    const double z = x == 0.0 ? 0.0 : x / by;
    return std::isinf(z) ? z : z + away * 4 * kEpsilon * std::fabs(z);
  };
  const double below = distance - margin;
  const double above = distance + margin;
  return {divided(below, below > 0.0 ? most : least, -1.0),
          divided(above, above > 0.0 ? least : most, 1.0)};
}

// Bound on the probability density of the variable within `error` of a point.
double DisplacementAlong::densityBound(double at, double error) const {
  const double least = deviation_ - deviation_error_;
  if (!(least > 0.0)) return kInfinity;
  const Bounds z = standardised(at, 2 * error);
  const double nearest = std::max({z.lower, -z.upper, 0.0});
  return kLargestDensity * std::exp(-0.5 * nearest * nearest) / least;
}

// Sorted and disjoint. Ends that are equal up to rounding count as touching, and are noted.
DisplacementAlong::Union DisplacementAlong::unite(std::vector<LineInterval> intervals,
                                                  double error) {
  std::sort(intervals.begin(), intervals.end(),
            [](const LineInterval& x, const LineInterval& y) { return x.lo < y.lo; });
  Union united;
  for (const LineInterval& next : intervals) {
    if (united.intervals.empty() || next.lo > united.intervals.back().hi) {
      united.intervals.push_back(next);
      continue;
    }
    LineInterval& last = united.intervals.back();
    if (next.hi <= last.hi) continue;
    if (next.lo > last.hi - 2 * error) united.joints.push_back(next.lo);
    last.hi = next.hi;
  }
  return united;
}

Bounds DisplacementAlong::mass(std::vector<LineInterval> intervals, double error) const {
  const Union united = unite(std::move(intervals), error);
  double lower = 0.0;
  double upper = 0.0;
  for (const LineInterval& interval : united.intervals) {
    const Bounds from = standardised(interval.lo, error);
    const Bounds to = standardised(interval.hi, error);
    lower += normalIntervalMass(from.upper, to.lower);
    upper += normalIntervalMass(from.lower, to.upper);
  }
  // What seems to touch may in truth leave a gap of twice the error.
  for (const double joint : united.joints) lower -= 2 * error * densityBound(joint, error);
  return widened(lower, upper, united.intervals.size() + united.joints.size());
}

Bounds DisplacementAlong::slope(std::vector<LineInterval> intervals, double error) const {
  const double least = deviation_ - deviation_error_;
  if (!(least > 0.0)) return {-kInfinity, kInfinity};
  const Union united = unite(std::move(intervals), error);
  double sum = 0.0;
  double margin = 0.0;
  const auto add = [&](double end, double sign) {
    if (std::isinf(end)) return;
    const Bounds z = standardised(end, error);
    const double density = normalDensity(z.middle());
    sum += sign * density;
    // The density's derivative is at most 0.25.
    margin += 0.25 * z.width() + 8 * kEpsilon * (1.0 + z.middle() * z.middle()) * density;
  };
  for (const LineInterval& interval : united.intervals) {
    add(interval.lo, 1.0);
    add(interval.hi, -1.0);
  }
  margin += static_cast<double>(united.joints.size()) * error / least;
  const double value = sum / deviation_;
  margin = margin / least + (deviation_error_ / least + 4 * kEpsilon) * std::fabs(value);
  return {value - margin, value + margin};
}

}  // namespace fcl_prob::detail
