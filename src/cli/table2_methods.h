// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Ways to tell whether a state of a robot is likely enough to be free: the rows of Table II.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/table2_scene.h"

namespace fcl_prob::cli {

struct Table2Method {
  std::string name;
  std::string published;  ///< its row in the paper's Table II; empty: it has none

  /// P(any body touches any obstacle) as the method has it; once it is seen to be at least
  /// `enough`, anything that is. Padding: 0 or 1.
  std::function<double(const Eigen::VectorXd& values, double enough)> probability;

  bool has_probability = true;  ///< false: the number is 0 or 1 and no probability
  bool is_certified = false;    ///< its answers are certified from both sides
};

/// All rows for a scene, which must outlive them.
/// \param threshold  at which the certified decision decides
std::vector<Table2Method> table2Methods(const Table2Scene& scene, double threshold,
                                        std::uint64_t seed);

}  // namespace fcl_prob::cli
