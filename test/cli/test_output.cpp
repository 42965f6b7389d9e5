// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Reports on disk are whole or not there.
#include "cli/output.h"

#include <filesystem>

#include "catch.h"
#include "command.h"
#include "fcl_prob/exceptions.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

std::size_t filesIn(const TemporaryFolder& folder) {
  const std::filesystem::directory_iterator files(folder.path(""));
  return static_cast<std::size_t>(std::distance(begin(files), end(files)));
}

}  // namespace

TEST_CASE("a file is written whole, also over an old one", "[cli]") {
  const TemporaryFolder folder;
  cli::writeFile(folder.path("report"), "first");
  CHECK(readWhole(folder.path("report")) == "first");
  cli::writeFile(folder.path("report"), "second and longer");
  CHECK(readWhole(folder.path("report")) == "second and longer");
  CHECK(filesIn(folder) == 1);
}

TEST_CASE("a file that cannot be written leaves nothing behind", "[cli]") {
  const TemporaryFolder folder;
  CHECK_THROWS_AS(cli::writeFile(folder.path("no/such/folder"), "x"), FileError);
  std::filesystem::create_directory(folder.path("taken"));
  CHECK_THROWS_AS(cli::writeFile(folder.path("taken"), "x"), FileError);
  CHECK(filesIn(folder) == 1);
  if (!std::filesystem::exists("/dev/full")) return;
  CHECK_THROWS_WITH(cli::writeFile("/dev/full", "x"),
                    "/dev/full: cannot be written: No space left on device");
  CHECK(std::filesystem::is_character_file("/dev/full"));
}

TEST_CASE("messages become one line", "[cli]") { CHECK(cli::onOneLine("a\nb\tc\r\n") == "a b c"); }
