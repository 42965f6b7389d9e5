// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Ways to tell whether a state of a robot is likely enough to be free: the rows of Table II.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bench/parts_store.h"
#include "bench/table2_scene.h"

namespace fcl_prob::cli {

/// What stands behind the number that a method gives.
enum class Table2Answer {
  counted,      ///< a share of samples
  upper_bound,  ///< a probability that is no smaller
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
  std::function<double(const Table2State& state, double enough)> probability;

  Table2Answer answer = Table2Answer::upper_bound;
  bool plans = true;    ///< a path is looked for with it
  int repetitions = 1;  ///< of which its number is the mean; its time is that of one
};

/// All rows for the states of a scene.
/// \param threshold  at which the certified and the probable decision decide
/// \param parts  of the meshes of all scenes
std::vector<Table2Method> table2Methods(const Table2Scene& scene, double threshold,
                                        std::uint64_t seed, PartsStore& parts);

}  // namespace fcl_prob::cli
