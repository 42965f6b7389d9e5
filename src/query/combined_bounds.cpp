// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/combined_bounds.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/constants.h"
#include "fcl_prob/exceptions.h"

namespace fcl_prob {
namespace {

using detail::kEpsilon;

void validate(const std::vector<Bounds>& events) {
  for (const Bounds& event : events) {
    if (event.lower >= 0.0 && event.lower <= event.upper && event.upper <= 1.0) continue;
    throw InvalidRequest("not an interval of a probability: [" + std::to_string(event.lower) +
                         ", " + std::to_string(event.upper) + "]");
  }
}

// Relative error of a sum of so many terms of one sign, each with a few ulp of its own.
double roundingOf(std::size_t terms) { return (static_cast<double>(terms) + 8.0) * 2 * kEpsilon; }

// log Π(1 - P): -infinity if one event is certain.
double logOfNone(const std::vector<Bounds>& events, double Bounds::*end) {
  double sum = 0.0;
  for (const Bounds& event : events) sum += std::log1p(-(event.*end));
  return sum;
}

}  // namespace

Bounds anyOf(const std::vector<Bounds>& events) {
  validate(events);
  Bounds any;
  for (const Bounds& event : events) {
    any.lower = std::max(any.lower, event.lower);
    any.upper += event.upper;
  }
  // One event keeps its bounds to the last bit.
  if (events.size() > 1) any.upper *= 1.0 + roundingOf(events.size());
  any.upper = std::min(any.upper, 1.0);
  return any;
}

Bounds anyOfIndependent(const std::vector<Bounds>& events) {
  validate(events);
  const double rounding = roundingOf(events.size());
  // The logarithms have one sign, so that their sum keeps its relative accuracy; that of
  // -expm1(-x) is not worse.
  const double least = -std::expm1(logOfNone(events, &Bounds::lower) * (1.0 - rounding));
  const double most = -std::expm1(logOfNone(events, &Bounds::upper) * (1.0 + rounding));
  Bounds any{std::max(0.0, least * (1.0 - rounding) - detail::kUnderflow),
             most * (1.0 + rounding) + (most > 0.0 ? detail::kUnderflow : 0.0)};
  // Neither tighter than any event by itself, nor than what holds without independence.
  const Bounds always = anyOf(events);
  any.lower = std::max(any.lower, always.lower);
  any.upper = std::min(any.upper, always.upper);
  return any;
}

}  // namespace fcl_prob
