// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "mass/cell_mass.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/constants.h"
#include "fcl_prob/normal_mass.h"
#include "gaussian/gauss_rule.h"
#include "gaussian/normal_density.h"

namespace fcl_prob::detail {

namespace {

// Half as wide as a piece of a quadrature may be to start with, in standard deviations.
constexpr double kPieceWidth = 1.0;

double density(double y) { return kInverseSqrtTwoPi * std::exp(-0.5 * y * y); }

double tail(double y) { return 0.5 * std::erfc(y * kInverseSqrtTwo); }

// The largest density at a distance of at most `margin` from [lo, hi].
double largestDensity(double lo, double hi, double margin) {
  const double nearest = std::max({lo - margin, -hi - margin, 0.0});
  return density(nearest);
}

// The cut cell in coordinates (k, v, u): k the closed axis, in which the part kept is y >= l(u, v),
// and u the outer axis, the one with the flattest slope. An axis that does not move is the point 0.
class CutCell {
 public:
  CutCell(const Cell& cell, const Eigen::Vector3d& m, double s) {
    order(cell, m);
    reflected_ = m[k_] < 0;
    lo_ = reflected_ ? -cell.hi[k_] : cell.lo[k_];
    hi_ = reflected_ ? -cell.lo[k_] : cell.hi[k_];
    const double scale = 1.0 / std::fabs(m[k_]);
    offset_ = s * scale;
    slope_u_ = u_moves_ ? m[u_] * scale : 0.0;
    slope_v_ = v_moves_ ? m[v_] * scale : 0.0;
    u_lo_ = cell.lo[u_];
    u_hi_ = cell.hi[u_];
    v_lo_ = cell.lo[v_];
    v_hi_ = cell.hi[v_];
    side_ = lo_ + hi_ >= 0 ? 1.0 : -1.0;
    tail_hi_ = tail(side_ * hi_);
    full_ = above(lo_);
  }

  struct Sums {
    double mass = 0.0;
    double moment_k = 0.0;
    double moment_v = 0.0;
    double moment_u = 0.0;
  };

  // Chooses the number of nodes and pieces for an error below `accuracy` (absolute), and bounds it.
  void plan(double accuracy) {
    pieces_ = 1;
    const double width = std::max(u_moves_ ? u_hi_ - u_lo_ : 0.0, v_moves_ ? v_hi_ - v_lo_ : 0.0);
    pieces_ = std::max(1, static_cast<int>(std::ceil(width / (2 * kPieceWidth))));
    for (;; pieces_ *= 2) {
      const double half = 0.5 * width / pieces_;
      if (chooseNodes(half, accuracy) || pieces_ >= 64) return;
    }
  }

  double errorBound() const { return error_; }

  template <bool with_moment>
  Sums integrate() const {
    Sums sums;
    if (!u_moves_) {
      inner<with_moment>(0.0, 1.0, sums);
      return sums;
    }
    std::array<double, 6> breaks = outerBreaks();
    for (int i = 0; i + 1 < 6; ++i) {
      const double width = breaks[i + 1] - breaks[i];
      if (width > 0) outerPieces<with_moment>(breaks[i], width, sums);
    }
    return sums;
  }

  Eigen::Vector3d moment(const Sums& sums) const {
    Eigen::Vector3d result = Eigen::Vector3d::Zero();
    if (u_moves_) result[u_] = sums.moment_u;
    if (v_moves_) result[v_] = sums.moment_v;
    result[k_] = reflected_ ? -sums.moment_k : sums.moment_k;
    return result;
  }

