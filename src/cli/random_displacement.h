// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Random displacements that a seed and an index determine.
#pragma once

#include "base/random_words.h"
#include "fcl_prob/whitening.h"

namespace fcl_prob::cli {

/// Displacement number `index` of a seed, metres, world frame.
inline Eigen::Vector3d randomDisplacement(const Whitening& whitening, std::uint64_t seed,
                                          std::uint64_t index) {
  Eigen::Vector3d y = detail::standardNormalFrom(detail::randomWords({seed}, index));
  y.tail(3 - whitening.rank()).setZero();
  return whitening.unapply(y);
}

}  // namespace fcl_prob::cli
