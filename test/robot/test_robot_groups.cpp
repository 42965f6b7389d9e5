// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Groups of an SRDF and their states, against what people read in the file.
#include "fcl_prob/robot_groups.h"

#include "arm_cases.h"
#include "catch.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/robot_scene.h"
#include "models.h"
#include "temporary_folder.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

using Texts = std::vector<std::string>;

std::string ofArm(const std::string& inside) {
  return "<robot name=\"arm\">" + inside + "</robot>";
}

RobotGroups groupsOf(const std::string& inside) {
  const TemporaryFolder folder;
  return loadGroups(folder.write("arm.srdf", ofArm(inside)), shippedArm());
}

RobotGroup groupOf(const std::string& inside) {
  return groupsOf("<group name=\"g\">" + inside + "</group>").at("g");
}

void refusedGroups(const std::string& inside, const std::string& told) {
  const TemporaryFolder folder;
  const std::string path = folder.write("arm.srdf", ofArm(inside));
  try {
    loadGroups(path, shippedArm());
  } catch (const FileError& error) {
    CAPTURE(error.what(), told);
    CHECK(std::string(error.what()).find(path + ": line ") == 0);
    CHECK(std::string(error.what()).find(told) != std::string::npos);
    return;
  }
  FAIL("accepted: " + inside);
}

}  // namespace

TEST_CASE("groups of the Fetch robot") {
  const auto urdf = modelOrSkip("fetch_robot/fetch_description/robots/fetch.urdf");
  const auto srdf = modelOrSkip("fetch_robot/fetch.srdf");
  if (!urdf || !srdf) return;
  RobotOptions options;
  options.packages["fetch_description"] = *modelsFolder() + "/fetch_robot/fetch_description";
  const RobotGroups groups = loadGroups(*srdf, Robot(*urdf, options));
  CHECK(groups.size() == 3);
  // Joints are in the order of their names.
  const Texts arm{"elbow_flex_joint",   "forearm_roll_joint",  "shoulder_lift_joint",
                  "shoulder_pan_joint", "upperarm_roll_joint", "wrist_flex_joint",
                  "wrist_roll_joint"};
  CHECK(groups.at("arm").joints == arm);
  CHECK(groups.at("arm").links.size() == 7);
  CHECK(groups.at("arm").states.empty());
  CHECK(groups.at("arm_with_torso").joints.size() == 8);
  CHECK(groups.at("gripper").joints == Texts{"l_gripper_finger_joint", "r_gripper_finger_joint"});
  CHECK(groups.at("gripper").links.size() == 3);
}

TEST_CASE("a group has its joints, those of its links, chains and groups") {
  CHECK(groupOf("<joint name=\"roll\"/><joint name=\"bend\"/>").joints == Texts{"bend", "roll"});
  CHECK(groupOf("<joint name=\"roll\"/><joint name=\"bend\"/>").links == Texts{"wrist", "hand"});
  CHECK(groupOf("<link name=\"wrist\"/><link name=\"base\"/>").joints == Texts{"roll"});
  CHECK(groupOf("<link name=\"wrist\"/><link name=\"base\"/>").links == Texts{"base", "wrist"});
  const RobotGroup chain = groupOf("<chain base_link=\"turret\" tip_link=\"tool\"/>");
  CHECK(chain.joints == Texts{"bend", "elbow", "roll", "shoulder"});
  CHECK(chain.links == Texts{"upper_arm", "forearm", "wrist", "hand", "tool"});
  // Between the fingers, through the hand that carries both; one of them mimics the other.
  const RobotGroup fingers =
      groupOf("<chain base_link=\"left_finger\" tip_link=\"right_finger\"/>");
  CHECK(fingers.joints == Texts{"grip"});
  CHECK(fingers.links == Texts{"left_finger", "right_finger"});
  CHECK(groupOf("<joint name=\"grip_right\"/><joint name=\"tip\"/>").joints.empty());
  CHECK(groupOf("<chain base_link=\"hand\" tip_link=\"hand\"/>").links.empty());
  CHECK(groupOf("").links.empty());
  const RobotGroups nested = groupsOf(
      "<group name=\"all\"><group name=\"x\"/><group name=\"y\"/><joint name=\"turn\"/></group>"
      "<group name=\"x\"><joint name=\"roll\"/></group>"
      "<group name=\"y\"><group name=\"x\"/><joint name=\"bend\"/></group>"
      "<end_effector name=\"e\" parent_link=\"hand\" group=\"x\"/><passive_joint name=\"p\"/>"
      "<disable_collisions link1=\"hand\" link2=\"wrist\" reason=\"Never\"/>");
  CHECK(nested.size() == 3);
  CHECK(nested.at("all").joints == Texts{"bend", "roll", "turn"});
  CHECK(nested.at("y").joints == Texts{"bend", "roll"});
}

