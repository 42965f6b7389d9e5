// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// fcl_prob decompose, and the methods that use convex parts, from outside.
#include <nlohmann/json.hpp>

#include "catch.h"
#include "command.h"
#include "fcl_prob/mesh_io.h"

using namespace fcl_prob;
using namespace fcl_prob_test;
using nlohmann::json;

namespace {

using Corners = std::pair<Eigen::Vector3d, Eigen::Vector3d>;

std::string fileOfBoxes(const std::string& name, const std::vector<Corners>& boxes,
                        const TemporaryFolder& folder) {
  std::string text;
  int first = 1;
  for (const auto& [lower, upper] : boxes) {
    for (int i = 0; i < 8; ++i) {
      text += "v";
      for (int k = 0; k < 3; ++k) text += " " + std::to_string((i >> k & 1) ? upper[k] : lower[k]);
      text += "\n";
    }
    for (const auto& f : {std::array{0, 2, 3, 1},
                          {4, 5, 7, 6},
                          {0, 1, 5, 4},
                          {2, 6, 7, 3},
                          {0, 4, 6, 2},
                          {1, 3, 7, 5}}) {
      text += "f";
      for (const int corner : f) text += " " + std::to_string(first + corner);
      text += "\n";
    }
    first += 8;
  }
  return folder.write(name, text);
}

/// Two boxes beside each other, in a shape that is not convex. Four faces meet at one of its edges.
std::string angleFile(const TemporaryFolder& folder) {
  return fileOfBoxes("angle.obj", {{{0, 0, 0}, {0.2, 1, 0.2}}, {{0.2, 0, 0}, {1, 0.2, 0.2}}},
                     folder);
}

/// The same shape with boxes that overlap, each of them closed.
std::string closedAngleFile(const TemporaryFolder& folder) {
  return fileOfBoxes("closed.obj",
                     {{{0, 0, 0}, {0.2, 1, 0.2}}, {{0.1, 0.01, 0.01}, {1, 0.19, 0.19}}}, folder);
}

json answerOf(const std::vector<std::string>& options, const TemporaryFolder& folder) {
  const std::string mesh = angleFile(folder);
  std::vector<std::string> arguments{"check",         mesh,      mesh,          "--pose-b",
                                     "0.3,0.45,0.05", "--sigma", "0.1,0.1,0.1", "--json"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const CommandResult result = runCommand(arguments, folder);
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  return json::parse(result.out);
}

}  // namespace

TEST_CASE("decompose writes one object a part", "[cli]") {
  const TemporaryFolder folder;
  const std::string output = folder.path("parts.obj");
  const CommandResult result =
      runCommand({"decompose", angleFile(folder), "--output", output}, folder);
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  CHECK(result.out.find(" convex parts") != std::string::npos);
  const std::string text = readWhole(output);
  CHECK(text.find("o part_1\n") != std::string::npos);
  CHECK(text.find("o part_2\n") != std::string::npos);
  // The importer rounds the corners to single precision, so that two parts are not quite enough.
  CHECK(loadMesh(output).triangles.size() >= 24);

  const CommandResult one = runCommand(
      {"decompose", angleFile(folder), "--parts", "1", "--output", folder.path("one.obj")}, folder);
  CHECK(one.out.find("in 1 convex part") != std::string::npos);
  CHECK(runCommand({"decompose", angleFile(folder)}, folder).refused());
  CHECK(runCommand({"decompose", angleFile(folder), "--parts", "0", "--output", output}, folder)
            .refused());
}

TEST_CASE("bounds with parts are above the certified lower bound", "[cli][slow]") {
  const TemporaryFolder folder;
  const double lower =
      answerOf({"--method", "interval", "--contact", "fcl"}, folder).at("lower").get<double>();
  REQUIRE(lower > 0.01);
  for (const std::string volume : {"sphere", "aabb", "obb", "rss", "obbrss", "kios", "kdop16",
                                   "kdop18", "kdop24", "kdop26", "convex"}) {
    const json sum =
        answerOf({"--method", "general-pcd", "--leaves", "parts", "--bv", volume}, folder);
    CHECK(sum.at("upper").get<double>() >= lower);
    CHECK(sum.at("statistics").at("leaf_pairs").get<int>() > 0);
  }
  const json bounds = answerOf({"--method", "parts-bounds"}, folder);
  CHECK(bounds.at("method") == "parts-bounds");
  CHECK(bounds.at("lower").is_null());
  CHECK(bounds.at("upper").get<double>() >= lower);
  const json hulls =
      answerOf({"--method", "general-pcd", "--leaves", "parts", "--bv", "convex"}, folder);
  CHECK(bounds.at("upper").get<double>() <= hulls.at("statistics").at("raw_sum").get<double>());
  CHECK(answerOf({"--method", "parts-bounds", "--threshold", "0.999"}, folder).at("decision") ==
        "below");
}

TEST_CASE("parts are refused where they prove nothing", "[cli][slow]") {
  const TemporaryFolder folder;
  const std::string mesh = angleFile(folder);
  const std::vector<std::string> scene{"check",     mesh,      mesh,         "--pose-b",
                                       "0.5,0.5,0", "--sigma", "0.1,0.1,0.1"};
  const auto refused = [&](std::vector<std::string> options) {
    options.insert(options.begin(), scene.begin(), scene.end());
    return runCommand(options, folder).refused();
  };
  CHECK(refused({"--method", "interval", "--leaves", "parts"}));
  CHECK(refused({"--method", "general-pcd", "--leaves", "vertices"}));
}

TEST_CASE("parts bound solids where they are proven to cover them", "[cli][slow]") {
  const TemporaryFolder folder;
  const std::string closed = closedAngleFile(folder);
  const auto answer = [&](const std::string& mesh, const std::vector<std::string>& method) {
    std::vector<std::string> words{"check",         mesh,      closed,        "--pose-b",
                                   "0.3,0.45,0.05", "--sigma", "0.1,0.1,0.1", "--contact",
                                   "solid",         "--json"};
    words.insert(words.end(), method.begin(), method.end());
    return runCommand(words, folder);
  };
  const double lower = json::parse(answer(closed, {"--method", "interval"}).out).at("lower");
  REQUIRE(lower > 0.01);
  const std::vector<std::string> sums{"--method", "general-pcd", "--leaves", "parts"};
  for (const auto& method : {std::vector<std::string>{"--method", "parts-bounds"}, sums}) {
    CHECK(json::parse(answer(closed, method).out).at("upper").get<double>() >= lower);
    CHECK(answer(angleFile(folder), method).refused());
  }
}
