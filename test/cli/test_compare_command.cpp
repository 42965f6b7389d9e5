// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// fcl_prob compare from outside, and its reports.
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "catch.h"
#include "cli/comparison.h"
#include "cli/comparison_report.h"
#include "cli/text_table.h"
#include "command.h"

using namespace fcl_prob;
using namespace fcl_prob_test;
using nlohmann::json;

namespace {

/// Two tetrahedra in general position, P about 0.1.
std::string tetrahedra(const TemporaryFolder& folder) {
  folder.write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  return folder.write("scene.json", R"({
"a": {"mesh": "t.obj", "pose": [0.83, 0.11, 0.07, 1, 0.1, 0.3, 0.2]}, "b": {"mesh": "t.obj"},
"displacement": {"sigma": [0.1, 0.05, 0.02], "sigma_axes": [1, 0.3, 0.2, 0.1]}})");
}

}  // namespace

TEST_CASE("compare has one record a method and budget, near its reference", "[cli]") {
  const TemporaryFolder folder;
  const CommandResult result =
      runCommand({"compare", "--scene", tetrahedra(folder), "--seeds", "3", "--json"}, folder);
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  const json answer = json::parse(result.out);
  const double reference = answer.at("reference").at("value").get<double>();
  CHECK(reference > 0.01);
  CHECK(reference < 0.5);
  CHECK(answer.at("reference").at("certified") == true);
  CHECK(answer.at("fcl").at("collides") == false);

  std::set<std::pair<std::string, std::string>> seen;
  std::set<std::string> methods;
  int answered = 0;
  for (const json& record : answer.at("records")) {
    CAPTURE(record.dump());
    CHECK(seen.emplace(record.at("method"), record.at("budget")).second);
    methods.insert(record.at("method").get<std::string>());
    if (record.contains("refusal")) continue;
    ++answered;
    CHECK(record.at("time_ms").get<double>() > 0.0);
    if (record.at("seeds") == 1) {
      CHECK(record.at("error").get<double>() ==
            Approx(std::abs(record.at("value").get<double>() - reference)));
    }
    if (record.at("method") == "du-toit-burdick") {  // certifies nothing
      CHECK(record.at("upper").is_null());
      CHECK(record.at("status") == "approximation");
    }
    if (record.at("lower").is_number()) CHECK(record.at("lower").get<double>() <= reference + 1e-9);
    if (record.at("upper").is_number()) CHECK(record.at("upper").get<double>() >= reference - 1e-9);
  }
  CHECK(seen.size() == cli::defaultRuns({}).size());
  CHECK(answered >= 27);
  for (const char* prior : {"du-toit-burdick", "park", "enlargement"}) {
    CHECK(methods.count(prior) == 1);
  }
}

TEST_CASE("the error of a method that samples is the one to be expected", "[cli]") {
  const TemporaryFolder folder;
  const CommandResult result = runCommand({"compare", "--scene", dataFile("two_boxes.json"),
                                           "--method", "monte-carlo", "--seeds", "40", "--json"},
                                          folder);
  REQUIRE(result.exit_code == 0);
  for (const json& record : json::parse(result.out).at("records")) {
    CAPTURE(record.dump());
    CHECK(record.at("seeds") == 40);
    // A root mean square over 40 draws is within a third of what it estimates.
    if (record.at("budget") == "100 samples") continue;  // too few for the stated error
    CHECK(record.at("error").get<double>() ==
          Approx(record.at("stated_error").get<double>()).epsilon(0.4));
  }
  CHECK(runCommand({"compare", "--scene", dataFile("two_boxes.json"), "--seeds", "0"}, folder)
            .refused());
}

TEST_CASE("compare as CSV and table, for one method", "[cli]") {
  const TemporaryFolder folder;
  const std::vector<std::string> arguments{
      "compare", "--scene", dataFile("two_boxes.json"), "--method", "monte-carlo", "--seeds", "1"};
  std::vector<std::string> with_csv = arguments;
  with_csv.emplace_back("--csv");
  const CommandResult csv = runCommand(with_csv, folder);
  REQUIRE(csv.exit_code == 0);
  std::istringstream lines(csv.out);
  std::string line;
  std::getline(lines, line);
  CHECK(line.rfind("method,budget,value,lower,upper,", 0) == 0);
  const auto commas = std::count(line.begin(), line.end(), ',');
  int rows = 0;
  while (std::getline(lines, line)) {
    CHECK(std::count(line.begin(), line.end(), ',') == commas);
    CHECK(line.rfind("monte-carlo,", 0) == 0);
    ++rows;
  }
  CHECK(rows == 4);

  const CommandResult table = runCommand(arguments, folder);
  CHECK(table.out.find("reference: ") == 0);
  CHECK(table.out.find("10000 samples") != std::string::npos);
}

TEST_CASE("compare plots with gnuplot, or says that it is missing", "[cli]") {
  const TemporaryFolder folder;
  const CommandResult result =
      runCommand({"compare", "--scene", dataFile("two_boxes.json"), "--method", "monte-carlo",
                  "--seeds", "2", "--plot", folder.path("plot.svg")},
                 folder);
  CHECK(result.exit_code == 0);
  if (std::system("command -v gnuplot >/dev/null 2>&1") == 0) {
    const std::string plot = readWhole(folder.path("plot.svg"));
    CHECK(plot.find("<svg") != std::string::npos);
    CHECK(plot.find("monte-carlo") != std::string::npos);
    CHECK(result.err.empty());
  } else {
    CHECK(result.err.find("gnuplot is not installed") != std::string::npos);
  }
  CHECK(runCommand({"compare", "--scene", dataFile("two_boxes.json"), "--plot", "x.pdf"}, folder)
            .refused());
}

TEST_CASE("tables as text and CSV", "[cli]") {
  cli::TextTable table({"a", "long"});
  table.add({"1,5", "x\"y"});
  CHECK(table.text() == "a    long\n1,5  x\"y\n");
  CHECK(table.csv() == "a,long\n\"1,5\",\"x\"\"y\"\n");
}

TEST_CASE("a comparison that was interrupted says so in whatever is written of it", "[cli]") {
  for (const bool interrupted : {false, true}) {
    fcl_prob::cli::Comparison comparison;
    comparison.interrupted = interrupted;
    const std::string table = fcl_prob::cli::tableOf(comparison);
    const std::string csv = fcl_prob::cli::csvOf(comparison);
    CHECK((table.find("INTERRUPTED") != std::string::npos) == interrupted);
    CHECK((csv.find("interrupted") != std::string::npos) == interrupted);
    CHECK(fcl_prob::cli::jsonOf(comparison).at("interrupted") == interrupted);
  }
}
