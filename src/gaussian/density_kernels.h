// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The inner loop of cubatures over plain arrays of doubles: the normal density along a line.
#pragma once

namespace fcl_prob::detail {

/// Of the points y_k = point + rho_k direction: Σ weight_k exp(-|y_k|²/2), Σ weight_k rho_k
/// exp(-|y_k|²/2), and the largest |y_k|².
struct DensitySums {
  double sum = 0.0, sum_of_rho = 0.0, farthest_square = 0.0;
};

/// A term is right to (|y|² + 40) 2^-52 of itself, and to 1e-307 of its weight. `count` is a
/// multiple of four: what is not needed has no weight.
using DensityKernel = DensitySums (*)(const double* point, const double* direction,
                                      const double* rho, const double* weight, int count);

/// The fastest for the processor; all of them have identical results.
DensityKernel densityKernel();

#if defined(__x86_64__)
DensityKernel densityKernelAvx2();
#endif

}  // namespace fcl_prob::detail
