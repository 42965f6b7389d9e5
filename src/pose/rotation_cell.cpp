// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "pose/rotation_cell.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "base/quantiles.h"
#include "cells/ball_truncation.h"
#include "fcl_prob/normal_mass.h"
#include "gaussian/normal_density.h"
#include "gaussian/rotation.h"
#include "pose/cell_moments.h"

namespace fcl_prob::detail {
namespace {

// The middle of a coordinate that is infinite on both sides, and the length cut off one that is so
// on one side.
constexpr double kMiddle = 3.0;
constexpr double kCutOff = 1.2;

// A shift of more deviations along an axis is left to the motion: its curvature bounds nothing.
constexpr double kMostShift = 3.0;

// Displacements of an exponential that are taken into account, in deviations.
constexpr double kReachOfDisplacement = 5.5;

// Of sums and products of a few dozen terms.
constexpr double kRounding = 1e-12;

// Of a mass over shifts: φ(0).
constexpr double kSteepest = 0.4;

// Deviations of the displacement that are farther apart lose too much in a covariance. It is
// rounded by a few ε of its largest entries, a relative change δ of which changes masses by less
// than 3 δ.
constexpr double kMostSpread = 1e3;
constexpr double kJoinedRounding = 1e-14;

Bounds massOf(const RotationCell& cell) {
  double mass = 1.0;
  for (Eigen::Index k = 0; k < cell.lo.size(); ++k) {
    mass *= normalIntervalMass(cell.lo[k], cell.hi[k]);
  }
  const double error = 4 * kIntervalMassRelativeError;
  return {std::max(0.0, mass * (1.0 - error) - kUnderflow),
          std::min(1.0, mass * (1.0 + error) + kUnderflow)};
}

RotationCell part(const RotationCell& cell, Eigen::Index k, double lo, double hi) {
  RotationCell result = cell;
  result.lo[k] = lo;
  result.hi[k] = hi;
  result.mass = massOf(result);
  result.conditional = {0.0, 1.0};
  return result;
}

double normalCdf(double x) { return normalTailMass(-x); }

// Of all sets of mass g or less the one with the largest second derivative of its mass along a
// direction is { |u| > a }: 2 a φ(a). At a = 1 it is largest.
double mostUpwards(double g) {
  const double a = g < 1.0 ? -normalQuantile(std::max(0.5 * g, 1e-300)) : 0.0;
  return 2.0 * std::max(a, 1.0) * normalDensity(std::max(a, 1.0));
}

// And downwards { |u| < b }.
double mostDownwards(double g) {
  const double b = g < 1.0 ? normalQuantile(0.5 + 0.5 * g) : 1.0;
  return 2.0 * std::min(b, 1.0) * normalDensity(std::min(b, 1.0));
}

}  // namespace

Bounds RotationCell::contribution() const {
  return {mass.lower * conditional.lower * (1.0 - 2 * kEpsilon) - kUnderflow,
          mass.upper * conditional.upper * (1.0 + 2 * kEpsilon) + kUnderflow};
}

RotationCell wholeRotationSpace(int rank) {
  RotationCell cell;
  cell.lo = Eigen::VectorXd::Constant(rank, -kInfinity);
  cell.hi = Eigen::VectorXd::Constant(rank, kInfinity);
  cell.mass = {1.0, 1.0};
  cell.curvature_parts = Eigen::VectorXd::Zero(rank);
  return cell;
}

std::vector<RotationCell> split(const RotationCell& cell, const MotionCosts& costs) {
  for (Eigen::Index k = 0; k < cell.lo.size(); ++k) {
    const double lo = cell.lo[k], hi = cell.hi[k];
    if (std::isfinite(lo) && std::isfinite(hi)) continue;
    if (std::isfinite(lo)) {
      return {part(cell, k, lo, lo + kCutOff), part(cell, k, lo + kCutOff, hi)};
    }
    if (std::isfinite(hi)) {
      return {part(cell, k, hi - kCutOff, hi), part(cell, k, lo, hi - kCutOff)};
    }
    return {part(cell, k, -kMiddle, kMiddle), part(cell, k, lo, -kMiddle),
            part(cell, k, kMiddle, hi)};
  }
  // Halves leave a half of what is of first order open, and a quarter or less of the rest.
  Eigen::Index k = 0;
  const Eigen::VectorXd width = cell.hi - cell.lo;
  const double scale = cell.moved_gap / std::max(costs.of(cell), 1e-300);
  const Eigen::VectorXd closed = 0.5 * scale * costs.first.cwiseProduct(width) +
                                 0.75 * scale * costs.second.cwiseProduct(width.cwiseAbs2()) +
                                 0.75 * cell.curvature_parts;
  closed.maxCoeff(&k);
  const double middle = 0.5 * (cell.lo[k] + cell.hi[k]);
  return {part(cell, k, cell.lo[k], middle), part(cell, k, middle, cell.hi[k])};
}

namespace {

// The pieces that motionOf() puts together.
class CellMotionBuilder {
 public:
  CellMotionBuilder(const MovedFrame& frame, const RotationCell& cell,
                    const Eigen::Vector3d& reference, double size, double expected)
      : frame_(frame),
        expected_(expected),
        conditional_(frame.conditional()),
        middle_(0.5 * (cell.lo + cell.hi)),
        half_((1.0 + kRounding) * 0.5 * (cell.hi - cell.lo)),
        mean_(middle_.size()),
        reach_(middle_.size()),
        variance_(middle_.size()),
        theta_(conditional_.rotationVector(middle_)) {
    for (Eigen::Index j = 0; j < middle_.size(); ++j) {
      const double length = cell.hi[j] - cell.lo[j];
      moments_.push_back(cellMoments(cell.lo[j], cell.hi[j]));
      mean_[j] = moments_.back().mean;
      reach_[j] = (1.0 + kRounding) * std::max(cell.hi[j] - mean_[j], mean_[j] - cell.lo[j]);
      // No truncated normal varies more than a uniform variable, nor than without truncation.
      variance_[j] = (1.0 + kRounding) * std::min(1.0, length * length / 12.0);
    }
    angle_ = largestAngle();
    const ConditionalMotion at_middle = frame.at(middle_);
    result_.turned = at_middle.motion;
    result_.displacement = at_middle.displacement;
    build(reference, size);
  }

