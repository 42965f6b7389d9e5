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

/// Translations of less than a twentieth of what the turn moves are what is hard; of three angles
/// the truth would take too long with them.
double drawnSigma(RandomBodies& random, double reach, int angles) {
  return std::max(0.003, reach * random.logUniform(angles == 3 ? 0.2 : 0.03, 1.5));
}

Lever drawnLever(RandomBodies& random, int angles, int least_rank) {
  Lever lever;
  lever.length = random.logUniform(0.3, 2.0);
  for (int i = 0; i < angles; ++i) lever.sigma[2 - i] = drawnAngle(random);
  lever.translation =
      drawnTranslation(random, drawnSigma(random, lever.reach(), angles), least_rank);
  return lever;
}

/// Where the lever's end is some deviations off, and a little beside it.
Vector3d drawnSpot(RandomBodies& random, const Lever& lever, double deviations) {
  Vector3d z;
  for (int i = 0; i < 3; ++i) z[i] = random.uniform(-deviations, deviations);
  return lever.endAt(z) + 0.5 * lever.translation.sigma * random.normalVector();
}

/// Radii of two balls together.
double leastRadius(const Lever& lever) { return 0.01 + 0.3 * lever.translation.sigma; }
double mostRadius(const Lever& lever) {
  return 0.02 + 5.0 * lever.reach() + 4.0 * lever.translation.sigma;
}

/// Where panels may begin if nothing smooths what happens.
void widenFeature(Component& component, const Lever& lever, double radius) {
  if (component.truth.smooth) return;
  component.truth.feature =
      std::min(1.0, 0.3 * std::max(radius, lever.translation.sigma) / lever.reach());
}

}  // namespace

double drawnAngle(RandomBodies& random) { return random.logUniform(0.005, 0.4); }

Translation drawnTranslation(RandomBodies& random, double sigma, int least_rank) {
  Translation translation;
  // Full rank in half of the cases.
  translation.rank = random.integer(0, 1) == 0 ? 3 : random.integer(least_rank, 3);
  translation.sigma = translation.rank == 0 ? 0.0 : sigma;
  translation.axes = random.rotation();
  return translation;
}

Draft leverBeforeBall(RandomBodies& random) {
  const int angles = random.integer(1, 3);
  const Lever lever = drawnLever(random, angles, angles == 3 ? 3 : 0);
  const Vector3d spot = drawnSpot(random, lever, 3.5);
  const double share = random.uniform(0.2, 0.8);
  const fcl::Transform3d world(random.pose(2.0));
  const bool in_body_frame = random.integer(0, 1) == 1;
  return {leastRadius(lever), mostRadius(lever), [=](double radius) {
            const Obstacle ball = ballObstacle(spot, radius, share * radius, lever.translation);
            JudgedScene scene = ballBeside({ball}, share * radius);
            scene.components = {leverBeside(lever, {ball}, world, in_body_frame)};
            widenFeature(scene.components.front(), lever, radius);
            return scene;
          }};
}

Draft leverBeforeWall(RandomBodies& random) {
  const int angles = random.integer(1, 3);
  Lever lever = drawnLever(random, angles, 1);
  const Vector3d normal = random.direction();
  // What moves along the wall only leaves a jump to the turn.
  if (lever.translation.sigmaAlong(normal) < 0.3 * lever.translation.sigma) {
    lever.translation.rank = 3;
  }
  const double radius = random.logUniform(0.01, 0.2), mean = normal.x() * lever.length;
  const double spread = lever.reach() + lever.translation.sigma;
  const fcl::Transform3d world(random.pose(2.0));
  const bool in_body_frame = random.integer(0, 1) == 1;
  const bool plate = random.integer(0, 1) == 1;
  const double thickness = random.logUniform(0.02, 1.0);
  return {mean - 9.0 * spread, mean + 9.0 * spread, [=](double height) {
            const double half = radius + thickness;
            const double width = 8.0 * (lever.length + std::fabs(height) + spread + half);
            const Obstacle wall =
                plate ? plateObstacle(normal, height - half, half, width, radius, lever.translation)
                      : wallObstacle(normal, height, radius, lever.translation);
            JudgedScene scene = ballBeside({wall}, radius);
            scene.components = {leverBeside(lever, {wall}, world, in_body_frame)};
            scene.components.front().truth.feature =
                std::min(1.0, lever.translation.sigmaAlong(normal) / lever.reach());
            return scene;
          }};
}

