// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/state_with_errors.h"

#include <cmath>
#include <memory>
#include <utility>

#include "base/decision.h"
#include "base/number_text.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/pose_probability.h"
#include "fcl_prob/random_configuration.h"
#include "robot/interval_with_errors.h"
#include "robot/joint_indices.h"
#include "robot/moving_obstacle.h"

namespace fcl_prob {
namespace detail {
namespace {

/// Obstacles that are displaced independently of each other, beside a robot with errors.
class AmongDisplaced : public RandomConfiguration {
 public:
  /// \param robot    the obstacles where they are expected, without displacements
  /// \param members  how many of B each obstacle has
  AmongDisplaced(std::shared_ptr<const RandomConfiguration> robot,
                 std::vector<GaussianDisplacement> displacements, std::vector<std::size_t> members)
      : robot_(std::move(robot)),
        displacements_(std::move(displacements)),
        members_(std::move(members)) {}

  int dimension() const override {
    return robot_->dimension() + 3 * static_cast<int>(displacements_.size());
  }

  PlacedConfiguration at(const Eigen::VectorXd& z) const override {
    PlacedConfiguration placed = robot_->at(z.head(robot_->dimension()));
    Eigen::Index next = robot_->dimension();
    std::size_t member = 0;
    for (std::size_t i = 0; i < displacements_.size(); ++i, next += 3) {
      const GaussianDisplacement& one = displacements_[i];
      const Eigen::Vector3d along = one.standardDeviations().cwiseProduct(z.segment<3>(next));
      const Eigen::Vector3d moved = one.mean() + one.axes() * along;
      for (std::size_t k = 0; k < members_[i]; ++k) {
        placed.poses_b[member++].translation() += moved;
      }
    }
    return placed;
  }

