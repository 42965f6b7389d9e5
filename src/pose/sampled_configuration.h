// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Where everything is in one sample of a random configuration and of the translation it leaves.
#pragma once

#include <utility>

#include "fcl_prob/random_configuration.h"
#include "sampling/placement_collider.h"

namespace fcl_prob::detail {

/// \param z  standard normals of the configuration
/// \param y  those of the translation that is left, along its axes
inline SampledPlacement sampledAt(const RandomConfiguration& configuration,
                                  const Eigen::VectorXd& z, const Eigen::Vector3d& y) {
  PlacedConfiguration placed = configuration.at(z);
  const GaussianDisplacement& left = placed.displacement;
  const Eigen::Vector3d displacement =
      left.mean() + left.axes() * left.standardDeviations().cwiseProduct(y);
  for (fcl::Transform3d& pose : placed.poses_a) pose.translation() += displacement;
  return {std::move(placed.poses_a), std::move(placed.poses_b)};
}

}  // namespace fcl_prob::detail
