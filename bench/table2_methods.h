// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Ways to tell whether a state of a robot is likely enough to be free: the rows of Table II.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/table2_scene.h"

namespace fcl_prob::cli {

/// What stands behind the number that a method gives.
enum class Table2Answer {
  probability,  ///< it is one: counted, or a bound
  certified,    ///< 0 or 1: below the threshold for certain, or not
  probable,     ///< 0 or 1: below the threshold but for a chance, or not
  padding       ///< 0 or 1: apart by so much, or not
};

/// Of one answer of the probable decision that a state is below the threshold.
inline constexpr double kChanceOfError = 1e-4;

struct Table2Method {
  std::string name;
  std::string published;  ///< its row in the paper's Table II; empty: it has none

  /// P(any body touches any obstacle) as the method has it, or 0 or 1; once it is seen to be at
  /// least `enough`, anything that is.
  std::function<double(const Eigen::VectorXd& values, double enough)> probability;

  Table2Answer answer = Table2Answer::probability;
};

/// All rows for a scene, which must outlive them.
/// \param threshold  at which the certified and the probable decision decide
std::vector<Table2Method> table2Methods(const Table2Scene& scene, double threshold,
                                        std::uint64_t seed);

}  // namespace fcl_prob::cli
