// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <fcl/geometry/shape/box.h>

#include <cmath>

#include "poses.h"
#include "scene_parts.h"

namespace fcl_prob_judge {
namespace {

using namespace fcl_prob;
using fcl_prob_test::at;

/// Two balls of radius R/2: one on a lever of length L that turns about y (s_b) and z (s_a), the
/// other on the arc that the first one draws.
JudgedScene arc(const std::string& name, double length, double s_a, double s_b, double s_t,
                double radius, double hit) {
  const Lever lever{length, {0.0, s_b, s_a}, {s_t, 3, Matrix3d::Identity()}};
  const double angle = hit * s_a;
  const Obstacle ball = ballObstacle(length * Vector3d(std::cos(angle), std::sin(angle), 0.0),
                                     radius, 0.5 * radius, lever.translation);
  JudgedScene scene = ballBeside({ball}, 0.5 * radius);
  scene.name = name;
  scene.components = {leverBeside(lever, {ball}, fcl_prob_test::kIdentity, false)};
  return scene;
}

/// A rod that turns about its middle, and a cube beside it.
JudgedScene turnedRod() {
  constexpr double kTurn = 0.3, kSigma = 0.01;
  const Vector3d at_b(0.45, 0.28, 0.0);
  JudgedScene scene;
  scene.name = "turned_rod";
  scene.a = {std::make_shared<fcl::Boxd>(1.0, 0.02, 0.02)};
  scene.b = {std::make_shared<fcl::Boxd>(0.04, 0.04, 0.04)};
  scene.pair = PairError{
      fcl_prob_test::kIdentity, at(at_b),
      PoseError::fromStandardDeviations(Vector3d::Constant(kSigma), Vector3d(0.0, 0.0, kTurn))};
  Component component;
  component.truth.dimension = 1;
  component.truth.smooth = false;
  component.truth.feature = kSigma / (0.5 * kTurn);
  component.truth.value = [=](const Vector3d& z) {
    const Rectangle rod{{0.0, 0.0}, {0.5, 0.01}, kTurn * z[0]};
    const Rectangle cube{at_b.head<2>(), {0.02, 0.02}, 0.0};
    return massBetween(-0.03, 0.03, 0.0, kSigma) * massOfRectangles(rod, cube, kSigma);
  };
  scene.components = {component};
  return scene;
}

}  // namespace

std::vector<JudgedScene> knownScenes() {
  std::vector<JudgedScene> scenes{arc("two_angles", 1.0, 0.1, 0.1, 0.005, 0.03, 0.0),
                                  arc("one_angle", 1.0, 0.3, 0.0, 0.02, 0.05, 2.0), turnedRod(),
                                  arc("long_lever", 2.0, 0.075, 0.056, 0.018, 0.09, -0.2),
                                  arc("nearly_sure", 1.0, 0.1, 0.1, 0.005, 0.4657, 0.0)};
  for (JudgedScene& scene : scenes) scene.findTruth();
  return scenes;
}

}  // namespace fcl_prob_judge