TEST_CASE("a state of a group has values of joints that move by themselves") {
  const RobotGroups groups = groupsOf(
      "<virtual_joint name=\"floor\" type=\"planar\" parent_frame=\"map\" child_link=\"base\"/>"
      "<group name=\"all\"><chain base_link=\"base\" tip_link=\"tool\"/><joint name=\"floor\"/>"
      "<link name=\"left_finger\"/><link name=\"right_finger\"/></group>"
      "<group name=\"hand\"><joint name=\"grip\"/></group>"
      "<group_state name=\"home\" group=\"all\"><joint name=\"elbow\" value=\" -0.5 \"/>"
      "<joint name=\"floor\" value=\"0 0 0\"/><joint name=\"grip_right\" value=\"-0.01\"/>"
      "<joint name=\"tip\" value=\"0\"/><joint name=\"turn\" value=\"1e1\"/></group_state>"
      "<group_state name=\"home\" group=\"hand\"><joint name=\"grip\" "
      "value=\"0.01\"/></group_state>"
      "<group_state name=\"shut\" group=\"hand\"/>");
  CHECK(groups.at("all").joints.size() == 6);
  using Values = std::map<std::string, double>;
  CHECK(groups.at("all").states.size() == 1);
  CHECK(groups.at("all").states.at("home") == Values{{"elbow", -0.5}, {"turn", 10.0}});
  CHECK(groups.at("hand").states.at("home") == Values{{"grip", 0.01}});
  CHECK(groups.at("hand").states.at("shut").empty());
  const Robot arm = shippedArm();
  const Eigen::VectorXd values = arm.values(groups.at("all").states.at("home"));
  CHECK(values == arm.values({{"elbow", -0.5}, {"turn", 10.0}}));
}

