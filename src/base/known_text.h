// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What is known of a probability, for people.
#pragma once

#include <optional>
#include <string>

#include "fcl_prob/bounds.h"
#include "fcl_prob/probability_result.h"

namespace fcl_prob::detail {

/// One number only where that is what is known: the estimate, or the middle of bounds that differ
/// by no more than a tenth of the upper one; else "in [0.06, 0.5]", "<= 0.5", ">= 0.06" or
/// "unknown". Six digits.
std::string knownText(const std::optional<double>& estimate, const Bounds& bounds);

std::string knownText(const ProbabilityResult& result);

/// The same behind the name of the probability: "= 0.25", but "<= 0.5".
std::string relationText(const std::optional<double>& estimate, const Bounds& bounds);
std::string relationText(const ProbabilityResult& result);

/// What is certain; [0, 1] where nothing is.
Bounds boundsOf(const ProbabilityResult& result);

}  // namespace fcl_prob::detail
