// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The steps of a motion are halved until what they sweep says enough.
#pragma once

#include "robot/placed_query.h"
#include "robot/swept_query.h"

namespace fcl_prob::detail {

struct SweptAnswer {
  ProbabilityResult result;
  double reach = 0.0;      ///< metres: of the longest step that was looked at last
  std::size_t steps = 0;   ///< looked at last
  std::size_t far = 0;     ///< left out: steps, or waypoints of bodies where only those count
  double far_upper = 0.0;  ///< of all that was left out
};

/// P(the motion, or one of its waypoints, touches one obstacle), whose error is the same all along.
///
/// The steps of every body are halved until no point moves farther than some distance from the
/// middle of its step, but for those that are too far from the obstacle to matter. What they sweep
/// bounds P from above, where the bodies are at their ends from below, one partition each. Where
/// that is too wide the distance is made smaller, as far as memory allows. Every answer holds, and
/// so do the best bounds of all. \param state     of the obstacle \param most_far  what may be left
/// out \param known     what is certain before
SweptAnswer sweptMotion(const SweptPath& path, const ObstacleAmongBodies& scene,
                        const ObstacleState& state, double most_far, const Bounds& known,
                        const ProbabilityRequest& request);

}  // namespace fcl_prob::detail
