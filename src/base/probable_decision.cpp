// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/probable_decision.h"

namespace fcl_prob {

std::string toString(ProbableDecision decision) {
  switch (decision) {
    case ProbableDecision::undecided:
      return "undecided";
    case ProbableDecision::certainly_below:
      return "certainly-below";
    case ProbableDecision::certainly_above:
      return "certainly-above";
    case ProbableDecision::probably_below:
      return "probably-below";
    case ProbableDecision::probably_above:
      return "probably-above";
  }
  return "";
}

}  // namespace fcl_prob
