// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "convex/spanning_frame.h"

#include <Eigen/LU>
#include <algorithm>
#include <limits>

namespace fcl_prob::detail {
namespace {

// Rounding of a coordinate of the widest extent, with room for the few operations that make it.
constexpr double kRelativeRounding = 32 * std::numeric_limits<double>::epsilon();

// What is left of `v` after its parts along the first `count` columns are taken out; twice, because
// the first pass leaves rounding of the size of `v`.
Eigen::Vector3d residual(const Eigen::Matrix3d& directions, int count, Eigen::Vector3d v) {
  for (int pass = 0; pass < 2; ++pass) {
    for (int k = 0; k < count; ++k) v -= directions.col(k) * directions.col(k).dot(v);
  }
  return v;
}

// The longest residual of the points about `origin`.
Eigen::Vector3d longestResidual(const std::vector<Eigen::Vector3d>& points,
                                const SpanningFrame& frame, int count) {
  Eigen::Vector3d longest = Eigen::Vector3d::Zero();
  double longest_norm = 0;
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3d candidate = residual(frame.directions, count, point - frame.origin);
    const double norm = candidate.stableNorm();
    if (norm > longest_norm) {
      longest_norm = norm;
      longest = candidate;
    }
  }
  return longest;
}

}  // namespace

Eigen::Vector3d SpanningFrame::coordinates(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d offset = point - origin;
  Eigen::Vector3d result = Eigen::Vector3d::Zero();
  for (int k = 0; k < dimension; ++k) result[k] = directions.col(k).dot(offset) / widths[k];
  return result;
}

SpanningFrame spanningFrame(const std::vector<Eigen::Vector3d>& points) {
  SpanningFrame frame{points.front(), Eigen::Matrix3d::Zero(), Eigen::Vector3d::Zero(), 0};
  // From the point farthest from the first one, so that the widest direction is nearly a diameter.
  frame.origin = points.front() + longestResidual(points, frame, 0);
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d longest = longestResidual(points, frame, k);
    const double width = longest.stableNorm();
    if (width <= kRelativeRounding * frame.widths[0] || width == 0) break;
    frame.widths[k] = width;
    frame.directions.col(k) = longest.stableNormalized();
    if (frame.directions.determinant() < 0) frame.directions.col(k) *= -1;
    frame.dimension = k + 1;
  }
  return frame;
}

}  // namespace fcl_prob::detail
