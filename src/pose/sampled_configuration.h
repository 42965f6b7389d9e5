// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// One sample of a random configuration: the normals that it takes, and where everything is in it
// and in one of the translation that it leaves.
#pragma once

#include <algorithm>
#include <utility>

#include "base/random_words.h"
#include "fcl_prob/random_configuration.h"
#include "sampling/placement_collider.h"

namespace fcl_prob::detail {

/// Standard normals, three from each block of a sample from `first_block` on.
inline Eigen::VectorXd standardNormals(RandomStream stream, std::uint64_t index, Eigen::Index count,
                                       std::uint64_t first_block = 0) {
  Eigen::VectorXd z(count);
  for (Eigen::Index k = 0; k < count; k += 3) {
    const std::uint64_t block = first_block + static_cast<std::uint64_t>(k / 3);
    const Eigen::Index some = std::min<Eigen::Index>(3, count - k);
    z.segment(k, some) = standardNormalFrom(randomWords(stream, index, block)).head(some);
  }
  return z;
}

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
