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
  PartsUse parts = PartsUse::none;
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
  std::string status;  ///< result.status, or "approximation" for what bounds nothing
  double value = 0.0;  ///< the single number that the method gives; of the first seed

  /// |value - reference|. Of a method that samples: its root mean square over `seeds` runs, since
  /// one draw may be right by luck. Not set where the reference is itself sampled and so is the
  /// method.
  std::optional<double> error;
  std::optional<double> relative_error;  ///< error / reference; infinite if only that is 0

  /// What the method itself says its error is: the standard error (root mean square over the
  /// seeds), or half of a two-sided interval.
  std::optional<double> stated_error;

  std::size_t seeds = 1;  ///< runs that `error` is taken over: 1 for a method that does not sample
  double time_ms = 0.0;   ///< of one run; the median over the seeds
};

struct Comparison {
  ComparisonReference reference;
  double build_ms = 0.0;
  NominalAnswer nominal;
  std::vector<ComparisonRecord> records;
  bool interrupted = false;  ///< methods are missing
};

/// Told before every run: which, of how many, and what it is. Returning false stops the comparison.
using ComparisonProgress =
    std::function<bool(std::size_t index, std::size_t count, const std::string& what)>;

/// Every method, the prior ones included, at its default budgets. `base` gives everything that is
/// not the budget: contact, seed, threads; its time limit, if any, holds for each run.
std::vector<ComparisonRun> defaultRuns(const ProbabilityRequest& base);

/// Runs them all, those that sample with `seeds` seeds from base.seed on. A method that refuses the
/// scene becomes a record that says why.
/// \throws Exception if the scene itself is bad, or no method can give a reference
Comparison compare(const PreparedScene& scene, const std::vector<ComparisonRun>& runs,
                   const ProbabilityRequest& base, std::size_t seeds,
                   const ComparisonProgress& progress);

}  // namespace fcl_prob::cli
