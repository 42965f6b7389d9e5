// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <algorithm>
#include <cmath>

#include "families.h"
#include "poses.h"

namespace fcl_prob_judge {
namespace {

using namespace fcl_prob;
using fcl_prob_test::at;

/// An arm whose joints turn about z and add up; its values are mean + factor·z.
struct PlanarArm {
  std::vector<double> links;
  Eigen::VectorXd mean;
  Eigen::MatrixXd factor;

  Vector3d endAt(const Eigen::VectorXd& joints) const {
    Vector3d end = Vector3d::Zero();
    double angle = 0.0;
    for (std::size_t i = 0; i < links.size(); ++i) {
      angle += joints[static_cast<Eigen::Index>(i)];
      end += links[i] * Vector3d(std::cos(angle), std::sin(angle), 0.0);
    }
    return end;
  }

  int rank() const { return static_cast<int>(factor.cols()); }

  Vector3d endGiven(const Vector3d& z) const { return endAt(mean + factor * z.head(rank())); }

  double length() const {
    double total = 0.0;
    for (const double link : links) total += link;
    return total;
  }

  /// Metres that the end moves by in one deviation of all joints, at most.
  double reach() const { return length() * factor.norm(); }

  std::shared_ptr<const RandomConfiguration> beside(const std::vector<Obstacle>& obstacles,
                                                    const fcl::Transform3d& world,
                                                    const Translation& translation) const {
    Vector3d sigma = Vector3d::Zero();
    sigma.head(translation.rank).setConstant(translation.sigma);
    const auto displacement = GaussianDisplacement::fromStandardDeviations(
        sigma, Eigen::Quaterniond(world.linear() * translation.axes));
    const auto kinematics = [arm = *this, world](const Eigen::VectorXd& joints) {
      return std::vector<fcl::Transform3d>{world * at(arm.endAt(joints))};
    };
    return std::make_shared<RandomJoints>(mean, factor * factor.transpose(), kinematics,
                                          placed(world, obstacles), displacement);
  }
};

/// As many joints as `rank`, or more that move together.
PlanarArm drawnArm(RandomBodies& random, int joints, int rank) {
  PlanarArm arm;
  arm.mean.resize(joints);
  arm.factor.resize(joints, rank);
  const double angle = drawnAngle(random) / joints;
  for (int i = 0; i < joints; ++i) {
    arm.links.push_back(random.uniform(0.1, 0.5));
    arm.mean[i] = random.uniform(-0.8, 0.8);
    for (int k = 0; k < rank; ++k) arm.factor(i, k) = angle * random.normal();
  }
  return arm;
}

Vector3d drawnDeviations(RandomBodies& random, double most) {
  return {random.uniform(-most, most), random.uniform(-most, most), random.uniform(-most, most)};
}

}  // namespace

Draft armBeforeObstacle(RandomBodies& random) {
  const int rank = random.integer(1, 3);
  const int joints = random.integer(0, 1) == 0 ? std::max(2, rank) : 7;
  const PlanarArm arm = drawnArm(random, joints, rank);
  const double sigma =
      std::max(0.003, arm.reach() * random.logUniform(rank == 3 ? 0.2 : 0.03, 1.0));
  const Translation translation = drawnTranslation(random, sigma, 3);
  const Vector3d mean = arm.endGiven(Vector3d::Zero());
  const Vector3d spot =
      arm.endGiven(drawnDeviations(random, 3.0)) + 0.5 * sigma * random.normalVector();
  const Vector3d normal = random.direction();
  const bool wall = random.integer(0, 2) == 0;
  const double share = random.uniform(0.2, 0.8), spread = arm.reach() + sigma;
  const fcl::Transform3d world(random.pose(2.0));
  const double least = wall ? normal.dot(mean) - 9.0 * spread : 0.01 + 0.3 * sigma;
  const double most = wall ? normal.dot(mean) + 9.0 * spread : 0.02 + 5.0 * spread;
  return {least, most, [=](double size) {
            const double of_a = wall ? 0.05 : share * size;
            const Obstacle obstacle = wall ? wallObstacle(normal, size, of_a, translation)
                                           : ballObstacle(spot, size, of_a, translation);
            JudgedScene scene = ballBeside({obstacle}, of_a);
            Component component;
            component.configuration = arm.beside({obstacle}, world, translation);
            component.truth.dimension = rank;
            component.truth.feature = std::min(1.0, sigma / arm.reach());
            component.truth.value = [=](const Vector3d& z) {
              return obstacle.mass(arm.endGiven(z));
            };
            scene.components = {component};
            return scene;
          }};
}

namespace {

/// A base that turns about one axis, and is translated where that is a rotation vector's: given the
/// turn an exponential's translation would be turned as well.
struct TurningBase {
  fcl::Transform3d pose;
  Vector3d axis;  ///< world frame
  double turn;    ///< deviation
  double sigma;
  PoseConvention convention;

