// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The slab kernels over a four-lane vector type `V4`; included once for each instruction set. No
// fused multiply-add is used, so that every instruction set gives the same bits.
#pragma once

#include <cmath>

#include "base/constants.h"
#include "convex/slab_kernels.h"
#include "convex/slab_planes.inl.h"

namespace fcl_prob::detail {

inline constexpr double kSmallest = 1e-300;

template <typename V4>
struct SlabKernelsOver {
  struct Directions {
    V4 x, y, z;
  };

  static V4 dot(const Directions& n, double x, double y, double z) {
    return n.x * V4(x) + n.y * V4(y) + n.z * V4(z);
  }

  static Directions directions(const SlabArrays& slabs, int i) {
    return {V4::load(slabs.nx() + i), V4::load(slabs.ny() + i), V4::load(slabs.nz() + i)};
  }

  static V4 radius(const Directions& n, const double* half) {
    return abs(n.x) * V4(half[0]) + abs(n.y) * V4(half[1]) + abs(n.z) * V4(half[2]);
  }

  static CellCut classify(const SlabArrays& slabs, const CellBox& cell) {
    CellCut cut{CellRelation::inside, 0, -1, false, 1.0};
    const double* c = cell.center;
    V4 worst(0.0);
    for (int i = 0; i < slabs.count; i += 4) {
      const Directions n = directions(slabs, i);
      const V4 d = dot(n, c[0], c[1], c[2]);
      const V4 r = radius(n, cell.half);
      const V4 lo = V4::load(slabs.lo() + i);
      const V4 hi = V4::load(slabs.hi() + i);
      if (greater(d - r, hi) | greater(lo, d + r))
        return {CellRelation::outside, 0, -1, false, 0.0};
      const V4 margin = V4::load(slabs.margin() + i);
      const V4 above = d + r - (hi - margin);
      const V4 below = lo + margin - (d - r);
      countSides(cut, greater(above, V4(0.0)), i, true);
      countSides(cut, greater(below, V4(0.0)), i, false);
      const V4 steepest = max(max(abs(n.x) * V4(cell.half[0]), abs(n.y) * V4(cell.half[1])),
                              abs(n.z) * V4(cell.half[2]));
      worst = max(worst, max(above, below) / max(steepest, V4(1e-300)));
    }
    if (cut.sides > 0) cut.relation = CellRelation::cut;
    cut.covered = 1.0 - 0.5 * worst.largest();
    return cut;
  }

  static CellRelation classifyPoint(const SlabArrays& slabs, const double* point) {
    int cut = 0;
    for (int i = 0; i < slabs.count; i += 4) {
      const V4 d = dot(directions(slabs, i), point[0], point[1], point[2]);
      const V4 lo = V4::load(slabs.lo() + i);
      const V4 hi = V4::load(slabs.hi() + i);
      if (greater(d, hi) | greater(lo, d)) return CellRelation::outside;
      const V4 margin = V4::load(slabs.margin() + i);
      cut |= greater(d, hi - margin) | greater(lo + margin, d);
    }
    return cut ? CellRelation::cut : CellRelation::inside;
  }

  static int pointsInBox(const PointArrays& points, const double* lo, const double* hi,
                         int* inside) {
    int found = 0;
    for (int i = 0; i < points.count; i += 4) {
      int mask = 15;
      for (int k = 0; k < 3; ++k) {
        const V4 y = V4::load(points.coordinates[k] + i);
        mask &= notLess(y, V4(lo[k])) & notLess(V4(hi[k]), y);
      }
      for (; mask != 0; mask &= mask - 1) {
        inside[found++] = i + __builtin_ctz(static_cast<unsigned>(mask));
      }
    }
    return found;
  }

  static void countSides(CellCut& cut, int mask, int first_slab, bool upper_side) {
    if (mask == 0) return;
    cut.sides += __builtin_popcount(static_cast<unsigned>(mask));
    cut.slab = first_slab + __builtin_ctz(static_cast<unsigned>(mask));
    cut.upper_side = upper_side;
  }

  // max over lambda of  min { m·y : y in cell, lo <= n·y <= hi }'s Lagrangian
  //   f(lambda) = lambda * (lambda > 0 ? lo : hi) + min over the cell of (m - lambda n)·y,
  // which is concave and piecewise linear with its breakpoints where a component of m - lambda n is
  // 0.
  static V4 dualValue(const V4& lambda, const Directions& n, const V4& lo, const V4& hi,
                      const CellBox& cell, const double* m) {
    const V4 x = V4(m[0]) - lambda * n.x;
    const V4 y = V4(m[1]) - lambda * n.y;
    const V4 z = V4(m[2]) - lambda * n.z;
    const V4 offset = max(lambda, V4(0.0)) * lo + min(lambda, V4(0.0)) * hi;
    return offset + x * V4(cell.center[0]) + y * V4(cell.center[1]) + z * V4(cell.center[2]) -
           abs(x) * V4(cell.half[0]) - abs(y) * V4(cell.half[1]) - abs(z) * V4(cell.half[2]);
  }

  // With |lambda| <= 8 and a value within reach every term is below 1000.
  static constexpr double kDualRounding = 16 * kEpsilon * 1000;

