// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "partition/cell_sampling.h"

#include <Random123/philox.h>

#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>

#include "fcl_prob/normal_mass.h"

namespace fcl_prob::detail {

namespace {

constexpr double kSqrt2 = 1.41421356237309504880;

// Boost would compute in long double, at three times the cost.
using InDouble = boost::math::policies::policy<boost::math::policies::promote_double<false>>;

// The point of [lo, hi] below which lies the share `u` of the interval's normal mass.
double truncatedNormal(double lo, double hi, double u) {
  if (lo + hi > 0) return -truncatedNormal(-hi, -lo, 1.0 - u);
  // On the side of the lower tail: Φ(y) = Φ(lo) + u (Φ(hi) - Φ(lo)).
  const double mass = normalTailMass(-lo) + u * normalIntervalMass(lo, hi);
  if (!(mass > 0.0)) return hi;
  const double y = -kSqrt2 * boost::math::erfc_inv(2.0 * std::min(mass, 0.999999), InDouble());
  return std::clamp(y, lo, hi);
}

// Sets of samples a cell: their differences give the variance.
constexpr int kSets = 8;

// No cell gets more samples than this in one set.
constexpr double kMostInSet = 4096;

// A point of the unit cube for one set of samples of a cell.
Eigen::Vector3d uniformPoint(std::uint64_t seed, std::uint64_t cell, std::uint64_t set) {
  using Generator = r123::Philox4x64;
  Generator generator;
  const Generator::ctr_type counter = {{cell, set, 0x63656c6c, 0}};
  const Generator::key_type key = {{seed, 0}};
  const Generator::ctr_type bits = generator(counter, key);
  Eigen::Vector3d point;
  for (int k = 0; k < 3; ++k) {
    point[k] = (static_cast<double>(bits[static_cast<std::size_t>(k)] >> 11) + 0.5) * 0x1p-53;
  }
  return point;
}

// Point `index` of an additive sequence that fills the unit cube evenly: multiples of the powers of
// 1 / 1.2207..., the root of x⁴ = x + 1, shifted at random, which makes each of them uniform
// (Cranley and Patterson 1976).
Eigen::Vector3d evenPoint(const Eigen::Vector3d& shift, int index) {
  static const Eigen::Vector3d step(0.8191725133961645, 0.6710436067037893, 0.5497004779019703);
  Eigen::Vector3d point = shift + index * step;
  for (int k = 0; k < 3; ++k) {
    point[k] = std::clamp(point[k] - std::floor(point[k]), 0x1p-54, 1.0 - 0x1p-53);
  }
  return point;
}

// Of the mean of samples that all collide, or none of which does: as if the next two were one of
// each kind (Laplace's rule of succession), and no more than the open mass can vary.
double varianceWhereAllAgree(const OpenCell& cell, int samples) {
  if (!(cell.drawn > 0.0)) return 0.0;
  const double open_share = std::clamp(cell.gap() / cell.drawn, 0.0, 1.0);
  const double other = std::min(1.0 / (samples + 2.0), open_share);
  return cell.drawn * cell.drawn * other * (1.0 - other) / samples;
}

}  // namespace

SampledMass average(const SampledMass& a, const SampledMass& b) {
  SampledMass sum;
  sum.samples = a.samples + b.samples;
  const double share_a = static_cast<double>(a.samples) / static_cast<double>(sum.samples);
  const double share_b = 1.0 - share_a;
  sum.mass = share_a * a.mass + share_b * b.mass;
  sum.variance = share_a * share_a * a.variance + share_b * share_b * b.variance;
  sum.doubt = share_a * a.doubt + share_b * b.doubt;
  sum.moment = share_a * a.moment + share_b * b.moment;
  sum.moment_variance =
      share_a * share_a * a.moment_variance + share_b * share_b * b.moment_variance;
  sum.moment_doubt = share_a * a.moment_doubt + share_b * b.moment_doubt;
  return sum;
}

CellSampler::CellSampler(const WhitenedPair& pair, ObstacleTable& obstacles,
                         const SolidContact* solids, std::uint64_t seed)
    : tester_(pair, obstacles, solids), seed_(seed) {}

// A point of the uncertain part with the density of the normal distribution up to `weight`: the
// axis along which the plane is steepest is drawn last, between the planes.
CellSampler::Draw CellSampler::draw(const OpenCell& open, const Eigen::Vector3d& uniform) const {
  const Cell& cell = open.cell;
  Draw result{Eigen::Vector3d::Zero(), 1.0};
  int steepest = -1;
  if (open.has_plane) {
    steepest = 0;
    for (int k = 1; k < cell.rank; ++k) {
      if (std::fabs(open.plane.m[k]) > std::fabs(open.plane.m[steepest])) steepest = k;
    }
  }
  double along = 0.0;
  for (int k = 0; k < cell.rank; ++k) {
    if (k == steepest) continue;
    result.point[k] = truncatedNormal(cell.lo[k], cell.hi[k], uniform[k]);
    result.weight *= normalIntervalMass(cell.lo[k], cell.hi[k]);
    if (open.has_plane) along += open.plane.m[k] * result.point[k];
  }
  if (steepest < 0) return result;
  const double slope = open.plane.m[steepest];
  double lo = (open.possible_from - along) / slope;
  const double end = open.plane_covers ? open.plane.s : 2 * kReach;
  double hi = (end - along) / slope;
  if (slope < 0) std::swap(lo, hi);
  lo = std::clamp(lo, cell.lo[steepest], cell.hi[steepest]);
  hi = std::clamp(hi, cell.lo[steepest], cell.hi[steepest]);
  result.weight *= normalIntervalMass(lo, hi);
  result.point[steepest] = hi > lo ? truncatedNormal(lo, hi, uniform[steepest]) : lo;
  return result;
}

// Means and spreads are updated set by set (Welford): a difference of sums of squares may come out
// negative where all sets agree.
CellSampler::CellMeans CellSampler::sampleCell(const OpenCell& cell, std::uint64_t index,
                                               int in_set) {
  points_.clear();
  weights_.clear();
  const PartMeasure measure(cell.cell);
  for (int set = 0; set < kSets; ++set) {
    const std::uint64_t number = kSets * calls_ + static_cast<std::uint64_t>(set);
    const Eigen::Vector3d shift = uniformPoint(seed_, index, number);
    for (int i = 0; i < in_set; ++i) {
      const Draw drawn = draw(cell, evenPoint(shift, i));
      const bool counted = drawn.weight > 0.0 && !measure.counts(cell.part, drawn.point);
      points_.push_back({drawn.point, !counted, false});
      weights_.push_back(counted ? drawn.weight / in_set : 0.0);
    }
  }
  tester_.test(cell.front, points_);
  CellMeans means;
  std::size_t hits = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    hits += points_[i].collides && weights_[i] > 0.0;
    if (points_[i].doubtful) means.doubt += weights_[i] / kSets;
  }
  means.agree = hits == 0 || hits == points_.size();
  for (int set = 0; set < kSets; ++set) {
    double mass = 0.0;
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();
    for (int i = set * in_set; i < (set + 1) * in_set; ++i) {
      if (!points_[i].collides) continue;
      mass += weights_[i];
      moment += weights_[i] * points_[i].y;
    }
    const double share = 1.0 / (set + 1);
    const double off = mass - means.mass;
    const Eigen::Vector3d moment_off = moment - means.moment;
    means.mass += share * off;
    means.mass_spread += set * share * off * off;
    means.moment += share * moment_off;
    means.moment_spread += set * share * moment_off.cwiseAbs2();
  }
  return means;
}

