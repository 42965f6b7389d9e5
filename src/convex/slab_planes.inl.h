// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The planes of a C-obstacle's slabs and what rounding may have moved them by, over a four-lane
// vector type `V4`; included once for each instruction set.
//
// Every bound here is a sum over the axes, so that it does not change when an axis is stretched:
// the size of a piece along one axis may be 1e12 of that along another.
#pragma once

#include <cmath>

#include "base/constants.h"
#include "convex/slab_kernels.h"

namespace fcl_prob::detail {

template <typename V4>
struct SlabPlanesOver {
  // Two edges closer to parallel than this, in the frame in which V is as wide along every axis,
  // give no trustworthy normal: the slab is left out, as if they were parallel.
  static constexpr double kParallelSine = 3e-8;

  // Of a product of edges: beyond these its square overflows or underflows.
  static constexpr double kLongest = 1e150;
  static constexpr double kShortest = 1e-140;

  // What is the same for all slabs of an obstacle.
  struct Scales {
    double inverse_width[3];
    double outward[3];   // padding: 4 errors and the rounding of a sum of products
    double rounding[3];  // of n·(y - v), for |p_i q_j| + |p_j q_i| = 1
  };

  // larger() would be one function for all instruction sets: see src/CMakeLists.txt.
  static double larger(double x, double y) { return x > y ? x : y; }

  static Scales scalesOf(const SlabExtent& extent) {
    Scales scales;
    for (int k = 0; k < 3; ++k) {
      scales.inverse_width[k] = 1.0 / larger(extent.width[k], 1e-150);
      scales.outward[k] = 4 * extent.error[k] + 32 * kEpsilon * extent.reach[k];
      scales.rounding[k] = 16 * kEpsilon * extent.reach[k];
    }
    return scales;
  }

  static void planes(const double* p, const double* q, int count, const SlabExtent& extent,
                     double* out) {
    const Scales scales = scalesOf(extent);
    double moved[3] = {0.0, 0.0, 0.0};
    bool bounded = false;
    for (int i = 0; i < count; i += 4) {
      double length[4];
      double sine[4];
      fourPlanes(p + i, q + i, count, scales, out + i, length, sine);
      for (int lane = 0; lane < 4; ++lane) {
        // The comparisons also catch NaN.
        if (sine[lane] >= kParallelSine && length[lane] >= kShortest && length[lane] <= kLongest) {
          bounded = true;
        } else {
          leaveOut(p + i + lane, q + i + lane, count, scales, out + i + lane, moved);
        }
      }
    }
    if (moved[0] + moved[1] + moved[2] != 0.0) payForMoves(p, q, count, extent, moved, out);
    // All edges parallel: V has no inside, which a margin without end says.
    if (!bounded) out[5 * count] = 4 * kUnbounded;
  }

  // A rounded normal n is off by a few ε (|p_i q_j| + |p_j q_i|) / |p × q| along each axis. Where V
  // is the obstacle of the rounded vertices, n·(y - v) <= -margin for the v of V farthest along n
  // implies that y is below V's own plane near n, for every y of a cell; the padding is that of V
  // against the true obstacle, which the margin takes off twice, since lo and hi have it added.
  static void fourPlanes(const double* p, const double* q, int count, const Scales& scales,
                         double* out, double* lengths, double* sines) {
    const V4 px = V4::load(p), py = V4::load(p + count), pz = V4::load(p + 2 * count);
    const V4 qx = V4::load(q), qy = V4::load(q + count), qz = V4::load(q + 2 * count);
    const V4 yz = py * qz, zy = pz * qy;
    const V4 zx = pz * qx, xz = px * qz;
    const V4 xy = px * qy, yx = py * qx;
    const V4 nx = yz - zy;
    const V4 ny = zx - xz;
    const V4 nz = xy - yx;
    const V4 length = sqrt(nx * nx + ny * ny + nz * nz);
    const V4 inverse = V4(1.0) / max(length, V4(1e-300));
    const V4 unit_x = nx * inverse, unit_y = ny * inverse, unit_z = nz * inverse;
    const V4 pad = abs(unit_x) * V4(scales.outward[0]) + abs(unit_y) * V4(scales.outward[1]) +
                   abs(unit_z) * V4(scales.outward[2]);
    const V4 rounding = (abs(yz) + abs(zy)) * V4(scales.rounding[0]) +
                        (abs(zx) + abs(xz)) * V4(scales.rounding[1]) +
                        (abs(xy) + abs(yx)) * V4(scales.rounding[2]);
    length.store(lengths);
    sineOf(px, py, pz, qx, qy, qz, nx, ny, nz, scales.inverse_width).store(sines);
    unit_x.store(out);
    unit_y.store(out + count);
    unit_z.store(out + 2 * count);
    (V4(0.0) - pad).store(out + 3 * count);
    pad.store(out + 4 * count);
    (pad + pad + rounding * inverse).store(out + 5 * count);
  }

