// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A query's result as JSON and as text.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "cli/nominal_answer.h"
#include "fcl_prob/probability_result.h"

namespace fcl_prob::cli {

/// A result with what surrounds it.
struct CheckReport {
  ProbabilityResult result;
  std::string method = {};  ///< instead of result.method, if not empty
  double threshold = -1.0;  ///< the one that was asked about, if result.decision is set
  NominalAnswer nominal;
  double time_ms = 0.0;   ///< the query alone
  double build_ms = 0.0;  ///< building the trees
};

/// One object with the stable fields method, lower, upper, estimate, standard_error, decision,
/// gradient, status, time_ms, build_ms, fcl, plan and statistics, null where the method does not
/// compute one; and probability and confidence_interval.
nlohmann::ordered_json jsonOf(const CheckReport& report);

/// For people: the probability first, then how far it can be trusted, then the rest.
std::string textOf(const CheckReport& report);

}  // namespace fcl_prob::cli
