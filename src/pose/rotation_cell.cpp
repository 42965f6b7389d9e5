// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "pose/rotation_cell.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>

#include "base/constants.h"
#include "fcl_prob/normal_mass.h"
#include "gaussian/normal_density.h"
#include "gaussian/rotation.h"
#include "partition/ball_truncation.h"

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
  return result;
}

// Mean of a coordinate in [lo, hi], to within kMeanError.
constexpr double kMeanError = 1e-10;
double meanOf(double lo, double hi) {
  const double length = hi - lo;
  const double middle = 0.5 * (lo + hi);
  // The next term of the series is below 1e-15 for the |middle| < 20 of cells that matter.
  if (length < 1e-3) return middle - middle * length * length / 12.0;
  const double mean = (normalDensity(lo) - normalDensity(hi)) / normalIntervalMass(lo, hi);
  return std::clamp(mean, lo, hi);
}

double quantile(double p) { return boost::math::quantile(boost::math::normal(), p); }
double normalCdf(double x) { return normalTailMass(-x); }

// Of all sets of mass g or less the one with the largest second derivative of its mass along a
// direction is { |u| > a }: 2 a φ(a). At a = 1 it is largest.
double mostUpwards(double g) {
  const double a = g < 1.0 ? -quantile(std::max(0.5 * g, 1e-300)) : 0.0;
  return 2.0 * std::max(a, 1.0) * normalDensity(std::max(a, 1.0));
}

// And downwards { |u| < b }.
double mostDownwards(double g) {
  const double b = g < 1.0 ? quantile(0.5 + 0.5 * g) : 1.0;
  return 2.0 * std::min(b, 1.0) * normalDensity(std::min(b, 1.0));
}

}  // namespace

RotationCell wholeRotationSpace(int rank) {
  RotationCell cell;
  cell.lo = Eigen::VectorXd::Constant(rank, -kInfinity);
  cell.hi = Eigen::VectorXd::Constant(rank, kInfinity);
  cell.mass = {1.0, 1.0};
  cell.curvature_parts = Eigen::VectorXd::Zero(rank);
  return cell;
}

std::vector<RotationCell> split(const RotationCell& cell, const Eigen::VectorXd& angles) {
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
  Eigen::Index k = 0;
  const bool by_curvature = cell.curvature_parts.sum() > cell.moved_gap;
  const Eigen::VectorXd turned = angles.cwiseProduct(cell.hi - cell.lo);
  (by_curvature ? cell.curvature_parts : turned).maxCoeff(&k);
  const double middle = 0.5 * (cell.lo[k] + cell.hi[k]);
  return {part(cell, k, cell.lo[k], middle), part(cell, k, middle, cell.hi[k])};
}

namespace {

// The pieces that motionOf() puts together.
class CellMotionBuilder {
 public:
  CellMotionBuilder(const MovedFrame& frame, const RotationCell& cell,
                    const Eigen::Vector3d& reference, double size)
      : frame_(frame),
        conditional_(frame.conditional()),
        middle_(0.5 * (cell.lo + cell.hi)),
        half_((1.0 + kRounding) * 0.5 * (cell.hi - cell.lo)),
        mean_(middle_.size()),
        reach_(middle_.size()),
        variance_(middle_.size()),
        theta_(conditional_.rotationVector(middle_)) {
    for (Eigen::Index j = 0; j < middle_.size(); ++j) {
      const double length = cell.hi[j] - cell.lo[j];
      mean_[j] = meanOf(cell.lo[j], cell.hi[j]);
      reach_[j] = (1.0 + kRounding) * std::max(cell.hi[j] - mean_[j], mean_[j] - cell.lo[j]);
      // No truncated normal varies more than a uniform variable, nor than without truncation.
      variance_[j] = (1.0 + kRounding) * std::min(1.0, length * length / 12.0);
    }
    // Columns of the factor are orthogonal.
    angle_ = 0.0;
    for (Eigen::Index j = 0; j < half_.size(); ++j) {
      angle_ = std::hypot(angle_, conditional_.rotationFactor().col(j).norm() * half_[j]);
    }
    angle_ *= 1.0 + kRounding;
    const ConditionalMotion at_middle = frame.at(middle_);
    result_.turned = at_middle.motion;
    result_.displacement = at_middle.displacement;
    build(reference, size);
  }

