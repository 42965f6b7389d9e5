// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The inner loop of masses of cells below a plane, over plain arrays of doubles.
#pragma once

namespace fcl_prob::detail {

/// Σ c_n sⁿ with s = (y - middle) inverse_half.
struct CutPolynomial {
  const double* coefficients;
  int terms;
  double middle;
  double inverse_half;
};

/// A cell that is cut, above every point of an axis v, at level - slope v.
struct CutAxes {
  double slope;
  double lo;  ///< of the cell, along the axis of the levels
  double hi;
  double side;            ///< -1: that axis is turned round
  double top;             ///< side s Σ c_n sⁿ of `mass` at hi
  CutPolynomial density;  ///< along v
  CutPolynomial mass;     ///< along the other axis, from its middle: without its first factor s
};

/// A piece of v, with a rule on [-1, 1].
struct CutPiece {
  const double* nodes;
  const double* weights;
  int count;  ///< a multiple of four: what is not needed has no weight
  double middle;
  double half;
  double level;
};

/// Σ weight_i density(v_i) (top - mass below the level there), v_i = middle + half node_i.
using CutKernel = double (*)(const CutAxes& axes, const CutPiece& piece);

/// The fastest for the processor; all of them have identical results.
CutKernel cutKernel();

#if defined(__x86_64__)
CutKernel cutKernelAvx2();
#endif

}  // namespace fcl_prob::detail
