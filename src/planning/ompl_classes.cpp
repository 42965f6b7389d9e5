// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <ompl/base/spaces/RealVectorStateSpace.h>

#include "base/refuse_band.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/ompl.h"
#include "robot/joint_indices.h"
#include "robot/moving_obstacle.h"
#include "robot/robot_among_obstacles.h"
#include "robot/state_screen.h"

namespace fcl_prob {
namespace {

/// Of joints, between two looks at the robot itself: as plans have it by default.
constexpr double kStepOfSelf = 0.05;

/// The part of a motion that is told as valid is found by so many halvings.
constexpr int kHalvings = 6;

std::vector<Eigen::Index> coordinatesOf(const Robot& robot, std::vector<std::string> names) {
  if (names.empty()) {
    for (const RobotJoint& joint : robot.joints()) names.push_back(joint.name);
  }
  return detail::jointIndices(robot, names);
}

}  // namespace

struct RobotRisk::Implementation {
  std::shared_ptr<const RobotQuery> query;
  std::shared_ptr<const SelfCollision> self;
  std::vector<Eigen::Index> indices;  ///< of the joints that are coordinates
  Eigen::VectorXd rest;
  ProbabilityRequest request;
  std::size_t motion_cells;
  detail::StateScreen screen;

  bool touchesItself(const Eigen::VectorXd& values) const { return self && self->collides(values); }
};

RobotRisk::RobotRisk(std::shared_ptr<const RobotQuery> query,
                     std::shared_ptr<const SelfCollision> self,
                     const std::vector<std::string>& joints, const Eigen::VectorXd& rest,
                     const ProbabilityRequest& request, std::size_t motion_cells) {
  if (!request.threshold) throw InvalidRequest("the states of a plan need a threshold");
  validateRequest(request);
  detail::refuseBand(request, "robots");
  query->robot().requireWithinLimits(rest);
  detail::requireStaying(query->obstacles(), "plans are");
  const detail::RobotAmongObstacles& among = query->among();
  const std::vector<Eigen::Index> indices = coordinatesOf(query->robot(), joints);
  implementation_.reset(new Implementation{std::move(query), std::move(self), indices, rest,
                                           request, motion_cells,
                                           detail::StateScreen(among, rest, indices)});
}

RobotRisk::~RobotRisk() = default;

Eigen::VectorXd RobotRisk::valuesOf(const ompl::base::State* state) const {
  const double* coordinates = state->as<ompl::base::RealVectorStateSpace::StateType>()->values;
  Eigen::VectorXd values = implementation_->rest;
  for (const Eigen::Index index : implementation_->indices) values[index] = *coordinates++;
  return values;
}

bool RobotRisk::isValid(const Eigen::VectorXd& values) const {
  const Implementation& of = *implementation_;
  if (!of.query->robot().isWithinLimits(values) || of.touchesItself(values)) return false;
  return of.screen.decision(values, of.request) == Decision::below;
}

bool RobotRisk::isValidMotion(const Eigen::VectorXd& from, const Eigen::VectorXd& to) const {
  const Implementation& of = *implementation_;
  if (!isValid(from) || !isValid(to)) return false;
  for (const Eigen::VectorXd& values : interpolated({from, to}, kStepOfSelf)) {
    if (of.touchesItself(values)) return false;
  }
  ProbabilityRequest request = of.request;
  request.max_cells = of.motion_cells;
  return of.query->motion({from, to}, ErrorsOverTime::persistent, request, BetweenWaypoints::swept)
             .decision == Decision::below;
}

double RobotRisk::upper(const Eigen::VectorXd& values) const {
  ProbabilityRequest request = implementation_->request;
  request.threshold.reset();
  return implementation_->query->state(values, request).any.upper;
}

double RobotRisk::threshold() const { return *implementation_->request.threshold; }

RiskValidityChecker::RiskValidityChecker(const ompl::base::SpaceInformationPtr& information,
                                         std::shared_ptr<const RobotRisk> risk)
    : ompl::base::StateValidityChecker(information), risk_(std::move(risk)) {
  specs_.clearanceComputationType = ompl::base::StateValidityCheckerSpecs::EXACT;
}

bool RiskValidityChecker::isValid(const ompl::base::State* state) const {
  return risk_->isValid(risk_->valuesOf(state));
}

double RiskValidityChecker::clearance(const ompl::base::State* state) const {
  return risk_->threshold() - risk_->upper(risk_->valuesOf(state));
}

SweptRiskValidator::SweptRiskValidator(const ompl::base::SpaceInformationPtr& information,
                                       std::shared_ptr<const RobotRisk> risk)
    : ompl::base::MotionValidator(information), risk_(std::move(risk)) {}

bool SweptRiskValidator::checkMotion(const ompl::base::State* from,
                                     const ompl::base::State* to) const {
  const bool valid = risk_->isValidMotion(risk_->valuesOf(from), risk_->valuesOf(to));
  ++(valid ? valid_ : invalid_);
  return valid;
}

bool SweptRiskValidator::checkMotion(const ompl::base::State* from, const ompl::base::State* to,
                                     std::pair<ompl::base::State*, double>& last) const {
  if (checkMotion(from, to)) return true;
  const Eigen::VectorXd start = risk_->valuesOf(from), way = risk_->valuesOf(to) - start;
  double valid = 0.0, step = 0.5;
  for (int i = 0; i < kHalvings; ++i, step *= 0.5) {
    if (risk_->isValidMotion(start, start + (valid + step) * way)) valid += step;
  }
  last.second = valid;
  if (last.first != nullptr) si_->getStateSpace()->interpolate(from, to, valid, last.first);
  return false;
}

RiskObjective::RiskObjective(const ompl::base::SpaceInformationPtr& information,
                             std::shared_ptr<const RobotRisk> risk, double length_weight)
    : ompl::base::StateCostIntegralObjective(information, true),
      risk_(std::move(risk)),
      length_weight_(length_weight) {
  description_ = "probability of collision, integrated along the path";
}

ompl::base::Cost RiskObjective::stateCost(const ompl::base::State* state) const {
  return ompl::base::Cost(risk_->upper(risk_->valuesOf(state)) + length_weight_);
}

}  // namespace fcl_prob
