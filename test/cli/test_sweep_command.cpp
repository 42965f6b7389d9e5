// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// fcl_prob sweep, from outside: bad lines, shards, kills.
#include <nlohmann/json.hpp>

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>

#include "catch.h"
#include "command.h"

using namespace fcl_prob_test;
using nlohmann::json;

namespace {

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::vector<json> recordsOf(const TemporaryFolder& folder, const std::string& name) {
  std::vector<json> records;
  for (const std::string& line : linesOf(readWhole(folder.path(name)))) {
    records.push_back(json::parse(line));
  }
  return records;
}

/// Boxes whose P has a closed form, and a mesh, by reference and in the line.
std::string queries(const TemporaryFolder& folder, int count) {
  folder.write("boxes.json", R"({"a": {"box": [0.4, 0.3, 0.2]}, "b": {"box": [0.4, 0.4, 0.25]},)"
                             R"( "displacement": {"sigma": [0.08, 0.05, 0.02]}})");
  std::string text;
  for (int i = 0; i < count; ++i) {
    const std::string pose = std::to_string(0.3 + 0.3 * i / count) + ", 0, 0]}\n";
    const std::string id = "{\"id\": " + std::to_string(i) + ", ";
    if (i % 3 == 0) {
      text += id + R"("a": {"mesh": ")" + dataFile("bracket.stl") +
              R"("}, "b": {"box": [0.4, 1, 1]},)" +
              R"( "displacement": {"sigma": [0.08, 0.05, 0.02]}, "pose_a": [)" + pose;
    } else {
      text += id + R"("scene": "boxes.json", "pose_a": [)" + pose;
    }
  }
  folder.write("queries.jsonl", text);
  return text;
}

CommandResult sweep(const TemporaryFolder& folder, const std::string& output,
                    std::vector<std::string> more = {}) {
  more.insert(more.begin(), {"sweep", "queries.jsonl", "--output", output});
  return runCommand(more, folder);
}