  // Rounding of the integral, relative to the mass of the cell, in two parts.
  //
  // Of levels and tails. The level is rounded by 2.5 ε of its terms, and where it enters or leaves
  // the cell, at the ends of the pieces, by up to 5 ε; the argument of a tail by ε of itself, at
  // both ends, and a tail by 6 ε. That moves the mass by so much of the largest density along the
  // closed axis, which is at most 1/width + |lo| + |hi| times the mass there, twice that where the
  // interval is around 0; the tails together are at most 3.8 times as large.
  //
  // Of sums. All terms are positive: half an ε of the mass for each of them, and for the densities
  // along the other two axes, whose exponents and nodes are rounded, 1.25 ε y² each.
  double roundingError() const {
    const double width = std::max(hi_ - lo_, 1e-300);
    const double u = u_moves_ ? std::max(std::fabs(u_lo_), std::fabs(u_hi_)) : 0.0;
    const double v = v_moves_ ? std::max(std::fabs(v_lo_), std::fabs(v_hi_)) : 0.0;
    const double reach = std::max(std::fabs(lo_), std::fabs(hi_));
    const double terms = std::fabs(offset_) + std::fabs(slope_u_) * u + std::fabs(slope_v_) * v;
    const double around_zero = lo_ < 0.0 && hi_ > 0.0 ? 2.0 : 1.0;
    const double of_level = std::max(64.0, around_zero * (24.0 + 2.0 * reach + 8.0 * terms));
    const double of_sums = std::max(64.0, 32.0 + 1.25 * (u * u + v * v) + 0.5 * mostTerms());
    return of_level * kEpsilon *
           (of_sums / of_level + 1.0 / width + std::fabs(lo_) + std::fabs(hi_));
  }

 private:
  void order(const Cell& cell, const Eigen::Vector3d& m) {
    k_ = 0;
    for (int i = 1; i < cell.rank; ++i) {
      if (std::fabs(m[i]) > std::fabs(m[k_])) k_ = i;
    }
    u_ = (k_ + 1) % 3;
    v_ = (k_ + 2) % 3;
    const auto steepness = [&](int i) { return i < cell.rank ? std::fabs(m[i]) : -1.0; };
    if (steepness(u_) > steepness(v_)) std::swap(u_, v_);
    u_moves_ = u_ < cell.rank;
    v_moves_ = v_ < cell.rank;
  }

  // Of the sum that integrate() is: pieces begin anew at up to four breaks along u and one along v.
  double mostTerms() const {
    const double inner = v_moves_ ? nodes_ * (pieces_ + 1.0) + 1.0 : 1.0;
    return u_moves_ ? nodes_ * (pieces_ + 4.0) * inner : inner;
  }

  // Mass of [l, hi] along the closed axis, computed on the side of the tail.
  double above(double l) const { return side_ * (tail(side_ * l) - tail_hi_); }

  bool chooseNodes(double half, double accuracy) {
    const double reach = std::max({std::fabs(lo_), std::fabs(hi_), std::fabs(u_lo_),
                                   std::fabs(u_hi_), std::fabs(v_lo_), std::fabs(v_hi_)});
    const double height = 1.0 / (1.0 + 0.25 * reach);  // imaginary half axis of the ellipse
    const double bulge = (std::fabs(slope_u_) + std::fabs(slope_v_)) * height;
    const double along_k = largestDensity(lo_, hi_, bulge) *
                           (hi_ - lo_ + bulge + bulge * std::exp(0.5 * bulge * bulge));
    double size = along_k * std::exp(height * height);
    double area = 1.0;
    if (u_moves_) {
      size *= largestDensity(u_lo_, u_hi_, height);
      area *= u_hi_ - u_lo_ + 2 * height;
    }
    if (v_moves_) {
      size *= largestDensity(v_lo_, v_hi_, height);
      area *= v_hi_ - v_lo_ + 2 * height;
    }
    if (!u_moves_ && !v_moves_) {
      nodes_ = GaussRule::kFewest;
      error_ = 0.0;
      return true;
    }
    const double ratio = height / std::max(half, 1e-300);
    const double rho = ratio + std::sqrt(1.0 + ratio * ratio);
    const double constant = 2 * (64.0 / 15.0) * size * area / (1.0 - 1.0 / (rho * rho));
    double error = constant * std::pow(rho, -2.0 * GaussRule::kFewest);
    nodes_ = GaussRule::kFewest;
    while (error > accuracy && nodes_ < GaussRule::kMost) {
      ++nodes_;
      error /= rho * rho;
    }
    error_ = error;
    return error <= accuracy;
  }

