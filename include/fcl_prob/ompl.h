// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A robot among obstacles in OMPL's own classes, for a SimpleSetup that a user has. In the library
// fcl_prob::planning.
#pragma once

#include <ompl/base/MotionValidator.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/StateValidityChecker.h>
#include <ompl/base/objectives/StateCostIntegralObjective.h>

#include <memory>
#include <string>
#include <vector>

#include "fcl_prob/robot_query.h"
#include "fcl_prob/self_collision.h"

namespace fcl_prob {

/// What OMPL's classes below are made of; they share it. Const and thread-safe, as planners that
/// use several threads need it.
class RobotRisk {
 public:
  /// \param query    what is asked; obstacles stay where they are
  /// \param self     whether the robot touches itself; null: nobody asks
  /// \param joints   those that are the coordinates of a state (a RealVectorStateSpace), in its
  ///                 order; none named: all
  /// \param rest     values of the others, of all joints in the order of Robot::joints()
  /// \param request  with the threshold that P of every state stays below; its limits are those of
  ///                 a state, and of a motion `motion_cells` cells
  /// \throws InvalidRequest without a threshold, for a name that is no joint or named twice, an
  ///         obstacle that moves, or as RobotQuery::state()
  RobotRisk(std::shared_ptr<const RobotQuery> query, std::shared_ptr<const SelfCollision> self,
            const std::vector<std::string>& joints, const Eigen::VectorXd& rest,
            const ProbabilityRequest& request, std::size_t motion_cells = 20'000);
  ~RobotRisk();

  /// All joint values of a state.
  Eigen::VectorXd valuesOf(const ompl::base::State* state) const;

  /// Whether it is within the limits, does not touch itself, and P is certainly below the
  /// threshold.
  bool isValid(const Eigen::VectorXd& values) const;

  /// Whether that holds of both ends, and P at any time between them is certainly below it
  /// (BetweenWaypoints::swept). The robot against itself is asked at steps of 0.05 (radians,
  /// metres), between which it is not looked at.
  bool isValidMotion(const Eigen::VectorXd& from, const Eigen::VectorXd& to) const;

  /// The upper end of P's certified interval, to the request's tolerance.
  double upper(const Eigen::VectorXd& values) const;

  double threshold() const;

 private:
  struct Implementation;
  std::unique_ptr<const Implementation> implementation_;
};

/// Valid where P is certainly below the threshold.
class RiskValidityChecker : public ompl::base::StateValidityChecker {
 public:
  RiskValidityChecker(const ompl::base::SpaceInformationPtr& information,
                      std::shared_ptr<const RobotRisk> risk);

  bool isValid(const ompl::base::State* state) const override;

  /// Not a distance in space: by how much the upper end of P is below the threshold. What planners
  /// maximise by it (MaximizeMinClearanceObjective) is the largest margin of probability.
  double clearance(const ompl::base::State* state) const override;

 private:
  std::shared_ptr<const RobotRisk> risk_;
};

/// Valid where P is certainly below the threshold at all times of the straight line between two
/// states: certified, so that the resolution of state checks plays no part.
class SweptRiskValidator : public ompl::base::MotionValidator {
 public:
  SweptRiskValidator(const ompl::base::SpaceInformationPtr& information,
                     std::shared_ptr<const RobotRisk> risk);

  bool checkMotion(const ompl::base::State* from, const ompl::base::State* to) const override;

  /// `last` is told to a 64th of the way at best: what is valid up to there is certified, too.
  bool checkMotion(const ompl::base::State* from, const ompl::base::State* to,
                   std::pair<ompl::base::State*, double>& last) const override;

 private:
  std::shared_ptr<const RobotRisk> risk_;
};

/// The upper end of P, integrated along the path; with the path's length times `length_weight`.
class RiskObjective : public ompl::base::StateCostIntegralObjective {
 public:
  RiskObjective(const ompl::base::SpaceInformationPtr& information,
                std::shared_ptr<const RobotRisk> risk, double length_weight = 0.01);

  ompl::base::Cost stateCost(const ompl::base::State* state) const override;

 private:
  std::shared_ptr<const RobotRisk> risk_;
  double length_weight_;
};

}  // namespace fcl_prob
