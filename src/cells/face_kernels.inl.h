// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The kernels over `Four`, whose above() tells of four faces at once by four bits; included once
// for each instruction set.
#pragma once

#include "cells/face_kernels.h"

namespace fcl_prob::detail {

/// The bits of a mask that are set, the lowest first, and how many.
struct SetBits {
  int at[kFaceLanes];
  int count;
};

inline constexpr SetBits kSetBits[16] = {
    {{0, 0, 0, 0}, 0}, {{0, 0, 0, 0}, 1}, {{1, 0, 0, 0}, 1}, {{0, 1, 0, 0}, 2},
    {{2, 0, 0, 0}, 1}, {{0, 2, 0, 0}, 2}, {{1, 2, 0, 0}, 2}, {{0, 1, 2, 0}, 3},
    {{3, 0, 0, 0}, 1}, {{0, 3, 0, 0}, 2}, {{1, 3, 0, 0}, 2}, {{0, 1, 3, 0}, 3},
    {{2, 3, 0, 0}, 2}, {{0, 2, 3, 0}, 3}, {{1, 2, 3, 0}, 3}, {{0, 1, 2, 3}, 4}};

template <typename Four>
struct FaceKernelsOver {
  static int firstAbove(const double* values, const double* limits, double by, int count) {
    int face = 0;
    for (; face + kFaceLanes <= count; face += kFaceLanes) {
      const int mask = Four::above(values + face, limits + face, by);
      if (mask != 0) return face + kSetBits[mask].at[0];
    }
    while (face < count && values[face] <= limits[face] + by) ++face;
    return face;
  }

  static int allAbove(const double* values, const double* limits, double by, int count,
                      int* found) {
    int so_far = 0;
    int face = 0;
    for (; face + kFaceLanes <= count; face += kFaceLanes) {
      const SetBits& bits = kSetBits[Four::above(values + face, limits + face, by)];
      for (int k = 0; k < kFaceLanes; ++k) found[so_far + k] = face + bits.at[k];
      so_far += bits.count;
    }
    for (; face < count; ++face) {
      found[so_far] = face;
      so_far += values[face] <= limits[face] + by ? 0 : 1;
    }
    return so_far;
  }

  static FaceKernels table() { return {firstAbove, allAbove}; }
};

}  // namespace fcl_prob::detail
