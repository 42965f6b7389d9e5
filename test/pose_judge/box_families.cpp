// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/math/bv/OBBRSS.h>

#include <algorithm>
#include <cmath>

#include "families.h"
#include "mesh_shapes.h"
#include "poses.h"

namespace fcl_prob_judge {
namespace {

using namespace fcl_prob;
using fcl_prob_test::at;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

fcl::Transform3d turnedAboutZ(const Vector3d& position, double angle) {
  return at(position) * fcl::Transform3d(Eigen::AngleAxisd(angle, Vector3d::UnitZ()));
}

/// Two boxes whose z axes agree: A's middle is `offset` along x from where it turns about z.
struct TurningBox {
  Vector3d a = Vector3d::Zero(), b = Vector3d::Zero();  ///< sides
  double offset = 0.0;
  double turn = 0.0;  ///< deviation of the angle
  double sigma = 0.0;
  Vector3d at_b = Vector3d::Zero();
  double angle_b = 0.0;

  double givenAngle(double angle) const {
    const Rectangle own{offset * Eigen::Vector2d(std::cos(angle), std::sin(angle)),
                        0.5 * a.head<2>(), angle};
    const Rectangle other{at_b.head<2>(), 0.5 * b.head<2>(), angle_b};
    const double half = 0.5 * (a.z() + b.z());
    return massBetween(-half, half, at_b.z(), sigma) * massOfRectangles(own, other, sigma);
  }

  /// Neither fits into the other, so that their surfaces meet wherever they do.
  bool neverWithin() const { return a.maxCoeff() > b.norm() && b.minCoeff() > a.minCoeff(); }
};

JudgedScene sceneOf(const TurningBox& boxes, const fcl::Transform3d& world, bool meshes) {
  JudgedScene scene;
  if (meshes && boxes.neverWithin()) {
    scene.a = {fcl_prob_test::makeModel<fcl::OBBRSSd>(fcl_prob_test::boxMesh(boxes.a))};
    scene.b = {fcl_prob_test::makeModel<fcl::OBBRSSd>(fcl_prob_test::boxMesh(boxes.b))};
  } else {
    scene.a = {std::make_shared<fcl::Boxd>(boxes.a)};
    scene.b = {std::make_shared<fcl::Boxd>(boxes.b)};
  }
  const Translation translation{boxes.sigma, 3, Matrix3d::Identity()};
  const PoseError error = errorOf({0.0, 0.0, boxes.turn}, translation, world.linear(),
                                  PoseConvention::world_rotation_vector);
  const fcl::Transform3d pose_a = world * at(boxes.offset, 0.0, 0.0);
  const fcl::Transform3d pose_b = world * turnedAboutZ(boxes.at_b, boxes.angle_b);
  if (boxes.offset == 0.0) scene.pair = PairError{pose_a, pose_b, error};
  Component component;
  component.configuration = std::make_shared<RandomPoses>(
      RandomPoses::Body{{pose_a}, world, error},
      RandomPoses::Body{{pose_b}, fcl_prob_test::kIdentity, PoseError()});
  component.truth.dimension = 1;
  component.truth.smooth = false;
  component.truth.feature =
      std::min(1.0, boxes.sigma / (boxes.turn * (boxes.offset + 0.5 * boxes.a.head<2>().norm())));
  component.truth.value = [boxes](const Vector3d& z) {
    return boxes.givenAngle(boxes.turn * z[0]);
  };
  scene.components = {component};
  return scene;
}

}  // namespace

Draft boxBesideBox(RandomBodies& random) {
  TurningBox boxes;
  boxes.a = {random.logUniform(0.3, 2.0), random.logUniform(0.01, 0.2),
             random.logUniform(0.01, 0.2)};
  boxes.offset = random.integer(0, 1) == 0 ? 0.0 : random.uniform(0.0, boxes.a.x());
  const double tip = boxes.offset + 0.5 * boxes.a.x();
  boxes.turn = random.logUniform(0.02, 0.5);
  boxes.sigma = std::max(0.003, tip * boxes.turn * random.logUniform(0.03, 1.0));
  boxes.angle_b = random.uniform(-M_PI, M_PI);
  const double angle = boxes.turn * random.uniform(-3.5, 3.5);
  boxes.at_b = random.uniform(0.4, 1.1) * tip * Vector3d(std::cos(angle), std::sin(angle), 0.0);
  boxes.at_b.z() = boxes.sigma * random.uniform(-1.0, 1.0);
  const Vector3d shape(1.0, random.uniform(0.3, 1.0), random.uniform(0.3, 1.0));
  const fcl::Transform3d world(random.pose(2.0));
  const bool meshes = random.integer(0, 1) == 1;
  return {0.01, 2.0 * tip, [=](double size) {
            TurningBox sized = boxes;
            sized.b = size * shape;
            return sceneOf(sized, world, meshes);
          }};
}

Draft boxBeforeWall(RandomBodies& random) {
  const Vector3d sides(random.logUniform(0.05, 1.0), random.logUniform(0.05, 1.0),
                       random.logUniform(0.05, 1.0));
  const fcl::Transform3d member = at(random.uniform(0.0, 1.0), 0.0, 0.0) *
                                  fcl::Transform3d(Eigen::Isometry3d(random.pose(0.0)));
  const double length = member.translation().norm() + 0.5 * sides.norm();
  Lever lever;
  lever.length = length;
  for (int i = random.integer(1, 2); i > 0; --i) lever.sigma[3 - i] = drawnAngle(random);
  const double scale = std::max(0.003, lever.reach() * random.logUniform(0.05, 1.5));
  lever.translation = drawnTranslation(random, scale, 1);
  const Vector3d normal = random.direction();
  if (lever.translation.sigmaAlong(normal) < 0.3 * scale) lever.translation.rank = 3;
  const double across = lever.translation.sigmaAlong(normal);
  const fcl::Transform3d world(random.pose(2.0));
  const auto lowest = [=](const Vector3d& z) {
    const Matrix3d turn = turned(lever.turnOf(z));
    const Vector3d own = (turn * member.linear()).transpose() * normal;
    return normal.dot(turn * member.translation()) - 0.5 * own.cwiseAbs().dot(sides);
  };
  const double mean = lowest(Vector3d::Zero()), spread = lever.reach() + across;
  return {mean - 9.0 * spread, mean + 9.0 * spread, [=](double height) {
            JudgedScene scene;
            scene.a = {std::make_shared<fcl::Boxd>(sides)};
            scene.b = {std::make_shared<fcl::Halfspaced>(normal, height)};
            Component component;
            component.configuration = std::make_shared<RandomPoses>(
                RandomPoses::Body{{world * member},
                                  world,
                                  errorOf(lever.sigma, lever.translation, world.linear(),
                                          PoseConvention::world_rotation_vector)},
                RandomPoses::Body{{world}, fcl_prob_test::kIdentity, PoseError()});
            component.truth.dimension = lever.dimension();
            component.truth.smooth = false;
            component.truth.feature = std::min(1.0, across / lever.reach());
            component.truth.value = [=](const Vector3d& z) {
              return massBetween(-kInfinity, height, lowest(z), across);
            };
            scene.components = {component};
            return scene;
          }};
}

}  // namespace fcl_prob_judge
