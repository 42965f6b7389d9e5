// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "partition/cell_sampling.h"

#include <Random123/philox.h>

#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>

#include "cobstacle/cell_section.h"
#include "fcl_prob/normal_mass.h"

namespace fcl_prob::detail {

namespace {

constexpr double kSqrt2 = 1.41421356237309504880;

// The point of [lo, hi] below which lies the share `u` of the interval's normal mass.
double truncatedNormal(double lo, double hi, double u) {
  if (lo + hi > 0) return -truncatedNormal(-hi, -lo, 1.0 - u);
  // On the side of the lower tail: Φ(y) = Φ(lo) + u (Φ(hi) - Φ(lo)).
  const double mass = normalTailMass(-lo) + u * normalIntervalMass(lo, hi);
  if (!(mass > 0.0)) return hi;
  const double y = -kSqrt2 * boost::math::erfc_inv(2.0 * std::min(mass, 0.999999));
  return std::clamp(y, lo, hi);
}

// Three numbers in (0, 1) for a sample of a cell.
void uniforms(std::uint64_t seed, std::uint64_t cell, std::uint64_t sample, double* out) {
  using Generator = r123::Philox4x64;
  Generator generator;
  const Generator::ctr_type counter = {{cell, sample, 0x63656c6c, 0}};
  const Generator::key_type key = {{seed, 0}};
  const Generator::ctr_type bits = generator(counter, key);
  for (int k = 0; k < 3; ++k) {
    out[k] = (static_cast<double>(bits[static_cast<std::size_t>(k)] >> 11) + 0.5) * 0x1p-53;
  }
}

}  // namespace

CellSampler::CellSampler(const WhitenedPair& pair, ObstacleTable& obstacles,
                         const SolidContact* solids, std::uint64_t seed)
    : pair_(pair), obstacles_(obstacles), solids_(solids), seed_(seed) {}

// A point of the uncertain part with the density of the normal distribution up to `weight`: the
// axis along which the plane is steepest is drawn last, between the planes.
CellSampler::Draw CellSampler::draw(const OpenCell& open, const double* uniform) const {
  const Cell& cell = open.cell;
  Draw result{Eigen::Vector3d::Zero(), 1.0};
  int steepest = -1;
  if (open.has_plane) {
    steepest = 0;
    for (int k = 1; k < cell.rank; ++k) {
      if (std::fabs(open.covered.m[k]) > std::fabs(open.covered.m[steepest])) steepest = k;
    }
  }
  double along = 0.0;
  for (int k = 0; k < cell.rank; ++k) {
    if (k == steepest) continue;
    result.point[k] = truncatedNormal(cell.lo[k], cell.hi[k], uniform[k]);
    result.weight *= normalIntervalMass(cell.lo[k], cell.hi[k]);
    if (open.has_plane) along += open.covered.m[k] * result.point[k];
  }
  if (steepest < 0) return result;
  const double slope = open.covered.m[steepest];
  double lo = (open.possible_from - along) / slope;
  // To the sides of `within` the open part reaches above the plane.
  const double end = open.coversToTheSides() ? open.covered.s : 2 * kReach;
  double hi = (end - along) / slope;
  if (slope < 0) std::swap(lo, hi);
  lo = std::clamp(lo, cell.lo[steepest], cell.hi[steepest]);
  hi = std::clamp(hi, cell.lo[steepest], cell.hi[steepest]);
  result.weight *= normalIntervalMass(lo, hi);
  result.point[steepest] = hi > lo ? truncatedNormal(lo, hi, uniform[steepest]) : lo;
  return result;
}

bool CellSampler::collides(const FrontPair& first, const CellBox& point) {
  if (first.isHalfSpace()) {
    return slabKernels().classify(obstacles_.slabs(first.obstacle), point).relation !=
           CellRelation::outside;
  }
  stack_.assign(1, first);
  while (!stack_.empty()) {
    const FrontPair pair = stack_.back();
    stack_.pop_back();
    const NodeBox box = obstacleBox(pair_, pair.nodes);
    bool outside = false;
    for (int k = 0; k < 3; ++k) {
      outside = outside || point.center[k] < box.lo[k] || point.center[k] > box.hi[k];
    }
    if (outside) continue;
    if (areLeaves(pair_, pair.nodes)) {
      const int obstacle = pair.obstacle >= 0 ? pair.obstacle : obstacles_.find(pair.nodes);
      const SlabArrays& slabs = obstacles_.slabs(obstacle);
      if (slabKernels().classify(slabs, point).relation == CellRelation::outside) continue;
      if (!slabs.outer_only) return true;
      const Eigen::Vector3d y(point.center[0], point.center[1], point.center[2]);
      if (contains(obstacles_.support(pair.nodes), y)) return true;
    } else {
      for (const NodePair& child : childrenOf(pair_, pair.nodes)) stack_.push_back({child, -1});
    }
  }
  return false;
}

bool CellSampler::collides(const OpenCell& cell, const Eigen::Vector3d& y) {
  const CellBox point{{y[0], y[1], y[2]}, {0.0, 0.0, 0.0}};
  // The leaves first: they are the cheapest to test.
  for (const FrontPair& pair : cell.front) {
    if (pair.obstacle >= 0 && collides(pair, point)) return true;
  }
  for (const FrontPair& pair : cell.front) {
    if (pair.obstacle < 0 && collides(pair, point)) return true;
  }
  return solids_ && solids_->at(y) == Containment::inside;
}

SampledMass CellSampler::sample(const std::vector<OpenCell>& cells) {
  constexpr int kSamples = 2;
  SampledMass total;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    double masses[kSamples];
    Eigen::Vector3d moments[kSamples];
    for (int j = 0; j < kSamples; ++j) {
      double uniform[3];
      uniforms(seed_, i, static_cast<std::uint64_t>(j), uniform);
      const Draw drawn = draw(cells[i], uniform);
      const bool open = drawn.weight > 0.0 && !cells[i].covers(drawn.point);
      masses[j] = open && collides(cells[i], drawn.point) ? drawn.weight : 0.0;
      moments[j] = masses[j] * drawn.point;
    }
    const double difference = 0.5 * (masses[0] - masses[1]);
    const Eigen::Vector3d moment_difference = 0.5 * (moments[0] - moments[1]);
    total.mass += 0.5 * (masses[0] + masses[1]);
    total.variance += difference * difference;
    total.moment += 0.5 * (moments[0] + moments[1]);
    total.moment_variance += moment_difference.cwiseAbs2();
    total.samples += kSamples;
  }
  return total;
}

}  // namespace fcl_prob::detail
