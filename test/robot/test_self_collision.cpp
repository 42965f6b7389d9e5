// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A robot against itself, compared with fcl::collide of every pair; SRDFs that are none.
#include "fcl_prob/self_collision.h"

#include <fcl/narrowphase/collision.h>

#include <functional>
#include <set>

#include "arm_cases.h"
#include "catch.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/robot_scene.h"
#include "models.h"
#include "temporary_folder.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

using Names = std::pair<std::string, std::string>;
using NamedPairs = std::multiset<Names>;

Names namesOf(const RobotBody& x, const RobotBody& y) { return std::minmax(x.link, y.link); }

/// Of the bodies whose links `are_looked_at`, by FCL, one pair after the other.
NamedPairs touchingByFcl(const Robot& robot, const Eigen::VectorXd& values,
                         const std::function<bool(const Names&)>& are_looked_at) {
  NamedPairs touching;
  const auto poses = robot.poses(values);
  const auto& bodies = robot.bodies();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Names names = namesOf(bodies[i], bodies[j]);
      fcl::CollisionResultd result;
      if (are_looked_at(names) &&
          fcl::collide(bodies[j].geometry.get(), poses[j], bodies[i].geometry.get(), poses[i],
                       fcl::CollisionRequestd(), result) > 0) {
        touching.insert(names);
      }
    }
  }
  return touching;
}

NamedPairs named(const Robot& robot, const std::vector<BodyPair>& pairs) {
  NamedPairs result;
  for (const BodyPair& pair : pairs) {
    result.insert(namesOf(robot.bodies()[pair.first], robot.bodies()[pair.second]));
  }
  return result;
}

/// The arm's pairs of links without a joint between them. (No two of its links with bodies are
/// fixed to each other.)
bool armLooksAt(const Names& names) {
  static const std::set<Names> joined{
      {"base", "turret"}, {"turret", "upper_arm"}, {"forearm", "upper_arm"}, {"forearm", "wrist"},
      {"hand", "wrist"},  {"hand", "left_finger"}, {"hand", "right_finger"}};
  return names.first != names.second && joined.count(names) == 0;
}

void checkAgainstFcl(const SelfCollision& self, int states,
                     const std::function<bool(const Names&)>& are_looked_at) {
  std::mt19937_64 random(21);
  int colliding = 0;
  for (int i = 0; i < states; ++i) {
    const Eigen::VectorXd values = randomValues(self.robot(), random);
    const NamedPairs truth = touchingByFcl(self.robot(), values, are_looked_at);
    CHECK(named(self.robot(), self.collisions(values)) == truth);
    CHECK(self.collides(values) == !truth.empty());
    colliding += !truth.empty();
  }
  CHECK(colliding > states / 100);
  CHECK(colliding < states);
}

}  // namespace

TEST_CASE("the arm touches itself where fcl::collide says so of any pair") {
  const Robot arm = shippedArm();
  const auto allowed = loadAllowedPairs(shippedFile("arm.srdf"), arm);
  REQUIRE(allowed.size() == 1);
  const SelfCollision self(arm, allowed);
  CHECK(self.pairs().size() == SelfCollision(arm).pairs().size() - 1);
  checkAgainstFcl(self, 2'000, [](const Names& names) {
    return armLooksAt(names) && names != Names("left_finger", "right_finger");
  });
}

TEST_CASE("closed fingers touch unless they may") {
  const Robot arm = shippedArm();
  const Eigen::VectorXd closed = arm.values({}), open = arm.values({{"grip", 0.01}});
  const SelfCollision self(arm);
  CHECK(named(arm, self.collisions(closed)) == NamedPairs{{"left_finger", "right_finger"}});
  CHECK_FALSE(self.collides(open));
  CHECK_FALSE(SelfCollision(arm, {{"right_finger", "left_finger"}}).collides(closed));
  CHECK_THROWS_AS(SelfCollision(arm, {{"right_finger", "thumb"}}), InvalidRequest);
  CHECK_THROWS_AS(self.collides(Eigen::VectorXd::Zero(5)), InvalidRequest);
}

TEST_CASE("links of the Fetch robot touch where fcl::collide says so of any pair") {
  const auto urdf = modelOrSkip("fetch_robot/fetch_description/robots/fetch.urdf");
  const auto srdf = modelOrSkip("fetch_robot/fetch.srdf");
  if (!urdf || !srdf) return;
  RobotOptions options;
  options.packages["fetch_description"] = *modelsFolder() + "/fetch_robot/fetch_description";
  const Robot robot(*urdf, options);
  const auto allowed = loadAllowedPairs(*srdf, robot);
  CHECK(allowed.size() > 100);
  const SelfCollision self(robot, allowed);
  std::set<Names> looked_at;
  for (const Names& names : named(robot, self.pairs())) looked_at.insert(names);
  for (const LinkPair& pair : allowed) {
    CHECK(looked_at.count(std::minmax(pair.first, pair.second)) == 0);
  }
  CHECK(looked_at.count({"base_link", "gripper_link"}) == 1);
  checkAgainstFcl(self, 100, [&](const Names& names) { return looked_at.count(names) > 0; });
}

