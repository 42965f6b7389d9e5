// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The estimate: stratified sampling of what the partition leaves open.
#pragma once

#include <cstdint>
#include <vector>

#include "partition/containment.h"
#include "partition/obstacle_table.h"
#include "partition/open_cell.h"

namespace fcl_prob::detail {

struct SampledMass {
  double mass = 0.0;
  double variance = 0.0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment_variance = Eigen::Vector3d::Zero();
  std::size_t samples = 0;
};

/// Unbiased estimate of the mass (and of ∫ y φ(y) dy) that collides in the uncertain part of each
/// open cell: what lies below its covered half-space. Two samples a cell, fixed by the seed; a
/// sample is tested against the cell's own front only.
class CellSampler {
 public:
  CellSampler(const WhitenedPair& pair, ObstacleTable& obstacles, const SolidContact* solids,
              std::uint64_t seed);

  SampledMass sample(const std::vector<OpenCell>& cells);

 private:
  struct Draw {
    Eigen::Vector3d point;
    double weight;
  };
  Draw draw(const OpenCell& cell, const double* uniforms) const;
  bool collides(const OpenCell& cell, const Eigen::Vector3d& y);
  bool collides(const FrontPair& pair, const CellBox& point);

  const WhitenedPair& pair_;
  ObstacleTable& obstacles_;
  const SolidContact* solids_;
  std::uint64_t seed_;
  std::vector<FrontPair> stack_;
};

}  // namespace fcl_prob::detail
