// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Ways to answer a query, cheapest first.
#pragma once

#include <string>
#include <vector>

#include "base/known.h"
#include "base/left_out.h"
#include "base/stopwatch.h"
#include "fcl_prob/probability_result.h"

namespace fcl_prob::detail {

/// One way to narrow what is known of P, or to estimate it. A rung knows no other rung.
template <typename Query>
struct Rung {
  const char* name;

  /// Whether it has something to say here; null: always.
  bool (*serves)(const Query& query);

  /// \return whether the query is answered, or a limit is in the way
  bool (Query::*climb)();

  /// Whether there is no answer without it.
  bool needed = false;
};

/// Climbs the rungs that serve, in their order, until one has answered.
/// \param records  what each told and took is added to them
/// \return  whether one has
template <typename Query>
bool climb(const std::vector<Rung<Query>>& ladder, Query& query, const Known& known,
           std::vector<RungRecord>& records) {
  for (const Rung<Query>& rung : ladder) {
    if (rung.serves && !rung.serves(query)) continue;
    if (!rung.needed && isLeftOut(rung.name)) continue;
    const Stopwatch watch;
    const bool answered = (query.*rung.climb)();
    records.push_back({rung.name, watch.seconds(), known.interval(), 1, answered ? 1U : 0U});
    if (answered) return true;
  }
  return false;
}

}  // namespace fcl_prob::detail
