// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "whitened_frame.h"

namespace oracle {

namespace {

ExactVector combined(const std::array<ExactVector, 3>& columns, const ExactVector& factors) {
  ExactVector sum{Rational(0), Rational(0), Rational(0)};
  for (std::size_t k = 0; k < 3; ++k) sum = sum + scaled(factors[k], columns[k]);
  return sum;
}

// A whitening that is not turned is diag(1/σ) Aᵀ, whatever the rounding of its rows means along
// axes of far larger deviations.
bool isTurned(const fcl_prob::Whitening& whitening,
              const fcl_prob::GaussianDisplacement& displacement) {
  for (int k = 0; k < whitening.rank(); ++k) {
    const Eigen::Vector3d row =
        whitening.matrix().row(k).transpose() * displacement.standardDeviations()[k];
    if (!((row - displacement.axes().col(k)).norm() < 1e-14)) return true;
  }
  return false;
}

// Gram and Schmidt, twice.
void makeOrthonormal(std::array<WideVector, 3>& rows, std::size_t rank) {
  for (std::size_t i = 0; i < rank; ++i) {
    for (int round = 0; round < 2; ++round) {
      for (std::size_t j = 0; j < i; ++j) {
        rows[i] = rows[i] - scaled(dot(rows[i], rows[j]), rows[j]);
      }
      rows[i] = scaled(Wide(1 / sqrt(dot(rows[i], rows[i]))), rows[i]);
    }
  }
}

}  // namespace

WhitenedFrame::WhitenedFrame(const fcl_prob::Whitening& whitening,
                             const fcl_prob::GaussianDisplacement& displacement)
    : rank_(whitening.rank()) {
  std::array<WideVector, 3> axes;   // as long as their standard deviations
  std::array<WideVector, 3> turns;  // rows of R
  for (int k = 0; k < 3; ++k) {
    axes[static_cast<std::size_t>(k)] = scaled(Wide(displacement.standardDeviations()[k]),
                                               converted<Wide>(displacement.axes().col(k)));
  }
  const bool turned = isTurned(whitening, displacement);
  for (int i = 0; i < 3; ++i) {
    const WideVector row = converted<Wide>(whitening.matrix().row(i).transpose());
    for (int j = 0; j < 3; ++j) {
      const bool moves = turned && i < rank_ && j < rank_;
      turns[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] =
          moves ? dot(row, axes[static_cast<std::size_t>(j)]) : Wide(i == j ? 1 : 0);
    }
  }
  makeOrthonormal(turns, static_cast<std::size_t>(rank_));
  Exact exact;
  exact.mean = converted<Rational>(displacement.mean());
  mean_ = converted<Wide>(displacement.mean());
  for (std::size_t k = 0; k < 3; ++k) {
    columns_[k] = {Wide(0), Wide(0), Wide(0)};
    for (std::size_t j = 0; j < 3; ++j) {
      columns_[k] = columns_[k] + scaled(turns[k][j], axes[j]);
    }
    exact.columns[k] = {Rational(columns_[k][0]), Rational(columns_[k][1]),
                        Rational(columns_[k][2])};
  }
  exact_ = std::make_shared<const Exact>(std::move(exact));
}

WideVector WhitenedFrame::roundedWide(const Eigen::Vector3d& y) const {
  WideVector sum = mean_;
  for (int k = 0; k < rank_; ++k) {
    sum = sum + scaled(Wide(y[k]), columns_[static_cast<std::size_t>(k)]);
  }
  return sum;
}

Displacement WhitenedFrame::displacement(const Eigen::Vector3d& y) const {
  return {roundedWide(y), [exact = exact_, y] {
            return exact->mean + combined(exact->columns, converted<Rational>(y));
          }};
}

Eigen::Vector3d WhitenedFrame::rounded(const Eigen::Vector3d& y) const {
  const WideVector wide = roundedWide(y);
  return {wide[0].convert_to<double>(), wide[1].convert_to<double>(), wide[2].convert_to<double>()};
}

}  // namespace oracle