TEST_CASE("links that are fixed to each other do not touch, whatever is between them") {
  const TemporaryFolder folder;
  const std::string ball = "<collision><geometry><sphere radius=\"0.1\"/></geometry></collision>";
  const auto fixed = [](const std::string& parent, const std::string& child) {
    return "<joint name=\"to_" + child + "\" type=\"fixed\"><parent link=\"" + parent +
           "\"/><child link=\"" + child + "\"/></joint>";
  };
  const Robot robot(folder.write("r.urdf", "<robot name=\"r\"><link name=\"a\">" + ball +
                                               "</link><link name=\"b\"/>" + "<link name=\"c\">" +
                                               ball + "</link>" + fixed("a", "b") +
                                               fixed("b", "c") + "</robot>"));
  CHECK(SelfCollision(robot).pairs().empty());
}

TEST_CASE("an SRDF may allow all pairs of a link but some") {
  const TemporaryFolder folder;
  const Robot arm = shippedArm();
  const std::string path = folder.write(
      "r.srdf",
      "<robot name=\"arm\"><!-- <disable_collisions/> --><group name=\"g\"><link name=\"?\"/>"
      "</group><disable_default_collisions link=\"base\"/>"
      "<enable_collisions link1=\"hand\" link2=\"base\"/>"
      "<disable_collisions link1=\"wrist\" link2=\"turret\"/></robot>");
  std::set<Names> allowed;
  for (const LinkPair& pair : loadAllowedPairs(path, arm)) {
    allowed.insert(std::minmax(pair.first, pair.second));
  }
  CHECK(allowed.size() == arm.links().size() - 2 + 1);
  CHECK(allowed.count({"base", "wrist"}) == 1);
  CHECK(allowed.count({"base", "hand"}) == 0);
  CHECK(allowed.count({"turret", "wrist"}) == 1);
}

TEST_CASE("what is no SRDF is refused with file and element") {
  const TemporaryFolder folder;
  const Robot arm = shippedArm();
  const auto refused = [&](const std::string& text, const std::string& told) {
    const std::string path = folder.write("bad.srdf", text);
    CAPTURE(text);
    try {
      loadAllowedPairs(path, arm);
    } catch (const FileError& error) {
      CAPTURE(error.what(), told);
      CHECK(std::string(error.what()).find(path) == 0);
      CHECK(std::string(error.what()).find(told) != std::string::npos);
      return;
    }
    FAIL("accepted");
  };
  const auto inside = [](const std::string& element) {
    return "<robot name=\"arm\">" + element + "</robot>";
  };
  CHECK_THROWS_AS(loadAllowedPairs(folder.path("none.srdf"), arm), FileError);
  refused("", "no SRDF");
  refused("nothing of the kind", "no SRDF");
  refused("<robot name=\"arm\">", "no SRDF");
  refused("<gripper name=\"arm\"/>", "its element is gripper, not robot");
  refused(inside("") + inside(""), "Extra content at the end");
  refused("<robot name=\"leg\"/>", "its name is leg, not arm");
  refused("<!DOCTYPE r [<!ENTITY e \"e\">]>" + inside(""), "document type");
  refused(inside("<disable_collisions link1=\"hand\"/>"), "disable_collisions: has no link2");
  refused(inside("<disable_collisions link1=\"hand\" link2=\"foot\"/>"), "has no link foot");
  refused(inside("<enable_collisions link1=\"paw\" link2=\"hand\"/>"), "has no link paw");
  refused(inside("<disable_default_collisions link=\"foot\"/>"), "has no link foot");
  refused(inside("\n<xacro:arm/>"), "line 2: the element xacro:arm");
  std::string deep;
  for (int i = 0; i < 100'000; ++i) deep += "<a>";
  refused(deep, "no SRDF: Excessive depth");
}

TEST_CASE("scenes of robots name an SRDF") {
  const RobotScene scene = loadRobotScene(shippedFile("arm_path.json"));
  const Robot robot = loadRobot(scene);
  CHECK_FALSE(loadSelfCollision(scene, robot).collides(robot.values({})));
  RobotScene without = scene;
  without.srdf.clear();
  CHECK(loadSelfCollision(without, robot).collides(robot.values({})));
}