 private:
  std::shared_ptr<const RandomConfiguration> robot_;
  std::vector<GaussianDisplacement> displacements_;
  std::vector<std::size_t> members_;
};

const GaussianDisplacement& gaussianOf(const Obstacle& obstacle) {
  const auto* gaussian = std::get_if<GaussianDisplacement>(&obstacle.displacement);
  if (gaussian != nullptr) return *gaussian;
  throw InvalidRequest("obstacle " + obstacle.name +
                       " has a displacement that is not Gaussian: errors of a robot are for those");
}

/// The bodies that count, which must be the same for all obstacles.
const std::vector<std::size_t>& bodiesOfAll(const RobotAmongObstacles& among) {
  for (std::size_t i = 1; i < among.obstacles().size(); ++i) {
    if (among.bodiesOf(i) == among.bodiesOf(0)) continue;
    throw UnsupportedGeometry(
        "errors of a robot whose contact is allowed with some obstacles, as " +
        among.obstacles()[i].name + ", and not with others");
  }
  return among.bodiesOf(0);
}

Eigen::MatrixXd covarianceOf(const RobotErrors& errors, Eigen::Index joints) {
  if (errors.joints.size() == 0) return Eigen::MatrixXd::Zero(joints, joints);
  if (errors.joints.rows() == joints && errors.joints.cols() == joints) return errors.joints;
  throw InvalidDistribution("the covariance of joint errors is " +
                            std::to_string(errors.joints.rows()) + " x " +
                            std::to_string(errors.joints.cols()) + ", the robot has " +
                            std::to_string(joints) + " joints");
}

}  // namespace

Eigen::MatrixXd validCovariance(const RobotAmongObstacles& among, const RobotErrors& errors) {
  requireStaying(among.obstacles(), "errors of a robot are");
  for (const Obstacle& obstacle : among.obstacles()) gaussianOf(obstacle);
  const auto joints = static_cast<Eigen::Index>(among.robot().joints().size());
  Eigen::MatrixXd covariance = covarianceOf(errors, joints);
  const auto nowhere = [](const Eigen::VectorXd&) { return std::vector<fcl::Transform3d>(); };
  const RandomJoints validated(Eigen::VectorXd::Zero(joints), covariance, nowhere, {},
                               GaussianDisplacement());
  return covariance;
}

// Given the joints and the base, a single obstacle leaves a Gaussian translation, which is answered
// exactly or counted; of several the displacements are drawn with the joints.
ProbabilityResult statesWithErrors(const RobotAmongObstacles& among,
                                   const std::vector<Eigen::VectorXd>& states,
                                   const RobotErrors& errors, const ProbabilityRequest& request) {
  requireStaying(among.obstacles(), "errors of a robot are");
  const Robot& robot = among.robot();
  const std::vector<std::size_t>& bodies = bodiesOfAll(among);
  std::vector<std::shared_ptr<const fcl::CollisionGeometryd>> a, b;
  for (std::size_t k = 0; k < states.size(); ++k) {
    for (const std::size_t body : bodies) a.push_back(robot.bodies()[body].geometry);
  }
  std::vector<fcl::Transform3d> poses_b;
  std::vector<GaussianDisplacement> displacements;
  std::vector<std::size_t> members;
  for (std::size_t i = 0; i < among.obstacles().size(); ++i) {
    const Obstacle& obstacle = among.obstacles()[i];
    displacements.push_back(gaussianOf(obstacle));
    b.push_back(obstacle.geometry);
    for (const ObstacleBody& body : obstacle.more) b.push_back(body.geometry);
    const auto poses = among.preparedObstacle(i).poses(obstacle.pose);
    poses_b.insert(poses_b.end(), poses.begin(), poses.end());
    members.push_back(poses.size());
  }
  if (bodies.empty()) {
    ProbabilityResult none;
    none.lower = none.upper = 0.0;
    none.status = ProbabilityStatus::exact;
    none.decision = decisionOf({0.0, 0.0}, request);
    return none;
  }
  const auto kinematics = [&](const Eigen::VectorXd& error) {
    std::vector<fcl::Transform3d> poses;
    for (const Eigen::VectorXd& values : states) {
      const std::vector<fcl::Transform3d> all = robot.poses(values + error);
      for (const std::size_t body : bodies) poses.push_back(all[body]);
    }
    return poses;
  };
  const bool several = displacements.size() > 1;
  const Eigen::VectorXd no_error = Eigen::VectorXd::Zero(states[0].size());
  const Eigen::MatrixXd covariance = covarianceOf(errors, no_error.size());
  std::shared_ptr<const RandomConfiguration> configuration = std::make_shared<RandomJoints>(
      no_error, covariance, kinematics, poses_b,
      several ? GaussianDisplacement() : displacements[0].reversed());
  if (request.method == ProbabilityMethod::interval) {
    if (states.size() == 1) {
      return intervalWithErrors(among, states[0], covariance, errors.base, request);
    }
    throw InvalidRequest("a certified interval with errors of joints or base is of one state");
  }
  if (errors.base) {
    const fcl::Transform3d base = robot.linkPose(robot.links()[0].name, states[0]);
    configuration = std::make_shared<RandomBase>(configuration, base, *errors.base);
  }
  if (several) {
    configuration = std::make_shared<AmongDisplaced>(configuration, displacements, members);
  }
  ProbabilityResult result;
  ConfigurationQuery(a, b).collisionProbability(*configuration, request, result);
  return result;
}

}  // namespace detail

Eigen::MatrixXd jointCovariance(const Robot& robot,
                                const std::map<std::string, double>& deviations) {
  const auto count = static_cast<Eigen::Index>(robot.joints().size());
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(count, count);
  for (const auto& [name, deviation] : deviations) {
    const Eigen::Index at = detail::jointIndex(robot, name);
    if (!(std::isfinite(deviation) && deviation >= 0.0)) {
      throw InvalidDistribution("the standard deviation of joint " + name + " is " +
                                detail::numberText(deviation));
    }
    covariance(at, at) = deviation * deviation;
  }
  return covariance;
}

}  // namespace fcl_prob
