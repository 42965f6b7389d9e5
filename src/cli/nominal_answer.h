// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What FCL says of the scene without the uncertainty.
#pragma once

#include <optional>

#include "cli/geometry.h"

namespace fcl_prob::cli {

/// FCL's own answers with A at its mean displacement. A field is not set where FCL has no answer
/// for such a pair of shapes.
struct NominalAnswer {
  std::optional<bool> collides;
  std::optional<double> distance;  ///< metres; 0 if they collide
};

/// \param a, b  meshes must have OBBRSS trees, for which FCL can do both quickly
NominalAnswer nominalAnswer(const Geometry& a, const fcl::Transform3d& pose_a, const Geometry& b,
                            const fcl::Transform3d& pose_b, const Eigen::Vector3d& mean);

}  // namespace fcl_prob::cli