double normal(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

/// Starts a sweep and kills it after a while. Returns whether it had ended by itself.
bool killedAfter(const TemporaryFolder& folder, const std::string& output, int microseconds) {
  const std::string command = commandPath();
  const pid_t child = ::fork();
  if (child == 0) {
    const int nowhere = ::open("/dev/null", O_WRONLY);
    ::dup2(nowhere, STDERR_FILENO);
    if (::chdir(folder.path("").c_str()) != 0) ::_exit(1);
    ::execl(command.c_str(), command.c_str(), "sweep", "queries.jsonl", "--output", output.c_str(),
            "--resume", "--threads", "2", nullptr);
    ::_exit(1);
  }
  ::usleep(microseconds);
  ::kill(child, SIGKILL);
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

TEST_CASE("sweep answers every line, with any number of threads", "[cli]") {
  const TemporaryFolder folder;
  queries(folder, 60);
  const CommandResult one = sweep(folder, "one.jsonl", {"--threads", "1"});
  CAPTURE(one.err);
  REQUIRE(one.exit_code == 0);
  CHECK(one.out.empty());
  REQUIRE(sweep(folder, "four.jsonl", {"--threads", "4"}).exit_code == 0);
  CHECK(readWhole(folder.path("one.jsonl")) == readWhole(folder.path("four.jsonl")));
  const std::vector<json> records = recordsOf(folder, "one.jsonl");
  REQUIRE(records.size() == 60);
  for (std::size_t i = 0; i < records.size(); ++i) {
    const json& record = records[i];
    CHECK(record.at("line") == i + 1);
    CHECK(record.at("id") == i);
    CHECK_FALSE(record.contains("error"));
    if (i % 3 == 0) continue;
    const double x = 0.3 + 0.3 * static_cast<double>(i) / 60.0;
    const double truth = (normal((0.4 - x) / 0.08) - normal((-0.4 - x) / 0.08)) *
                         (1.0 - 2.0 * normal(-0.35 / 0.05)) * (1.0 - 2.0 * normal(-0.225 / 0.02));
    CHECK(record.at("lower").get<double>() <= truth + 1e-5);
    CHECK(record.at("upper").get<double>() >= truth - 1e-5);
    CHECK(record.at("probability").get<double>() == Approx(truth).margin(1e-5));
  }
}

TEST_CASE("sweep answers as check does", "[cli]") {
  const TemporaryFolder folder;
  folder.write("queries.jsonl", "{\"scene\": \"" + dataFile("finger_mug.json") + "\"}\n" +
                                    "{\"scene\": \"" + dataFile("two_knots.json") + "\"}");
  REQUIRE(sweep(folder, "out").exit_code == 0);
  const std::vector<json> records = recordsOf(folder, "out");
  REQUIRE(records.size() == 2);
  for (std::size_t i = 0; i < 2; ++i) {
    const CommandResult check = runCommand(
        {"check", "--json", "--scene", dataFile(i == 0 ? "finger_mug.json" : "two_knots.json")},
        folder);
    const json answer = json::parse(check.out);
    for (const char* key : {"lower", "upper", "estimate", "decision", "status", "method"}) {
      CHECK(records[i].at(key) == answer.at(key));
    }
    CHECK(records[i].at("cells") == answer.at("statistics").at("cells"));
  }
}

TEST_CASE("what varies of a sweep's scene", "[cli]") {
  const TemporaryFolder folder;
  queries(folder, 1);
  const std::string scene = R"({"scene": "boxes.json", )";
  folder.write(
      "queries.jsonl",
      scene + R"("pose_a": [0.5, 0, 0]})" + "\n\n  \n" +                  // 1, blank lines
          scene + R"("pose_b": [-0.5, 0, 0], "id": "moved"})" + "\r\n" +  // 4
          scene + R"("mean": [0.5, 0, 0]})" + "\n" + scene +
          R"("displacement": {"sigma": [0.08, 0.05, 0.02], "mean": [0.5, 0, 0]}})" + "\n" + scene +
          R"("pose_a": [0.5, 0, 0], "pose_error": {"sigma": [0.08, 0.05, 0.02, 0, 0, 0]}})" + "\n" +
          scene + R"("pose_a": [0.5, 0, 0], "request": {"method": "convex-pcd"}})");
  REQUIRE(sweep(folder, "out").exit_code == 0);
  const std::vector<json> records = recordsOf(folder, "out");
  REQUIRE(records.size() == 6);
  CHECK(records[1].at("line") == 4);
  CHECK(records[1].at("id") == "moved");
  for (std::size_t i = 0; i < 5; ++i) {
    CAPTURE(records[i].dump());
    CHECK(records[i].at("probability").get<double>() == Approx(0.1056497736).epsilon(1e-8));
  }
  CHECK(records[5].at("status") == "bound-only");
}

TEST_CASE("a bad line of a sweep is a record with its number", "[cli]") {
  const TemporaryFolder folder;
  queries(folder, 1);
  const std::string good = "{\"scene\": \"boxes.json\"}";
  const std::vector<std::string> bad = {
      "no JSON",
      "{",
      "[1, 2]",
      "{\"scene\": \"none.json\", \"id\": 5}",
      "{\"scene\": \"boxes.json\", \"sceen\": 1}",
      "{\"scene\": \"boxes.json\", \"scene\": \"boxes.json\"}",
      "{\"scene\": \"boxes.json\", \"id\": 1.5}",
      "{\"scene\": \"boxes.json\", \"pose_a\": [1, 2]}",
      "{\"scene\": \"boxes.json\", \"mean\": [1, 2, 1e999]}",
      "{\"scene\": \"boxes.json\", \"request\": {\"threshold\": 7}}",
      "{\"scene\": \"boxes.json\", \"request\": {\"method\": \"magic\"}}",
      "{\"scene\": \"boxes.json\", \"a\": {\"sphere\": 1}}",
      "{\"a\": {\"sphere\": 1}, \"b\": {\"sphere\": 1}}",
      "{\"a\": {\"sphere\": -1}, \"b\": {\"sphere\": 1}, \"displacement\": {\"sigma\": [1, 1, 1]}}",
      "{\"a\": {\"mesh\": \"none.stl\"}, \"b\": {\"sphere\": 1}, \"displacement\": {\"sigma\": [1, "
      "1, 1]}}",
      "{\"scene\": \"\"}",
      "{\"scene\": \"queries.jsonl\"}",
      "\xff\xfe{}",
      "{\"id\": \"\\ud800\"}",
      std::string("{\"scene\": \"\0\"}", 14),
      std::string(100, '['),
      std::string(3 << 20, ' ') + good,
      "null"};
  std::string text;
  for (const std::string& line : bad) text += line + "\n" + good + "\n";
  folder.write("queries.jsonl", text);
  const CommandResult run = sweep(folder, "out");
  CAPTURE(run.err);
  REQUIRE(run.exit_code == 0);
  CHECK(run.err.find(std::to_string(bad.size()) + " with errors") != std::string::npos);
  const std::vector<json> records = recordsOf(folder, "out");
  REQUIRE(records.size() == 2 * bad.size());
  for (std::size_t i = 0; i < records.size(); ++i) {
    CAPTURE(records[i].dump());
    CHECK(records[i].at("line") == i + 1);
    CHECK(records[i].contains("error") == (i % 2 == 0));
  }
  CHECK(records[6].at("id") == 5);
}

TEST_CASE("shards of a sweep are all of it, each line once", "[cli]") {
  const TemporaryFolder folder;
  queries(folder, 25);
  REQUIRE(sweep(folder, "whole").exit_code == 0);
  std::vector<std::string> parts;
  for (const char* shard : {"1/3", "2/3", "3/3"}) {
    REQUIRE(sweep(folder, "part", {"--shard", shard}).exit_code == 0);
    for (const std::string& line : linesOf(readWhole(folder.path("part")))) parts.push_back(line);
    REQUIRE(::unlink(folder.path("part").c_str()) == 0);
  }
  std::vector<std::string> whole = linesOf(readWhole(folder.path("whole")));
  std::sort(parts.begin(), parts.end());
  std::sort(whole.begin(), whole.end());
  CHECK(parts == whole);
  for (const char* shard : {"0/3", "4/3", "1/0", "1", "/", "a/b", "1/3x", "-1/3", ""}) {
    CAPTURE(shard);
    if (*shard != '\0') CHECK(sweep(folder, "none", {"--shard", shard}).refused());
  }
}

TEST_CASE("a sweep that is killed loses and doubles no line", "[cli]") {
  const TemporaryFolder folder;
  queries(folder, 400);
  REQUIRE(sweep(folder, "whole").exit_code == 0);
  std::mt19937 random(7);
  bool ended = false;
  int kills = 0;
  for (; kills < 200 && !ended; ++kills) {
    ended = killedAfter(folder, "killed", std::uniform_int_distribution<int>(2000, 60000)(random));
    // As if it had been killed in the middle of a line.
    if (kills % 2 == 0 && !ended) {
      const std::string text = readWhole(folder.path("killed"));
      if (text.size() > 20)
        REQUIRE(::truncate(folder.path("killed").c_str(), text.size() - 7) == 0);
    }
  }
  CAPTURE(kills);
  REQUIRE(sweep(folder, "killed", {"--resume"}).exit_code == 0);
  CHECK(readWhole(folder.path("killed")) == readWhole(folder.path("whole")));
  // Once more, for nothing.
  REQUIRE(sweep(folder, "killed", {"--resume"}).exit_code == 0);
  CHECK(readWhole(folder.path("killed")) == readWhole(folder.path("whole")));
}

TEST_CASE("sweep takes over nothing that is not its own", "[cli]") {
  const TemporaryFolder folder;
  const std::string text = queries(folder, 5);
  CHECK(sweep(folder, "out").exit_code == 0);
  const std::string results = readWhole(folder.path("out"));
  CHECK(sweep(folder, "out").refused());  // without --resume
  const auto refusedOver = [&](const std::string& content) {
    folder.write("other", content);
    const bool refused = sweep(folder, "other", {"--resume"}).refused();
    return refused && readWhole(folder.path("other")) == content;
  };
  CHECK(refusedOver("my notes\n"));
  CHECK(refusedOver("my notes"));
  CHECK(refusedOver("{\"line\": 1}\n"));
  CHECK(refusedOver("{\"line\": -1, \"query\": \"00000000\"}\n"));
  CHECK(refusedOver(results + linesOf(results)[0] + "\n"));
  CHECK(refusedOver("{\"line\": 2, \"query\": \"00000000\"}\n"));
  CHECK(refusedOver("{\"line\": 77, \"query\": \"00000000\"}\n"));
  // The queries have changed.
  folder.write("queries.jsonl", text + "{\"scene\": \"boxes.json\"}\n");
  CHECK(sweep(folder, "out", {"--resume"}).exit_code == 0);
  CHECK(recordsOf(folder, "out").size() == 6);
  folder.write("queries.jsonl", "{\"scene\": \"boxes.json\"}\n" + text);
  CHECK(sweep(folder, "out", {"--resume"}).refused());
  CHECK(sweep(folder, "out", {"--resume", "--shard", "1/2"}).refused());
}

TEST_CASE("sweep says in one line what is wrong with its files", "[cli]") {
  const TemporaryFolder folder;
  CHECK(sweep(folder, "out").refused());
  queries(folder, 2);
  CHECK(runCommand({"sweep", "queries.jsonl"}, folder).refused());
  CHECK(sweep(folder, "no/such/folder").refused());
  CHECK(sweep(folder, "/dev/full").refused());
  CHECK(sweep(folder, ".").refused());
  CHECK(sweep(folder, "out", {"--threads", "0"}).refused());
  CHECK(sweep(folder, "out", {"--threads", "-1"}).refused());
  CHECK(runCommand({"sweep", ".", "--output", "out"}, folder).refused());
  // No query is no fault.
  folder.write("queries.jsonl", "\n\n");
  CHECK(sweep(folder, "empty").exit_code == 0);
  CHECK(readWhole(folder.path("empty")).empty());
}
