// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What a cell reaches along the faces of a convex body, held against the offsets of one obstacle.
#pragma once

namespace fcl_prob::detail {

/// Whether a value is above a limit is whether it is not at most limit + by, so that what is not a
/// number is above.
struct FaceKernels {
  /// The first face whose value is above its limit, or `count`.
  int (*firstAbove)(const double* values, const double* limits, double by, int count);

  /// All of them in order, into `found`, which has room for `count` and kFaceLanes more; how many.
  int (*allAbove)(const double* values, const double* limits, double by, int count, int* found);
};

inline constexpr int kFaceLanes = 4;

/// The fastest for the processor; all of them have identical results.
const FaceKernels& faceKernels();

#if defined(__x86_64__)
FaceKernels avx2FaceKernels();
#endif

}  // namespace fcl_prob::detail
