// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "base/ladder.h"

#include <catch2/catch.hpp>

#include "base/statistics.h"

using namespace fcl_prob;
using namespace fcl_prob::detail;

namespace {

/// P is 0.3; each rung knows it to a tenth of what the one before does.
class Toy {
 public:
  explicit Toy(const ProbabilityRequest& request) : known(request) {}

  Climbed look() { return narrowTo(0.3); }
  Climbed lookCloser() { return narrowTo(0.03); }
  Climbed lookClosest() { return narrowTo(0.003); }

  bool small = true;
  Known known;
  std::vector<RungRecord> records;

 private:
  Climbed narrowTo(double away) {
    known.narrow({0.3 - away, 0.3 + away});
    return {known.satisfied().has_value(), "to " + std::to_string(away).substr(0, 5)};
  }
};

const std::vector<Rung<Toy>> kToys{
    {"glance", [](const Toy& toy) { return toy.small ? nullptr : "it is large"; }, &Toy::look},
    {"touch", [](const Toy&) { return ""; }, &Toy::look},
    {"look", nullptr, &Toy::lookCloser},
    {"stare", nullptr, &Toy::lookClosest, true}};

std::vector<std::string> climbed(Toy& toy) {
  climb(kToys, toy, toy.known, toy.records);
  std::vector<std::string> names;
  for (const RungRecord& record : toy.records) {
    if (record.times > 0) names.push_back(record.name);
  }
  return names;
}

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("rungs are climbed in their order until one has answered") {
  ProbabilityRequest request;
  request.relative_tolerance = 0.0;
  request.absolute_tolerance = 0.1;
  Toy toy(request);
  CHECK(climbed(toy) == Names{"glance", "look"});
  CHECK(toy.records[0].answered == 0);
  CHECK(toy.records[1].answered == 1);
  CHECK(toy.records[1].known.lower == 0.3 - 0.03);
  ProbabilityResult result;
  toy.known.tell(result);
  CHECK(*result.upper == 0.3 + 0.03);
}

TEST_CASE("a threshold ends a climb by a decision only") {
  ProbabilityRequest request;
  request.absolute_tolerance = 0.1;
  request.threshold = 0.301;
  Toy toy(request);
  CHECK(climbed(toy) == Names{"glance", "look", "stare"});
  CHECK(toy.known.decision() == Decision::undecided);
  request.threshold = 0.35;
  Toy other(request);
  CHECK(climbed(other) == Names{"glance", "look"});
  CHECK(other.known.decision() == Decision::below);
}

TEST_CASE("rungs that do not serve or are left out are not climbed, those that are needed are") {
  ProbabilityRequest request;
  request.relative_tolerance = 0.0;
  request.absolute_tolerance = 0.1;
  Toy toy(request);
  toy.small = false;
  CHECK(climbed(toy) == Names{"look"});
  leftOut() = {"look", "stare"};
  Toy without(request);
  const Names names = climbed(without);
  leftOut().clear();
  CHECK(names == Names{"glance", "stare"});
}

TEST_CASE("a plan is a line for each rung that was climbed, or that was left out for a reason") {
  ProbabilityRequest request;
  request.relative_tolerance = 0.0;
  request.absolute_tolerance = 0.1;
  Toy toy(request);
  climbed(toy);
  CHECK(planOf(toy.records) == std::vector<std::string>{"glance: to 0.300; P <= 0.6",
                                                        "look: to 0.030; P in [0.27, 0.33]"});
  Toy large(request);
  large.small = false;
  climbed(large);
  CHECK(planOf(large.records) == std::vector<std::string>{"glance: left out, it is large",
                                                          "look: to 0.030; P in [0.27, 0.33]"});
  leftOut() = {"look"};
  Toy without(request);
  climbed(without);
  leftOut().clear();
  REQUIRE(planOf(without.records).size() == 3);
  CHECK(planOf(without.records)[1] == "look: left out, as was asked");
  CHECK(noteOf({"one", "two"}) == "one; two");
}

TEST_CASE("what is known gets no wider") {
  const ProbabilityRequest request;
  Known known(request);
  known.narrow({0.1, 0.5});
  known.narrow({0.0, 0.4});
  CHECK(known.interval().lower == 0.1);
  CHECK(known.interval().upper == 0.4);
}

TEST_CASE("rungs of one name are one where answers are added up") {
  ProbabilityStatistics one, all;
  one.cells = 3;
  one.peak_memory = 10;
  one.rungs = {{"a", 1.0, {0.1, 0.2}, 1, 0}, {"b", 2.0, {0.1, 0.15}, 1, 1}};
  addStatistics(one, all);
  one.rungs = {{"b", 3.0, {0.0, 0.05}, 1, 1}};
  addStatistics(one, all);
  CHECK(all.cells == 6);
  CHECK(all.peak_memory == 10);
  REQUIRE(all.rungs.size() == 2);
  CHECK(all.rungs[1].seconds == 5.0);
  CHECK(all.rungs[1].times == 2);
  CHECK(all.rungs[1].answered == 2);
  CHECK(all.rungs[1].known.lower == 0.0);
  CHECK(all.rungs[1].known.upper == 0.15);
}