  static double minimumAlong(const SlabArrays& slabs, const CellBox& cell, const double* m) {
    // A larger multiplier only amplifies rounding; any multiplier gives a valid bound.
    const V4 largest(8.0);
    V4 best(m[0] * cell.center[0] + m[1] * cell.center[1] + m[2] * cell.center[2] -
            std::fabs(m[0]) * cell.half[0] - std::fabs(m[1]) * cell.half[1] -
            std::fabs(m[2]) * cell.half[2]);
    for (int i = 0; i < slabs.count; i += 4) {
      const Directions n = directions(slabs, i);
      const V4 lo = max(V4::load(slabs.lo() + i), V4(-1e15));
      const V4 hi = min(V4::load(slabs.hi() + i), V4(1e15));
      const V4* axes[3] = {&n.x, &n.y, &n.z};
      for (int k = 0; k < 3; ++k) {
        const V4 lambda = clampedRatio(m[k], *axes[k], largest);
        best = max(best, dualValue(lambda, n, lo, hi, cell, m));
      }
    }
    return best.largest() - kDualRounding;
  }

  static V4 clampedRatio(double numerator, const V4& n, const V4& largest) {
    // n = 0 gives an infinite ratio (or NaN for 0/0), which the clamp turns into a finite
    // multiplier.
    return min(max(V4(numerator) / n, V4(0.0) - largest), largest);
  }

  // From the corner of the cell that lies deepest within a plane, the plane allows a width of
  // slack / |n_k| along axis k.
  static void contract(const SlabArrays& slabs, const CellBox& cell, double* lo, double* hi) {
    V4 lowest[3] = {V4(-kUnbounded), V4(-kUnbounded), V4(-kUnbounded)};
    V4 highest[3] = {V4(kUnbounded), V4(kUnbounded), V4(kUnbounded)};
    for (int i = 0; i < slabs.count; i += 4) {
      const Directions n = directions(slabs, i);
      const V4 d = dot(n, cell.center[0], cell.center[1], cell.center[2]);
      const V4 r = radius(n, cell.half);
      const V4 below = V4::load(slabs.hi() + i) - (d - r);
      const V4 above = (d + r) - V4::load(slabs.lo() + i);
      const V4* axes[3] = {&n.x, &n.y, &n.z};
      for (int k = 0; k < 3; ++k) {
        const V4 inverse = V4(1.0) / max(abs(*axes[k]), V4(kSmallest));
        const V4 from_lo = select(*axes[k], below, above) * inverse;
        const V4 from_hi = select(*axes[k], above, below) * inverse;
        highest[k] = min(highest[k], V4(cell.center[k] - cell.half[k]) + from_lo);
        lowest[k] = max(lowest[k], V4(cell.center[k] + cell.half[k]) - from_hi);
      }
    }
    for (int k = 0; k < 3; ++k) {
      lo[k] = std::fmax(lo[k], lowest[k].largest() - kContractRounding);
      hi[k] = std::fmin(hi[k], -(V4(0.0) - highest[k]).largest() + kContractRounding);
    }
  }

  // The slabs' own padding pays for the rounding of a slack; this for that of the sums that follow.
  static constexpr double kContractRounding = 1e-12;

  // A plane over which the cell sticks out by an excess is satisfied once the cell is narrowed by
  // excess / |n_k| along axis k, on the side towards which the plane's outward normal points.
  static CellSlice coveredSlice(const SlabArrays& slabs, const CellBox& cell) {
    V4 from_hi[3] = {V4(0.0), V4(0.0), V4(0.0)};
    V4 from_lo[3] = {V4(0.0), V4(0.0), V4(0.0)};
    for (int i = 0; i < slabs.count; i += 4) {
      const Directions n = directions(slabs, i);
      const V4 d = dot(n, cell.center[0], cell.center[1], cell.center[2]);
      const V4 r = radius(n, cell.half);
      const V4 margin = V4::load(slabs.margin() + i);
      const V4 above = max((d + r) - (V4::load(slabs.hi() + i) - margin), V4(0.0));
      const V4 below = max((V4::load(slabs.lo() + i) + margin) - (d - r), V4(0.0));
      const V4* axes[3] = {&n.x, &n.y, &n.z};
      for (int k = 0; k < 3; ++k) {
        const V4 inverse = V4(1.0) / max(abs(*axes[k]), V4(kSmallest));
        const V4 width_above = above * inverse;
        const V4 width_below = below * inverse;
        // n_k >= 0: the upper plane narrows from hi, the lower one from lo. An excess on the wrong
        // side cannot be mended.
        const V4 never_above = above * V4(kUnbounded);
        const V4 never_below = below * V4(kUnbounded);
        from_hi[k] = max(from_hi[k], select(*axes[k], max(width_above, never_below),
                                            max(width_below, never_above)));
        from_lo[k] = max(from_lo[k], select(*axes[k], max(width_below, never_above),
                                            max(width_above, never_below)));
      }
    }
    CellSlice best{-1, false, 0.0};
    double fraction = 0.0;
    for (int k = 0; k < 3; ++k) {
      const double width = 2 * cell.half[k];
      const double narrowed[2] = {from_hi[k].largest(), from_lo[k].largest()};
      for (int side = 0; side < 2; ++side) {
        const double left = width - narrowed[side] - kContractRounding;
        if (left > fraction * width) {
          fraction = left / width;
          best = {k, side == 0, left};
        }
      }
    }
    return best;
  }

  static SlabKernels table() {
    return {&classify,
            &classifyPoint,
            &pointsInBox,
            &minimumAlong,
            &contract,
            &coveredSlice,
            &SlabPlanesOver<V4>::planes,
            &SlabPlanesOver<V4>::triangleSlabs};
  }
};

}  // namespace fcl_prob::detail
