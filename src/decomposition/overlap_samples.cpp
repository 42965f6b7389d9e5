// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "decomposition/overlap_samples.h"

#include <cmath>

#include "base/quantiles.h"

namespace fcl_prob::detail {
namespace {

constexpr int kSamples = 2048;

/// Evenly spread in the unit cube: the additive recurrence of the third root of x = 1 + 1/x³
/// (Roberts 2018), mapped to N(0, I).
std::vector<Eigen::Vector3d> normalPoints() {
  constexpr double kRoot = 1.22074408460575947536;
  std::vector<Eigen::Vector3d> points;
  for (int i = 1; i <= kSamples; ++i) {
    Eigen::Vector3d point;
    double step = 1.0;
    for (int k = 0; k < 3; ++k) {
      step /= kRoot;
      const double uniform = 0.5 + i * step - std::floor(0.5 + i * step);
      point[k] = -std::sqrt(2.0) * erfcInverse(2.0 * std::max(uniform, 1e-12));
    }
    points.push_back(point);
  }
  return points;
}

}  // namespace

std::vector<std::vector<double>> sampledOverlaps(
    const std::vector<std::optional<KnownObstacle>>& obstacles, const Eigen::Vector3d& centre) {
  std::vector<std::vector<double>> overlaps(obstacles.size(),
                                            std::vector<double>(obstacles.size(), 0.0));
  for (const Eigen::Vector3d& z : normalPoints()) {
    const double weight = std::exp(-centre.dot(z) - 0.5 * centre.squaredNorm()) / kSamples;
    std::vector<std::size_t> around;
    for (std::size_t i = 0; i < obstacles.size(); ++i) {
      if (obstacles[i] && obstacles[i]->contains(centre + z)) around.push_back(i);
    }
    for (const std::size_t i : around) {
      for (const std::size_t j : around) overlaps[i][j] += weight;
    }
  }
  return overlaps;
}

std::vector<std::pair<std::size_t, std::size_t>> heaviestTree(
    const std::vector<std::vector<double>>& weights) {
  const std::size_t count = weights.size();
  std::vector<std::pair<std::size_t, std::size_t>> tree;
  std::vector<std::size_t> parent(count, 0);
  std::vector<bool> reached(count, false);
  if (count > 0) reached[0] = true;
  for (std::size_t step = 1; step < count; ++step) {
    std::size_t next = 0;
    for (std::size_t i = 1; i < count; ++i) {
      if (reached[i]) continue;
      if (next == 0 || weights[i][parent[i]] > weights[next][parent[next]]) next = i;
    }
    reached[next] = true;
    tree.emplace_back(parent[next], next);
    for (std::size_t i = 1; i < count; ++i) {
      if (!reached[i] && weights[i][next] > weights[i][parent[i]]) parent[i] = next;
    }
  }
  return tree;
}

}  // namespace fcl_prob::detail
