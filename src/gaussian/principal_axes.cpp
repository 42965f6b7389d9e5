// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "gaussian/principal_axes.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "base/constants.h"

namespace fcl_prob::detail {
namespace {

// Rounding errors that a covariance computed as a product of three matrices may carry, in units of
// kEpsilon sqrt(a_ii a_jj) an entry.
constexpr double kEntryErrors = 8.0;

// Convergence is quadratic; a 3x3 matrix needs about five sweeps.
constexpr int kMaxSweeps = 60;

constexpr std::array<std::pair<int, int>, 3> kPairs{{{0, 1}, {0, 2}, {1, 2}}};

struct Rotation {
  double cosine, sine, tangent;
};

// The smaller rotation that makes [[app, apq], [apq, aqq]] diagonal (Golub and Van Loan, 8.5.2).
Rotation annihilating(double app, double aqq, double apq) {
  const double cotangent = (0.5 * aqq - 0.5 * app) / apq;
  const double size = std::abs(cotangent);
  double tangent = size > 1e150 ? 0.5 / size : 1 / (size + std::sqrt(size * size + 1));
  if (cotangent < 0) tangent = -tangent;
  const double cosine = 1 / std::sqrt(tangent * tangent + 1);
  return {cosine, tangent * cosine, tangent};
}

void rotateColumns(Eigen::Matrix3d& axes, int p, int q, const Rotation& rotation) {
  const Eigen::Vector3d column = axes.col(p);
  axes.col(p) = rotation.cosine * column - rotation.sine * axes.col(q);
  axes.col(q) = rotation.sine * column + rotation.cosine * axes.col(q);
}

bool negligible(double product, double first_norm, double second_norm) {
  return std::abs(product) <= kEpsilon * first_norm * second_norm ||
         std::abs(product) <= std::numeric_limits<double>::min();
}

void rotateSymmetric(Eigen::Matrix3d& a, int p, int q, const Rotation& rotation) {
  const int r = 3 - p - q;
  const double arp = a(r, p);
  const double arq = a(r, q);
  a(p, p) -= rotation.tangent * a(p, q);
  a(q, q) += rotation.tangent * a(p, q);
  a(p, q) = a(q, p) = 0;
  a(r, p) = a(p, r) = rotation.cosine * arp - rotation.sine * arq;
  a(r, q) = a(q, r) = rotation.sine * arp + rotation.cosine * arq;
}

// Diagonalises `a` in place; returns the eigenvectors as columns.
Eigen::Matrix3d jacobi(Eigen::Matrix3d& a) {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
    bool converged = true;
    for (const auto& [p, q] : kPairs) {
      if (negligible(a(p, q), std::sqrt(std::abs(a(p, p))), std::sqrt(std::abs(a(q, q))))) continue;
      converged = false;
      const Rotation rotation = annihilating(a(p, p), a(q, q), a(p, q));
      rotateSymmetric(a, p, q, rotation);
      rotateColumns(axes, p, q, rotation);
    }
    if (converged) break;
  }
  return axes;
}

// Makes the rows of `factor` orthogonal in place; returns the rotation whose columns are the left
// singular vectors.
Eigen::Matrix3d oneSidedJacobi(Eigen::Matrix<double, 3, 6>& factor) {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
    bool converged = true;
    for (const auto& [p, q] : kPairs) {
      const double product = factor.row(p).dot(factor.row(q));
      const double p_norm = factor.row(p).norm();
      const double q_norm = factor.row(q).norm();
      if (negligible(product, p_norm, q_norm)) continue;
      converged = false;
      const Rotation rotation = annihilating(p_norm * p_norm, q_norm * q_norm, product);
      const Eigen::Matrix<double, 1, 6> row = factor.row(p);
      factor.row(p) = rotation.cosine * row - rotation.sine * factor.row(q);
      factor.row(q) = rotation.sine * row + rotation.cosine * factor.row(q);
      rotateColumns(axes, p, q, rotation);
    }
    if (converged) break;
  }
  return axes;
}

