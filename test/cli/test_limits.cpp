// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A limit that ends a check is told, with what allows more.
#include <nlohmann/json.hpp>

#include "catch.h"
#include "command.h"

using namespace fcl_prob_test;

namespace {

/// P(two knots touch) as closely as no limit allows. \return  the last line of its plan
std::string endOf(std::vector<std::string> limit, const std::string& status) {
  const TemporaryFolder folder;
  const std::string knot = dataFile("torus_knot.ply");
  std::vector<std::string> command{"check", knot, knot, "--json"};
  for (const char* option :
       {"--pose-b", "0.1,0,0", "--sigma", "0.01,0.02,0.03", "--method", "interval",
        "--relative-tolerance", "1e-9", "--absolute-tolerance", "0"}) {
    command.emplace_back(option);
  }
  command.insert(command.end(), limit.begin(), limit.end());
  const CommandResult result = runCommand(command, folder);
  CAPTURE(result.out, result.err);
  CHECK(result.exit_code == 3);
  const auto answer = nlohmann::json::parse(result.out);
  CHECK(answer.at("status") == status);
  CHECK(answer.at("lower").get<double>() <= answer.at("upper").get<double>());
  return answer.at("plan").back();
}

}  // namespace

TEST_CASE("a limit that ends a check says what allows more", "[cli]") {
  CHECK(endOf({"--time-limit", "0.05"}, "time-limit") ==
        "stopped at 0.05 s: --time-limit allows more");
  CHECK(endOf({"--max-cells", "100"}, "cell-limit") ==
        "stopped at 100 cells: --max-cells allows more");
  CHECK(endOf({"--max-memory", "100000"}, "memory-limit") ==
        "stopped at 100000 bytes: --max-memory allows more");
}

TEST_CASE("a check without limits ends after 20 s", "[cli][long]") {
  CHECK(endOf({"--max-cells", "1000000000", "--max-memory", "1000000000000"}, "time-limit") ==
        "stopped at 20 s: --time-limit allows more");
}
