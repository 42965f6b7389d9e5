// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Ways to answer a query, cheapest first.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/known.h"
#include "base/left_out.h"
#include "base/stopwatch.h"
#include "fcl_prob/probability_result.h"

namespace fcl_prob::detail {

/// What came of climbing a rung.
struct Climbed {
  bool answered;     ///< the query, or a limit is in the way
  std::string note;  ///< what it did, or why it could not; "": nothing that others do not say
};

/// Rung::whyNot of a rung that nobody would expect where it does not serve.
constexpr const char* unless(bool serves) { return serves ? nullptr : ""; }

/// One way to narrow what is known of P, or to estimate it. A rung knows no other rung.
template <typename Query>
struct Rung {
  const char* name;

  /// Why it is left out: null if it is not, "" if nobody would expect it here. No function: never.
  const char* (*whyNot)(const Query& query);

  Climbed (Query::*climb)();

  /// Whether there is no answer without it.
  bool needed = false;
};

/// Climbs the rungs that serve, in their order, until one has answered.
/// \param records  what each told and took, or why it was left out, is added to them
/// \return  whether one has
template <typename Query>
bool climb(const std::vector<Rung<Query>>& ladder, Query& query, const Known& known,
           std::vector<RungRecord>& records) {
  for (const Rung<Query>& rung : ladder) {
    const char* why_not = rung.whyNot ? rung.whyNot(query) : nullptr;
    if (!why_not && !rung.needed && isLeftOut(rung.name)) why_not = "as was asked";
    if (why_not) {
      if (*why_not) records.push_back({rung.name, 0.0, known.interval(), 0, 0, why_not});
      continue;
    }
    const Stopwatch watch;
    Climbed climbed = (query.*rung.climb)();
    records.push_back({rung.name, watch.seconds(), known.interval(), 1, climbed.answered ? 1U : 0U,
                       std::move(climbed.note)});
    if (climbed.answered) return true;
  }
  return false;
}

/// ProbabilityResult::plan: a line for each rung that has a note, with the bounds after it.
std::vector<std::string> planOf(const std::vector<RungRecord>& rungs);

/// One line of several.
std::string noteOf(const std::vector<std::string>& notes);

/// What an answer says of itself, as the note of the rung that it is of: nothing where its own
/// rungs have said it.
std::string noteOf(const ProbabilityResult& answer);

}  // namespace fcl_prob::detail
