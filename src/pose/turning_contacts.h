// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Which rotations matter for contact, and about which point least. Steers; no bound depends on it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "fcl_prob/gaussian_displacement.h"
#include "scene/partition_object.h"

namespace fcl_prob::detail {

struct TurningContacts {
  Eigen::Vector3d centre;  ///< metres, world frame: contacts move least if A turns about that
  Eigen::MatrixXd axes;   ///< orthogonal: coordinates of rotations, the one that matters most first
  Eigen::VectorXd moved;  ///< P of what contacts are moved by a unit of each, added up
  double pushed;          ///< P of what contacts are moved by a metre along their normals, added up
};

/// From contacts on random lines through the displacement space: they lie on the boundary as the
/// density has it (see motionFlux()). Nothing without contacts.
/// \param turns  radians a unit of each coordinate of the rotation, world frame
std::optional<TurningContacts> turningContacts(const PartitionObject& a, const PartitionObject& b,
                                               const GaussianDisplacement& displacement,
                                               const Eigen::MatrixXd& turns, std::uint64_t seed);

}  // namespace fcl_prob::detail