  // Where, along u, the cut enters or leaves an edge of the (k, v) rectangle.
  std::array<double, 6> outerBreaks() const {
    std::array<double, 6> breaks{u_lo_, u_lo_, u_lo_, u_lo_, u_lo_, u_hi_};
    int count = 1;
    for (const double level : {lo_, hi_}) {
      for (const double v : {v_lo_, v_hi_}) {
        const double u = (offset_ - slope_v_ * v - level) / slope_u_;
        breaks[count++] = (u > u_lo_ && u < u_hi_) ? u : u_lo_;  // false for NaN and infinity
      }
    }
    std::sort(breaks.begin() + 1, breaks.begin() + 5);
    return breaks;
  }

  template <bool with_moment>
  void outerPieces(double start, double width, Sums& sums) const {
    const GaussRule& rule = GaussRule::ofSize(nodes_);
    const double piece = (u_hi_ - u_lo_) / pieces_;
    const int count = std::max(1, static_cast<int>(std::ceil(width / piece - 1e-9)));
    const double half = 0.5 * width / count;
    for (int i = 0; i < count; ++i) {
      const double middle = start + (2 * i + 1) * half;
      for (int j = 0; j < nodes_; ++j) {
        const double u = middle + half * rule.node[j];
        const double weight = half * rule.weight[j] * density(u);
        const double before = sums.mass;
        inner<with_moment>(u, weight, sums);
        if (with_moment) sums.moment_u += u * (sums.mass - before);
      }
    }
  }

  // The integral over v for one u: where the cut is below the cell, through it, and above it.
  template <bool with_moment>
  void inner(double u, double weight, Sums& sums) const {
    const double level = offset_ - slope_u_ * u;
    if (!v_moves_) {
      partial<with_moment>(level, 0.0, weight, sums);
      return;
    }
    // l(v) = level - slope_v v falls with v if slope_v > 0.
    const double at_lo = (level - lo_) / slope_v_;  // l = lo
    const double at_hi = (level - hi_) / slope_v_;  // l = hi
    const bool falling = slope_v_ > 0;
    double begin = v_lo_;
    double end = v_hi_;
    if (slope_v_ == 0.0) {
      if (level <= lo_) return full<with_moment>(v_lo_, v_hi_, weight, sums);
      if (level >= hi_) return;
    } else if (falling) {
      begin = std::clamp(at_hi, v_lo_, v_hi_);
      end = std::clamp(at_lo, v_lo_, v_hi_);
      full<with_moment>(end, v_hi_, weight, sums);
    } else {
      begin = std::clamp(at_lo, v_lo_, v_hi_);
      end = std::clamp(at_hi, v_lo_, v_hi_);
      full<with_moment>(v_lo_, begin, weight, sums);
    }
    if (end > begin) innerPieces<with_moment>(begin, end - begin, level, weight, sums);
  }

  template <bool with_moment>
  void innerPieces(double start, double width, double level, double weight, Sums& sums) const {
    const GaussRule& rule = GaussRule::ofSize(nodes_);
    const double piece = (v_hi_ - v_lo_) / pieces_;
    const int count = std::max(1, static_cast<int>(std::ceil(width / piece - 1e-9)));
    const double half = 0.5 * width / count;
    for (int i = 0; i < count; ++i) {
      const double middle = start + (2 * i + 1) * half;
      for (int j = 0; j < nodes_; ++j) {
        const double v = middle + half * rule.node[j];
        const double node_weight = weight * half * rule.weight[j] * density(v);
        partial<with_moment>(level - slope_v_ * v, v, node_weight, sums);
      }
    }
  }

  template <bool with_moment>
  void partial(double l, double v, double weight, Sums& sums) const {
    const double cut = std::clamp(l, lo_, hi_);
    const double mass = weight * above(cut);
    sums.mass += mass;
    if (with_moment) {
      sums.moment_v += v * mass;
      sums.moment_k += weight * (density(cut) - density(hi_));
    }
  }

  template <bool with_moment>
  void full(double begin, double end, double weight, Sums& sums) const {
    if (!(end > begin)) return;
    const double interval = normalIntervalMass(begin, end);
    sums.mass += weight * full_ * interval;
    if (with_moment) {
      sums.moment_v += weight * full_ * normalIntervalMoment(begin, end);
      sums.moment_k += weight * interval * normalIntervalMoment(lo_, hi_);
    }
  }

