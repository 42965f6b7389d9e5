// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "pose/boundary_model.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <complex>

#include "base/symmetric_axes.h"

namespace fcl_prob::detail {
namespace {

// Of the weight of the point nearest to the origin, what points far out have at least. Weights are
// roots of what the density asks for: few points would be all there is otherwise.
constexpr double kLeastWeight = 0.1;

// Ridge of products, relative to the points' number: they are told by few points.
constexpr double kRidge = 1e-3;

// Of a point's residual, what a fit leaves at least where it is nearly determined by that point.
constexpr double kLeastLeft = 0.2;

// A coefficient of a product above this would make the quadric turn back within what is sampled.
constexpr double kMostCurved = 0.5;

// Steps and end of the integral over the characteristic function: e^(-t²/2) is below 1e-16 there,
// and what the steps miss is the mass of values above 2π over a step.
constexpr double kStep = 0.04;
constexpr double kEnd = 8.6;

Eigen::MatrixXd basisAcross(const Eigen::VectorXd& u) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(u);
  const Eigen::MatrixXd q = qr.householderQ();
  return q.rightCols(u.size() - 1);
}

Eigen::RowVectorXd termsOf(const Eigen::VectorXd& w, bool quadratic) {
  Eigen::RowVectorXd row(BoundaryModel::coefficients(w.size() + 1, quadratic));
  row[0] = 1.0;
  row.segment(1, w.size()) = w.transpose();
  if (!quadratic) return row;
  Eigen::Index column = 1 + w.size();
  for (Eigen::Index j = 0; j < w.size(); ++j) {
    for (Eigen::Index k = j; k < w.size(); ++k) row[column++] = w[j] * w[k];
  }
  return row;
}

}  // namespace

BoundaryModel::BoundaryModel(const Eigen::VectorXd& u, double a)
    : u_(u),
      basis_(basisAcross(u)),
      a_(a),
      b_(Eigen::VectorXd::Zero(u.size() - 1)),
      c_(Eigen::MatrixXd::Zero(u.size() - 1, u.size() - 1)) {}

double BoundaryModel::level(const Eigen::VectorXd& across) const {
  return a_ + b_.dot(across) + across.dot(c_ * across);
}

Eigen::Index BoundaryModel::coefficients(Eigen::Index dimension, bool quadratic) {
  return dimension + (quadratic ? dimension * (dimension - 1) / 2 : 0);
}

// u·x - L(w) is a normal variable and, in the axes of C, a sum of independent b w + λ w². Its
// characteristic function is known, and the probability that it is positive is an integral over
// that (Gil-Pelaez 1951; Imhof 1961).
double BoundaryModel::mass() const {
  using Complex = std::complex<double>;
  const auto axes = symmetricAxes(c_);
  const Eigen::VectorXd& curved = axes.eigenvalues();
  const Eigen::VectorXd slope = axes.eigenvectors().transpose() * b_;
  double sum = 0.0;
  for (double t = 0.5 * kStep; t < kEnd; t += kStep) {
    Complex exponent(-0.5 * t * t, -t * a_);
    Complex factor(1.0, 0.0);
    for (Eigen::Index k = 0; k < curved.size(); ++k) {
      const Complex of_square(1.0, 2.0 * t * curved[k]);
      exponent -= 0.5 * t * t * slope[k] * slope[k] / of_square;
      factor /= std::sqrt(of_square);
    }
    sum += (std::exp(exponent) * factor).imag() / t;
  }
  return std::clamp(0.5 + sum * kStep / M_PI, 0.0, 1.0);
}

void BoundaryModel::fit(const Eigen::MatrixXd& points, bool quadratic) {
  const Eigen::Index rows = points.cols();
  const Eigen::Index columns = coefficients(dimension(), quadratic);
  const Eigen::VectorXd along = points.transpose() * u_;
  const double nearest = along.cwiseAbs().minCoeff();
  Eigen::VectorXd weights(rows);
  Eigen::MatrixXd design(rows, columns);
  for (Eigen::Index i = 0; i < rows; ++i) {
    weights[i] = std::exp(0.25 * (nearest * nearest - along[i] * along[i])) + kLeastWeight;
    design.row(i) = termsOf(acrossOf(points.col(i)), quadratic);
  }
  Eigen::MatrixXd normal = design.transpose() * weights.asDiagonal() * design;
  for (Eigen::Index k = dimension(); k < columns; ++k) normal(k, k) += kRidge * weights.sum();
  const Eigen::LDLT<Eigen::MatrixXd> solver(normal);
  const Eigen::VectorXd fitted = solver.solve(design.transpose() * weights.cwiseProduct(along));
  if (!fitted.allFinite()) return;
  a_ = fitted[0];
  b_ = fitted.segment(1, dimension() - 1);
  Eigen::Index column = dimension();
  for (Eigen::Index j = 0; quadratic && j + 1 < dimension(); ++j) {
    for (Eigen::Index k = j; k + 1 < dimension(); ++k) {
      const double product = std::clamp(fitted[column++], -kMostCurved, kMostCurved);
      c_(j, k) = c_(k, j) = j == k ? product : 0.5 * product;
    }
  }
  // What a point is off by if it had no part in the fit.
  double squares = 0.0;
  misfits_.clear();
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Eigen::VectorXd row = design.row(i).transpose();
    const double leverage = weights[i] * row.dot(solver.solve(row));
    const double off =
        (along[i] - level(acrossOf(points.col(i)))) / std::max(1.0 - leverage, kLeastLeft);
    squares += weights[i] * off * off;
    misfits_.push_back({along[i] - off, along[i]});
  }
  spread_ = std::sqrt(squares / weights.sum());
}

BoundaryModel BoundaryModel::alongNormal() const {
  const double length = std::sqrt(1.0 + b_.squaredNorm());
  return {(u_ - basis_ * b_) / length, a_ / length};
}

}  // namespace fcl_prob::detail
