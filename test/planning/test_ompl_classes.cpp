// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A user's own SimpleSetup of OMPL with the classes of fcl_prob/ompl.h.
#include "fcl_prob/ompl.h"

#include <fcl/geometry/shape/sphere.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>

#include "catch.h"
#include "fcl_prob/exceptions.h"

using namespace fcl_prob;

namespace {

namespace ob = ompl::base;

const std::vector<std::string> kJoints{"turn", "elbow"};

std::shared_ptr<const RobotQuery> armPastBall() {
  const Robot arm(std::string(FCL_PROB_SOURCE_DIR) + "/data/arm.urdf");
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.translation() = Eigen::Vector3d(0.55, 0.1, 0.35);
  return std::make_shared<const RobotQuery>(
      arm,
      std::vector<Obstacle>{{"ball", std::make_shared<fcl::Sphered>(0.08), pose,
                             GaussianDisplacement::fromStandardDeviations({0.02, 0.02, 0.03})}});
}

std::shared_ptr<const RobotRisk> riskOf(const std::shared_ptr<const RobotQuery>& query) {
  ProbabilityRequest request;
  request.threshold = 0.05;
  request.relative_tolerance = 0.1;
  request.max_cells = 2'000;
  return std::make_shared<const RobotRisk>(
      query, std::make_shared<const SelfCollision>(query->robot()), kJoints,
      query->robot().values({{"shoulder", 0.15}, {"grip", 0.02}}), request);
}

class Setup {
 public:
  Setup() : query(armPastBall()), risk(riskOf(query)), space(std::make_shared<Space>(2)) {
    ompl::msg::noOutputHandler();
    ob::RealVectorBounds bounds(2);
    bounds.setLow(-1.2);
    bounds.setHigh(1.2);
    space->setBounds(bounds);
    setup = std::make_unique<ompl::geometric::SimpleSetup>(space);
    const auto& information = setup->getSpaceInformation();
    setup->setStateValidityChecker(std::make_shared<RiskValidityChecker>(information, risk));
    information->setMotionValidator(std::make_shared<SweptRiskValidator>(information, risk));
    information->setup();
  }

  ob::ScopedState<> at(double turn, double elbow) const {
    ob::ScopedState<> state(space);
    state[0] = turn;
    state[1] = elbow;
    return state;
  }

  using Space = ob::RealVectorStateSpace;
  std::shared_ptr<const RobotQuery> query;
  std::shared_ptr<const RobotRisk> risk;
  std::shared_ptr<Space> space;
  std::unique_ptr<ompl::geometric::SimpleSetup> setup;
};

}  // namespace

TEST_CASE("a planner of OMPL's goes around what is too likely") {
  const Setup of;
  const auto start = of.at(-0.7, 0.3), goal = of.at(0.9, 0.3);
  CHECK(!of.setup->getSpaceInformation()->checkMotion(start.get(), goal.get()));
  of.setup->setStartAndGoalStates(start, goal);
  of.setup->setPlanner(
      std::make_shared<ompl::geometric::RRTConnect>(of.setup->getSpaceInformation()));
  REQUIRE(of.setup->solve(20.0) == ob::PlannerStatus::EXACT_SOLUTION);
  const std::vector<ob::State*>& states = of.setup->getSolutionPath().getStates();
  for (std::size_t i = 0; i + 1 < states.size(); ++i) {
    const Eigen::VectorXd from = of.risk->valuesOf(states[i]);
    const Eigen::VectorXd to = of.risk->valuesOf(states[i + 1]);
    for (const Eigen::VectorXd& values : interpolated({from, to}, 0.02)) {
      ProbabilityRequest request;
      request.relative_tolerance = 0.05;
      CHECK(of.query->state(values, request).any.lower < 0.05);
    }
  }
}

TEST_CASE("clearance, the valid part of a motion and the cost of a path say what they should") {
  const Setup of;
  const auto& information = of.setup->getSpaceInformation();
  const auto far = of.at(-0.9, 0.3), near = of.at(0.15, 0.3);
  const auto& checker = *information->getStateValidityChecker();
  CHECK(checker.isValid(far.get()));
  CHECK(!checker.isValid(near.get()));
  CHECK(checker.clearance(far.get()) > 0.04);
  CHECK(checker.clearance(near.get()) < 0.0);
  std::pair<ob::State*, double> last{information->allocState(), -1.0};
  CHECK(!information->checkMotion(far.get(), near.get(), last));
  CHECK(last.second > 0.2);
  CHECK(last.second < 1.0);
  CHECK(information->checkMotion(far.get(), last.first));
  information->freeState(last.first);
  const RiskObjective objective(information, of.risk);
  CHECK(objective.stateCost(near.get()).value() > objective.stateCost(far.get()).value());
  CHECK(objective.motionCost(far.get(), near.get()).value() >
        objective.motionCost(far.get(), of.at(-1.1, 0.3).get()).value());
}

TEST_CASE("a risk that cannot be meant is refused") {
  const auto query = armPastBall();
  const Eigen::VectorXd rest = query->robot().values({});
  ProbabilityRequest request;
  CHECK_THROWS_AS(RobotRisk(query, nullptr, kJoints, rest, request), InvalidRequest);
  request.threshold = 0.05;
  CHECK_THROWS_AS(RobotRisk(query, nullptr, {"elbwo"}, rest, request), InvalidRequest);
  CHECK_THROWS_AS(RobotRisk(query, nullptr, {"elbow", "elbow"}, rest, request), InvalidRequest);
  CHECK_THROWS_AS(RobotRisk(query, nullptr, kJoints, rest.head(2), request), InvalidRequest);
}