  int k_, u_, v_;
  bool u_moves_, v_moves_, reflected_;
  double lo_, hi_, u_lo_, u_hi_, v_lo_, v_hi_;
  double offset_, slope_u_, slope_v_;
  double side_, tail_hi_, full_;
  int pieces_ = 1;
  int nodes_ = GaussRule::kFewest;
  double error_ = 0.0;
};

// Where the plane lies with respect to the cell: +1 if the whole cell is kept, -1 if nothing is.
int side(const Cell& cell, const Eigen::Vector3d& m, double s) {
  double middle = 0.0;
  double radius = 0.0;
  for (int i = 0; i < cell.rank; ++i) {
    middle += 0.5 * m[i] * (cell.lo[i] + cell.hi[i]);
    radius += 0.5 * std::fabs(m[i]) * (cell.hi[i] - cell.lo[i]);
  }
  // A plane within rounding of the cell counts as cutting it.
  const double rounding = 64 * kEpsilon * kReach;
  if (middle - radius >= s + rounding) return 1;
  if (middle + radius <= s - rounding) return -1;
  return 0;
}

bool hasMovingNormal(const Cell& cell, const Eigen::Vector3d& m) {
  double largest = 0.0;
  for (int i = 0; i < cell.rank; ++i) largest = std::max(largest, std::fabs(m[i]));
  return largest > 1e-12;
}

}  // namespace

CellBox Cell::box() const {
  CellBox box;
  for (int i = 0; i < 3; ++i) {
    box.center[i] = 0.5 * (lo[i] + hi[i]);
    // Rounded outwards, so that the box contains the cell.
    box.half[i] = i < rank ? 0.5 * (hi[i] - lo[i]) * (1 + 4 * kEpsilon) + kEpsilon * kReach : 0.0;
  }
  return box;
}

Bounds cellMass(const Cell& cell) {
  double mass = 1.0;
  for (int i = 0; i < cell.rank; ++i) mass *= normalIntervalMass(cell.lo[i], cell.hi[i]);
  const double error = 4 * kIntervalMassRelativeError;
  return {mass * (1 - error), mass * (1 + error)};
}

Eigen::Vector3d cellMoment(const Cell& cell) {
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (int i = 0; i < cell.rank; ++i) {
    moment[i] = normalIntervalMoment(cell.lo[i], cell.hi[i]);
    for (int j = 0; j < cell.rank; ++j) {
      if (j != i) moment[i] *= normalIntervalMass(cell.lo[j], cell.hi[j]);
    }
  }
  return moment;
}

Bounds cellHalfSpaceMass(const Cell& cell, const Eigen::Vector3d& m, double s, double accuracy) {
  const int position = side(cell, m, s);
  if (position < 0) return {0.0, 0.0};
  const Bounds whole = cellMass(cell);
  if (position > 0) return whole;
  if (!hasMovingNormal(cell, m)) return {0.0, whole.upper};
  CutCell cut(cell, m, s);
  cut.plan(accuracy * whole.upper);
  const double mass = cut.integrate<false>().mass;
  const double error = cut.errorBound() + cut.roundingError() * whole.upper;
  return {std::clamp(mass - error, 0.0, whole.lower), std::clamp(mass + error, 0.0, whole.upper)};
}

Moment cellHalfSpaceMoment(const Cell& cell, const Eigen::Vector3d& m, double s) {
  const int position = side(cell, m, s);
  if (position < 0) return {Eigen::Vector3d::Zero(), 0.0};
  const double mass = cellMass(cell).upper;
  const double reach = std::max(cell.lo.cwiseAbs().maxCoeff(), cell.hi.cwiseAbs().maxCoeff());
  const double rounding = 64 * kEpsilon * (reach + 1.0);
  if (position > 0) return {cellMoment(cell), rounding * mass};
  // A plane that does not move cuts all or nothing.
  if (!hasMovingNormal(cell, m)) return {0.5 * cellMoment(cell), reach * mass};
  CutCell cut(cell, m, s);
  cut.plan(1e-10 * mass);
  const Eigen::Vector3d value = cut.moment(cut.integrate<true>());
  // The factor y is at most the reach plus the ellipse's height, 1.
  return {value, (reach + 1.0) * (cut.errorBound() + cut.roundingError() * mass)};
}

}  // namespace fcl_prob::detail
