// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The estimate: stratified sampling of what the partition leaves open.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "partition/point_tester.h"

namespace fcl_prob::detail {

struct SampledMass {
  double mass = 0.0;
  double variance = 0.0;
  double doubt = 0.0;  ///< of `mass`: samples that may collide or not, within rounding
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment_variance = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment_doubt = Eigen::Vector3d::Zero();
  std::size_t samples = 0;

  /// Of chance and of doubt, which does not average out.
  double standardError() const { return std::sqrt(variance + doubt * doubt); }
};

/// Of two sets of samples of the same cells, each counted by its size.
SampledMass average(const SampledMass& a, const SampledMass& b);

/// Estimate of the mass (and of ∫ y φ(y) dy) that collides in the open part of each open cell: what
/// is known of neither its plane nor its part. Some sets of samples a cell, fixed by the seed,
/// whose differences give the variance; each set is spread evenly over the cell. A sample is tested
/// against the cell's own front only.
class CellSampler {
 public:
  CellSampler(const WhitenedPair& pair, ObstacleTable& obstacles, const SolidContact* solids,
              std::uint64_t seed);

  /// About `count` samples, at least a few a cell. Every call draws others.
  SampledMass sample(const std::vector<OpenCell>& cells, double count);

 private:
  /// Means over the sets, and the sums of the squares of what the sets are off them.
  struct CellMeans {
    double mass = 0.0;
    double mass_spread = 0.0;
    double doubt = 0.0;
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();
    Eigen::Vector3d moment_spread = Eigen::Vector3d::Zero();
    bool agree = false;  ///< all samples collide, or none does
  };
  struct Draw {
    Eigen::Vector3d point;
    double weight;
  };
  CellMeans sampleCell(const OpenCell& cell, std::uint64_t index, int in_set);
  Draw draw(const OpenCell& cell, const Eigen::Vector3d& uniform) const;

  PointTester tester_;
  std::uint64_t seed_;
  std::uint64_t calls_ = 0;
  std::vector<TestedPoint> points_;
  std::vector<double> weights_;
};

}  // namespace fcl_prob::detail
