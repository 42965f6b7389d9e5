// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "sampling/importance_density.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/quantiles.h"
#include "fcl_prob/normal_mass.h"

namespace fcl_prob::detail {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegreesOfFreedom = 4.0;

double logStandardNormal(const Eigen::Vector3d& y, int rank) {
  return -0.5 * (y.squaredNorm() + rank * std::log(2 * kPi));
}

/// Log of the normalising constant of a t distribution of unit scatter.
double logStudentConstant(int rank) {
  // Not std::lgamma, which writes to a global variable (signgam).
  return logGamma(0.5 * (kDegreesOfFreedom + rank)) - logGamma(0.5 * kDegreesOfFreedom) -
         0.5 * rank * std::log(kDegreesOfFreedom * kPi);
}

/// A chi-squared variable with four degrees of freedom from two uniforms.
double chiSquaredOfFour(double u, double v) { return -2.0 * std::log(u * v); }

/// The standard normal within [lo, hi], by inversion on the side of the tail.
double truncatedNormal(double lo, double hi, double uniform) {
  if (hi < 0.0) return -truncatedNormal(-hi, -lo, uniform);
  const double above_hi = normalTailMass(hi);
  const double tail = above_hi + uniform * (normalTailMass(lo) - above_hi);
  if (!(tail > 0.0)) return lo;  // rounded to nothing: most of it is there
  const double y = std::sqrt(2.0) * erfcInverse(2.0 * tail);
  return std::clamp(y, lo, hi);
}

bool within(const CoverBox& box, const Eigen::Vector3d& y) {
  return (y.array() >= box.lo.array()).all() && (y.array() <= box.hi.array()).all();
}

}  // namespace

ImportanceDensity::ImportanceDensity(int rank, ObstacleCover cover, double cover_share,
                                     const std::vector<MixtureComponent>& components)
    : rank_(rank), cover_(std::move(cover)), cover_share_(components.empty() ? 1.0 : cover_share) {
  double cumulated = 0.0;
  for (const MixtureComponent& component : components) {
    Prepared prepared;
    cumulated += component.weight;
    prepared.cumulated = cumulated;
    prepared.centre = component.centre;
    const Eigen::MatrixXd block = component.scatter.topLeftCorner(rank, rank);
    const Eigen::MatrixXd root = block.llt().matrixL();
    prepared.root.setZero();
    prepared.inverse_root.setZero();
    prepared.root.topLeftCorner(rank, rank) = root;
    prepared.inverse_root.topLeftCorner(rank, rank) = root.inverse();
    prepared.log_scale =
        std::log(component.weight) - root.diagonal().array().log().sum() + logStudentConstant(rank);
    components_.push_back(prepared);
  }
}

Eigen::Vector3d ImportanceDensity::sampleShell(RandomStream stream, std::uint64_t index,
                                               double uniform) const {
  Eigen::Vector3d direction = standardNormalFrom(randomWords(stream, index, 0));
  for (int k = rank_; k < 3; ++k) direction[k] = 0.0;
  const double beyond = std::max(uniform * cover_.mass, std::numeric_limits<double>::min());
  const double half_square = gammaQInverse(0.5 * rank_, beyond);
  const double radius = std::max(cover_.shell_radius, std::sqrt(2.0 * half_square));
  return direction * (radius / direction.norm());
}

Eigen::Vector3d ImportanceDensity::sampleBoxes(RandomStream stream, std::uint64_t index,
                                               double choice) const {
  double left = choice * cover_.mass;
  std::size_t k = 0;
  for (; k + 1 < cover_.boxes.size() && left >= cover_.boxes[k].mass; ++k) {
    left -= cover_.boxes[k].mass;
  }
  const CoverBox& box = cover_.boxes[k];
  const auto words = randomWords(stream, index, 0);
  Eigen::Vector3d y = Eigen::Vector3d::Zero();
  for (int i = 0; i < rank_; ++i) {
    y[i] = truncatedNormal(box.lo[i], box.hi[i], uniformFrom(words[i]));
  }
  return y;
}

/// How many times the cover contains `y`.
double ImportanceDensity::coverCount(const Eigen::Vector3d& y) const {
  if (cover_.shell_radius > 0.0) return y.norm() >= cover_.shell_radius ? 1.0 : 0.0;
  return static_cast<double>(std::count_if(cover_.boxes.begin(), cover_.boxes.end(),
                                           [&y](const auto& box) { return within(box, y); }));
}

Eigen::Vector3d ImportanceDensity::sample(RandomStream stream, std::uint64_t index) const {
  const auto words = randomWords(stream, index, 1);
  const double choice = uniformFrom(words[0]);
  if (choice < cover_share_) {
    return cover_.shell_radius > 0.0 ? sampleShell(stream, index, choice / cover_share_)
                                     : sampleBoxes(stream, index, choice / cover_share_);
  }
  const double among =
      (choice - cover_share_) / (1.0 - cover_share_) * components_.back().cumulated;
  std::size_t k = 0;
  while (k + 1 < components_.size() && components_[k].cumulated < among) ++k;
  const Eigen::Vector3d normal = standardNormalFrom(randomWords(stream, index, 0));
  const double chi_squared = chiSquaredOfFour(uniformFrom(words[1]), uniformFrom(words[2]));
  return components_[k].centre +
         components_[k].root * normal * std::sqrt(kDegreesOfFreedom / chi_squared);
}

double ImportanceDensity::ratio(const Eigen::Vector3d& y) const {
  double ratio = cover_share_ * coverCount(y) / cover_.mass;
  const double log_normal = logStandardNormal(y, rank_);
  const double exponent = 0.5 * (kDegreesOfFreedom + rank_);
  for (const Prepared& component : components_) {
    const double distance = (component.inverse_root * (y - component.centre)).squaredNorm();
    // As one exponential: the densities by themselves would underflow.
    ratio += (1.0 - cover_share_) *
             std::exp(component.log_scale - exponent * std::log1p(distance / kDegreesOfFreedom) -
                      log_normal);
  }
  // What collides is within the cover, up to rounding.
  return std::max(ratio, cover_share_ / cover_.mass);
}

}  // namespace fcl_prob::detail
