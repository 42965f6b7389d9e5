// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Which wings of the library this build has (CMake: FCL_PROB_WITH_EXACT and so on). What is behind
// `if constexpr` of a wing that is left out is compiled and never linked.
#pragma once

#include <string>

#include "fcl_prob/exceptions.h"

#ifndef FCL_PROB_HAS_EXACT
#define FCL_PROB_HAS_EXACT 1
#endif
#ifndef FCL_PROB_HAS_PAPER
#define FCL_PROB_HAS_PAPER 1
#endif
#ifndef FCL_PROB_HAS_DECOMPOSITION
#define FCL_PROB_HAS_DECOMPOSITION 1
#endif
#ifndef FCL_PROB_HAS_SAMPLING
#define FCL_PROB_HAS_SAMPLING 1
#endif

namespace fcl_prob::detail {

/// Masses of C-obstacles of convex shapes without cells.
inline constexpr bool kHasExact = FCL_PROB_HAS_EXACT != 0;

/// GeneralPCD of the paper, and methods before it.
inline constexpr bool kHasPaper = FCL_PROB_HAS_PAPER != 0;

/// Convex parts of meshes, and bounds on pairs of them.
inline constexpr bool kHasDecomposition = FCL_PROB_HAS_DECOMPOSITION != 0;

/// Monte Carlo and rare events.
inline constexpr bool kHasSampling = FCL_PROB_HAS_SAMPLING != 0;

[[noreturn]] inline void refuseWithout(const std::string& method, const std::string& wing) {
  throw UnsupportedGeometry("method " + method +
                            " is not in this build of fcl_prob, which was made "
                            "without FCL_PROB_WITH_" +
                            wing);
}

}  // namespace fcl_prob::detail
