// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// To be compiled once for every instruction set, four numbers at a time by the vector extension of
// gcc and clang: the same operations in the same order.
#include <cstring>

#include "mass/cut_kernels.h"

namespace fcl_prob::detail {
namespace {

constexpr int kCutLanes = 4;
typedef double CutLanes __attribute__((vector_size(32)));

inline void cutSum(const CutPolynomial& of, const CutLanes& s, CutLanes& sum) {
  sum = CutLanes{};
  for (int n = of.terms - 1; n >= 0; --n) sum = sum * s + of.coefficients[n];
}

inline double pieceMass(const CutAxes& axes, const CutPiece& piece) {
  CutLanes sum{};
  const CutLanes lowest = CutLanes{} + axes.lo;
  const CutLanes highest = CutLanes{} + axes.hi;
  for (int first = 0; first < piece.count; first += kCutLanes) {
    CutLanes v, weight;
    std::memcpy(&v, piece.nodes + first, sizeof v);
    std::memcpy(&weight, piece.weights + first, sizeof weight);
    v = piece.middle + piece.half * v;
    CutLanes level = piece.level - axes.slope * v;
    level = level < lowest ? lowest : level;
    level = level > highest ? highest : level;
    const CutLanes s = (v - axes.density.middle) * axes.density.inverse_half;
    const CutLanes t = (axes.side * level - axes.mass.middle) * axes.mass.inverse_half;
    CutLanes density, mass;
    cutSum(axes.density, s, density);
    cutSum(axes.mass, t, mass);
    sum += weight * density * (axes.top - axes.side * (t * mass));
  }
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

}  // namespace
}  // namespace fcl_prob::detail
