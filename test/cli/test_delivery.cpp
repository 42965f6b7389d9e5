// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Reports that cannot be delivered: exit code 2, one line that says so, and no file that looks
// whole.
#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "catch.h"
#include "command.h"

using namespace fcl_prob_test;

namespace {

using Words = std::vector<std::string>;

/// Every way to make a command write a file, without its name.
std::vector<Words> writers() {
  const std::string scene = dataFile("two_boxes.json");
  const Words compare{"compare",    "--scene",   scene, "--method",
                      "convex-pcd", "--samples", "100", "--relative-tolerance",
                      "0.5"};
  std::vector<Words> all{{"check", "--scene", scene},
                         {"check", "--scene", scene, "--json"},
                         {"export", "--scene", scene, "--samples", "100"}};
#ifdef FCL_PROB_HAS_BENCH
  all.push_back({"bench"});
#endif
  for (const char* form : {"", "--csv", "--json"}) {
    all.push_back(compare);
    if (*form != '\0') all.back().push_back(form);
  }
  for (Words& words : all) words.emplace_back("--output");
  return all;
}

std::string endingOf(const Words& words) { return words[0] == "export" ? ".glb" : ".txt"; }

std::string joined(const Words& words) {
  std::string text;
  for (const std::string& word : words) text += word + " ";
  return text;
}

std::size_t filesIn(const std::string& folder) {
  const std::filesystem::directory_iterator files(folder);
  return static_cast<std::size_t>(std::distance(begin(files), end(files)));
}

}  // namespace

TEST_CASE("a report for a folder that is not there exits with 2", "[cli]") {
  const TemporaryFolder folder;
  for (Words words : writers()) {
    words.push_back(folder.path("nowhere/report" + endingOf(words)));
    CAPTURE(joined(words));
    const CommandResult result = runCommand(words, folder);
    CHECK(result.exit_code == 2);
    CHECK(result.out.empty());
    CHECK(result.err.find("report" + endingOf(words) + ": cannot be written: No such file") !=
          std::string::npos);
  }
}

TEST_CASE("a disk that is full leaves the old report as it was", "[cli]") {
  const TemporaryFolder folder;
  const TemporaryFolder reports;
  for (Words words : writers()) {
    const std::string report = reports.write("report" + endingOf(words), "the old one");
    words.push_back(report);
    CAPTURE(joined(words));
    const std::size_t files = filesIn(reports.path(""));
    // No file may become larger than 0 blocks, the error output's excepted.
    const CommandResult result = runCommandIn("ulimit -f 0", words, folder);
    CHECK(result.exit_code == 2);
    CHECK(readWhole(report) == "the old one");
    CHECK(filesIn(reports.path("")) == files);
    const CommandResult whole = runCommand(words, folder);
    CHECK((whole.exit_code == 0 || whole.exit_code == 3));
    CHECK(readWhole(report).size() > 50);
    CHECK(filesIn(reports.path("")) == files);
  }
}

TEST_CASE("a plot that does not fit on the disk exits with 2 and leaves no half of it", "[cli]") {
  if (std::system("command -v gnuplot >/dev/null 2>&1") != 0) {
    std::cout << "SKIPPED: gnuplot is not installed\n";
    return;
  }
  const TemporaryFolder folder;
  const TemporaryFolder plots;
  const Words compare{"compare",   "--scene", dataFile("two_boxes.json"), "--method", "convex-pcd",
                      "--samples", "100",     "--relative-tolerance",     "0.5",      "--plot"};
  const auto plotTo = [&](const std::string& path, const std::string& before) {
    Words words = compare;
    words.push_back(path);
    return runCommandIn(before, words, folder);
  };
  const std::string plot = plots.write("plot.svg", "the old one");
  // Full for gnuplot's script and the error output too, or only for the plot, which is longer.
  for (const char* limit : {"ulimit -f 0", "ulimit -f 6"}) {
    CAPTURE(limit);
    const CommandResult full = plotTo(plot, limit);
    CHECK(full.exit_code == 2);
    CHECK((full.err.empty() ||
           full.err.find("plot.svg: cannot be written: File too large") != std::string::npos));
    CHECK(readWhole(plot) == "the old one");
    CHECK(filesIn(plots.path("")) == 1);
  }
  CHECK(plotTo(plot, "true").exit_code == 0);
  CHECK(readWhole(plot).size() > 6 * 1024);

  if (!std::filesystem::exists("/dev/full")) {
    std::cout << "SKIPPED: no /dev/full\n";
    return;
  }
  const std::string device = plots.path("device.svg");
  std::filesystem::create_symlink("/dev/full", device);
  const CommandResult full = plotTo(device, "true");
  CHECK(full.exit_code == 2);
  CHECK(full.err.find("device.svg: cannot be written: No space left on device") !=
        std::string::npos);
  CHECK(std::filesystem::is_symlink(device));
  CHECK(filesIn(plots.path("")) == 2);
}

TEST_CASE("a closed pipe is told and exits with 2", "[cli]") {
  const TemporaryFolder folder;
  const std::string scene = dataFile("two_boxes.json");
  for (const Words& words :
       {Words{"check", "--scene", scene}, Words{"check", "--help"}, Words{"--help"}}) {
    CAPTURE(joined(words));
    int ends[2];
    REQUIRE(::pipe(ends) == 0);
    ::close(ends[0]);
    REQUIRE(ends[1] < 10);  // the shell's limit
    const CommandResult result = runCommand(words, folder, "&" + std::to_string(ends[1]));
    ::close(ends[1]);
    CHECK(result.exit_code == 2);
    CHECK(result.err.find("standard output: cannot be written: Broken pipe") != std::string::npos);
  }
}