  // Between p and q in the frame in which V is as wide along every axis.
  static V4 sineOf(const V4& px, const V4& py, const V4& pz, const V4& qx, const V4& qy,
                   const V4& qz, const V4& nx, const V4& ny, const V4& nz, const double* inverse) {
    const V4 ix(inverse[0]), iy(inverse[1]), iz(inverse[2]);
    const V4 n = norm(nx * iy * iz, ny * iz * ix, nz * ix * iy);
    return n / max(norm(px * ix, py * iy, pz * iz) * norm(qx * ix, qy * iy, qz * iz), V4(1e-300));
  }

  static V4 norm(const V4& x, const V4& y, const V4& z) { return sqrt(x * x + y * y + z * z); }

  // Leaves a slab out. Moving a vertex, so that the shorter of the two edges becomes parallel to
  // the longer one, makes an obstacle without it; `moved` adds up those moves.
  static void leaveOut(const double* p, const double* q, int count, const Scales& scales,
                       double* out, double* moved) {
    double pp = 0.0, pq = 0.0, qq = 0.0;
    for (int k = 0; k < 3; ++k) {
      const double pk = p[k * count] * scales.inverse_width[k];
      const double qk = q[k * count] * scales.inverse_width[k];
      pp += pk * pk;
      pq += pk * qk;
      qq += qk * qk;
    }
    const double* longer = pp > qq ? p : q;
    const double* shorter = pp > qq ? q : p;
    const double ratio = larger(pp, qq) > 1e-280 ? pq / larger(pp, qq) : 0.0;
    for (int k = 0; k < 3; ++k) {
      const double along = ratio * longer[k * count];
      const double whole = shorter[k * count];
      moved[k] += std::fabs(whole - along) + 4 * kEpsilon * (std::fabs(whole) + std::fabs(along));
      out[k * count] = 0.0;
    }
    out[3 * count] = -kUnbounded;
    out[4 * count] = kUnbounded;
    out[5 * count] = 0.0;
  }

  // V without the slabs left out is the obstacle of vertices that are off by up to `moved`: that
  // moves the planes, and turns their normals p × q.
  static void payForMoves(const double* p, const double* q, int count, const SlabExtent& extent,
                          const double* moved, double* out) {
    for (int i = 0; i < count; ++i) {
      if (out[4 * count + i] >= kUnbounded) continue;
      double normal[3];
      double length = 0.0;
      double turned = 0.0;
      double shifted = 0.0;
      for (int k = 0; k < 3; ++k) {
        const int u = (k + 1) % 3 * count + i;
        const int v = (k + 2) % 3 * count + i;
        const double move_u = moved[(k + 1) % 3];
        const double move_v = moved[(k + 2) % 3];
        normal[k] = p[u] * q[v] - p[v] * q[u];
        length = std::hypot(length, normal[k]);
        turned += extent.reach[k] * ((std::fabs(p[u]) + std::fabs(q[u]) + move_u) * move_v +
                                     (std::fabs(p[v]) + std::fabs(q[v])) * move_u);
        shifted += std::fabs(out[k * count + i]) * moved[k];
      }
      const double margin = out[5 * count + i] + 4 * turned / length + 2 * shifted;
      out[5 * count + i] = margin < kUnbounded ? margin : 4 * kUnbounded;
    }
  }

  static void triangleSlabs(const double* a, const double* b, const double* error, double* out) {
    double p[3 * kTriangleSlabs];
    double q[3 * kTriangleSlabs];
    double base[3];  // b0 - a0
    double edges_a[2][3];
    double edges_b[2][3];
    SlabExtent extent;
    for (int k = 0; k < 3; ++k) {
      const double of_a[3] = {a[3 + k] - a[k], a[6 + k] - a[k], a[6 + k] - a[3 + k]};
      const double of_b[3] = {b[3 + k] - b[k], b[6 + k] - b[k], b[6 + k] - b[3 + k]};
      base[k] = b[k] - a[k];
      const auto add = [&](int slab, double first, double second) {
        p[k * kTriangleSlabs + slab] = first;
        q[k * kTriangleSlabs + slab] = second;
      };
      add(0, of_a[0], of_a[1]);
      add(1, of_b[0], of_b[1]);
      for (int i = 0; i < 9; ++i) add(2 + i, of_a[i / 3], of_b[i % 3]);
      add(11, 0.0, 0.0);
      for (int edge = 0; edge < 2; ++edge) {
        edges_a[edge][k] = of_a[edge];
        edges_b[edge][k] = of_b[edge];
      }
      extent.width[k] = 0.0;
      extent.reach[k] = std::fabs(a[k]) + std::fabs(b[k]) + kReach;
      for (int edge = 0; edge < 3; ++edge) {
        const double longer = larger(std::fabs(of_a[edge]), std::fabs(of_b[edge]));
        extent.width[k] = larger(extent.width[k], longer);
        extent.reach[k] += longer;
      }
      extent.error[k] = error[k];
    }
    planes(p, q, kTriangleSlabs, extent, out);
    closeFlat(p, q, extent, out);
    addExtents(base, edges_a, edges_b, out);
  }