  CellMotion take() { return std::move(result_); }

 private:
  // The first-order turns, and what they leave: |u(1) - u(0) - ω × u| <= ¾ |Δθ|² |u|, since
  // |J(θ) - J(θ')| <= ½ |θ - θ'| for the Jacobian J of the exponential and |ω| <= |Δθ|.
  void build(const Eigen::Vector3d& reference, double size) {
    const Eigen::Matrix3d jacobian = translationJacobian(theta_);
    const Eigen::Vector3d about = frame_.frame().translation();
    const Eigen::Vector3d lever = reference - about;
    PointMotion& motion = result_.motion;
    motion.centre = reference;
    motion.remainder = 0.75 * angle_ * angle_ * (1.0 + kRounding);
    motion.ball =
        motion.remainder * lever.norm() + 64 * kEpsilon * (size + about.norm() + reference.norm());
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
    const Eigen::Vector3d mean = displacement.mean() + shifts * (mean_ - middle_);
    share(shifts);
    result_.displacement = displacement.withMean(mean);
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
    Eigen::MatrixXd moved = Eigen::MatrixXd::Zero(3, half_.size());
    for (int k = 0; k < 3; ++k) {
      const Eigen::RowVectorXd along = displacement.axes().col(k).transpose() * shifts;
      const double sigma = displacement.standardDeviations()[k];
      const double reach = along.cwiseAbs().dot(reach_) / sigma;
      if (sigma > 0.0 && reach <= kMostShift) {
        const Eigen::VectorXd whitened = along.transpose() / sigma;
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

  const MovedFrame& frame_;
  const ConditionalTranslation& conditional_;
  Eigen::VectorXd middle_;
  Eigen::VectorXd half_;
  Eigen::VectorXd mean_;      ///< of z in the cell
  Eigen::VectorXd reach_;     ///< how far z may be from that
  Eigen::VectorXd variance_;  ///< bound on that of z in the cell
  Eigen::Vector3d theta_;     ///< at the middle
  double angle_ = 0.0;        ///< bound on |θ - theta_|
  CellMotion result_;
};

}  // namespace

CellMotion motionOf(const MovedFrame& frame, const RotationCell& cell,
                    const Eigen::Vector3d& reference, double size) {
  return CellMotionBuilder(frame, cell, reference, size).take();
}

// With y + w(z) for the displacement in deviations, V⁻ ⊂ V(z) ⊂ V⁺ for all z in the cell and
// g(w) = P(y + w ∈ V±), E g(w) differs from g(E w) by ½ E wᵀHw at most, H being a Hessian of g
// between E w and w, where g is at most Φ(Φ⁻¹(g(E w)) + |w|).
void setConditional(const CellMotion& motion, const Bounds& inner, RotationCell& cell) {
  constexpr double kSteepest = 0.4;  // of g: φ(0)
  double most = inner.upper;
  if (most > 0.0 && most < 1.0 && motion.reach > 0.0) {
    most = std::min(1.0, (1.0 + 1e-9) * normalCdf(quantile(most) + motion.reach + 1e-9));
  }
  const double variance = motion.curvatures.sum();
  const double up = 0.5 * mostUpwards(most) * variance * (1.0 + 1e-9);
  const double down = 0.5 * mostDownwards(most) * variance * (1.0 + 1e-9);
  const double slack = kSteepest * motion.slack + motion.tail;
  const bool shifted = variance > 0.0;
  const double upper = inner.upper + slack + (shifted ? up : 0.0);
  const double lower = inner.lower - slack - (shifted ? down : 0.0);
  cell.conditional = {std::clamp(lower * (1.0 - kRounding) - kUnderflow, 0.0, 1.0),
                      std::clamp(upper * (1.0 + kRounding), 0.0, 1.0)};
  cell.moved_gap = inner.width() + 2.0 * motion.tail;
  cell.curvature_parts = motion.curvatures * (shifted ? (up + down) / variance : 0.0);
}

}  // namespace fcl_prob::detail
