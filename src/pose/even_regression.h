// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The mean of a function of standard normals from antithetic pairs, with a quadratic control
// variate.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace fcl_prob::detail {

/// Values of a function at z and at -z.
struct AntitheticPair {
  Eigen::VectorXd z;
  double at_z = 0.0;
  double at_opposite = 0.0;

  double even() const { return 0.5 * (at_z + at_opposite); }
};

struct EstimatedMean {
  double mean = 0.0;
  double standard_error = 0.0;
  double deviation = 0.0;  ///< of one pair, with what the quadratic explains taken out
  double freedom = 0.0;    ///< degrees of freedom of the residuals
  bool quadratic = false;  ///< whether it is in use
};

/// E f(z) for z ~ N(0, I). Of a pair, the odd part of f cancels; of the rest the products z_j z_k,
/// whose means are known, explain what is quadratic (regression estimator: Glynn and Szechtman
/// 2002). Where the pairs are too few to fit them, or the fit costs more than it explains, their
/// plain mean. The standard error is the larger one of least squares and of what the residuals give
/// without equal variances (MacKinnon and White 1985), with the factor that makes the square of
/// error / standard error one on average for so few degrees of freedom; a tenth of what the
/// products explain is added for terms of higher order that the pairs may not show. \param pairs at
/// least 4; independent, with independent errors of their own
EstimatedMean meanOfPairs(const std::vector<AntitheticPair>& pairs);

}  // namespace fcl_prob::detail
