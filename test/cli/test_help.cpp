// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What the command says of itself.
#include <algorithm>

#include "catch.h"
#include "command.h"
#include "fcl_prob/version.h"

using namespace fcl_prob_test;

TEST_CASE("without arguments the command says in five lines what to try next", "[cli]") {
  const TemporaryFolder folder;
  const CommandResult result = runCommand({}, folder);
  CHECK(result.exit_code == 2);
  CHECK(result.out.empty());
  CHECK(std::count(result.err.begin(), result.err.end(), '\n') == 5);
  CHECK(result.err.find("fcl_prob check --scene") != std::string::npos);
}

TEST_CASE("the help of check groups its options", "[cli]") {
  const TemporaryFolder folder;
  const std::string help = runCommand({"check", "--help"}, folder).out;
  // A heading, then an option of that group, in this order.
  std::size_t at = 0;
  for (const char* text : {"\nObjects:", "--pose-a", "\nError:", "--sigma", "\nQuestion:",
                           "--threshold", "\nLimits:", "--time-limit", "\nOutput:", "--json"}) {
    CAPTURE(text, help);
    at = help.find(text, at);
    REQUIRE(at != std::string::npos);
  }
  CHECK(help.find("--gradient") < help.find("\nLimits:"));
}

TEST_CASE("--version names the program and its version", "[cli]") {
  const TemporaryFolder folder;
  const CommandResult result = runCommand({"--version"}, folder);
  CHECK(result.exit_code == 0);
  CHECK(result.out == "fcl_prob " FCL_PROB_VERSION "\n");
  CHECK(result.err.empty());
}
