// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// An object that the arm holds: where it is, what it touches, and what it adds to P.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>

#include "arm_cases.h"
#include "catch.h"
#include "fcl_prob/collision_probability.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/robot_scene.h"
#include "robot/robot_among_obstacles.h"
#include "temporary_folder.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

/// Held in front of the hand, across it.
AttachedObject rod(std::vector<std::string> touch_links = {"left_finger", "right_finger"}) {
  fcl::Transform3d in_link = fcl::Transform3d::Identity();
  in_link.translation() = Eigen::Vector3d(0.09, 0.0, 0.0);
  return {"rod", "hand", std::make_shared<fcl::Cylinderd>(0.01, 0.3), in_link,
          std::move(touch_links)};
}

bool touches(const SelfCollision& self, const Eigen::VectorXd& values, const std::string& first,
             const std::string& second) {
  const auto& bodies = self.robot().bodies();
  for (const BodyPair& pair : self.collisions(values)) {
    if (bodies[pair.first].name() == first && bodies[pair.second].name() == second) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("an attached object moves with its link") {
  const Robot arm = shippedArm();
  const Robot holding = arm.withAttached(rod());
  CHECK(arm.attached().empty());
  REQUIRE(holding.bodies().size() == arm.bodies().size() + 1);
  CHECK(holding.bodies().back().name() == "rod");
  CHECK(holding.bodies().back().link == "hand");
  CHECK(holding.joints().size() == arm.joints().size());
  std::mt19937_64 random(4);
  for (int i = 0; i < 20; ++i) {
    const Eigen::VectorXd values = randomValues(arm, random);
    const Eigen::Matrix4d expected = (arm.linkPose("hand", values) * rod().in_link).matrix();
    CHECK((holding.poses(values).back().matrix() - expected).norm() < 1e-15);
  }
}

TEST_CASE("an attached object is part of the robot for obstacles") {
  const Robot arm = shippedArm({"hand"});
  const Robot holding = arm.withAttached(rod());
  const Eigen::VectorXd values = arm.values({{"shoulder", 0.2}, {"elbow", 0.4}});
  const fcl::Transform3d at_rod = holding.poses(values).back();
  Obstacle ball{"ball", std::make_shared<fcl::Sphered>(0.02), fcl::Transform3d::Identity(),
                GaussianDisplacement::fromStandardDeviations({0.01, 0.01, 0.01})};
  // Beside the rod's end, far from the hand.
  ball.pose.translation() = at_rod * Eigen::Vector3d(0.035, 0.0, 0.14);
  ProbabilityRequest request;
  request.absolute_tolerance = 1e-7;
  const Bounds without = RobotQuery(arm, {ball}).state(values, request).any;
  const Bounds with = RobotQuery(holding, {ball}).state(values, request).any;
  ProbabilityResult alone;
  collisionProbability(rod().geometry.get(), at_rod, ball.geometry.get(), ball.pose,
                       std::get<GaussianDisplacement>(ball.displacement), request, alone);
  CHECK(without.upper < 1e-6);
  CHECK(with.lower > 0.1);
  CHECK(with.lower <= *alone.upper + without.upper);
  CHECK(with.upper >= *alone.lower);
}

TEST_CASE("an attached object leaves what was prepared of the robot as it was") {
  const Robot arm = shippedArm();
  const Obstacle ball{"ball", std::make_shared<fcl::Sphered>(0.02), fcl::Transform3d::Identity(),
                      GaussianDisplacement::fromStandardDeviations({0.01, 0.01, 0.01})};
  const RobotQuery without(arm, {ball}), with(arm.withAttached(rod()), {ball});
  const auto &before = without.among().prepared(), &after = with.among().prepared();
  REQUIRE(after.geometries.size() == before.geometries.size() + 1);
  for (std::size_t i = 0; i < before.geometries.size(); ++i) {
    CHECK(after.geometries[i] == before.geometries[i]);
    CHECK(&after.hulls.ballsOf(i) == &before.hulls.ballsOf(i));
    CHECK(&after.hulls.of(i) == &before.hulls.of(i));
  }
}

TEST_CASE("an attached object touches the robot unless it may") {
  const Robot arm = shippedArm();
  // Bent to where the rod goes through the forearm or wrist.
  const Eigen::VectorXd straight = arm.values({{"grip", 0.0}});
  const SelfCollision strict(arm.withAttached(rod({}))), self(arm.withAttached(rod()));
  CHECK(touches(strict, straight, "left_finger", "rod"));
  CHECK(touches(strict, straight, "right_finger", "rod"));
  CHECK_FALSE(touches(self, straight, "left_finger", "rod"));
  CHECK_FALSE(touches(self, straight, "right_finger", "rod"));
  // The wrist carries the hand, yet what the hand holds may not touch it.
  AttachedObject backwards = rod();
  backwards.in_link.translation() = Eigen::Vector3d(-0.05, 0.0, 0.0);
  CHECK(touches(SelfCollision(arm.withAttached(backwards)), straight, "wrist", "rod"));
  CHECK_FALSE(touches(SelfCollision(arm.withAttached(backwards)), straight, "hand", "rod"));
}

TEST_CASE("two attached objects may not touch each other unless one link carries both") {
  const Robot arm = shippedArm();
  AttachedObject box{"box", "forearm", std::make_shared<fcl::Boxd>(0.4, 0.2, 0.2)};
  box.in_link.translation() = Eigen::Vector3d(0.5, 0.0, 0.0);
  const Eigen::VectorXd values = arm.values({{"grip", 0.01}});
  CHECK(touches(SelfCollision(arm.withAttached(rod()).withAttached(box)), values, "rod", "box"));
  box.link = "hand";
  CHECK_FALSE(
      touches(SelfCollision(arm.withAttached(rod()).withAttached(box)), values, "rod", "box"));
}

TEST_CASE("what cannot be attached is refused") {
  const Robot arm = shippedArm();
  const auto refused = [&](auto change) {
    AttachedObject object = rod();
    change(object);
    CHECK_THROWS_AS(arm.withAttached(object), InvalidRequest);
  };
  refused([](AttachedObject& object) { object.link = "foot"; });
  refused([](AttachedObject& object) { object.touch_links = {"foot"}; });
  refused([](AttachedObject& object) { object.name = ""; });
  refused([](AttachedObject& object) { object.name = "hand"; });
  CHECK_THROWS_AS(arm.withAttached(rod()).withAttached(rod()), InvalidRequest);
  AttachedObject object = rod();
  object.geometry = nullptr;
  CHECK_THROWS_AS(arm.withAttached(object), InvalidGeometry);
  object = rod();
  object.in_link.linear() *= 2.0;
  CHECK_THROWS_AS(arm.withAttached(object), InvalidPose);
}

TEST_CASE("scenes of robots attach objects") {
  const TemporaryFolder folder;
  const auto sceneWith = [&](const std::string& attached) {
    return loadRobotScene(
        folder.write("scene.json", R"({"robot": {"urdf": ")" + shippedFile("arm.urdf") +
                                       R"(", "attached": [)" + attached +
                                       R"(]}, "joints": {}, "obstacles": [{"name": "o",)"
                                       R"( "sphere": 1, "displacement": {"sigma": [1, 1, 1]}}]})"));
  };
  const std::string can =
      R"({"name": "can", "link": "hand", "cylinder": {"radius": 0.03, "length": 0.12},)"
      R"( "pose": [0.09, 0, 0], "touch_links": ["left_finger", "right_finger"]})";
  const Robot robot = loadRobot(sceneWith(can));
  REQUIRE(robot.attached().size() == 1);
  CHECK(robot.attached()[0].in_link.translation().x() == 0.09);
  CHECK(robot.attached()[0].touch_links.size() == 2);
  CHECK(loadRobotQuery(sceneWith(can)).robot().bodies().size() == 11);
  CHECK_THROWS_AS(loadRobot(sceneWith(can + ", " + can)), InvalidRequest);
  CHECK_THROWS_AS(sceneWith(R"({"name": "can", "sphere": 1})"), FileError);
  CHECK_THROWS_AS(sceneWith(R"({"name": "can", "link": "hand", "sphere": 1, "touch": []})"),
                  FileError);
}
