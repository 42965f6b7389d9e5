// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What is asked of every scene, and what came out.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "judged_scene.h"

namespace fcl_prob_judge {

/// `decide`: on which side of a threshold near P; `estimate`: P without a threshold.
enum class Mode { decide, estimate };

struct JudgePlan {
  fcl_prob::ProbabilityMethod method = fcl_prob::ProbabilityMethod::automatic;
  std::vector<Mode> modes{Mode::decide, Mode::estimate};
  std::vector<double> factors{0.5, 0.97, 1.03, 2.0};  ///< of thresholds: see thresholdAt()
  std::vector<double> confidences{0.9999, 0.99};      ///< of decisions; estimates have the last
  double relative_tolerance = 0.01;
  std::uint64_t first_seed = 1;
  std::uint64_t seeds = 20;
  unsigned threads = 1;
  std::optional<double> time_limit;      ///< seconds a query
  std::optional<std::size_t> max_cells;  ///< for runs that must not go by a clock
  std::optional<double> budget;          ///< seconds of the whole run: no seed is begun after them
};

/// One query.
struct Answer {
  std::string scene;
  double truth = 0.0;
  Mode mode = Mode::decide;
  double factor = 0.0, threshold = 0.0;
  double confidence = 0.0;
  std::uint64_t seed = 0;
  std::string decision, status;
  std::optional<double> lower, upper, estimate, standard_error, interval_lower, interval_upper;
  double seconds = 0.0;
  double samples = 0.0;
  std::string exception;  ///< what was thrown

  bool decidedWrongly() const;
  bool undecided() const { return mode == Mode::decide && decision == "undecided"; }
  bool converged() const { return status == "converged" || status == "exact"; }

  /// Whether the confidence interval does not hold P.
  bool missed() const;

  /// Whether the certified bounds do not.
  bool violated() const;

  /// Error over standard error; infinite where none is stated of what is wrong by more than 1e-9.
  /// Not set without an estimate or without a standard error.
  std::optional<double> deviations() const;
};

/// factor·P, or what leaves (1 - P)/factor where that is above 1.
double thresholdAt(double probability, double factor);

/// Seeds outermost, so that all scenes have as many when the budget ends. `tell` has every answer
/// at once.
void runJudge(const JudgePlan& plan, const std::vector<AskableScene>& scenes,
              const std::function<void(const Answer&)>& tell);

/// One line of JSON, and back.
std::string jsonOf(const Answer& answer);
Answer answerFromJson(const std::string& line);

}  // namespace fcl_prob_judge
