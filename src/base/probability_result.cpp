// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "base/statistics.h"

#include <algorithm>
#include <limits>

#include "fcl_prob/exceptions.h"

namespace fcl_prob {
namespace detail {
namespace {

const std::string& nameOf(const RungRecord& rung) { return rung.name; }
const std::string& nameOf(const std::pair<std::string, double>& time) { return time.first; }

// What is told of it is of the first answer that climbed it.
void addTo(RungRecord& same, const RungRecord& one) {
  if (same.times == 0 && one.times > 0) same.note = one.note;
  same.seconds += one.seconds;
  same.known.lower = std::min(same.known.lower, one.known.lower);
  same.known.upper = std::max(same.known.upper, one.known.upper);
  same.times += one.times;
  same.answered += one.answered;
}

void addTo(std::pair<std::string, double>& same, const std::pair<std::string, double>& one) {
  same.second += one.second;
}

template <typename Named>
void addByName(const std::vector<Named>& more, std::vector<Named>& all) {
  for (const Named& one : more) {
    const auto same = std::find_if(all.begin(), all.end(), [&one](const Named& of_all) {
      return nameOf(of_all) == nameOf(one);
    });
    if (same == all.end()) {
      all.push_back(one);
    } else {
      addTo(*same, one);
    }
  }
}

}  // namespace

void addStatistics(const ProbabilityStatistics& one, ProbabilityStatistics& all) {
  all.cells += one.cells;
  all.pairs_tested += one.pairs_tested;
  all.leaf_pairs += one.leaf_pairs;
  all.peak_front = std::max(all.peak_front, one.peak_front);
  all.peak_memory = std::max(all.peak_memory, one.peak_memory);
  all.samples += one.samples;
  all.hits += one.hits;
  addByName(one.rungs, all.rungs);
  addByName(one.seconds, all.seconds);
}

}  // namespace detail

double ProbabilityResult::probability() const {
  if (estimate) return *estimate;
  if (lower && upper) return 0.5 * (*lower + *upper);
  if (upper) return *upper;
  return std::numeric_limits<double>::quiet_NaN();
}

std::string toString(Decision decision) {
  switch (decision) {
    case Decision::none:
      return "none";
    case Decision::below:
      return "below";
    case Decision::above:
      return "above";
    case Decision::undecided:
      return "undecided";
  }
  throw InvalidRequest("not a Decision: " + std::to_string(static_cast<int>(decision)));
}

std::string toString(ProbabilityStatus status) {
  switch (status) {
    case ProbabilityStatus::converged:
      return "converged";
    case ProbabilityStatus::exact:
      return "exact";
    case ProbabilityStatus::decided:
      return "decided";
    case ProbabilityStatus::bound_only:
      return "bound-only";
    case ProbabilityStatus::sampled:
      return "sampled";
    case ProbabilityStatus::time_limit:
      return "time-limit";
    case ProbabilityStatus::cell_limit:
      return "cell-limit";
    case ProbabilityStatus::memory_limit:
      return "memory-limit";
    case ProbabilityStatus::resolution_limit:
      return "resolution-limit";
    case ProbabilityStatus::cancelled:
      return "cancelled";
    case ProbabilityStatus::band_limit:
      return "band-limit";
  }
  throw InvalidRequest("not a ProbabilityStatus: " + std::to_string(static_cast<int>(status)));
}

}  // namespace fcl_prob
