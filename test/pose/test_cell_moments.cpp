// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Moments of truncated normals against quadrature.
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>

#include "catch.h"
#include "pose/cell_moments.h"

using namespace fcl_prob::detail;

namespace {

/// ∫ (t - about)^power over [lo, hi] with the normal density, up to a factor, in long double.
long double moment(double lo, double hi, long double about, int power) {
  const long double middle = 0.5L * (static_cast<long double>(lo) + hi);
  const auto integrand = [&](long double t) {
    return std::pow(t - about, static_cast<long double>(power)) *
           std::exp(-0.5L * (t - middle) * (t + middle));
  };
  long double sum = 0.0L;
  constexpr int kParts = 64;
  const long double part = (static_cast<long double>(hi) - lo) / kParts;
  for (int i = 0; i < kParts; ++i) {
    sum += boost::math::quadrature::gauss<long double, 15>::integrate(integrand, lo + i * part,
                                                                      lo + (i + 1) * part);
  }
  return sum;
}

}  // namespace

TEST_CASE("moments of a truncated normal are what quadrature finds, within their errors") {
  for (const double length : {1e-6, 1e-3, 0.015, 0.0201, 0.3, 1.2, 3.0, 6.0}) {
    for (const double lo : {-9.0, -6.0, -3.0, -1.0, -0.4, 0.0, 0.7, 2.0, 5.0, 9.5}) {
      const double hi = lo + length;
      const CellMoments moments = cellMoments(lo, hi);
      const long double mass = moment(lo, hi, 0.0L, 0);
      const long double mean = lo + moment(lo, hi, static_cast<long double>(lo), 1) / mass;
      const auto variance = static_cast<double>(moment(lo, hi, mean, 2) / mass);
      const auto third = static_cast<double>(moment(lo, hi, mean, 3) / mass);
      CAPTURE(lo, hi);
      CHECK(std::fabs(moments.mean - static_cast<double>(mean)) <= kMeanError);
      CHECK(std::fabs(moments.variance - variance) <= moments.variance_error);
      CHECK(std::fabs(third) <= moments.third);
      if (length >= 0.3 && hi <= 10.0) CHECK(moments.third <= std::fabs(third) + 3e-8);
    }
  }
}
