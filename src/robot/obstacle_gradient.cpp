// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/obstacle_gradient.h"

#include <Eigen/Geometry>
#include <cmath>

#include "base/random_words.h"
#include "fcl_prob/exceptions.h"
#include "query/groups_query.h"
#include "robot/gradient_parts.h"
#include "robot/reversed.h"

namespace fcl_prob::detail {
namespace {

/// One obstacle, and the bodies that may touch it as one group.
class ObstacleLines {
 public:
  ObstacleLines(const std::vector<WaypointBody>& bodies, const Robot& robot,
                const std::vector<Eigen::VectorXd>& waypoints, const ObstacleAmongBodies& scene,
                const fcl::Transform3d& pose, const MotionGradientRequest& request)
      : query_(geometriesOf(bodies, scene), scene.obstacle.geometries()),
        poses_b_(scene.obstacle.poses(pose)),
        request_(request) {
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
      MotionGradientRequest of_one = parts.requestOf(i);
      of_one.seed += i * kSeedsApart;
      const MotionGradient part = of(components[i].displacement, of_one);
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
      return query_.gradient(poses_a_, poses_b_, displacement, velocities_, request);
    }
    ProbabilityRequest certain;
    certain.contact = request.contact;
    const ProbabilityResult result = query_.answer(poses_a_, poses_b_, displacement, certain);
    MotionGradient gradient;
    gradient.probability = result.probability();
    gradient.status = result.status;
    gradient.gradient = gradient.gradient_standard_error = Eigen::VectorXd::Zero(parameters_);
    return gradient;
  }

  static PreparedGeometries geometriesOf(const std::vector<WaypointBody>& bodies,
                                         const ObstacleAmongBodies& scene) {
    PreparedGeometries geometries;
    for (const WaypointBody& one : bodies) geometries.push_back(scene.robot.geometries[one.body]);
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

  GroupsQuery query_;
  std::vector<fcl::Transform3d> poses_a_;
  std::vector<fcl::Transform3d> poses_b_;
  MemberVelocities velocities_;
  MotionGradientRequest request_;
  Eigen::Index parameters_ = 0;
};

/// Π (1 - P_k) over all obstacles but two, each factor with so much of its standard error.
double noneTouches(const std::vector<MotionGradient>& parts, std::size_t but, std::size_t and_but,
                   double errors) {
  double none = 1.0;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (k == but || k == and_but) continue;
    none *= std::hypot(1.0 - parts[k].probability, errors * parts[k].standard_error);
  }
  return none;
}

/// Of a gradient with its standard error.
Eigen::ArrayXd sizeOf(const MotionGradient& part) {
  return (part.gradient.array().square() + part.gradient_standard_error.array().square()).sqrt();
}

}  // namespace

MotionGradient obstacleGradient(const Robot& robot, const std::vector<Eigen::VectorXd>& waypoints,
                                const std::vector<WaypointBody>& bodies,
                                const ObstacleAmongBodies& scene, const ObstacleState& state,
                                const MotionGradientRequest& request) {
  const ObstacleLines lines(bodies, robot, waypoints, scene, state.pose, request);
  return std::visit([&lines](const auto& displacement) { return lines(reversed(displacement)); },
                    state.displacement);
}

// P = 1 - Π (1 - P_i), so that ∂P = Σ ∂P_i Π_{j ≠ i} (1 - P_j). What is off of one obstacle, which
// is told by the same lines, changes its own term by its gradient and those of all others by its P:
// both may be off together, what is off of different obstacles is independent. The other factors
// are taken as large as their errors make them in the mean of squares.
JointGradient anyOfGradients(const std::vector<MotionGradient>& parts, Eigen::Index joints,
                             Eigen::Index waypoints) {
  JointGradient result;
  Eigen::ArrayXd gradient = Eigen::ArrayXd::Zero(joints * waypoints);
  Eigen::ArrayXd variance = gradient;
  double none = 1.0;
  double square = 0.0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const double others = noneTouches(parts, i, i, 0.0);
    const double others_or_more = noneTouches(parts, i, i, 1.0);
    none *= 1.0 - parts[i].probability;
    square += std::pow(others_or_more * parts[i].standard_error, 2);
    result.lines += parts[i].lines;
    result.status = statusOfBoth(result.status, parts[i].status);
    gradient += others * parts[i].gradient.array();
    // An error may be infinite, which counts for nothing where a factor is certainly 0.
    Eigen::ArrayXd error = Eigen::ArrayXd::Zero(joints * waypoints);
    if (others_or_more > 0.0) error = others_or_more * parts[i].gradient_standard_error.array();
    for (std::size_t j = 0; j < parts.size(); ++j) {
      const double factor = noneTouches(parts, i, j, 1.0) * parts[i].standard_error;
      if (j != i && factor > 0.0) error += factor * sizeOf(parts[j]);
    }
    variance += error.square();
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