SampledMass CellSampler::sample(const std::vector<OpenCell>& cells, double count) {
  double deviation = 0.0;
  for (const OpenCell& cell : cells) deviation += cell.samplingDeviation();
  const double sets_per_deviation = deviation > 0.0 ? count / kSets / deviation : 0.0;
  constexpr double kVariance = 1.0 / (kSets * (kSets - 1.0));
  SampledMass total;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const double in_set = sets_per_deviation * cells[i].samplingDeviation();
    const int n = static_cast<int>(std::clamp(std::ceil(in_set), 1.0, kMostInSet));
    const CellMeans means = sampleCell(cells[i], i, n);
    total.mass += means.mass;
    const double least = means.agree ? varianceWhereAllAgree(cells[i], kSets * n) : 0.0;
    total.variance += std::max(least, kVariance * means.mass_spread);
    total.moment += means.moment;
    const Eigen::Vector3d least_moment = least * cells[i].cell.largestCoordinates().cwiseAbs2();
    total.moment_variance += (kVariance * means.moment_spread).cwiseMax(least_moment);
    total.doubt += means.doubt;
    total.moment_doubt += means.doubt * cells[i].cell.largestCoordinates();
    total.samples += kSets * static_cast<std::size_t>(n);
  }
  ++calls_;
  return total;
}

}  // namespace fcl_prob::detail