// Makes the columns p < q of `axes`, each times its deviation, orthogonal by the rotation of the
// two (Hestenes); returns false if they are. Nothing is multiplied by a deviation, so that the
// smaller one may be as small as doubles go.
bool separateColumns(const Eigen::Vector3d& deviations, int p, int q, Eigen::Matrix3d& axes) {
  const Eigen::Vector3d first = axes.col(p);
  const Eigen::Vector3d second = axes.col(q);
  const double product = first.dot(second);
  if (std::abs(product) <= kEpsilon) return false;
  const double ratio = deviations[q] / deviations[p];
  const double difference = ratio * ratio * second.squaredNorm() - first.squaredNorm();
  const double root = std::hypot(difference, 2.0 * ratio * product);
  // tan / ratio
  const double share =
      2.0 * product * (difference < 0.0 ? -1.0 : 1.0) / (std::abs(difference) + root);
  const double tangent = ratio * share;
  const double cosine = 1.0 / std::sqrt(1.0 + tangent * tangent);
  axes.col(p) = cosine * (first - tangent * ratio * second);
  axes.col(q) = cosine * (second + share * first);
  return true;
}

// Makes the columns from `rank` on orthogonal to all before.
void completeAxes(int rank, Eigen::Matrix3d& axes) {
  for (int k = rank; k < 3; ++k) {
    for (int pass = 0; pass < 2; ++pass) {
      for (int j = 0; j < k; ++j) axes.col(k) -= axes.col(j) * axes.col(j).dot(axes.col(k));
    }
    axes.col(k).normalize();
  }
}

}  // namespace

PrincipalAxes principalAxesOfOblique(Eigen::Vector3d standard_deviations, Eigen::Matrix3d axes) {
  const int rank = static_cast<int>((standard_deviations.array() > 0).count());
  for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
    bool converged = true;
    for (const auto& [p, q] : kPairs) {
      if (q < rank && separateColumns(standard_deviations, p, q, axes)) converged = false;
    }
    if (converged) break;
  }
  for (int k = 0; k < rank; ++k) {
    standard_deviations[k] *= axes.col(k).norm();
    axes.col(k).normalize();
  }
  completeAxes(rank, axes);
  return orderedAxes(standard_deviations, axes);
}

PrincipalAxes orderedAxes(const Eigen::Vector3d& standard_deviations, const Eigen::Matrix3d& axes) {
  std::array<int, 3> order{};
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return standard_deviations[a] > standard_deviations[b]; });
  PrincipalAxes result;
  for (int k = 0; k < 3; ++k) {
    result.standard_deviations[k] = standard_deviations[order[k]];
    result.axes.col(k) = axes.col(order[k]);
  }
  if (result.axes.determinant() < 0) result.axes.col(2) = -result.axes.col(2);
  result.rank = static_cast<int>((result.standard_deviations.array() > 0).count());
  return result;
}

PrincipalAxes principalAxesOfCovariance(const Eigen::Matrix3d& covariance) {
  Eigen::Matrix3d diagonalised = covariance;
  const Eigen::Vector3d entry_scale = covariance.diagonal().cwiseAbs().cwiseSqrt();
  const Eigen::Matrix3d axes = jacobi(diagonalised);

  Eigen::Vector3d standard_deviations;
  for (int k = 0; k < 3; ++k) {
    const double eigenvalue = diagonalised(k, k);
    const double deviation = eigenvalue > 0 ? std::sqrt(eigenvalue) : 0.0;
    const double reach = axes.col(k).cwiseAbs().dot(entry_scale);
    const bool is_rounding = deviation <= std::sqrt(kEntryErrors * kEpsilon) * reach;
    standard_deviations[k] = is_rounding ? 0.0 : deviation;
  }
  PrincipalAxes result = orderedAxes(standard_deviations, axes);
  result.least_eigenvalue = diagonalised.diagonal().minCoeff();
  return result;
}

PrincipalAxes principalAxesOfFactor(const Eigen::Matrix<double, 3, 6>& factor) {
  const double largest = factor.cwiseAbs().maxCoeff();
  if (largest == 0) return orderedAxes(Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity());
  const double scale = powerOfTwoAt(largest);  // squares neither overflow nor underflow
  Eigen::Matrix<double, 3, 6> rows = factor / scale;
  const Eigen::Vector3d entry_scale = rows.rowwise().norm();
  const Eigen::Matrix3d axes = oneSidedJacobi(rows);

  Eigen::Vector3d standard_deviations;
  for (int k = 0; k < 3; ++k) {
    const double norm = rows.row(k).norm();
    const bool is_rounding =
        norm <= kEntryErrors * kEpsilon * axes.col(k).cwiseAbs().dot(entry_scale);
    standard_deviations[k] = is_rounding ? 0.0 : norm * scale;
  }
  return orderedAxes(standard_deviations, axes);
}

}  // namespace fcl_prob::detail
