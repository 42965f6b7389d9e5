// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cells/direction_groups.h"

#include <algorithm>
#include <cstddef>

#include "base/constants.h"

namespace fcl_prob::detail {

namespace {

// Squared distance of unit vectors that count as one.
constexpr double kSame = 1e-12;

}  // namespace

std::vector<int> groupByDirection(const std::vector<Eigen::Vector3d>& vectors, int most) {
  std::vector<Eigen::Vector3d> directions;
  directions.reserve(vectors.size());
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& vector : vectors) {
    directions.push_back(vector.normalized());
    sum += vector;
  }
  // The first is the one that is farthest from the mean.
  std::vector<double> distances(vectors.size(), kInfinity);
  std::vector<int> groups(vectors.size(), 0);
  Eigen::Vector3d center = sum.normalized();
  for (int group = -1; group < most; ++group) {
    std::size_t farthest = 0;
    for (std::size_t i = 0; i < directions.size(); ++i) {
      const double distance = (directions[i] - center).squaredNorm();
      if (group <= 0 || distance < distances[i]) {
        distances[i] = distance;
        groups[i] = std::max(group, 0);
      }
      if (distances[i] > distances[farthest]) farthest = i;
    }
    if (directions.empty() || distances[farthest] < kSame) break;
    center = directions[farthest];
  }
  return groups;
}

}  // namespace fcl_prob::detail
