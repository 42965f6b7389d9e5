// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Whether what was stated held as often as it was stated.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "judge_run.h"

namespace fcl_prob_judge {

/// So many of so many went wrong where each may with a small chance.
struct Misses {
  std::size_t count = 0, of = 0;

  void add(bool missed);

  /// Whether as many have less than one chance in a thousand.
  bool tooMany(double chance) const;
};

/// Of what was asked at one confidence with a threshold.
struct DecisionTally {
  Misses wrong;
  std::size_t undecided = 0;
  std::vector<double> seconds;
};

/// Of one scene, or of all of them.
struct Verdict {
  double truth = 0.0;
  std::map<double, DecisionTally> decisions;  ///< by confidence
  std::map<double, Misses> intervals;         ///< that do not hold P, by confidence
  std::size_t estimates = 0, converged = 0;
  std::size_t unstated = 0;  ///< converged without a standard error
  std::size_t violated = 0;  ///< certified bounds beside P
  std::size_t exceptions = 0;
  std::vector<double> deviations;  ///< of what says `converged`
  double worst = 0.0;              ///< of these, with its sign
  std::uint64_t worst_seed = 0;
  std::vector<double> seconds;  ///< of estimates

  void add(const Answer& answer);
  std::size_t beyond(double deviations) const;
  double rootMeanSquare() const;

  /// What must not be, in words; empty if all holds: wrong decisions or missed intervals beyond
  /// what chance allows at a level of 1e-3, estimates beyond 6 standard errors, certified bounds
  /// beside P, exceptions.
  std::string faults() const;
};

class JudgeReport {
 public:
  void add(const Answer& answer);

  const Verdict& total() const { return total_; }
  const Verdict& of(const std::string& scene) const { return verdicts_.at(scene); }

  /// Two tables (decisions, with the intervals at the same confidence; estimates) and the faults of
  /// every scene.
  std::string text() const;
  bool hasFaults() const;

 private:
  std::map<std::string, Verdict> verdicts_;
  Verdict total_;
};

}  // namespace fcl_prob_judge
