// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Standard normal measures of boxes and polytopes, as balls.
#pragma once

#include <unordered_map>

#include "polytope.h"

namespace verify {

/// Keeps the values at sides, which neighbouring cells share.
class Masses {
 public:
  /// The precision of masses of boxes, of which differences with 1 are wanted.
  explicit Masses(slong bits) : bits_(bits) {}
  Ball box(int rank, const Vec& lo, const Vec& hi);
  /// Of a polytope in this box: to a relative error of some 1e-13, by Gauss and Legendre's rule
  /// with a bound of its error.
  Ball polytope(const Polytope& polytope, const Vec& lo, const Vec& hi);

 private:
  Ball interval(double lo, double hi);
  const Ball& above(double x);  // of x >= 0
  void add_polytope(const Polytope& polytope, Vec lo, Vec hi, Ball& sum);
  slong bits_;
  std::unordered_map<double, Ball> above_;
};

}  // namespace verify