  CellMotion take() { return std::move(result_); }

 private:
  // |F z| is convex: it is largest at a corner of the cell.
  double largestAngle() const {
    double largest = 0.0;
    for (unsigned corner = 0; corner < (1U << half_.size()); ++corner) {
      Eigen::VectorXd off = half_;
      for (Eigen::Index j = 0; j < off.size(); ++j) {
        if ((corner >> j) % 2 == 1) off[j] = -off[j];
      }
      largest = std::max(largest, (conditional_.rotationFactor() * off).norm());
    }
    return largest * (1.0 + kRounding);
  }

  // With R(s) for the rotation at θ_c + s Δθ and u(s) = R(s) R_c⁻¹ u, u' = ω(s) × u(s) and ω(s) =
  // J(θ_c + s Δθ) Δθ, J being the Jacobian of the exponential, |ω| <= |Δθ|. So u(1) - u is ω(0) × u
  // up to ½ |Δθ|² |u| and what ω varies by, |ω(s) - ω(0)| <= s V: ½ V |u|. With ½ ω(0) × (ω(0) × u)
  // it is so up to that and ⅙ |Δθ| (|Δθ|² + V) |u|, V being ½ |Δθ|² at most.
  void build(const Eigen::Vector3d& reference, double size) {
    const Eigen::Matrix3d jacobian = translationJacobian(theta_);
    const Eigen::Vector3d about = frame_.frame().translation();
    const Eigen::Vector3d lever = reference - about;
    PointMotion& motion = result_.motion;
    motion.centre = reference;
    const double varied = 0.5 * variationOfRate();
    motion.remainder = (0.5 * angle_ * angle_ + varied) * (1.0 + kRounding);
    motion.ball = (0.25 * angle_ * angle_ * angle_ + varied) * (1.0 + kRounding) * lever.norm() +
                  64 * kEpsilon * (size + about.norm() + reference.norm());
    Eigen::MatrixXd shifts(3, half_.size());
    const Eigen::Matrix3d to_world =
        frame_.isExponential() ? jacobian : Eigen::Matrix3d::Identity().eval();
    for (Eigen::Index j = 0; j < half_.size(); ++j) {
      const Eigen::Vector3d turn = jacobian * conditional_.rotationFactor().col(j);
      motion.turns.push_back(turn * half_[j]);
      shifts.col(j) = to_world * conditional_.slope().col(j) + turn.cross(lever);
    }
    const GaussianDisplacement& displacement = result_.displacement;
    if (frame_.isExponential()) addExponential();
    const Eigen::Vector3d mean =
        displacement.mean() + shifts * (mean_ - middle_) + takeSecondOrder(lever);
    share(shifts);
    join();
    result_.displacement =
        result_.joined ? withShifts().withMean(mean) : displacement.withMean(mean);
  }

  // J = 1 + a [θ]× + b [θ]×², a = ∫ (1 - x) cos(|θ| x) dx and b = ½ ∫ (1 - x)² cos(|θ| x) dx over
  // 0 <= x <= 1, so that |a'| <= |θ| / 12, |b'| <= |θ| / 60 and b <= 1/6; Δθ × Δθ is 0. Bound on
  // |ω(s) - ω(0)| / s, the V of build(). J is also ∫ exp(x [θ]×) dx, which varies by ½ |Δθ| at
  // most.
  double variationOfRate() const {
    const double from = theta_.norm();
    const double most = from + angle_;
    return angle_ * angle_ * std::min(0.5, from * (1.0 / 6.0 + most / 12.0 + from * most / 60.0));
  }

