// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "base/ladder.h"

#include "base/known_text.h"

namespace fcl_prob::detail {
namespace {

std::string lineOf(const RungRecord& rung) {
  if (rung.times == 0) return rung.name + ": left out, " + rung.note;
  const bool tells = rung.known.width() < 1.0;
  return rung.name + ": " + rung.note +
         (tells ? "; P " + relationText(std::nullopt, rung.known) : "");
}

}  // namespace

std::vector<std::string> planOf(const std::vector<RungRecord>& rungs) {
  std::vector<std::string> plan;
  for (const RungRecord& rung : rungs) {
    if (!rung.note.empty()) plan.push_back(lineOf(rung));
  }
  return plan;
}

std::string noteOf(const std::vector<std::string>& notes) {
  std::string all;
  for (const std::string& note : notes) all += (all.empty() ? "" : "; ") + note;
  return all;
}

std::string noteOf(const ProbabilityResult& answer) {
  return answer.statistics.rungs.empty() ? noteOf(answer.plan) : "";
}

}  // namespace fcl_prob::detail
