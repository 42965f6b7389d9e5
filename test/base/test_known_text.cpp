// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What people are told of a probability.
#include "base/known_text.h"

#include "catch.h"

using namespace fcl_prob;
using detail::knownText;
using detail::relationText;

TEST_CASE("one number is told only where one is known") {
  const std::optional<double> none;
  CHECK(knownText(0.25, {0.0, 1.0}) == "0.25");
  CHECK(knownText(none, {0.249, 0.251}) == "0.25");
  CHECK(knownText(none, {1.0, 1.0}) == "1");
  CHECK(knownText(none, {0.0, 0.0}) == "0");
  CHECK(knownText(none, {0.06, 1.0}) == ">= 0.06");
  CHECK(knownText(none, {0.0, 1.5e-12}) == "<= 1.5e-12");
  CHECK(knownText(none, {0.06, 0.5}) == "in [0.06, 0.5]");
  CHECK(knownText(none, {0.0, 1.0}) == "unknown");
  CHECK(relationText(none, {0.06, 1.0}) == ">= 0.06");
  CHECK(relationText(0.25, {0.0, 1.0}) == "= 0.25");
  ProbabilityResult result;
  CHECK(knownText(result) == "unknown");
  result.upper = 0.125;
  CHECK(relationText(result) == "<= 0.125");
  result.estimate = 0.0625;
  CHECK(relationText(result) == "= 0.0625");
}