  // ½ ω × (ω × u), ω = Σ a_j turns_j: a_j² is within ½ of ½, and so every term between two ends.
  // Returns what is in the middle of these.
  Eigen::Vector3d takeSecondOrder(const Eigen::Vector3d& u) {
    std::vector<Eigen::Vector3d>& shifts = result_.motion.shifts;
    const std::vector<Eigen::Vector3d>& turns = result_.motion.turns;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (std::size_t j = 0; j < turns.size(); ++j) {
      const Eigen::Vector3d squared = 0.25 * turns[j].cross(turns[j].cross(u));
      middle += squared;
      shifts.push_back((1.0 + kRounding) * squared);
      for (std::size_t k = 0; k < j; ++k) {
        shifts.push_back((0.5 + kRounding) *
                         (turns[j].cross(turns[k].cross(u)) + turns[k].cross(turns[j].cross(u))));
      }
    }
    return middle;
  }

  // V(θ) ρ is taken for V(θ_c) ρ: |V(θ) - V(θ_c)| <= ½ |θ - θ_c|.
  void addExponential() {
    const GaussianDisplacement rho = conditional_.translation(mean_);
    double most = rho.mean().norm() + kReachOfDisplacement * rho.standardDeviations().norm();
    for (Eigen::Index j = 0; j < half_.size(); ++j) {
      most += conditional_.slope().col(j).norm() * reach_[j];
    }
    result_.motion.ball += 0.5 * angle_ * most * (1.0 + kRounding);
    if (rho.rank() > 0) {
      result_.tail = ballMass(kReachOfDisplacement, rho.rank()).outside.upper;
    }
  }

  // Along axes with enough displacement shifts are left to the curvature, along others to the
  // motion.
  void share(const Eigen::MatrixXd& shifts) {
    const GaussianDisplacement& displacement = result_.displacement;
    result_.curvatures = Eigen::VectorXd::Zero(half_.size());
    whitened_ = Eigen::MatrixXd::Zero(3, half_.size());
    Eigen::MatrixXd moved = Eigen::MatrixXd::Zero(3, half_.size());
    for (int k = 0; k < 3; ++k) {
      const Eigen::RowVectorXd along = displacement.axes().col(k).transpose() * shifts;
      const double sigma = displacement.standardDeviations()[k];
      const double reach = along.cwiseAbs().dot(reach_) / sigma;
      if (sigma > 0.0 && reach <= kMostShift) {
        const Eigen::VectorXd whitened = along.transpose() / sigma;
        whitened_.row(k) = whitened.transpose();
        result_.curvatures += (1.0 + kRounding) * whitened.cwiseAbs2().cwiseProduct(variance_);
        result_.slack += whitened.cwiseAbs().sum() * kMeanError;
        result_.reach = std::hypot(result_.reach, reach * (1.0 + kRounding));
      } else {
        moved += displacement.axes().col(k) * along;
      }
    }
    for (Eigen::Index j = 0; j < half_.size(); ++j) {
      if (!moved.col(j).isZero(0)) result_.motion.shifts.push_back(moved.col(j) * reach_[j]);
    }
  }

  // Z = z_j - E z_j in the cell and G ~ N(0, v) with v = E Z² have the same mean of f(a Z) and f(a
  // G) but for derivatives of f of third and fourth order (Taylor's theorem, to the third and the
  // fourth term), times |a|³ |E Z³| / 6 and |a|⁴ (E Z⁴ + E G⁴) / 24. f is the mass of a set over
  // shifts; its derivatives are integrals of Hermite polynomials over the set, and largest over the
  // one on which these are positive. E Z⁴ <= reach² v.
  void join() {
    constexpr double kThird = 0.756;   // ∫ max(He₃ φ, 0)
    constexpr double kFourth = 1.401;  // ∫ max(He₄ φ, 0)
    const double spread = spreadOfDeviations();
    if (result_.curvatures.isZero(0.0) || spread > kMostSpread) return;
    result_.higher = Eigen::VectorXd::Zero(half_.size());
    for (Eigen::Index j = 0; j < half_.size(); ++j) {
      const CellMoments& moments = moments_[static_cast<std::size_t>(j)];
      const double a = whitened_.col(j).norm();
      const double v = moments.variance + moments.variance_error;
      const double fourth = reach_[j] * reach_[j] * v + 3.0 * v * v;
      result_.higher[j] =
          (1.0 + 1e-9) * (kThird * a * a * a * moments.third / 6.0 +
                          kFourth * a * a * a * a * fourth / 24.0 + a * a * moments.variance_error);
    }
    const double by_curvature =
        0.5 * (mostUpwards(expected_) + mostDownwards(expected_)) * result_.curvatures.sum();
    result_.joined = 2.0 * result_.higher.sum() < by_curvature;
    if (result_.joined) result_.slack += kJoinedRounding * spread * spread / kSteepest;
  }

