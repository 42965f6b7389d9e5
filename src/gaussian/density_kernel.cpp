// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "gaussian/density_kernel.h"

#include <cstdint>
#include <cstring>

#include "base/with_avx2.h"

namespace fcl_prob::detail {
namespace {

constexpr int kLanes = 4;
typedef double Lanes __attribute__((vector_size(32)));
typedef std::uint64_t LaneBits __attribute__((vector_size(32)));

/// Replaces x, -708 <= x <= 0, by exp(x): 2^k exp(r), |r| <= log(2)/2, by Taylor's polynomial of
/// degree 11, whose remainder is below 7e-15. 2^k is added to the exponent's bits; k is in the low
/// bits of x log₂e plus 1.5 2^52.
void exponentiate(Lanes& x) {
  constexpr double kRound = 6755399441055744.0, kLog2E = 1.4426950408889634;
  // The first has zeros at its end, so that its product with k is exact (Cody and Waite 1980).
  constexpr double kLog2High = 0.693147180369123816490, kLog2Low = 1.90821492927058770002e-10;
  const Lanes rounded = x * kLog2E + kRound;
  const Lanes k = rounded - kRound;
  const Lanes r = (x - k * kLog2High) - k * kLog2Low;
  // Estrin's scheme: Horner's would wait for itself.
  const Lanes r2 = r * r, r4 = r2 * r2;
  const Lanes a = (r + 1.0) + r2 * (r * (1.0 / 6.0) + 0.5);
  const Lanes b = (r * (1.0 / 120.0) + 1.0 / 24.0) + r2 * (r * (1.0 / 5040.0) + 1.0 / 720.0);
  const Lanes c =
      (r * (1.0 / 362880.0) + 1.0 / 40320.0) + r2 * (r * (1.0 / 39916800.0) + 1.0 / 3628800.0);
  Lanes p = a + r4 * (b + r4 * c);
  LaneBits bits, exponent;
  std::memcpy(&bits, &p, sizeof bits);
  std::memcpy(&exponent, &rounded, sizeof exponent);
  bits += exponent << 52;
  std::memcpy(&x, &bits, sizeof x);
}

void load(const double* values, Lanes& lanes) { std::memcpy(&lanes, values, sizeof lanes); }

double sumOf(const Lanes& lanes) { return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]); }

}  // namespace

// Four lines at a time, node by node.
FCL_PROB_WITH_AVX2
DensitySums densityOfLines(const DensityLines& lines, const DensityNodes& nodes) {
  Lanes total{}, moment[3] = {}, farthest{};
  const Lanes least = Lanes{} - 708.0;
  for (int first = 0; first < lines.count; first += kLanes) {
    Lanes point[3], direction[3];
    for (int axis = 0; axis < 3; ++axis) {
      load(lines.point[axis] + first, point[axis]);
      load(lines.direction[axis] + first, direction[axis]);
    }
    Lanes sum{}, sum_of_rho{};
    for (int k = 0; k < nodes.count; ++k) {
      const double rho = nodes.rho[k];
      const Lanes x = direction[0] * rho + point[0];
      const Lanes y = direction[1] * rho + point[1];
      const Lanes z = direction[2] * rho + point[2];
      const Lanes square = x * x + y * y + z * z;
      Lanes term = square * -0.5;
      term = term > least ? term : least;
      exponentiate(term);
      term *= nodes.weight[k];
      sum += term;
      sum_of_rho += term * rho;
      farthest = square > farthest ? square : farthest;
    }
    Lanes weight;
    load(lines.weight + first, weight);
    total += weight * sum;
    for (int axis = 0; axis < 3; ++axis) {
      moment[axis] += weight * (sum * point[axis] + sum_of_rho * direction[axis]);
    }
  }
  DensitySums sums;
  sums.sum = sumOf(total);
  for (int axis = 0; axis < 3; ++axis) sums.moment[axis] = sumOf(moment[axis]);
  for (int k = 0; k < kLanes; ++k) {
    if (farthest[k] > sums.farthest_square) sums.farthest_square = farthest[k];
  }
  return sums;
}

}  // namespace fcl_prob::detail
