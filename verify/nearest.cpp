// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "nearest.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace verify {
namespace {

// Weights with sum 1 that make `Σ weights_i points_i` shortest; false if the points depend on each
// other.
bool shortest_combination(const std::vector<Vec>& points, std::vector<double>& weights) {
  // Unknown are the weights and a multiplier: 2 (p_i · Σ w_j p_j) + μ = 0, Σ w_j = 1.
  const std::size_t n = points.size() + 1;
  std::vector<std::vector<double>> m(n, std::vector<double>(n + 1, 1));
  double scale = 0;
  for (const Vec& p : points) scale = std::max(scale, dot(p, p));
  for (std::size_t i = 0; i + 1 < n; ++i) {
    for (std::size_t j = 0; j + 1 < n; ++j) m[i][j] = dot(points[i], points[j]) / scale;
    m[i][n] = 0;
  }
  m[n - 1][n - 1] = 0;
  for (std::size_t column = 0; column < n; ++column) {
    std::size_t pivot = column;
    for (std::size_t row = column + 1; row < n; ++row) {
      if (std::abs(m[row][column]) > std::abs(m[pivot][column])) pivot = row;
    }
    std::swap(m[pivot], m[column]);
    if (!(std::abs(m[column][column]) > 1e-15)) return false;
    for (std::size_t row = 0; row < n; ++row) {
      if (row == column) continue;
      const double factor = m[row][column] / m[column][column];
      for (std::size_t k = column; k <= n; ++k) m[row][k] -= factor * m[column][k];
    }
  }
  weights.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) weights[i] = m[i][n] / m[i][i];
  return true;
}

Vec combination(const std::vector<Vec>& points, const std::vector<double>& weights) {
  Vec result{};
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (int k = 0; k < 3; ++k) result[k] += weights[i] * points[i][k];
  }
  return result;
}

// Moves the weights towards the shortest combination until one of them is zero, which is dropped.
void step_to_boundary(std::vector<Vec>& points, std::vector<double>& weights,
                      const std::vector<double>& wanted) {
  double step = 1;
  std::size_t first = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (wanted[i] > 1e-14 || weights[i] - wanted[i] <= 0) continue;
    const double here = weights[i] / (weights[i] - wanted[i]);
    if (here <= step) {
      step = here;
      first = i;
    }
  }
  for (std::size_t i = 0; i < weights.size(); ++i) weights[i] += step * (wanted[i] - weights[i]);
  points.erase(points.begin() + static_cast<std::ptrdiff_t>(first));
  weights.erase(weights.begin() + static_cast<std::ptrdiff_t>(first));
}

}  // namespace

bool nearest_to_origin(const std::function<Vec(const Vec&)>& support, Vec& direction,
                       const std::function<bool(const Vec&)>& accept) {
  std::vector<Vec> points{support({1, 0, 0})};
  std::vector<double> weights{1}, wanted;
  direction = points[0];
  for (int round = 0; round < 100; ++round) {
    if (accept(direction)) return true;
    const Vec next = support(direction);
    if (dot(direction, next) >= dot(direction, direction) * (1 - 1e-14) || points.size() == 4)
      break;
    points.push_back(next);
    weights.push_back(0);
    while (points.size() > 1 && shortest_combination(points, wanted)) {
      if (*std::min_element(wanted.begin(), wanted.end()) > 1e-14) {
        weights = wanted;
        break;
      }
      step_to_boundary(points, weights, wanted);
    }
    const Vec before = direction;
    direction = combination(points, weights);
    if (direction == before) break;
  }
  return false;
}

}  // namespace verify
