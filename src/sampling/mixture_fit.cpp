// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "sampling/mixture_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace fcl_prob::detail {
namespace {

constexpr int kIterations = 12;

/// Points that a component must be made of, in effect: below it a scatter is not known.
constexpr double kFewestPoints = 8.0;

/// Too narrow a density makes a few weights dominate, too wide a one only wastes samples.
constexpr double kWidening = 1.3;

using Points = std::vector<WeightedPoint>;
using Responsibilities = std::vector<std::vector<double>>;  // [component][point]

struct Gaussian {
  MixtureComponent component;
  Eigen::Matrix3d inverse_root;
  double log_scale;
};

/// The component of weighted points; `shares` says how much of each point is its own.
MixtureComponent componentOf(const Points& points, const std::vector<double>& shares, int rank) {
  MixtureComponent component{0.0, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero()};
  for (std::size_t i = 0; i < points.size(); ++i) {
    component.weight += shares[i];
    component.centre += shares[i] * points[i].point;
  }
  component.centre /= component.weight;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d d = points[i].point - component.centre;
    component.scatter += shares[i] * d * d.transpose();
  }
  component.scatter /= component.weight;
  const double floor = 1e-6 * component.scatter.trace() + 1e-24;
  for (int k = 0; k < rank; ++k) component.scatter(k, k) += floor;
  return component;
}

Gaussian prepared(const MixtureComponent& component, int rank) {
  Gaussian gaussian{component, Eigen::Matrix3d::Zero(), 0.0};
  const Eigen::MatrixXd block = component.scatter.topLeftCorner(rank, rank);
  const Eigen::MatrixXd root = block.llt().matrixL();
  gaussian.inverse_root.topLeftCorner(rank, rank) = root.inverse();
  gaussian.log_scale = std::log(component.weight) - root.diagonal().array().log().sum();
  return gaussian;
}

/// How many equally weighted points these shares are worth.
double effectiveCount(const std::vector<double>& shares) {
  double sum = 0.0;
  double squares = 0.0;
  for (double share : shares) {
    sum += share;
    squares += share * share;
  }
  return squares > 0.0 ? sum * sum / squares : 0.0;
}

/// Well separated starting points: the heaviest one, then always the one whose weight times squared
/// distance from those chosen is largest.
std::vector<Eigen::Vector3d> startingPoints(const Points& points, std::size_t count) {
  const auto heaviest =
      std::max_element(points.begin(), points.end(),
                       [](const auto& a, const auto& b) { return a.weight < b.weight; });
  std::vector<Eigen::Vector3d> chosen = {heaviest->point};
  std::vector<double> distance(points.size(), std::numeric_limits<double>::infinity());
  while (chosen.size() < count) {
    std::size_t farthest = 0;
    double largest = -1.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      distance[i] = std::min(distance[i], (points[i].point - chosen.back()).squaredNorm());
      if (points[i].weight * distance[i] <= largest) continue;
      largest = points[i].weight * distance[i];
      farthest = i;
    }
    chosen.push_back(points[farthest].point);
  }
  return chosen;
}

Responsibilities nearestStart(const Points& points, const std::vector<Eigen::Vector3d>& starts) {
  Responsibilities shares(starts.size(), std::vector<double>(points.size(), 0.0));
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::size_t nearest = 0;
    for (std::size_t k = 1; k < starts.size(); ++k) {
      if ((points[i].point - starts[k]).squaredNorm() <
          (points[i].point - starts[nearest]).squaredNorm()) {
        nearest = k;
      }
    }
    shares[nearest][i] = points[i].weight;
  }
  return shares;
}

std::vector<Gaussian> maximise(const Points& points, const Responsibilities& responsibilities,
                               int rank) {
  std::vector<Gaussian> mixture;
  for (const auto& shares : responsibilities) {
    if (effectiveCount(shares) < kFewestPoints) continue;
    mixture.push_back(prepared(componentOf(points, shares, rank), rank));
  }
  return mixture;
}

Responsibilities expect(const Points& points, const std::vector<Gaussian>& mixture) {
  Responsibilities shares(mixture.size(), std::vector<double>(points.size(), 0.0));
  std::vector<double> logs(mixture.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t k = 0; k < mixture.size(); ++k) {
      const Eigen::Vector3d d = points[i].point - mixture[k].component.centre;
      logs[k] = mixture[k].log_scale - 0.5 * (mixture[k].inverse_root * d).squaredNorm();
    }
    const double top = *std::max_element(logs.begin(), logs.end());
    double sum = 0.0;
    for (double& value : logs) sum += value = std::exp(value - top);
    for (std::size_t k = 0; k < mixture.size(); ++k) {
      shares[k][i] = points[i].weight * logs[k] / sum;
    }
  }
  return shares;
}

}  // namespace

std::vector<MixtureComponent> fitMixture(const std::vector<WeightedPoint>& points, int rank,
                                         int most) {
  std::vector<double> weights;
  for (const WeightedPoint& point : points) weights.push_back(point.weight);
  const double effective = effectiveCount(weights);
  if (effective < kFewestPoints) return {};
  const double worth = std::floor(effective / (2 * kFewestPoints));
  const auto count = static_cast<std::size_t>(std::clamp(worth, 1.0, static_cast<double>(most)));
  std::vector<Gaussian> mixture =
      maximise(points, nearestStart(points, startingPoints(points, count)), rank);
  if (mixture.empty()) mixture = maximise(points, {weights}, rank);
  for (int i = 0; i < kIterations; ++i) {
    std::vector<Gaussian> next = maximise(points, expect(points, mixture), rank);
    if (next.empty()) break;
    mixture = std::move(next);
  }
  double total = 0.0;
  for (const Gaussian& gaussian : mixture) total += gaussian.component.weight;
  std::vector<MixtureComponent> components;
  for (const Gaussian& gaussian : mixture) {
    components.push_back(gaussian.component);
    components.back().weight /= total;
    components.back().scatter *= kWidening;
  }
  return components;
}

}  // namespace fcl_prob::detail
