// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "judge_report.h"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <cstdio>
#include <sstream>

namespace fcl_prob_judge {
namespace {

/// Of a test of one scene's misses.
constexpr double kLevel = 1e-3;

template <typename... Values>
std::string formatted(const char* format, const Values&... values) {
  char line[400];
  std::snprintf(line, sizeof(line), format, values...);
  return line;
}

double quantileOf(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const double at = share * static_cast<double>(values.size() - 1);
  return values[static_cast<std::size_t>(std::lround(at))];
}

std::string timesOf(const std::vector<double>& seconds) {
  return formatted("%8.1f %8.1f %9.1f", 1e3 * quantileOf(seconds, 0.5),
                   1e3 * quantileOf(seconds, 0.9), 1e3 * quantileOf(seconds, 1.0));
}

std::string textOf(const Misses& misses, double chance) {
  return formatted("%6zu/%-6zu%s", misses.count, misses.of, misses.tooMany(chance) ? "!" : " ");
}

std::string titleOf(const std::string& name, const Verdict& verdict) {
  // Of all scenes together there is no P.
  return verdict.truth == 0.0 ? formatted("%-20s %9s ", name.c_str(), "")
                              : formatted("%-20s %9.6g ", name.c_str(), verdict.truth);
}

std::string decisionRow(const std::string& name, double confidence, const Verdict& verdict) {
  const DecisionTally& decisions = verdict.decisions.at(confidence);
  const auto intervals = verdict.intervals.find(confidence);
  return titleOf(name, verdict) + formatted("%7g ", confidence) +
         textOf(decisions.wrong, 1.0 - confidence) +
         textOf(intervals == verdict.intervals.end() ? Misses() : intervals->second,
                1.0 - confidence) +
         formatted(" %5.1f%% ", 100.0 * static_cast<double>(decisions.undecided) /
                                    static_cast<double>(decisions.wrong.of)) +
         timesOf(decisions.seconds) + "\n";
}

std::string estimateRow(const std::string& name, const Verdict& verdict) {
  return titleOf(name, verdict) +
         formatted("%6zu %6zu %4zu %6zu %4zu %4zu %4zu %9.3g %9.3g@%-6llu ", verdict.estimates,
                   verdict.converged, verdict.unstated, verdict.beyond(3.0), verdict.beyond(5.0),
                   verdict.beyond(6.0), verdict.beyond(10.0), verdict.rootMeanSquare(),
                   verdict.worst, static_cast<unsigned long long>(verdict.worst_seed)) +
         timesOf(verdict.seconds) + "\n";
}

void tellMisses(std::ostream& faults, const char* what, const Misses& misses, double confidence) {
  if (!misses.tooMany(1.0 - confidence)) return;
  faults << "; " << misses.count << " of " << misses.of << " " << what << " at " << confidence;
}

}  // namespace

void Misses::add(bool missed) {
  ++of;
  if (missed) ++count;
}

bool Misses::tooMany(double chance) const {
  if (count == 0) return false;
  const boost::math::binomial_distribution<double> allowed(static_cast<double>(of), chance);
  return cdf(complement(allowed, static_cast<double>(count) - 1.0)) < kLevel;
}

void Verdict::add(const Answer& answer) {
  if (!answer.exception.empty()) {
    ++exceptions;
    return;
  }
  if (answer.violated()) ++violated;
  if (answer.interval_lower) intervals[answer.confidence].add(answer.missed());
  if (answer.mode == Mode::decide) {
    DecisionTally& tally = decisions[answer.confidence];
    if (answer.undecided()) ++tally.undecided;
    tally.wrong.add(answer.decidedWrongly());
    tally.seconds.push_back(answer.seconds);
    return;
  }
  ++estimates;
  seconds.push_back(answer.seconds);
  if (!answer.converged()) return;
  ++converged;
  const std::optional<double> off = answer.deviations();
  if (!off) {
    ++unstated;
    return;
  }
  deviations.push_back(*off);
  if (std::fabs(*off) > std::fabs(worst)) {
    worst = *off;
    worst_seed = answer.seed;
  }
}

std::size_t Verdict::beyond(double limit) const {
  return static_cast<std::size_t>(std::count_if(deviations.begin(), deviations.end(),
                                                [&](double z) { return std::fabs(z) > limit; }));
}

double Verdict::rootMeanSquare() const {
  double squares = 0.0;
  for (const double z : deviations) squares += z * z;
  return deviations.empty() ? 0.0 : std::sqrt(squares / static_cast<double>(deviations.size()));
}

std::string Verdict::faults() const {
  std::ostringstream faults;
  for (const auto& [confidence, tally] : decisions) {
    tellMisses(faults, "decisions wrong", tally.wrong, confidence);
  }
  for (const auto& [confidence, misses] : intervals) {
    tellMisses(faults, "intervals beside P", misses, confidence);
  }
  if (beyond(6.0) > 0) {
    faults << "; " << beyond(6.0) << " of " << deviations.size()
           << " estimates beyond 6 standard errors";
  }
  if (violated > 0) faults << "; " << violated << " certified bounds beside P";
  if (exceptions > 0) faults << "; " << exceptions << " exceptions";
  const std::string text = faults.str();
  return text.empty() ? text : text.substr(2);
}

void JudgeReport::add(const Answer& answer) {
  Verdict& verdict = verdicts_[answer.scene];
  verdict.truth = answer.truth;
  verdict.add(answer);
  total_.add(answer);
}

bool JudgeReport::hasFaults() const {
  bool faulty = !total_.faults().empty();
  for (const auto& [name, verdict] : verdicts_) faulty = faulty || !verdict.faults().empty();
  return faulty;
}

std::string JudgeReport::text() const {
  std::string decisions, estimates, faults;
  const auto tell = [&](const std::string& name, const Verdict& verdict) {
    for (const auto& [confidence, tally] : verdict.decisions) {
      decisions += decisionRow(name, confidence, verdict);
    }
    if (verdict.estimates > 0) estimates += estimateRow(name, verdict);
    if (!verdict.faults().empty()) faults += name + ": " + verdict.faults() + "\n";
  };
  for (const auto& [name, verdict] : verdicts_) tell(name, verdict);
  tell("total", total_);
  std::string text;
  if (!decisions.empty()) {
    text += formatted("%-20s %9s %7s %13s  %13s  %6s %8s %8s %9s\n", "scene", "P", "conf.", "wrong",
                      "beside P", "undec.", "ms: 50 %", "90 %", "worst") +
            decisions + "\n";
  }
  if (!estimates.empty()) {
    text += formatted("%-20s %9s %6s %6s %4s %6s %4s %4s %4s %9s %9s@%-6s %8s %8s %9s\n", "scene",
                      "P", "asked", "conv.", "none", ">3 s.e", ">5", ">6", ">10", "rms", "worst",
                      "seed", "ms: 50 %", "90 %", "worst") +
            estimates + "\n";
  }
  return text + (faults.empty() ? "No faults.\n" : "FAULTS\n" + faults);
}

}  // namespace fcl_prob_judge
