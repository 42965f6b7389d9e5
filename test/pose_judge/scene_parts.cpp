// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene_parts.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/sphere.h>

#include <cmath>

#include "poses.h"

namespace fcl_prob_judge {

using namespace fcl_prob;
using fcl_prob_test::at;

Matrix3d turned(const Vector3d& turn) {
  const double angle = turn.norm();
  if (angle == 0.0) return Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
}

Vector3d Lever::turnOf(const Vector3d& z) const {
  Vector3d turn = Vector3d::Zero();
  int next = 0;
  for (int axis = 2; axis >= 0; --axis) {
    if (sigma[axis] > 0.0) turn[axis] = sigma[axis] * z[next++];
  }
  return turn;
}

Vector3d Lever::endAt(const Vector3d& z) const { return length * turned(turnOf(z)).col(0); }

Obstacle ballObstacle(const Vector3d& centre, double radius, double radius_of_a,
                      const Translation& translation) {
  Obstacle ball{std::make_shared<fcl::Sphered>(radius - radius_of_a), at(centre),
                [=](const Vector3d& c) { return massOfBall(c - centre, radius, translation); },
                nullptr};
  if (translation.rank < 3) {
    ball.inside = [=](const Vector3d& c) { return ballWithin(c - centre, radius, translation); };
  }
  return ball;
}

Obstacle wallObstacle(const Vector3d& normal, double height, double radius_of_a,
                      const Translation& translation) {
  const double sigma = translation.sigmaAlong(normal);
  return {std::make_shared<fcl::Halfspaced>(normal, height - radius_of_a), fcl_prob_test::kIdentity,
          [=](const Vector3d& c) { return massBetween(-INFINITY, height, normal.dot(c), sigma); },
          nullptr};
}

Obstacle plateObstacle(const Vector3d& normal, double height, double half, double width,
                       double radius_of_a, const Translation& translation) {
  const double sigma = translation.sigmaAlong(normal);
  const auto turn = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), normal);
  return {std::make_shared<fcl::Boxd>(width, width, 2.0 * (half - radius_of_a)),
          at(height * normal) * fcl::Transform3d(turn),
          [=](const Vector3d& c) {
            return massBetween(height - half, height + half, normal.dot(c), sigma);
          },
          nullptr};
}

PoseError errorOf(const Vector3d& rotation_sigma, const Translation& translation,
                  const Matrix3d& axes, PoseConvention convention) {
  Vector3d sigma = Vector3d::Zero();
  sigma.head(translation.rank).setConstant(translation.sigma);
  const Matrix3d rotation = axes * rotation_sigma.cwiseAbs2().asDiagonal() * axes.transpose();
  return PoseError::fromIndependent(GaussianDisplacement::fromStandardDeviations(
                                        sigma, Eigen::Quaterniond(axes * translation.axes)),
                                    0.5 * (rotation + rotation.transpose()), convention);
}

JudgedScene ballBeside(const std::vector<Obstacle>& obstacles, double radius_of_a) {
  JudgedScene scene;
  scene.a = {std::make_shared<fcl::Sphered>(radius_of_a)};
  for (const Obstacle& obstacle : obstacles) scene.b.push_back(obstacle.geometry);
  return scene;
}

double massOf(const std::vector<Obstacle>& obstacles, const Vector3d& centre) {
  double total = 0.0;
  for (const Obstacle& obstacle : obstacles) total += obstacle.mass(centre);
  return total;
}

std::vector<fcl::Transform3d> placed(const fcl::Transform3d& world,
                                     const std::vector<Obstacle>& obstacles) {
  std::vector<fcl::Transform3d> poses;
  for (const Obstacle& obstacle : obstacles) poses.push_back(world * obstacle.pose);
  return poses;
}

Component leverBeside(const Lever& lever, const std::vector<Obstacle>& obstacles,
                      const fcl::Transform3d& world, bool in_body_frame) {
  Component component;
  const PoseError error = in_body_frame
                              ? errorOf(lever.sigma, lever.translation, Matrix3d::Identity(),
                                        PoseConvention::body_rotation_vector)
                              : errorOf(lever.sigma, lever.translation, world.linear(),
                                        PoseConvention::world_rotation_vector);
  component.configuration = std::make_shared<RandomPoses>(
      RandomPoses::Body{{world * at(lever.length, 0.0, 0.0)}, world, error},
      RandomPoses::Body{placed(world, obstacles), fcl_prob_test::kIdentity, PoseError()});
  component.truth.dimension = lever.dimension();
  component.truth.feature = std::min(1.0, lever.translation.sigma / lever.reach());
  component.truth.value = [=](const Vector3d& z) { return massOf(obstacles, lever.endAt(z)); };
  if (obstacles.front().inside) {
    component.truth.smooth = false;
    // Of several the one that is nearest: they are apart.
    component.truth.inside = [=](const Vector3d& z) {
      double most = -INFINITY;
      for (const Obstacle& obstacle : obstacles) {
        most = std::max(most, obstacle.inside(lever.endAt(z)));
      }
      return most;
    };
  }
  return component;
}

double logOdds(double probability) { return std::log(probability) - std::log1p(-probability); }

std::optional<JudgedScene> sized(const Draft& draft, double probability) {
  const double wanted = logOdds(probability);
  double least = draft.least, most = draft.most;
  if (draft.make(least).roughTruth() > probability || draft.make(most).roughTruth() < probability) {
    return std::nullopt;
  }
  for (int round = 0; round < 30; ++round) {
    const double size = 0.5 * (least + most);
    JudgedScene scene = draft.make(size);
    const double got = scene.roughTruth();
    if (std::fabs(logOdds(std::clamp(got, 1e-12, 1.0 - 1e-12)) - wanted) < 0.05) return scene;
    (got < probability ? least : most) = size;
  }
  return std::nullopt;
}

}  // namespace fcl_prob_judge
