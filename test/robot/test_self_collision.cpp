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
#include "fcl_prob/normal_mass.h"
#include "fcl_prob/robot_errors.h"
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

namespace {

/// Two balls of radius 0.1 m on carriages of their own along one line.
Robot twoCarriages() {
  std::string urdf = "<robot name=\"carriages\"><link name=\"rail\"/>";
  for (const std::string name : {"left", "right"}) {
    urdf += "<link name=\"" + name +
            "\"><collision><geometry><sphere radius=\"0.1\"/></geometry></collision></link>"
            "<joint name=\"" +
            name + "\" type=\"prismatic\"><parent link=\"rail\"/><child link=\"" + name +
            "\"/><axis xyz=\"1 0 0\"/>"
            "<limit lower=\"-2\" upper=\"2\" velocity=\"1\" effort=\"1\"/></joint>";
  }
  return Robot::fromText(urdf + "</robot>");
}

}  // namespace

// Their distance is Gaussian: P has a closed form.
TEST_CASE("a robot with errors of its joints touches itself as often as it should") {
  const Robot robot = twoCarriages();
  const SelfCollision self(robot);
  REQUIRE(self.pairs().size() == 1);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  int outside = 0, wrong = 0, decided = 0;
  constexpr int kScenes = 60;
  for (int scene = 0; scene < kScenes; ++scene) {
    const Eigen::Vector2d deviations(0.02 + 0.1 * uniform(random), 0.02 + 0.1 * uniform(random));
    const double correlation = scene % 5 == 0 ? 1.0 : 1.8 * uniform(random) - 0.9;
    Eigen::Matrix2d covariance = deviations.cwiseAbs2().asDiagonal();
    covariance(0, 1) = covariance(1, 0) = correlation * deviations[0] * deviations[1];
    const double apart = 0.4 * uniform(random);
    const double spread = std::sqrt(std::max(0.0, covariance.trace() - 2.0 * covariance(0, 1)));
    const double truth = normalIntervalMass((-0.2 - apart) / spread, (0.2 - apart) / spread);
    const Eigen::VectorXd values = robot.values({{"left", 0.5}, {"right", 0.5 + apart}});
    ProbabilityRequest request;
    request.seed = 100 + static_cast<std::uint64_t>(scene);
    const ProbabilityResult counted = self.probability(values, covariance, request);
    CAPTURE(scene, truth, *counted.estimate, *counted.standard_error);
    CHECK(std::fabs(*counted.estimate - truth) < 5.0 * *counted.standard_error + 1e-12);
    outside += truth < counted.confidence_interval->lower - 1e-12 ||
               truth > counted.confidence_interval->upper + 1e-12;
    request.threads = 2;
    CHECK(self.probability(values, covariance, request).estimate == counted.estimate);
    request.threshold = truth < 0.5 ? 0.3 : 0.7;
    const ProbabilityResult against = self.probability(values, covariance, request);
    decided += against.decision != Decision::undecided;
    wrong += against.decision == (truth < *request.threshold ? Decision::above : Decision::below);
  }
  CHECK(outside <= 4);  // of 99 % intervals
  CHECK(wrong <= 3);
  CHECK(decided > kScenes / 2);
}

TEST_CASE("what cannot be counted of a robot against itself is refused") {
  const Robot robot = twoCarriages();
  const SelfCollision self(robot);
  const Eigen::VectorXd values = robot.values({});
  const Eigen::MatrixXd covariance = jointCovariance(robot, {{"left", 0.1}});
  ProbabilityRequest request;
  CHECK_THROWS_AS(self.probability(values, Eigen::Matrix3d::Identity(), request),
                  InvalidDistribution);
  CHECK_THROWS_AS(self.probability(values, -Eigen::Matrix2d::Identity(), request),
                  InvalidDistribution);
  CHECK_THROWS_AS(self.probability(Eigen::Vector2d(3.0, 0.0), covariance, request), InvalidRequest);
  request.method = ProbabilityMethod::interval;
  CHECK_THROWS_AS(self.probability(values, covariance, request), InvalidRequest);
  request = {};
  request.contact = ContactMeaning::solid;
  CHECK_THROWS_AS(self.probability(values, covariance, request), InvalidRequest);
}