Draft leverBetweenBalls(RandomBodies& random) {
  const Lever lever = drawnLever(random, random.integer(1, 2), 2);
  const double hit = random.uniform(0.5, 3.5), other_hit = -random.uniform(0.5, 3.5);
  const Vector3d spot = lever.endAt({hit, random.uniform(-1.0, 1.0), 0.0});
  const Vector3d other = lever.endAt({other_hit, random.uniform(-1.0, 1.0), 0.0});
  const double ratio = random.logUniform(0.3, 1.0), share = random.uniform(0.2, 0.8);
  const fcl::Transform3d world(random.pose(2.0));
  // Never both at once.
  const double most = std::min(mostRadius(lever), 0.999 * (spot - other).norm() / (1.0 + ratio));
  return {std::min(leastRadius(lever), 0.5 * most), most, [=](double radius) {
            const double of_a = share * ratio * radius;
            const std::vector<Obstacle> balls{
                ballObstacle(spot, radius, of_a, lever.translation),
                ballObstacle(other, ratio * radius, of_a, lever.translation)};
            JudgedScene scene = ballBeside(balls, of_a);
            scene.components = {leverBeside(lever, balls, world, false)};
            widenFeature(scene.components.front(), lever, ratio * radius);
            return scene;
          }};
}

Draft leverOfSeveral(RandomBodies& random) {
  const int count = random.integer(2, 3);
  std::vector<Lever> levers;
  std::vector<Vector3d> spots;
  std::vector<double> weights;
  double left = 1.0, least = 0.0, most = 0.0;
  for (int i = 0; i < count; ++i) {
    levers.push_back(drawnLever(random, random.integer(1, 2), 2));
    spots.push_back(drawnSpot(random, levers.back(), 3.5));
    weights.push_back(i + 1 == count ? left : left * random.logUniform(0.01, 0.8));
    left -= weights.back();
    least = std::max(least, leastRadius(levers.back()));
    most = std::max(most, mostRadius(levers.back()));
  }
  const double share = random.uniform(0.2, 0.8);
  const fcl::Transform3d world(random.pose(2.0));
  return {least, most, [=](double radius) {
            JudgedScene scene;
            for (std::size_t i = 0; i < levers.size(); ++i) {
              const Obstacle ball =
                  ballObstacle(spots[i], radius, share * radius, levers[i].translation);
              if (i == 0) scene = ballBeside({ball}, share * radius);
              scene.components.push_back(leverBeside(levers[i], {ball}, world, i % 2 == 1));
              scene.components.back().weight = weights[i];
              widenFeature(scene.components.back(), levers[i], radius);
            }
            return scene;
          }};
}

Draft leverBesideLever(RandomBodies& random) {
  const int angles = random.integer(1, 2);
  Lever lever = drawnLever(random, angles, 3);
  Lever other = drawnLever(random, 1, 3);
  const double reach = lever.reach() + other.reach();
  lever.translation.sigma = drawnSigma(random, reach, angles + 1) * M_SQRT1_2;
  other.translation.sigma = lever.translation.sigma;
  Translation both = lever.translation;
  both.sigma = std::hypot(lever.translation.sigma, other.translation.sigma);
  const Vector3d spot = drawnSpot(random, lever, 3.0);
  // The other one is at `spot` where it is not turned.
  fcl::Transform3d frame(random.pose(0.0));
  frame.translation() = spot - frame.linear() * Vector3d(other.length, 0.0, 0.0);
  const double share = random.uniform(0.2, 0.8);
  const fcl::Transform3d world(random.pose(2.0));
  const auto body = [](const Lever& of, const fcl::Transform3d& pose) {
    return RandomPoses::Body{{pose * at(of.length, 0.0, 0.0)},
                             pose,
                             errorOf(of.sigma, of.translation, Matrix3d::Identity(),
                                     PoseConvention::body_rotation_vector)};
  };
  return {0.01 + 0.3 * both.sigma, 5.0 * reach + 4.0 * both.sigma, [=](double radius) {
            JudgedScene scene =
                ballBeside({ballObstacle(spot, radius, share * radius, both)}, share * radius);
            Component component;
            component.configuration =
                std::make_shared<RandomPoses>(body(lever, world), body(other, world * frame));
            component.truth.dimension = angles + 1;
            component.truth.feature =
                std::min(1.0, both.sigma / std::max(lever.reach(), other.reach()));
            component.truth.value = [=](const Vector3d& z) {
              const Vector3d own(z[0], angles == 2 ? z[1] : 0.0, 0.0);
              const Vector3d theirs = frame * other.endAt({z[angles], 0.0, 0.0});
              return massOfBall(lever.endAt(own) - theirs, radius, both);
            };
            scene.components = {component};
            return scene;
          }};
}

}  // namespace fcl_prob_judge
