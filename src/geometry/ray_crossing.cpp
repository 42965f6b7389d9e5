// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "geometry/ray_crossing.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace fcl_prob::detail {
namespace {

/// What products below the smallest normal number lose, absolutely.
constexpr double kLostBelowNormal = 32 * std::numeric_limits<double>::denorm_min();

/// Sign of `value` if it exceeds its error, else 0.
int certainSign(double value, double error) {
  error += kLostBelowNormal;
  return value > error ? 1 : value < -error ? -1 : 0;
}

}  // namespace

std::optional<int> rayCrossing(const std::array<Eigen::Vector3d, 3>& corners, int axis,
                               double margin) {
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  for (const int k : {u, v}) {
    const auto [lo, hi] = std::minmax({corners[0][k], corners[1][k], corners[2][k]});
    if (lo > margin || hi < -margin) return 0;
  }
  double reach = margin;
  for (const Eigen::Vector3d& corner : corners) {
    reach = std::max(reach, corner.cwiseAbs().maxCoeff() + margin);
  }
  int positive = 0;
  int negative = 0;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d& p = corners[k];
    const Eigen::Vector3d& q = corners[(k + 1) % 3];
    const int sign = certainSign(p[u] * q[v] - p[v] * q[u], 16 * margin * reach);
    positive += sign > 0;
    negative += sign < 0;
  }
  if (positive > 0 && negative > 0) return 0;
  if (positive < 3 && negative < 3) return std::nullopt;
  const int facing = positive == 3 ? 1 : -1;

  const auto [lowest, highest] =
      std::minmax({corners[0][axis], corners[1][axis], corners[2][axis]});
  if (highest < -margin) return 0;
  if (lowest > margin) return facing;
  // Which side of the triangle's plane the origin is on.
  const double volume = corners[0].dot(corners[1].cross(corners[2]));
  const int ahead = certainSign(volume, 96 * margin * reach * reach);
  if (ahead == 0) return std::nullopt;
  return ahead == facing ? facing : 0;
}

}  // namespace fcl_prob::detail