  double spreadOfDeviations() const {
    double largest = 0.0, least = kInfinity;
    for (const double sigma : result_.displacement.standardDeviations()) {
      if (!(sigma > 0.0)) continue;
      largest = std::max(largest, sigma);
      least = std::min(least, sigma);
    }
    return largest > 0.0 ? largest / least : 1.0;
  }

  // D^½ (1 + Σ v a aᵀ) D^½ in the axes of the displacement: of the same rank.
  GaussianDisplacement withShifts() const {
    const GaussianDisplacement& displacement = result_.displacement;
    Eigen::Matrix3d inner = Eigen::Matrix3d::Identity();
    for (Eigen::Index j = 0; j < half_.size(); ++j) {
      inner += moments_[static_cast<std::size_t>(j)].variance * whitened_.col(j) *
               whitened_.col(j).transpose();
    }
    const Eigen::Matrix3d root =
        displacement.axes() * displacement.standardDeviations().asDiagonal();
    const Eigen::Matrix3d covariance = root * inner * root.transpose();
    return GaussianDisplacement(displacement.mean(),
                                0.5 * covariance + 0.5 * covariance.transpose());
  }

  const MovedFrame& frame_;
  double expected_;  ///< steers
  const ConditionalTranslation& conditional_;
  Eigen::VectorXd middle_;
  Eigen::VectorXd half_;
  std::vector<CellMoments> moments_;
  Eigen::MatrixXd whitened_;  ///< shifts in deviations, those that are not left to the motion
  Eigen::VectorXd mean_;      ///< of z in the cell
  Eigen::VectorXd reach_;     ///< how far z may be from that
  Eigen::VectorXd variance_;  ///< bound on that of z in the cell
  Eigen::Vector3d theta_;     ///< at the middle
  double angle_ = 0.0;        ///< bound on |θ - theta_|
  CellMotion result_;
};

}  // namespace

CellMotion motionOf(const MovedFrame& frame, const RotationCell& cell,
                    const Eigen::Vector3d& reference, double size, double expected) {
  return CellMotionBuilder(frame, cell, reference, size, expected).take();
}

// With y + w(z) for the displacement in deviations, V⁻ ⊂ V(z) ⊂ V⁺ for all z in the cell and
// g(w) = P(y + w ∈ V±), E g(w) differs from g(E w) by ½ E wᵀHw at most, H being a Hessian of g
// between E w and w, where g is at most Φ(Φ⁻¹(g(E w)) + |w|).
void setConditional(const CellMotion& motion, const Bounds& inner, RotationCell& cell) {
  const double slack = kSteepest * motion.slack + motion.tail;
  if (motion.joined) {
    const double higher = motion.higher.sum();
    cell.conditional = {
        std::clamp((inner.lower - slack - higher) * (1.0 - kRounding) - kUnderflow, 0.0, 1.0),
        std::clamp((inner.upper + slack + higher) * (1.0 + kRounding), 0.0, 1.0)};
    cell.open = cell.conditional.width();
    cell.moved_gap = inner.width() + 2.0 * motion.tail;
    cell.curvature_parts = 2.0 * motion.higher;
    return;
  }
  double most = inner.upper;
  if (most > 0.0 && most < 1.0 && motion.reach > 0.0) {
    most = std::min(1.0, (1.0 + 1e-9) * normalCdf(normalQuantile(most) + motion.reach + 1e-9));
  }
  const double variance = motion.curvatures.sum();
  const double up = 0.5 * mostUpwards(most) * variance * (1.0 + 1e-9);
  const double down = 0.5 * mostDownwards(most) * variance * (1.0 + 1e-9);
  const bool shifted = variance > 0.0;
  const double upper = inner.upper + slack + (shifted ? up : 0.0);
  const double lower = inner.lower - slack - (shifted ? down : 0.0);
  cell.conditional = {std::clamp(lower * (1.0 - kRounding) - kUnderflow, 0.0, 1.0),
                      std::clamp(upper * (1.0 + kRounding), 0.0, 1.0)};
  cell.open = cell.conditional.width();
  cell.moved_gap = inner.width() + 2.0 * motion.tail;
  cell.curvature_parts = motion.curvatures * (shifted ? (up + down) / variance : 0.0);
}

}  // namespace fcl_prob::detail