TEST_CASE("groups that are none are refused with file, line and element") {
  const auto group = [](const std::string& inside) {
    return "\n<group name=\"g\">\n" + inside + "</group>";
  };
  refusedGroups("<group/>", "line 1: group: has no name");
  refusedGroups(group("") + group(""), "line 4: group: there is another one named g");
  refusedGroups(group("<joint name=\"knee\"/>"), "line 3: group g: joint: arm has no joint knee");
  refusedGroups(group("<joint/>"), "line 3: group g: joint: has no name");
  refusedGroups(group("<link name=\"knee\"/>"), "line 3: group g: link: arm has no link knee");
  refusedGroups(group("<chain base_link=\"base\"/>"), "line 3: group g: chain: has no tip_link");
  refusedGroups(group("<chain base_link=\"base\" tip_link=\"x\"/>"),
                "group g: chain: arm has no link x");
  refusedGroups(group("<chain base_link=\"base\" tip_link=\"hand\" via=\"x\"/>"),
                "the attribute via");
  refusedGroups(group("<group name=\"h\"/>"), "line 3: group g: group: no group h");
  refusedGroups(group("<group name=\"g\"/>"), "nested too deeply, or within itself");
  refusedGroups(group("<jiont name=\"elbow\"/>"), "line 3: group: the element jiont is not known");
  refusedGroups("<xacro:arm/>", "line 1: the element xacro:arm");
  refusedGroups(group("<xacro:arm/>"), "xacro has not been run");
  std::string nested;
  for (int i = 0; i < 100; ++i) {
    nested += "<group name=\"g" + std::to_string(1000 + i) + "\"><group name=\"g" +
              std::to_string(1001 + i) + "\"/></group>";
  }
  refusedGroups(nested + "<group name=\"g1100\"/>", "nested too deeply");
  const auto state = [](const std::string& inside) {
    return "<group name=\"g\"><joint name=\"elbow\"/><joint name=\"grip\"/></group>\n"
           "<group_state name=\"s\" group=\"g\">\n" +
           inside + "</group_state>";
  };
  refusedGroups("<group_state name=\"s\"/>", "line 1: group_state: has no group");
  refusedGroups("<group_state name=\"s\" group=\"g\"/>", "group_state: s is of no group: g");
  refusedGroups(state("") + "<group_state name=\"s\" group=\"g\"/>",
                "line 3: group_state: there is anoth");
  refusedGroups(state("<joint name=\"knee\" value=\"0\"/>"),
                "line 3: group_state s: joint: arm has no");
  refusedGroups(state("<joint name=\"roll\" value=\"0\"/>"), "joint: no joint of group g: roll");
  refusedGroups(state("<joint name=\"elbow\"/>"), "joint: has no value");
  for (const std::string bad : {"", "x", "nan", "1e999", "1 2", "${pi}"}) {
    refusedGroups(state("<joint name=\"elbow\" value=\"" + bad + "\"/>"),
                  "line 3: group_state s: joint: ");
  }
  refusedGroups(state("<joint name=\"elbow\" value=\"1\"/><joint name=\"elbow\" value=\"1\"/>"),
                "twice");
  refusedGroups(state("<link name=\"hand\"/>"), "the element link is not known");
}

TEST_CASE("a group that is part of many is looked at once") {
  std::string text = "<group name=\"g0\"><joint name=\"elbow\"/></group>";
  for (int i = 1; i < 60; ++i) {
    const std::string before = "<group name=\"g" + std::to_string(i - 1) + "\"/>";
    text += "<group name=\"g" + std::to_string(i) + "\">" + before + before + "</group>";
  }
  CHECK(groupsOf(text).at("g59").joints == Texts{"elbow"});
}

TEST_CASE("a plan of a scene moves the joints of a group") {
  const TemporaryFolder folder;
  folder.write("arm.urdf", [] {
    std::ifstream file(shippedFile("arm.urdf"));
    return std::string(std::istreambuf_iterator<char>(file), {});
  }());
  folder.write("arm.srdf",
               ofArm("<group name=\"wrist\"><joint name=\"roll\"/><joint name=\"bend\"/>"
                     "</group><group name=\"none\"><joint name=\"tip\"/></group>"));
  const auto scene = [&](const std::string& srdf, const std::string& which) {
    return loadRobotScene(folder.write(
        "scene.json", R"({"robot": {"urdf": "arm.urdf")" + srdf +
                          R"(}, "obstacles": [{"name": "ball", "sphere": 0.1, "displacement":
                          {"sigma": [0.1, 0.1, 0.1]}}], "plan": {"start": {}, "goal": {})" +
                          which + "}}"));
  };
  const std::string srdf = R"(, "srdf": "arm.srdf")";
  const auto moved = [&](const RobotScene& of) { return plannedJoints(of, loadRobot(of)); };
  CHECK(moved(scene(srdf, R"(, "group": "wrist")")) == Texts{"bend", "roll"});
  CHECK(moved(scene(srdf, R"(, "joints": ["turn"])")) == Texts{"turn"});
  CHECK(moved(scene("", "")).empty());
  CHECK_THROWS_AS(moved(scene(srdf, R"(, "group": "hand")")), InvalidRequest);
  CHECK_THROWS_AS(moved(scene(srdf, R"(, "group": "none")")), InvalidRequest);
  CHECK_THROWS_AS(scene("", R"(, "group": "wrist")"), FileError);
  CHECK_THROWS_AS(scene(srdf, R"(, "group": "wrist", "joints": ["turn"])"), FileError);
}
