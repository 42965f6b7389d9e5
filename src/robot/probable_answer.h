// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// On which side of a threshold the probability of any of several obstacles is, with samples.
#pragma once

#include <functional>
#include <vector>

#include "fcl_prob/probable_decision.h"
#include "query/prepared_geometry.h"
#include "robot/placed_query.h"

namespace fcl_prob::detail {

/// Placed bodies against one obstacle whose displacement is Gaussian and not 0.
struct ProbableScene {
  const PreparedObstacle* obstacle;  ///< bounded
  ObstacleState state;
  std::vector<PlacedBody> bodies;
};

/// Whether that can be sampled; else only the certified way is left.
bool canBeSampled(const PreparedObstacle& obstacle, const ObstacleState& state);

/// A certain answer to the same question, within limits.
using Proof = std::function<ProbableResult(const ProbabilityRequest&)>;

/// \param chance  of a wrong decision, in (0, 1)
/// \param prove   asked at most once
ProbableResult probablyAny(const std::vector<ProbableScene>& scenes, const PreparedRobot& robot,
                           double threshold, double chance, const Proof& prove,
                           const ProbabilityRequest& request);

}  // namespace fcl_prob::detail
