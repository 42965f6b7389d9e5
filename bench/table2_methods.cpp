// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "bench/table2_methods.h"

#include "bench/least_distance.h"
#include "bench/table2_bounds.h"
#include "cli/geometry.h"
#include "cli/random_displacement.h"
#include "geometry/mesh_visitor.h"

namespace fcl_prob::cli {
namespace {

using Poses = std::vector<fcl::Transform3d>;

constexpr int kSamplesOfState = 10'000;

const GaussianDisplacement& gaussianOf(const Obstacle& obstacle) {
  return std::get<GaussianDisplacement>(obstacle.displacement);
}

/// Displaced obstacles, the same standard normal numbers at every state.
class MonteCarloRow {
 public:
  MonteCarloRow(const Table2Scene& scene, std::uint64_t seed) {
    const Whitening unit(GaussianDisplacement::fromStandardDeviations({1.0, 1.0, 1.0}));
    for (std::size_t j = 0; j < scene.obstacles().size(); ++j) {
      normals_.emplace_back();
      for (std::uint64_t i = 0; i < kSamplesOfState; ++i) {
        normals_.back().push_back(randomDisplacement(unit, seed + 1000 * j, i));
      }
    }
  }

  double operator()(const Table2State& state, double enough) const {
    const Poses poses = state.query.robot().poses(state.values);
    int hits = 0;
    for (std::size_t i = 0; i < kSamplesOfState; ++i) {
      hits += isHit(state.query, poses, i);
      if (hits >= enough * kSamplesOfState) break;
    }
    return static_cast<double>(hits) / kSamplesOfState;
  }

 private:
  bool isHit(const RobotQuery& query, const Poses& poses, std::size_t sample) const {
    for (std::size_t j = 0; j < query.obstacles().size(); ++j) {
      const Obstacle& obstacle = query.obstacles()[j];
      const GaussianDisplacement& error = gaussianOf(obstacle);
      const Eigen::Vector3d scaled = error.standardDeviations().cwiseProduct(normals_[j][sample]);
      fcl::Transform3d pose = obstacle.pose;
      pose.translation() += error.mean() + error.axes() * scaled;
      if (touchesAny(query.robot(), poses, *obstacle.geometry, pose)) return true;
    }
    return false;
  }

  std::vector<std::vector<Eigen::Vector3d>> normals_;  ///< by obstacle
};

/// Collision with obstacles that are thicker by so many of their largest standard deviations.
class PaddingRow {
 public:
  PaddingRow(const Table2Scene& scene, double deviations) {
    for (const auto& around : scene.around) {
      for (const Obstacle& obstacle : around->query.obstacles()) {
        const double padding = deviations * gaussianOf(obstacle).standardDeviations().maxCoeff();
        padded_[&obstacle] = padded(*obstacle.geometry, padding);
      }
    }
  }

  double operator()(const Table2State& state, double) const {
    const Poses poses = state.query.robot().poses(state.values);
    for (const Obstacle& obstacle : state.query.obstacles()) {
      const fcl::CollisionGeometryd& thick = *padded_.at(&obstacle);
      if (touchesAny(state.query.robot(), poses, thick, obstacle.pose)) return 1.0;
    }
    return 0.0;
  }

 private:
  std::map<const Obstacle*, std::shared_ptr<const fcl::CollisionGeometryd>> padded_;
};

/// Distance from obstacles, by FCL, of less than so many of their largest standard deviations.
class DistanceRow {
 public:
  explicit DistanceRow(double deviations) : deviations_(deviations) {}

  double operator()(const Table2State& state, double) const {
    const Poses poses = state.query.robot().poses(state.values);
    for (const Obstacle& obstacle : state.query.obstacles()) {
      const double far = deviations_ * gaussianOf(obstacle).standardDeviations().maxCoeff();
      if (leastDistance(state.query.robot(), poses, obstacle, far) < far) return 1.0;
    }
    return 0.0;
  }

 private:
  double deviations_;
};

constexpr std::size_t kCellsOfDecision = 2'000;

/// Ours: as planCertified() decides.
class CertifiedRow {
 public:
  explicit CertifiedRow(double threshold) {
    request_.threshold = threshold;
    request_.relative_tolerance = 0.05;
    request_.max_cells = kCellsOfDecision;
  }

  double operator()(const Table2State& state, double enough) const {
    if (const auto told = state.isBelow(enough)) return *told ? 0.0 : 1.0;
    return state.query.state(state.values, request_).decision == Decision::below ? 0.0 : 1.0;
  }

 private:
  ProbabilityRequest request_;
};

/// Ours, too, and never certified: after the same screens, from the first of bounds, cells and
/// samples that tells.
class ProbableRow {
 public:
  ProbableRow(double threshold, std::uint64_t seed) : threshold_(threshold) {
    request_.max_cells = kCellsOfDecision;
    request_.seed = seed;
  }

  double operator()(const Table2State& state, double enough) const {
    if (const auto told = state.isBelow(enough)) return *told ? 0.0 : 1.0;
    const ProbableDecision decision =
        state.query.decideProbably({state.values}, threshold_, kChanceOfError, request_).decision;
    const bool below = decision == ProbableDecision::certainly_below ||
                       decision == ProbableDecision::probably_below;
    return below ? 0.0 : 1.0;
  }

 private:
  double threshold_;
  ProbabilityRequest request_;
};

}  // namespace

std::vector<Table2Method> table2Methods(const Table2Scene& scene, double threshold,
                                        std::uint64_t seed, PartsStore& parts) {
  std::vector<Table2Method> methods{
      {"certified decision", "", CertifiedRow(threshold), Table2Answer::certified},
      {"probable decision", "", ProbableRow(threshold, seed), Table2Answer::probable},
      {"padding by 2 sigma", "", PaddingRow(scene, 2.0), Table2Answer::padding},
      {"padding by 3 sigma", "", PaddingRow(scene, 3.0), Table2Answer::padding},
      {"distance of 2 sigma", "", DistanceRow(2.0), Table2Answer::padding, false},
      {"distance of 3 sigma", "", DistanceRow(3.0), Table2Answer::padding, false}};
  for (Table2Method& bound : table2Bounds(scene, parts)) methods.push_back(std::move(bound));
  methods.push_back({"Monte Carlo, 10,000 samples", "monte-carlo", MonteCarloRow(scene, seed),
                     Table2Answer::counted});
  return methods;
}

}  // namespace fcl_prob::cli
