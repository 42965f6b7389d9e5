// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "lines/corner_means.h"

#include <algorithm>
#include <cmath>

#include "convex/slab_kernels.h"
#include "fcl_prob/normal_mass.h"
#include "gaussian/normal_density.h"

namespace fcl_prob::detail {
namespace {

// Columns farther out have too little of the distribution for a mean place.
constexpr double kLeastMeasure = 1e-100;

// Of the mean place: what densities and masses are rounded by, with much to spare.
constexpr double kRoundedMean = 1e-12;

/// Where in an interval its mean is, as a share of the way, and how well that is known.
struct MeanShare {
  double share;
  double slack;
};

std::optional<MeanShare> meanShare(double lo, double hi) {
  const double measure = normalIntervalMass(lo, hi);
  if (lo <= -kReach || hi >= kReach || !(measure > kLeastMeasure)) return std::nullopt;
  const double mean = normalIntervalMoment(lo, hi) / measure;
  const double density = std::max(normalDensity(lo), normalDensity(hi));
  const double off = kRoundedMean * (1.0 + std::fabs(mean) + density / measure);
  return MeanShare{std::clamp((mean - lo) / (hi - lo), 0.0, 1.0), off / (hi - lo)};
}

}  // namespace

std::optional<CornerMeans> CornerMeans::of(const Column& column) {
  const auto first = meanShare(column.lo[0], column.hi[0]);
  const auto second = meanShare(column.lo[1], column.hi[1]);
  if (!first || !second) return std::nullopt;
  CornerMeans means;
  for (std::size_t k = 0; k < 4; ++k) {
    const bool high_first = (k & 1) != 0, high_second = (k & 2) != 0;
    means.corners_[k] = {high_first ? column.hi[0] : column.lo[0],
                         high_second ? column.hi[1] : column.lo[1]};
    means.weights_[k] = (high_first ? first->share : 1.0 - first->share) *
                        (high_second ? second->share : 1.0 - second->share);
  }
  means.slack_ = 4.0 * (first->slack + second->slack) + kRoundedMean;
  return means;
}

double CornerMeans::most(const CornerValues& of_corners) const {
  double mean = 0.0, largest = 0.0;
  for (std::size_t k = 0; k < 4; ++k) {
    mean += weights_[k] * of_corners[k];
    largest = std::max(largest, std::fabs(of_corners[k]));
  }
  return mean + slack_ * largest;
}

double CornerMeans::mostTail(const CornerValues& s) const {
  const double least = *std::min_element(s.begin(), s.end());
  if (least < 0.0) return normalTailMass(least);
  CornerValues tails;
  for (std::size_t k = 0; k < 4; ++k) tails[k] = normalTailMass(s[k]);
  return most(tails);
}

// Jensen's inequality.
double CornerMeans::leastTail(const CornerValues& s) const {
  const auto [least, largest] = std::minmax_element(s.begin(), s.end());
  return normalTailMass(*least < 0.0 ? *largest : most(s));
}

}  // namespace fcl_prob::detail