  bool inWorld() const {
    return convention == PoseConvention::world_rotation_vector ||
           convention == PoseConvention::world_exponential;
  }

  PoseError error() const {
    const Vector3d own = inWorld() ? axis : pose.linear().transpose() * axis;
    const Translation translation{sigma, sigma > 0.0 ? 3 : 0, Matrix3d::Identity()};
    const Matrix3d axes = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitX(), own).matrix();
    return errorOf({turn, 0.0, 0.0}, translation, axes, convention);
  }

  /// What it turns about.
  Vector3d centre() const {
    return convention == PoseConvention::world_exponential ? Vector3d::Zero()
                                                           : Vector3d(pose.translation());
  }

  Vector3d moved(const Vector3d& point, double z) const {
    return centre() + turned(turn * z * axis) * (point - centre());
  }
};

}  // namespace

Draft armOnBase(RandomBodies& random) {
  const int joints = random.integer(1, 2);
  const PlanarArm arm = drawnArm(random, joints, joints);
  const fcl::Transform3d world(random.pose(2.0));
  TurningBase base;
  base.pose = world * fcl::Transform3d(random.pose(0.5));
  base.axis = random.direction();
  base.turn = drawnAngle(random);
  base.convention = static_cast<PoseConvention>(random.integer(0, 3));
  const bool exponential = base.convention == PoseConvention::world_exponential ||
                           base.convention == PoseConvention::body_exponential;
  const Vector3d mean = world * arm.endGiven(Vector3d::Zero());
  const double reach =
      std::max(arm.reach(), base.turn * ((mean - base.centre()).norm() + arm.length()));
  const double sigma = std::max(0.003, reach * random.logUniform(joints == 2 ? 0.2 : 0.03, 1.0));
  base.sigma = exponential ? 0.0 : 0.6 * sigma;
  const Translation carried{exponential ? sigma : 0.8 * sigma, 3, Matrix3d::Identity()};
  const Translation both{sigma, 3, Matrix3d::Identity()};
  const auto endGiven = [=](const Vector3d& z) {
    const Vector3d own(z[0], joints == 2 ? z[1] : 0.0, 0.0);
    return base.moved(world * arm.endGiven(own), z[joints]);
  };
  const Vector3d spot =
      endGiven(drawnDeviations(random, 2.5)) + 0.5 * sigma * random.normalVector();
  const double share = random.uniform(0.2, 0.8);
  return {0.01 + 0.3 * sigma, 0.02 + 5.0 * (reach + sigma), [=](double radius) {
            const Vector3d local = world.inverse() * spot;
            const Obstacle ball = ballObstacle(local, radius, share * radius, both);
            JudgedScene scene = ballBeside({ball}, share * radius);
            Component component;
            component.configuration = std::make_shared<RandomBase>(
                arm.beside({ball}, world, carried), base.pose, base.error());
            component.truth.dimension = joints + 1;
            component.truth.feature = std::min(1.0, sigma / reach);
            component.truth.value = [=](const Vector3d& z) {
              return massOfBall(endGiven(z) - spot, radius, both);
            };
            scene.components = {component};
            return scene;
          }};
}

}  // namespace fcl_prob_judge
