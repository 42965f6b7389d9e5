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

// The columns of the inverse of a matrix given by its rows.
std::array<ExactVector, 3> inverse(const std::array<ExactVector, 3>& rows) {
  const Rational det = determinant(rows[0], rows[1], rows[2]);
  std::array<ExactVector, 3> columns;
  for (std::size_t k = 0; k < 3; ++k) {
    columns[k] = scaled(Rational(1 / det), cross(rows[(k + 1) % 3], rows[(k + 2) % 3]));
  }
  return columns;
}

}  // namespace

WhitenedFrame::WhitenedFrame(const fcl_prob::Whitening& whitening,
                             const fcl_prob::GaussianDisplacement& displacement)
    : rank_(whitening.rank()) {
  std::array<ExactVector, 3> axes;     // as long as their standard deviations
  std::array<ExactVector, 3> product;  // rows of W A; of a unit matrix where nothing moves
  for (int k = 0; k < 3; ++k) {
    const auto column = static_cast<std::size_t>(k);
    axes[column] = scaled(Rational(displacement.standardDeviations()[k]),
                          converted<Rational>(displacement.axes().col(k)));
  }
  for (int i = 0; i < 3; ++i) {
    const ExactVector row = converted<Rational>(whitening.matrix().row(i).transpose());
    for (int j = 0; j < 3; ++j) {
      const bool moves = i < rank_ && j < rank_;
      product[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] =
          moves ? dot(row, axes[static_cast<std::size_t>(j)]) : Rational(i == j ? 1 : 0);
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const Rational off = dot(product[i], product[j]) - (i == j ? 1 : 0);
      error_ = std::max(error_, std::abs(off.convert_to<double>()));
    }
  }
  Exact exact;
  exact.mean = converted<Rational>(whitening.mean());
  const std::array<ExactVector, 3> inverted = inverse(product);
  for (std::size_t k = 0; k < 3; ++k) {
    exact.columns[k] = combined(axes, inverted[k]);
    columns_[k] = toWide(exact.columns[k]);
  }
  mean_ = toWide(exact.mean);
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
