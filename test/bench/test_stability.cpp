// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// fcl_prob bench stability, and the truths that it compares with.
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "bench/stability_case.h"
#include "catch.h"
#include "command.h"

namespace {

using fcl_prob::cli::Precise;

nlohmann::json stability(const std::string& cases, const std::string& seed) {
  const fcl_prob_test::TemporaryFolder folder;
  const auto result = fcl_prob_test::runCommand(
      {"bench", "stability", "--cases", cases, "--seed", seed, "--json"}, folder);
  REQUIRE(result.exit_code == 0);
  return nlohmann::json::parse(result.out);
}

void checkNothingViolated(const nlohmann::json& records, std::size_t cases) {
  std::set<std::string> families, methods;
  for (const nlohmann::json& record : records) {
    CAPTURE(record.dump());
    CHECK(record.at("cases").get<std::size_t>() == cases);
    CHECK(record.at("violated") == 0);
    CHECK(record.at("failed") == 0);
    families.insert(record.at("family"));
    methods.insert(record.at("method"));
    if (record.at("method") == "exact" && record.at("family") == "P down to 1e-300") {
      CHECK(record.at("worst_error").get<double>() < 1e-10);
    }
  }
  CHECK(families.size() >= 17);
  CHECK(methods ==
        std::set<std::string>{"exact", "interval", "estimate", "convex-pcd", "general-pcd"});
}

}  // namespace

TEST_CASE("no bound is violated in stiff and extreme scenes", "[cli]") {
  checkNothingViolated(stability("2", "1"), 2);
}

TEST_CASE("no bound is violated in many stiff and extreme scenes", "[cli][long]") {
  checkNothingViolated(stability("300", "2"), 300);
}

TEST_CASE("the truths of the stability benchmark keep their digits", "[cli]") {
  using namespace fcl_prob::cli;
  const auto near = [](const Precise& value, double expected) {
    return value.convert_to<double>() == Approx(expected).epsilon(1e-14);
  };
  // By mpmath with 60 digits.
  CHECK(near(preciseNormalMass(-38), 2.8854283600687864e-316));
  CHECK(near(preciseNormalMass(-1), 0.15865525393145705));
  CHECK(near(preciseIntervalMass(-1, 1), 0.68268949213708590));
  CHECK(near(preciseIntervalMass(-1e-12, 1e-12), 2e-12 / std::sqrt(2 * M_PI)));
  CHECK(near(preciseBallMass(0, 1), 0.19874804309879920));
  CHECK(near(preciseBallMass(0.5, 1), 0.17955979780833954));
  CHECK(AxisRange{0, 1, 0}.mass() == 1);
  CHECK(AxisRange{0, 1, 0}.mass(true) == 0);
  // By symmetry half of the square, less half of what both halves share.
  const SlantedStrip half{-1, -1, 2, 2, 1, 1.0, 1.0};
  CHECK(near(half.mass(), 0.5 * 0.6826894921370859 * 0.6826894921370859));
}

namespace {

using fcl_prob::cli::StabilityCase;

// Whether an answer asked for with hardly any tolerance still holds the truth.
void checkTightAnswers(std::uint64_t seed, std::uint64_t cases, std::size_t cells) {
  const auto families = fcl_prob::cli::stabilityFamilies();
  int tight = 0;
  for (std::size_t k = 0; k < families.size(); ++k) {
    for (std::uint64_t i = 0; i < cases; ++i) {
      fcl_prob::cli::StabilityRandom random(seed, k, i);
      const StabilityCase scene = families[k].make(random);
      if (scene.displacement.size() > 1) continue;
      fcl_prob::ProbabilityRequest request;
      request.method = fcl_prob::ProbabilityMethod::interval;
      request.contact = scene.contact;
      request.relative_tolerance = 1e-13;
      request.absolute_tolerance = 0;
      request.max_cells = cells;
      fcl_prob::ProbabilityResult result;
      fcl_prob::PreparedQuery(scene.a, scene.b)
          .collisionProbability(scene.pose_a, scene.pose_b, scene.displacement[0].displacement,
                                request, result);
      CAPTURE(families[k].name, families[k].objects, i, *result.lower, *result.upper);
      REQUIRE(*result.lower <= scene.truth.upper);
      REQUIRE(*result.upper >= scene.truth.lower);
      tight += *result.upper - *result.lower < 1e-9 * *result.upper;
    }
  }
  CAPTURE(tight);
  CHECK(tight > 0.15 * static_cast<double>(families.size() * cases));
}

}  // namespace

TEST_CASE("intervals as tight as rounding allows hold known probabilities", "[cli][slow]") {
  checkTightAnswers(3, 4, 300);
}

TEST_CASE("many intervals as tight as rounding allows hold known probabilities", "[cli][long]") {
  checkTightAnswers(4, 200, 1500);
}
