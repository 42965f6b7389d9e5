// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// fcl_prob path, from outside.
#ifdef FCL_PROB_HAS_ROBOT
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "catch.h"
#include "command.h"

using namespace fcl_prob_test;
using nlohmann::json;

namespace {

json answerOf(std::vector<std::string> options) {
  const TemporaryFolder folder;
  options.insert(options.begin(), {"path", "--scene", dataFile("arm_path.json"), "--json"});
  const CommandResult result = runCommand(options, folder);
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  return json::parse(result.out);
}

}  // namespace

TEST_CASE("path answers the motion that the project ships", "[cli]") {
  const json decided = answerOf({});
  CHECK(decided.at("decision") == "below");
  CHECK(decided.at("waypoints").get<int>() > 10);
  const json persistent = answerOf({"--method", "interval", "--threshold", "0.9999", "--by-body"});
  CHECK(persistent.at("parts").size() == 2);
  CHECK(persistent.at("bodies").size() == 10);
  const json estimate = answerOf({"--method", "estimate", "--tolerance", "0.05"});
  CHECK(estimate.at("estimate").get<double>() > 1e-4);
  CHECK(estimate.at("standard_error").get<double>() > 0.0);
  CHECK(estimate.at("lower").get<double>() <= persistent.at("upper").get<double>());
  const json independent = answerOf({"--errors", "independent", "--tolerance", "0.5"});
  CHECK(independent.at("upper").get<double>() >= persistent.at("lower").get<double>());
  CHECK(independent.at("parts").size() == 2 * independent.at("waypoints").get<std::size_t>());
  CHECK(independent.at("by_waypoint").size() == independent.at("waypoints").get<std::size_t>());
  const json any = answerOf({"--errors", "any-dependence", "--tolerance", "0.5"});
  CHECK(any.at("upper") == any.at("any_dependence").at("upper"));
  CHECK(any.at("worst").at("lower").get<double>() <= any.at("upper").get<double>());
}

TEST_CASE("path refuses states that joints cannot reach, unless it is told to take them", "[cli]") {
  const TemporaryFolder folder;
  folder.write("motion.csv", "turn,elbow\n0,0.5\n0,45\n");
  for (const std::vector<std::string>& of :
       {std::vector<std::string>{}, {"--between"}, {"--threshold", "0.5", "--probable", "0.01"}}) {
    std::vector<std::string> options{"path",
                                     "--scene",
                                     dataFile("arm_path.json"),
                                     "--motion",
                                     folder.path("motion.csv"),
                                     "--json",
                                     "--tolerance",
                                     "0.5"};
    options.insert(options.end(), of.begin(), of.end());
    const CommandResult refused = runCommand(options, folder);
    CAPTURE(refused.err);
    CHECK(refused.refused());
    for (const char* told : {"waypoint 1", "joint elbow", "45 rad", "-2.4 to 2.4", "degrees"}) {
      CHECK(refused.err.find(told) != std::string::npos);
    }
    options.insert(options.end(), {"--allow-outside-limits", "--time-limit", "1"});
    const json answer = json::parse(runCommand(options, folder).out);
    CHECK(answer.at("links_without_body") == json{"tool"});
    CHECK(answer.at("plan").size() == 1);
  }
}

TEST_CASE("path tells what a mesh of the robot was read without", "[cli]") {
  const TemporaryFolder folder;
  folder.write("arm.obj", "6540 2180\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  folder.write("arm.urdf",
               "<robot name=\"r\"><link name=\"l\"><collision><geometry><mesh "
               "filename=\"arm.obj\"/></geometry></collision></link></robot>");
  folder.write("scene.json", R"({"robot": {"urdf": "arm.urdf"}, "joints": {}, "obstacles": [
    {"name": "o", "sphere": 0.1, "pose": [0.2, 0.2, 0.3],
     "displacement": {"sigma": [0.1, 0.1, 0.1]}}], "request": {"threshold": 0.9}})");
  for (const std::vector<std::string>& of :
       {std::vector<std::string>{}, {"--json"}, {"--probable", "0.01"}, {"--between"}}) {
    std::vector<std::string> options{"path", "--scene", folder.path("scene.json")};
    options.insert(options.end(), of.begin(), of.end());
    const CommandResult result = runCommand(options, folder);
    CAPTURE(of, result.out, result.err);
    CHECK(result.exit_code == 0);
    CHECK(result.out.find("arm.obj: ") != std::string::npos);
  }
}

TEST_CASE("path tells how P changes with the joints", "[cli]") {
  const json answered = answerOf({"--threshold", "0.9999", "--gradient"});
  const json& gradient = answered.at("gradient");
  CHECK(gradient.at("lines").get<int>() >= 4096);
  CHECK(gradient.at("status") == "sampled");
  const double p = gradient.at("probability").get<double>();
  const double doubt = 5.0 * gradient.at("standard_error").get<double>();
  CHECK(p + doubt >= answered.at("lower").get<double>());
  CHECK(p - doubt <= answered.at("upper").get<double>());
  for (const json& joint : gradient.at("joints")) {
    CHECK(joint.at("gradient").size() == answered.at("waypoints").get<std::size_t>());
    CHECK(joint.at("standard_error").size() == joint.at("gradient").size());
  }
  const TemporaryFolder folder;
  const CommandResult swept =
      runCommand({"path", "--scene", dataFile("arm_path.json"), "--between", "--gradient"}, folder);
  CHECK(swept.refused());
}