  // A triangle without area, slab 0 or 1, may make an obstacle that is flat or a segment, which the
  // normals that are left do not bound sideways: slabs left out are put across it. Any slab holds
  // V.
  static void closeFlat(const double* p, const double* q, const SlabExtent& extent, double* out) {
    constexpr int kCount = kTriangleSlabs;
    const bool flat = out[4 * kCount] >= kUnbounded || out[4 * kCount + 1] >= kUnbounded;
    if (!flat) return;
    const Scales scales = scalesOf(extent);
    int kept = -1;
    for (int i = 0; i < kCount && kept < 0; ++i) {
      if (out[4 * kCount + i] < kUnbounded) kept = i;
    }
    for (int i = 0; i < kCount; ++i) {
      if (out[4 * kCount + i] < kUnbounded) continue;
      double edge[3];
      double length_p = 0.0;
      double length_q = 0.0;
      for (int k = 0; k < 3; ++k) {
        length_p += std::fabs(p[k * kCount + i]);
        length_q += std::fabs(q[k * kCount + i]);
      }
      for (int k = 0; k < 3; ++k) edge[k] = (length_p > length_q ? p : q)[k * kCount + i];
      double across[3] = {0.0, 0.0, 0.0};
      if (kept >= 0) {
        for (int k = 0; k < 3; ++k) across[k] = out[k * kCount + kept];
      } else {
        // Of a segment: two directions across it, in turn.
        double axis[3] = {0.0, 0.0, 0.0};
        axis[shortestAxis(edge)] = 1.0;
        if (i % 2 == 0) {
          cross(edge, axis, across);
        } else {
          for (int k = 0; k < 3; ++k) across[k] = axis[k];
        }
      }
      addAcross(across, edge, scales, out + i);
    }
  }

  static int shortestAxis(const double* v) {
    int shortest = 0;
    for (int k = 1; k < 3; ++k) {
      if (std::fabs(v[k]) < std::fabs(v[shortest])) shortest = k;
    }
    return shortest;
  }

  static void cross(const double* u, const double* v, double* out) {
    for (int k = 0; k < 3; ++k) {
      out[k] = u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
    }
  }

  // A slab with the normal `across` × `edge`, if that is one.
  static void addAcross(const double* across, const double* edge, const Scales& scales,
                        double* out) {
    double n[3];
    cross(across, edge, n);
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    if (!(length >= kShortest && length <= kLongest)) return;
    double pad = 0.0;
    for (int k = 0; k < 3; ++k) {
      out[k * kTriangleSlabs] = n[k] / length;
      pad += std::fabs(n[k]) / length * scales.outward[k];
    }
    out[3 * kTriangleSlabs] = -pad;
    out[4 * kTriangleSlabs] = pad;
    // A margin without end, which says that V has no inside, stays.
    out[5 * kTriangleSlabs] = larger(out[5 * kTriangleSlabs], 2 * pad);
  }

  // The extent of V along the normals, to the padding that is in lo and hi.
  static void addExtents(const double* base, const double edges_a[2][3], const double edges_b[2][3],
                         double* out) {
    constexpr int kCount = kTriangleSlabs;
    for (int i = 0; i < kCount; i += 4) {
      const V4 x = V4::load(out + i), y = V4::load(out + kCount + i),
               z = V4::load(out + 2 * kCount + i);
      const auto along = [&](const double* v) {
        return x * V4(v[0]) + y * V4(v[1]) + z * V4(v[2]);
      };
      const V4 first = along(base);
      const V4 zero(0.0);
      const V4 a1 = along(edges_a[0]), a2 = along(edges_a[1]);
      const V4 b1 = along(edges_b[0]), b2 = along(edges_b[1]);
      const V4 hi = first + max(zero, max(b1, b2)) - min(zero, min(a1, a2));
      const V4 lo = first + min(zero, min(b1, b2)) - max(zero, max(a1, a2));
      (V4::load(out + 3 * kCount + i) + lo).store(out + 3 * kCount + i);
      (V4::load(out + 4 * kCount + i) + hi).store(out + 4 * kCount + i);
    }
  }
};

}  // namespace fcl_prob::detail
