// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// fcl_prob plan, from outside, and its paths read again by fcl_prob path.
#ifdef FCL_PROB_HAS_PLANNING
#include <nlohmann/json.hpp>

#include "catch.h"
#include "command.h"

using namespace fcl_prob_test;
using nlohmann::json;

namespace {

std::vector<std::string> planOptions(const std::vector<std::string>& more,
                                     const std::string& max_states = "700") {
  std::vector<std::string> options{"plan",           "--scene", dataFile("arm_plan.json"),
                                   "--largest-step", "0.1",     "--max-states",
                                   max_states};
  options.insert(options.end(), more.begin(), more.end());
  return options;
}

json motionOf(const std::string& file, const TemporaryFolder& folder) {
  const CommandResult result =
      runCommand({"path", "--scene", dataFile("arm_plan.json"), "--motion", file, "--largest-step",
                  "0.1", "--threshold", "0.9999", "--method", "interval", "--json"},
                 folder);
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  return json::parse(result.out);
}

}  // namespace

TEST_CASE("plan writes paths that path reads as the same motion", "[cli]") {
  const TemporaryFolder folder;
  const CommandResult result = runCommand(
      planOptions({"--json", "--output", "plan.json", "--csv", "plan.csv", "--reproduce", "fault"}),
      folder);
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  CHECK(result.out.empty());
  const json plan = json::parse(readWhole(folder.path("plan.json")));
  CHECK(plan.at("status") == "solved");
  CHECK(plan.at("largest").at("upper").get<double>() <= 0.05);
  CHECK(plan.at("waypoints").size() >= 2);
  CHECK(plan.at("waypoints")[0].at("turn") == 0.9);
  const CommandResult again = runCommand({"plan", "--scene", "fault/scene.json", "--json"}, folder);
  REQUIRE(again.exit_code == 0);
  CHECK(json::parse(again.out).at("waypoints") == plan.at("waypoints"));
  const json from_json = motionOf("plan.json", folder), from_csv = motionOf("plan.csv", folder);
  CHECK(from_json.at("waypoints").get<std::size_t>() > plan.at("waypoints").size());
  CHECK(from_json.at("self_collisions").empty());
  for (const char* key : {"waypoints", "lower", "upper"}) {
    CHECK(from_json.at(key) == from_csv.at(key));
  }
  const json& motion = plan.at("motion");
  CHECK(from_json.at("lower").get<double>() <= motion.at("upper").get<double>());
  CHECK(from_json.at("upper").get<double>() >= motion.at("lower").get<double>());
}

TEST_CASE("plan says why there is no path", "[cli]") {
  const TemporaryFolder folder;
  const CommandResult limit = runCommand(planOptions({"--json"}, "3"), folder);
  CHECK(limit.exit_code == 3);
  CHECK(json::parse(limit.out).at("status") == "state-limit");
  CHECK(json::parse(limit.out).at("waypoints").empty());
  const CommandResult start = runCommand(planOptions({"--threshold", "1e-30"}), folder);
  CHECK(start.exit_code == 3);
  CHECK(start.out.find("start-refused") != std::string::npos);
}

TEST_CASE("plan moves the joints of a group of the SRDF and no others", "[cli]") {
  const TemporaryFolder folder;
  folder.write("arm.srdf",
               "<robot name=\"arm\"><group name=\"turret\"><joint name=\"turn\"/></group>"
               "<group name=\"both\"><joint name=\"turn\"/><joint name=\"elbow\"/></group>"
               "<group_state name=\"aside\" group=\"both\"><joint name=\"turn\" value=\"-1\"/>"
               "<joint name=\"elbow\" value=\"0.5\"/></group_state></robot>");
  json scene{{"robot", {{"urdf", dataFile("arm.urdf")}, {"srdf", "arm.srdf"}}}};
  scene["obstacles"] = {{{"name", "far"},
                         {"sphere", 0.1},
                         {"pose", {9, 0, 0}},
                         {"displacement", {{"sigma", {1e-2, 1e-2, 1e-2}}}}}};
  scene["plan"] = {{"start", {{"turn", -1.0}, {"elbow", 0.5}}},
                   {"goal", {{"turn", 1.0}, {"elbow", 0.5}}},
                   {"group", "turret"}};
  scene["request"] = {{"threshold", 0.05}};
  folder.write("scene.json", scene.dump());
  const CommandResult result = runCommand({"plan", "--scene", "scene.json", "--json"}, folder);
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  for (const json& waypoint : json::parse(result.out).at("waypoints")) {
    CHECK(waypoint.at("elbow") == 0.5);
  }
  // From a state that the SRDF names.
  scene["plan"]["start"] = "aside";
  scene["plan"]["group"] = "both";
  folder.write("scene.json", scene.dump());
  const CommandResult named = runCommand({"plan", "--scene", "scene.json", "--json"}, folder);
  CAPTURE(named.err);
  REQUIRE(named.exit_code == 0);
  CHECK(json::parse(named.out).at("waypoints")[0].at("turn") == -1.0);
  scene["plan"]["start"] = "nowhere";
  folder.write("scene.json", scene.dump());
  const CommandResult nowhere = runCommand({"plan", "--scene", "scene.json"}, folder);
  CHECK((nowhere.refused() &&
         nowhere.err.find("group both has no state nowhere") != std::string::npos));
  scene["plan"].erase("group");
  folder.write("scene.json", scene.dump());
  CHECK(runCommand({"plan", "--scene", "scene.json"}, folder).refused());
  scene["plan"]["start"] = {{"turn", -1.0}, {"elbow", 0.5}};
  scene["plan"]["group"] = "wrist";
  folder.write("scene.json", scene.dump());
  CHECK(runCommand({"plan", "--scene", "scene.json"}, folder).refused());
  // Nor does a joint beside the group get to where it should be.
  scene["plan"]["group"] = "turret";
  scene["plan"]["goal"]["elbow"] = 0.6;
  folder.write("scene.json", scene.dump());
  CHECK(runCommand({"plan", "--scene", "scene.json"}, folder).refused());
}

TEST_CASE("plan says in one line what is wrong with a scene or a motion", "[cli]") {
  const TemporaryFolder folder;
  CHECK(runCommand({"plan"}, folder).refused());
  CHECK(runCommand({"plan", "--scene", dataFile("arm_path.json")}, folder).refused());
  CHECK(runCommand(planOptions({"--motion-threshold", "2"}), folder).refused());
  const auto isRefused = [&](const std::string& name, const std::string& text) {
    folder.write(name, text);
    return runCommand({"path", "--scene", dataFile("arm_plan.json"), "--motion", name}, folder)
        .refused();
  };
  CHECK(runCommand({"path", "--scene", dataFile("arm_plan.json")}, folder).refused());
  CHECK(isRefused("m.csv", ""));
  CHECK(isRefused("m.csv", "turn,elbow\n"));
  CHECK(isRefused("m.csv", "turn,elbow\n1\n"));
  CHECK(isRefused("m.csv", "turn,elbow\n1,nan\n"));
  CHECK(isRefused("m.csv", "turn,turn\n1,2\n"));
  CHECK(isRefused("m.csv", "turn,knee\n1,2\n"));
  CHECK(isRefused("m.json", "{\"waypoints\": []}"));
  CHECK(isRefused("m.json", "{\"ways\": []}"));
}
#endif
