// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A quadric that follows the boundary of contact in the space of all that is random: what a second-
// order reliability method takes for the answer, and here only a control variate.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace fcl_prob::detail {

/// { x : u·x > L(w) } with L(w) = a + b·w + wᵀCw, w being x without its part along u, in a basis.
/// x ~ N(0, I).
class BoundaryModel {
 public:
  /// The half-space { u·x > a }. \param u  unit
  BoundaryModel(const Eigen::VectorXd& u, double a);

  Eigen::Index dimension() const { return u_.size(); }
  const Eigen::VectorXd& direction() const { return u_; }

  /// Of the part of x across the direction.
  Eigen::VectorXd acrossOf(const Eigen::VectorXd& x) const { return basis_.transpose() * x; }
  Eigen::VectorXd pointAt(const Eigen::VectorXd& across, double along) const {
    return basis_ * across + along * u_;
  }

  /// L(w).
  double level(const Eigen::VectorXd& across) const;

  /// Root mean square of what the points it was fitted to are off, along u, each from what is
  /// fitted to the others.
  double spread() const { return spread_; }

  /// A point of the boundary, and where it was expected from the others.
  struct Misfit {
    double expected;
    double at;
  };
  const std::vector<Misfit>& misfits() const { return misfits_; }

  /// P(u·x > L(w)): what it would be if contact began there.
  double mass() const;

  /// Least squares over points of the boundary, weighted with what the density there is like.
  /// \param points  one a column; a linear fit needs more of them than dimensions
  void fit(const Eigen::MatrixXd& points, bool quadratic);

  /// The same boundary, if it is a plane, seen along its normal.
  BoundaryModel alongNormal() const;

  /// Coefficients of a fit.
  static Eigen::Index coefficients(Eigen::Index dimension, bool quadratic);

 private:
  Eigen::VectorXd u_;
  Eigen::MatrixXd basis_;  ///< of the rest, a column each
  double a_;
  Eigen::VectorXd b_;
  Eigen::MatrixXd c_;  ///< symmetric
  double spread_ = 1.0;
  std::vector<Misfit> misfits_;
};

}  // namespace fcl_prob::detail
