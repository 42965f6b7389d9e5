// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// An example against OMPL: a rigid body planned through a hole in a wall with P < 5 % everywhere.
#include <fcl/geometry/shape/box.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/goals/GoalState.h>
#include <ompl/base/spaces/SE3StateSpace.h>
#include <ompl/base/terminationconditions/IterationTerminationCondition.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include "catch.h"
#include "fcl_prob/group.h"
#include "geometry/displaced_collider.h"
#include "random_bodies.h"

namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using fcl_prob::Decision;
using Poses = std::vector<fcl::Transform3d>;

constexpr double kMostProbable = 0.05;

fcl::Transform3d poseOf(const ob::State* state) {
  const auto& se3 = *state->as<ob::SE3StateSpace::StateType>();
  const auto& q = se3.rotation();
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.linear() = Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized().toRotationMatrix();
  pose.translation() = Eigen::Vector3d(se3.getX(), se3.getY(), se3.getZ());
  return pose;
}

/// A wall across x = 0 of four boxes around a square hole, and a body that fits through it.
struct Scene {
  std::shared_ptr<fcl::Boxd> body = std::make_shared<fcl::Boxd>(0.4, 0.2, 0.1);
  fcl_prob::GroupQuery::Geometries wall;
  Poses wall_poses;
  fcl_prob::GaussianDisplacement error =
      fcl_prob::GaussianDisplacement::fromStandardDeviations({0.01, 0.02, 0.03});

  Scene() {
    const auto add = [this](double y, double z, double width, double height) {
      wall.push_back(std::make_shared<fcl::Boxd>(0.1, width, height));
      fcl::Transform3d pose = fcl::Transform3d::Identity();
      pose.translation() = Eigen::Vector3d(0.0, y, z);
      wall_poses.push_back(pose);
    };
    // The hole: 0.7 m wide and high.
    add(0.0, 1.35, 4.7, 2.0);
    add(0.0, -1.35, 4.7, 2.0);
    add(1.35, 0.0, 2.0, 0.7);
    add(-1.35, 0.0, 2.0, 0.7);
  }
};

/// What a planner needs: a state is valid if the body collides with less than 5 %.
class ProbabilityChecker : public ob::StateValidityChecker {
 public:
  ProbabilityChecker(const ob::SpaceInformationPtr& space, const Scene& scene)
      : ob::StateValidityChecker(space), scene_(scene), query_({scene.body}, scene.wall) {
    request_.threshold = kMostProbable;
  }

  bool isValid(const ob::State* state) const override {
    if (!si_->satisfiesBounds(state)) return false;
    fcl_prob::ProbabilityResult result;
    query_.collisionProbability({poseOf(state)}, scene_.wall_poses, scene_.error, request_, result);
    return result.decision == Decision::below;
  }

 private:
  const Scene& scene_;
  fcl_prob::GroupQuery query_;
  fcl_prob::ProbabilityRequest request_;
};

og::SimpleSetup plannerFor(const Scene& scene) {
  const auto space = std::make_shared<ob::SE3StateSpace>();
  ob::RealVectorBounds bounds(3);
  bounds.setLow(-0.8);
  bounds.setHigh(0.8);
  space->setBounds(bounds);
  og::SimpleSetup setup(space);
  const auto& information = setup.getSpaceInformation();
  setup.setStateValidityChecker(std::make_shared<ProbabilityChecker>(information, scene));
  information->setStateValidityCheckingResolution(0.02);
  ob::ScopedState<ob::SE3StateSpace> start(space), goal(space);
  start->setXYZ(-0.6, 0.3, 0.2);
  start->rotation().setAxisAngle(0, 0, 1, 1.0);
  goal->setXYZ(0.6, -0.2, -0.3);
  goal->rotation().setIdentity();
  setup.setStartAndGoalStates(start, goal);
  setup.setPlanner(std::make_shared<og::RRTConnect>(information));
  return setup;
}

double sampledProbability(const Scene& scene, const fcl::Transform3d& pose, int samples,
                          fcl_prob_test::RandomBodies& random) {
  const Eigen::Matrix3d factor = scene.error.axes() * scene.error.standardDeviations().asDiagonal();
  std::vector<std::unique_ptr<fcl_prob::detail::DisplacedCollider>> colliders;
  for (std::size_t i = 0; i < scene.wall.size(); ++i) {
    colliders.push_back(std::make_unique<fcl_prob::detail::DisplacedCollider>(
        *scene.body, pose, *scene.wall[i], scene.wall_poses[i], fcl_prob::ContactMeaning::fcl));
  }
  int hits = 0;
  for (int i = 0; i < samples; ++i) {
    const Eigen::Vector3d moved = factor * random.normalVector();
    hits += std::any_of(colliders.begin(), colliders.end(),
                        [&](const auto& collider) { return collider->collides(moved); });
  }
  return static_cast<double>(hits) / samples;
}

}  // namespace

TEST_CASE("OMPL plans a rigid body through a hole with a collision probability below 5 %") {
  ompl::msg::setLogLevel(ompl::msg::LOG_WARN);
  ompl::RNG::setSeed(1);
  const Scene scene;
  og::SimpleSetup setup = plannerFor(scene);
  const auto solved = setup.solve(ob::IterationTerminationCondition(20000));
  REQUIRE(solved == ob::PlannerStatus::EXACT_SOLUTION);
  og::PathGeometric path = setup.getSolutionPath();
  path.interpolate();
  fcl_prob_test::RandomBodies random(1);
  double largest = 0.0;
  bool through_hole = false;
  for (const ob::State* state : path.getStates()) {
    const fcl::Transform3d pose = poseOf(state);
    largest = std::max(largest, sampledProbability(scene, pose, 400, random));
    through_hole = through_hole || std::fabs(pose.translation().x()) < 0.1;
  }
  CHECK(through_hole);
  // 5 standard errors of 400 samples at 5 %.
  CHECK(largest < kMostProbable + 5 * 0.011);
}

TEST_CASE("a state that does not collide by itself is refused if it probably would") {
  const Scene scene;
  og::SimpleSetup setup = plannerFor(scene);
  setup.setup();
  ob::ScopedState<ob::SE3StateSpace> state(setup.getStateSpace());
  state->rotation().setIdentity();
  state->setXYZ(0.0, 0.0, 0.0);
  CHECK(setup.getStateValidityChecker()->isValid(state.get()));
  state->setXYZ(0.0, 0.24, 0.0);  // 1 cm from the edge, half a standard deviation
  const fcl_prob::detail::DisplacedCollider collider(*scene.body, poseOf(state.get()),
                                                     *scene.wall[2], scene.wall_poses[2],
                                                     fcl_prob::ContactMeaning::fcl);
  CHECK_FALSE(collider.collides(Eigen::Vector3d::Zero()));
  CHECK_FALSE(setup.getStateValidityChecker()->isValid(state.get()));
}
