// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "base/known_text.h"

#include <sstream>

namespace fcl_prob::detail {
namespace {

/// Of the upper bound: bounds that differ by no more are told by their middle, whose first digit
/// they then leave little doubt about.
constexpr double kOneNumber = 0.1;

constexpr int kDigits = 6;

std::string shortText(double value) {
  std::ostringstream text;
  text.precision(kDigits);
  text << value;
  return text.str();
}

bool isOneNumber(const std::optional<double>& estimate, const Bounds& bounds) {
  return estimate || bounds.width() <= kOneNumber * bounds.upper;
}

}  // namespace

std::string knownText(const std::optional<double>& estimate, const Bounds& bounds) {
  if (isOneNumber(estimate, bounds)) return shortText(estimate.value_or(bounds.middle()));
  const bool from_below = bounds.lower > 0.0, from_above = bounds.upper < 1.0;
  if (from_below && from_above) {
    return "in [" + shortText(bounds.lower) + ", " + shortText(bounds.upper) + "]";
  }
  if (from_above) return "<= " + shortText(bounds.upper);
  return from_below ? ">= " + shortText(bounds.lower) : "unknown";
}

std::string knownText(const ProbabilityResult& result) {
  return knownText(result.estimate, boundsOf(result));
}

std::string relationText(const std::optional<double>& estimate, const Bounds& bounds) {
  return (isOneNumber(estimate, bounds) ? "= " : "") + knownText(estimate, bounds);
}

std::string relationText(const ProbabilityResult& result) {
  return relationText(result.estimate, boundsOf(result));
}

Bounds boundsOf(const ProbabilityResult& result) {
  return {result.lower.value_or(0.0), result.upper.value_or(1.0)};
}

}  // namespace fcl_prob::detail
