// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The part of a triangle within a box.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <limits>

namespace fcl_prob::detail {

/// What is left of a triangle within a box: every side adds one corner at most.
struct ClippedTriangle {
  std::array<Eigen::Vector3d, 9> corners;
  int count;

  /// Keeps { sign x[axis] <= level }.
  void clip(int axis, double sign, double level);
};

inline void ClippedTriangle::clip(int axis, double sign, double level) {
  std::array<double, 9> beyond;
  int outside = 0;
  for (int i = 0; i < count; ++i) {
    beyond[i] = sign * corners[i][axis] - level;
    if (beyond[i] > 0) ++outside;
  }
  if (outside == 0) return;
  const ClippedTriangle whole = *this;
  count = 0;
  if (outside == whole.count) return;
  for (int i = 0; i < whole.count; ++i) {
    const int next = i + 1 < whole.count ? i + 1 : 0;
    if (beyond[i] <= 0) corners[count++] = whole.corners[i];
    if ((beyond[i] <= 0) == (beyond[next] <= 0)) continue;
    const double share = beyond[i] / (beyond[i] - beyond[next]);
    corners[count++] = whole.corners[i] + share * (whole.corners[next] - whole.corners[i]);
  }
}

/// The largest m·x over the part of a triangle within a box, up to rounding; -inf if there is none.
inline double highestWithin(const std::array<Eigen::Vector3d, 3>& triangle,
                            const Eigen::Vector3d& lo, const Eigen::Vector3d& hi,
                            const Eigen::Vector3d& m) {
  ClippedTriangle rest;
  std::copy(triangle.begin(), triangle.end(), rest.corners.begin());
  rest.count = 3;
  for (int k = 0; k < 3 && rest.count > 0; ++k) {
    rest.clip(k, 1.0, hi[k]);
    rest.clip(k, -1.0, -lo[k]);
  }
  double highest = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < rest.count; ++i) highest = std::max(highest, m.dot(rest.corners[i]));
  return highest;
}

}  // namespace fcl_prob::detail