TEST_CASE("path answers for the time between waypoints", "[cli]") {
  const json some = answerOf({"--threshold", "0.9999"});
  CHECK(some.at("between").is_null());
  const json all = answerOf({"--threshold", "0.9999", "--between"});
  CHECK(all.at("upper").get<double>() >= some.at("lower").get<double>());
  CHECK(all.at("between").at("steps").get<int>() > 10);
  CHECK(all.at("between").at("widening").get<double>() > 0.0);
  const TemporaryFolder folder;
  const std::string scene = dataFile("arm_path.json");
  CHECK(runCommand({"path", "--scene", scene, "--between", "--errors", "independent"}, folder)
            .refused());
}

TEST_CASE("path decides probably where it is asked to", "[cli]") {
  const json probable = answerOf({"--probable", "1e-4"});
  const std::string decision = probable.at("decision");
  CHECK((decision == "probably-below" || decision == "certainly-below"));
  CHECK(probable.at("probable").at("upper").get<double>() < 0.05);
  CHECK(probable.at("certified").at("upper") >= probable.at("probable").at("upper"));
  const TemporaryFolder folder;
  const std::string scene = dataFile("arm_path.json");
  CHECK(runCommand({"path", "--scene", scene, "--probable", "2"}, folder).refused());
  CHECK(runCommand({"path", "--scene", scene, "--probable", "0.1", "--between"}, folder).refused());
}

TEST_CASE("path answers where joints and base have errors of their own", "[cli]") {
  const TemporaryFolder folder;
  folder.write("scene.json", R"({"robot": {"urdf": ")" + dataFile("arm.urdf") +
                                 R"("}, "joints": {"turn": 0.6, "elbow": 0.3, "grip": 0.02},)"
                                 R"( "joint_error": {"sigma": {"turn": 0.02}},)"
                                 R"( "base_error": {"sigma": [0.01, 0.01, 0, 0, 0, 0]},)"
                                 R"( "obstacles": [{"name": "ball", "sphere": 0.1,)"
                                 R"( "pose": [0.55, 0.25, 0.35],)"
                                 R"( "displacement": {"sigma": [0.03, 0.02, 0.04]}}]})");
  const std::vector<std::string> path{"path", "--scene", folder.path("scene.json")};
  const auto run = [&](const std::string& option) {
    std::vector<std::string> all = path;
    all.push_back(option);
    return runCommand(all, folder);
  };
  const json answer = json::parse(run("--json").out);
  const double estimate = answer.at("estimate");
  CHECK(answer.at("confidence_interval")[0].get<double>() < estimate);
  CHECK(answer.at("confidence_interval")[1].get<double>() > estimate);
  const json itself = answer.at("touches_itself");
  CHECK(itself.at("estimate") == 0.0);
  CHECK(itself.at("confidence_interval")[1].get<double>() < 0.01);
  const std::string text = runCommand(path, folder).out;
  CHECK(text.find("\nconfidence interval [") != std::string::npos);
  CHECK(text.find("\nP that it touches itself: 0, ") != std::string::npos);
  for (const char* option : {"--by-body", "--between"}) {
    const CommandResult refused = run(option);
    CHECK(refused.exit_code == 2);
    CHECK(refused.err.find("errors of joints") != std::string::npos);
  }
  // The same errors all along: more is touched on the way than at its likeliest state.
  folder.write("way.csv", "turn,elbow,grip\n0.5,0.3,0.02\n0.6,0.3,0.02\n0.7,0.3,0.02\n");
  const CommandResult way = runCommand(
      {"path", "--scene", folder.path("scene.json"), "--motion", folder.path("way.csv"), "--json"},
      folder);
  REQUIRE(way.exit_code == 0);
  CHECK(json::parse(way.out).at("estimate").get<double>() > estimate);
  // How errors go on in time is asked of several waypoints only.
  const CommandResult one = runCommand(
      {"path", "--scene", folder.path("scene.json"), "--errors", "independent", "--json"}, folder);
  REQUIRE(one.exit_code == 0);
  CHECK(json::parse(one.out).at("estimate").get<double>() == estimate);
  CHECK(runCommand({"path", "--scene", folder.path("scene.json"), "--motion",
                    folder.path("way.csv"), "--errors", "independent"},
                   folder)
            .refused());
  CHECK(json::parse(way.out).count("touches_itself") == 0);
}

