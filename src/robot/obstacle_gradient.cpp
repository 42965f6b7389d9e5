// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/obstacle_gradient.h"

#include <Eigen/Geometry>
#include <cmath>

#include "fcl_prob/exceptions.h"
#include "fcl_prob/group.h"
#include "robot/gradient_parts.h"
#include "robot/reversed.h"

namespace fcl_prob::detail {
namespace {

/// One obstacle, and the bodies that may touch it as one group.
class ObstacleLines {
 public:
  ObstacleLines(const std::vector<WaypointBody>& bodies, const Robot& robot,
                const std::vector<Eigen::VectorXd>& waypoints,
                const std::shared_ptr<const fcl::CollisionGeometryd>& obstacle,
                const fcl::Transform3d& pose, const MotionGradientRequest& request)
      : query_(geometriesOf(bodies, robot), {obstacle}), poses_b_{pose}, request_(request) {
    const Eigen::Index joints = waypoints[0].size();
    parameters_ = joints * static_cast<Eigen::Index>(waypoints.size());
    for (const WaypointBody& one : bodies) {
      poses_a_.push_back(one.pose);
      velocities_.emplace_back(Eigen::MatrixXd::Zero(6, parameters_));
      const Eigen::Index first = joints * static_cast<Eigen::Index>(one.waypoint);
      for (const CarryingJoint& joint : robot.carryingJoints(one.body, waypoints[one.waypoint])) {
        velocities_.back().col(first + static_cast<Eigen::Index>(joint.joint)) +=
            velocityOf(joint, one.shifted);
      }
    }
  }

  MotionGradient operator()(const GaussianDisplacement& displacement) const {
    return of(displacement, request_);
  }

  MotionGradient operator()(const GaussianMixture& mixture) const {
    MotionGradient sum;
    Eigen::ArrayXd variance = Eigen::ArrayXd::Zero(parameters_);
    sum.gradient = Eigen::VectorXd::Zero(parameters_);
    const auto& components = mixture.components();
    GradientParts parts(request_, components.size());
    sum.status = ProbabilityStatus::exact;
    for (std::size_t i = 0; i < components.size(); ++i) {
      const double weight = components[i].weight;
      const MotionGradient part = of(components[i].displacement, parts.requestOf(i));
      sum.probability += weight * part.probability;
      sum.standard_error = std::hypot(sum.standard_error, weight * part.standard_error);
      sum.gradient += weight * part.gradient;
      variance += (weight * part.gradient_standard_error.array()).square();
      sum.lines += part.lines;
      sum.status = statusOfBoth(sum.status, part.status);
    }
    sum.gradient_standard_error = variance.sqrt();
    return sum;
  }

  MotionGradient operator()(const TruncatedGaussian&) const {
    throw InvalidRequest("a truncated displacement has no gradient for joints");
  }

 private:
  MotionGradient of(const GaussianDisplacement& displacement,
                    const MotionGradientRequest& request) const {
    if (displacement.rank() > 0) {
      return query_.motionGradient(poses_a_, poses_b_, displacement, velocities_, request);
    }
    ProbabilityRequest certain;
    certain.contact = request.contact;
    ProbabilityResult result;
    MotionGradient gradient;
    gradient.probability =
        query_.collisionProbability(poses_a_, poses_b_, displacement, certain, result);
    gradient.status = result.status;
    gradient.gradient = gradient.gradient_standard_error = Eigen::VectorXd::Zero(parameters_);
    return gradient;
  }

  static GroupQuery::Geometries geometriesOf(const std::vector<WaypointBody>& bodies,
                                             const Robot& robot) {
    GroupQuery::Geometries geometries;
    for (const WaypointBody& one : bodies) {
      geometries.push_back(robot.bodies()[one.body].geometry);
    }
    return geometries;
  }

  static Eigen::Matrix<double, 6, 1> velocityOf(const CarryingJoint& joint,
                                                const Eigen::Vector3d& shifted) {
    const Eigen::Vector3d along = joint.factor * joint.axis;
    Eigen::Matrix<double, 6, 1> velocity = Eigen::Matrix<double, 6, 1>::Zero();
    if (joint.turns) {
      velocity << (joint.point + shifted).cross(along), along;
    } else {
      velocity.head<3>() = along;
    }
    return velocity;
  }

  GroupQuery query_;
  std::vector<fcl::Transform3d> poses_a_;
  std::vector<fcl::Transform3d> poses_b_;
  MemberVelocities velocities_;
  MotionGradientRequest request_;
  Eigen::Index parameters_ = 0;
};

}  // namespace

MotionGradient obstacleGradient(const Robot& robot, const std::vector<Eigen::VectorXd>& waypoints,
                                const std::vector<WaypointBody>& bodies,
                                const std::shared_ptr<const fcl::CollisionGeometryd>& obstacle,
                                const ObstacleState& state, const MotionGradientRequest& request) {
  const ObstacleLines lines(bodies, robot, waypoints, obstacle, state.pose, request);
  return std::visit([&lines](const auto& displacement) { return lines(reversed(displacement)); },
                    state.displacement);
}

// P = 1 - Π (1 - P_i), so that ∂P = Σ ∂P_i Π_{j ≠ i} (1 - P_j).
JointGradient anyOfGradients(const std::vector<MotionGradient>& parts, Eigen::Index joints,
                             Eigen::Index waypoints) {
  JointGradient result;
  Eigen::ArrayXd gradient = Eigen::ArrayXd::Zero(joints * waypoints);
  Eigen::ArrayXd variance = gradient;
  double none = 1.0;
  double square = 0.0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    double others = 1.0;
    for (std::size_t j = 0; j < parts.size(); ++j) {
      if (j != i) others *= 1.0 - parts[j].probability;
    }
    none *= 1.0 - parts[i].probability;
    square += std::pow(others * parts[i].standard_error, 2);
    result.lines += parts[i].lines;
    result.status = statusOfBoth(result.status, parts[i].status);
    gradient += others * parts[i].gradient.array();
    variance += (others * parts[i].gradient_standard_error.array()).square();
  }
  result.probability = 1.0 - none;
  result.standard_error = std::sqrt(square);
  const Eigen::VectorXd errors = variance.sqrt();
  result.gradient = Eigen::Map<const Eigen::MatrixXd>(gradient.data(), joints, waypoints);
  result.gradient_standard_error =
      Eigen::Map<const Eigen::MatrixXd>(errors.data(), joints, waypoints);
  return result;
}

}  // namespace fcl_prob::detail
