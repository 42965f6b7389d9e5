// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "pose/even_regression.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace fcl_prob::detail {
namespace {

// Residual degrees of freedom, besides one for each coefficient, from which on products are fitted.
constexpr Eigen::Index kSpare = 8;

// Of the standard deviation that products explain, what terms of higher order may hide.
constexpr double kUnseen = 0.1;

Eigen::Index productsOf(Eigen::Index dimension) { return dimension * (dimension + 1) / 2; }

// 1, then z_j z_k - [j = k]: all but the first have mean 0.
Eigen::MatrixXd designOf(const std::vector<AntitheticPair>& pairs, bool quadratic) {
  const auto rows = static_cast<Eigen::Index>(pairs.size());
  const Eigen::Index dimension = pairs[0].z.size();
  Eigen::MatrixXd design(rows, 1 + (quadratic ? productsOf(dimension) : 0));
  design.col(0).setOnes();
  if (!quadratic) return design;
  for (Eigen::Index row = 0; row < rows; ++row) {
    const Eigen::VectorXd& z = pairs[static_cast<std::size_t>(row)].z;
    Eigen::Index column = 1;
    for (Eigen::Index j = 0; j < dimension; ++j) {
      for (Eigen::Index k = j; k < dimension; ++k) {
        design(row, column++) = z[j] * z[k] - (j == k ? 1.0 : 0.0);
      }
    }
  }
  return design;
}

// For Student's t with so many degrees of freedom: E t² = ν / (ν - 2).
double spreadOf(double freedom) { return freedom > 2.5 ? freedom / (freedom - 2.0) : 5.0; }

EstimatedMean fit(const std::vector<AntitheticPair>& pairs, bool quadratic) {
  const Eigen::MatrixXd design = designOf(pairs, quadratic);
  Eigen::VectorXd values(design.rows());
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    values[i] = pairs[static_cast<std::size_t>(i)].even();
  }
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(design);
  const Eigen::MatrixXd q =
      qr.householderQ() * Eigen::MatrixXd::Identity(design.rows(), design.cols());
  // The first row of (XᵀX)⁻¹Xᵀ = R⁻¹Qᵀ: the weights with which the values make up the mean.
  const Eigen::VectorXd first = qr.matrixQR()
                                    .topRows(design.cols())
                                    .triangularView<Eigen::Upper>()
                                    .transpose()
                                    .solve(Eigen::VectorXd::Unit(design.cols(), 0));
  const Eigen::VectorXd weights = q * first;
  const Eigen::VectorXd residuals = values - q * (q.transpose() * values);
  const auto freedom = static_cast<double>(design.rows() - design.cols());
  const double variance = residuals.squaredNorm() / freedom;
  double robust = 0.0;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    // A point that determines its own fitted value says nothing of its residual.
    const double left = std::max(1.0 - q.row(i).squaredNorm(), 1e-3);
    const double term = weights[i] * residuals[i];
    robust += 0.5 * term * term * (1.0 / left + 1.0 / (left * left));
  }
  EstimatedMean result;
  result.mean = weights.dot(values);
  result.standard_error =
      std::sqrt(std::max(variance * weights.squaredNorm(), robust) * spreadOf(freedom));
  result.deviation = std::sqrt(variance);
  result.freedom = freedom;
  result.quadratic = quadratic;
  return result;
}

}  // namespace

EstimatedMean meanOfPairs(const std::vector<AntitheticPair>& pairs) {
  const EstimatedMean plain = fit(pairs, false);
  const Eigen::Index products = productsOf(pairs[0].z.size());
  const bool enough = static_cast<Eigen::Index>(pairs.size()) >= 2 * products + kSpare;
  if (products == 0 || !enough) return plain;
  EstimatedMean fitted = fit(pairs, true);
  // Terms of fourth order are large where few or none of the pairs are: residuals show them only
  // in part. Taken as a share of what the quadratic explains.
  const double spread = plain.deviation * plain.deviation - fitted.deviation * fitted.deviation;
  const double unseen =
      kUnseen * std::sqrt(std::max(0.0, spread) / static_cast<double>(pairs.size()));
  fitted.standard_error = std::hypot(fitted.standard_error, unseen);
  return fitted.standard_error <= plain.standard_error ? fitted : plain;
}

}  // namespace fcl_prob::detail
