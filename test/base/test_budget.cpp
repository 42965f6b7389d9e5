// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "base/budget.h"

#include <catch2/catch.hpp>
#include <thread>

using namespace fcl_prob;
using namespace fcl_prob::detail;

TEST_CASE("what one part does not use is there for the next") {
  ProbabilityRequest whole;
  whole.max_cells = 100;
  whole.samples = 50;
  Budget budget(whole);
  ProbabilityRequest part = whole;
  budget.share(4, part);
  CHECK(part.max_cells == 25);
  CHECK(part.samples == 12);
  ProbabilityStatistics little;
  little.cells = 10;
  little.samples = 50;
  budget.spend(little);
  budget.share(3, part);
  CHECK(part.max_cells == 30);
  CHECK(part.samples == 1);
  CHECK_FALSE(budget.exhausted());
  budget.spendCells(90);
  CHECK(budget.exhausted() == ProbabilityStatus::cell_limit);
  budget.share(2, part);
  CHECK(part.max_cells == 1);
}

TEST_CASE("what is kept back is not shared") {
  ProbabilityRequest whole;
  whole.max_cells = 100;
  const Budget budget(whole);
  ProbabilityRequest part = whole;
  budget.share(2, part, budget.left().part(0.5));
  CHECK(part.max_cells == 25);
}

TEST_CASE("time is shared, and is up for all parts at once") {
  ProbabilityRequest whole;
  whole.time_limit = 1e-9;
  Budget budget(whole);
  while (!(budget.seconds() > 1e-6)) {
  }
  CHECK(budget.look() == ProbabilityStatus::time_limit);
  CHECK(budget.exhausted() == ProbabilityStatus::time_limit);
  CHECK(budget.withTimeLeft().time_limit > 0.0);  // a request has to be valid
  whole.time_limit = 1000.0;
  Budget long_one(whole);
  CHECK_FALSE(long_one.look());
  CHECK(long_one.look(1e-12) == ProbabilityStatus::time_limit);
  CHECK_FALSE(long_one.stopped());  // an earlier end is not that of the whole
  ProbabilityRequest half = whole;
  long_one.shareTime(2, half);
  CHECK(*half.time_limit <= 500.0);
  CHECK(*half.time_limit > 490.0);
}

TEST_CASE("who cancels is not asked again, and is asked by his own thread only") {
  ProbabilityRequest request;
  int asked = 0;
  ProbabilityProgress told;
  request.on_progress = [&](const ProbabilityProgress& progress) {
    told = progress;
    return ++asked < 2;
  };
  Budget budget(request);
  std::thread([&] { CHECK(budget.goOn()); }).join();
  CHECK(asked == 0);
  CHECK_FALSE(budget.look({0.25, 0.75}, 0.5));
  CHECK(told.interval.lower == 0.25);
  CHECK(told.fraction == 0.5);
  CHECK(budget.look() == ProbabilityStatus::cancelled);
  CHECK_FALSE(budget.goOn());
  CHECK(budget.exhausted() == ProbabilityStatus::cancelled);
  CHECK(asked == 2);
}

TEST_CASE("an interruption looks now and then, and stays due") {
  ProbabilityRequest request;
  int asked = 0;
  request.on_progress = [&](const ProbabilityProgress&) { return ++asked < 3; };
  Budget budget(request);
  const Interruption interruption = budget.interruption();
  int calls = 0;
  while (!interruption()) ++calls;
  CHECK(asked == 3);
  CHECK(calls > 2 * 3);
  for (int i = 0; i < 1000; ++i) CHECK(interruption());
  CHECK(asked == 3);
}
