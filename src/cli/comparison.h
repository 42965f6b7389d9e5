// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Every method at several budgets on one scene.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/prepared_scene.h"
#include "cli/prior_runs.h"

namespace fcl_prob::cli {

/// One method at one budget, to be run.
struct ComparisonRun {
  std::string method;  ///< "interval", "park"
  std::string budget;  ///< "1 %" (relative tolerance), "10000 samples", "delta 0.99"
  ProbabilityRequest request;
  std::optional<PriorRun> prior;  ///< one of the prior methods, instead of the request's
};

enum class ReferenceKind {
  certified,
  counted,   ///< Monte Carlo, where no certified method can do the scene
  estimated  ///< over rotations, with other samples than what is judged
};

/// What the errors are measured against.
struct ComparisonReference {
  double value = 0.0;
  Bounds interval;  ///< contains P: always if certified, else with its confidence
  ReferenceKind kind = ReferenceKind::counted;
  double time_ms = 0.0;

  bool certified() const { return kind == ReferenceKind::certified; }
};

/// What became of a run.
struct ComparisonRecord {
  std::string method;
  std::string budget;
  std::optional<std::string> refusal;  ///< why the method cannot do this scene; then nothing below
  ProbabilityResult result;
  std::string status;           ///< result.status, or "approximation" for what bounds nothing
  double value = 0.0;           ///< the single number that the method gives
  double error = 0.0;           ///< |value - reference|
  double relative_error = 0.0;  ///< error / reference; infinite if that is 0 and the error is not
  double time_ms = 0.0;
};

struct Comparison {
  ComparisonReference reference;
  double build_ms = 0.0;
  NominalAnswer nominal;
  std::vector<ComparisonRecord> records;
};

/// Told before every run: which, of how many, and what it is. Returning false stops the comparison.
using ComparisonProgress =
    std::function<bool(std::size_t index, std::size_t count, const std::string& what)>;

/// Every method, the prior ones included, at its default budgets. `base` gives everything that is
/// not the budget: contact, seed, threads; its time limit, if any, holds for each run.
std::vector<ComparisonRun> defaultRuns(const ProbabilityRequest& base);

/// Runs them all. A method that refuses the scene becomes a record that says why.
/// \throws Exception if the scene itself is bad, or no method can give a reference
Comparison compare(const PreparedScene& scene, const std::vector<ComparisonRun>& runs,
                   const ProbabilityRequest& base, const ComparisonProgress& progress);

}  // namespace fcl_prob::cli