TEST_CASE("path tells of a state that collides with itself", "[cli]") {
  CHECK(answerOf({}).at("self_collisions").empty());
  const TemporaryFolder folder;
  const std::string scene =
      R"({"robot": {"urdf": ")" + dataFile("arm.urdf") +
      R"("}, "waypoints": [{"grip": 0.01}, {"grip": 0}, {}], "obstacles": [{"name": "o",)"
      R"( "sphere": 0.1, "pose": [2, 0, 0], "displacement": {"sigma": [0.1, 0.1, 0.1]}}]})";
  folder.write("scene.json", scene);
  const CommandResult result = runCommand({"path", "--scene", "scene.json", "--json"}, folder);
  REQUIRE(result.exit_code == 0);
  const json touching = json::parse(result.out).at("self_collisions");
  REQUIRE(touching.size() == 1);
  CHECK(touching[0].at("bodies") == json{"left_finger", "right_finger"});
  CHECK(touching[0].at("first_waypoint") == 1);
  CHECK(touching[0].at("waypoints") == 2);
  const CommandResult text = runCommand({"path", "--scene", "scene.json"}, folder);
  CHECK(text.out.find("collides with itself: left_finger and right_finger at 2") !=
        std::string::npos);
}

TEST_CASE("a reproduction of a robot needs no other file, and has the same bits", "[cli]") {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path("given/part"));
  std::filesystem::copy_file(dataFile("mug.obj"), folder.path("given/part/mug.obj"));
  std::filesystem::copy_file(dataFile("gripper_finger.off"), folder.path("given/finger.off"));
  const std::string body = "<collision><geometry><mesh filename=";
  const std::string end = "/></geometry></collision></link>";
  const auto jointTo = [](const std::string& link) {
    return "<joint name='to_" + link + "' type='continuous'><parent link='base'/><child link='" +
           link + "'/><axis xyz='0 0 1'/></joint>";
  };
  folder.write("given/robot.urdf", "<robot name='r'><link name='base'/><link name='a'>" + body +
                                       "\"package://part/mug.obj\" scale='1 -1 1'" + end +
                                       "<link name='b'>" + body + "'finger.off'" + end +
                                       jointTo("a") + jointTo("b") + "</robot>");
  folder.write("given/robot.srdf",
               "<robot name='r'><disable_collisions link1='a' link2='b' reason='Never'/></robot>");
  folder.write("given/scene.json", R"({
    "robot": {"urdf": "robot.urdf", "srdf": "robot.srdf", "packages": {"part": "part"}},
    "obstacles": [
      {"name": "mug", "mesh": "part/mug.obj", "scale": 0.7, "pose": [0.11, 0, 0.02, 1, 0, 0, 0],
       "displacement": {"sigma": [0.01, 0.02, 0.01]}},
      {"name": "other", "robot": {"urdf": "robot.urdf", "packages": {"part": "part"}, "joints": {"to_a": 1}},
       "pose": [-0.12, 0, 0, 1, 0, 0, 0], "displacement": {"sigma": [0.01, 0.01, 0.02]}},
      {"name": "two", "bodies": [{"sphere": 0.02}, {"mesh": "finger.off", "normalize": true, "scale": 0.1}],
       "pose": [0, 0.15, 0.1, 1, 0, 0, 0], "displacement": {"sigma": [0.02, 0.01, 0.01]}}],
    "waypoints": [{"to_a": 0.1}, {"to_a": 0.3, "to_b": 0.2}]})");
  const auto ask = [&](const std::string& scene, const std::vector<std::string>& more) {
    std::vector<std::string> options{"path", "--scene", folder.path(scene), "--json"};
    options.insert(options.end(), more.begin(), more.end());
    const CommandResult result = runCommand(options, folder);
    CAPTURE(result.err);
    REQUIRE(result.exit_code == 0);
    return json::parse(result.out);
  };
  const std::string fault = folder.path("fault");
  const json first = ask("given/scene.json",
                         {"--errors", "independent", "--tolerance", "0.07", "--reproduce", fault});
  CHECK(
      runCommand({"path", "--scene", folder.path("given/scene.json"), "--reproduce", fault}, folder)
          .err.find("is there already") != std::string::npos);
  std::filesystem::remove_all(folder.path("given"));
  const json again = ask("fault/scene.json", {});
  CHECK(first.at("lower").get<double>() > 1e-3);
  for (const char* key : {"lower", "upper", "status", "parts", "by_waypoint", "self_collisions"}) {
    CHECK(first.at(key) == again.at(key));
  }
  std::ifstream stream(folder.path("fault/scene.json"));
  const std::string description = json::parse(stream)["description"];
  CHECK(description.find("\"lower\":" + first["lower"].dump()) != std::string::npos);
}

TEST_CASE("path says in one line what is wrong with a scene", "[cli]") {
  const TemporaryFolder folder;
  CHECK(runCommand({"path"}, folder).refused());
  CHECK(runCommand({"path", "--scene", "none.json"}, folder).refused());
  CHECK(runCommand({"path", "--scene", dataFile("two_boxes.json")}, folder).refused());
  folder.write("r.urdf", "no XML");
  folder.write("scene.json",
               R"({"robot": {"urdf": "r.urdf"}, "joints": {}, "obstacles": [{"name": "o",)"
               R"( "sphere": 1, "displacement": {"sigma": [1, 1, 1]}}]})");
  CHECK(runCommand({"path", "--scene", "scene.json"}, folder).refused());
}
#endif
