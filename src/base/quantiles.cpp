// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "base/quantiles.h"

#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <boost/math/special_functions/gamma.hpp>

namespace fcl_prob::detail {

double erfcInverse(double value) { return boost::math::erfc_inv(value); }

double erfcInverseInDouble(double value) {
  using InDouble = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
  return boost::math::erfc_inv(value, InDouble());
}

double logGamma(double x) { return boost::math::lgamma(x); }

double gammaQ(double a, double x) { return boost::math::gamma_q(a, x); }

double gammaPInverse(double a, double value) { return boost::math::gamma_p_inv(a, value); }

double gammaQInverse(double a, double value) { return boost::math::gamma_q_inv(a, value); }

double normalQuantile(double below) { return quantile(boost::math::normal(), below); }

double chiSquaredQuantile(double freedom, double below) {
  return quantile(boost::math::chi_squared(freedom), below);
}

double betaQuantile(double alpha, double beta, double below) {
  return quantile(boost::math::beta_distribution<>(alpha, beta), below);
}

double betaQuantileAbove(double alpha, double beta, double above) {
  return quantile(complement(boost::math::beta_distribution<>(alpha, beta), above));
}

}  // namespace fcl_prob::detail
