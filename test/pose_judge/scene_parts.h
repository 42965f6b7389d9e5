// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What scenes of the judge are put together of: levers and obstacles, each with its P given where
// the lever's end is.
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <string>
#include <vector>

#include "fcl_prob/pose_error.h"
#include "given_mass.h"
#include "judged_scene.h"

namespace fcl_prob_judge {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// The rotation by |turn| radians about `turn`.
Matrix3d turned(const Vector3d& turn);

/// A ball at (length, 0, 0) of a frame that turns about its origin and is translated.
struct Lever {
  double length = 1.0;
  Vector3d sigma = Vector3d::Zero();  ///< radians, of the rotation vector about x, y, z
  Translation translation;

  /// Of z: as many as angles vary; about z first, then y, then x.
  int dimension() const { return static_cast<int>((sigma.array() > 0.0).count()); }
  Vector3d turnOf(const Vector3d& z) const;
  Vector3d endAt(const Vector3d& z) const;

  /// Metres that its end moves by in one deviation.
  double reach() const { return length * sigma.maxCoeff(); }
};

/// What the ball of a lever, an arm or a base may hit, in the frame that the scene is described in.
struct Obstacle {
  std::shared_ptr<fcl::CollisionGeometryd> geometry;
  fcl::Transform3d pose;
  /// P given where the ball's centre is before it is translated.
  std::function<double(const Vector3d&)> mass;
  /// If set: negative where that is 0, which it is not smoothly.
  std::function<double(const Vector3d&)> inside = nullptr;
};

/// \param radius  of the two balls together
Obstacle ballObstacle(const Vector3d& centre, double radius, double radius_of_a,
                      const Translation& translation);

/// A half-space whose normal points towards the ball; contact where normal·centre <= height.
Obstacle wallObstacle(const Vector3d& normal, double height, double radius_of_a,
                      const Translation& translation);

/// A box so wide that only its two faces across `normal` matter; contact where normal·centre is
/// within `half` of `height`.
Obstacle plateObstacle(const Vector3d& normal, double height, double half, double width,
                       double radius_of_a, const Translation& translation);

/// The error of a frame whose axes stand as `axes` in the frame that the convention refers to.
fcl_prob::PoseError errorOf(const Vector3d& rotation_sigma, const Translation& translation,
                            const Matrix3d& axes, fcl_prob::PoseConvention convention);

/// The geometries of `obstacles` as B, and a ball as A.
JudgedScene ballBeside(const std::vector<Obstacle>& obstacles, double radius_of_a);

/// A lever beside obstacles, all placed by `world`; with the error in the frame's own axes or in
/// the world's.
Component leverBeside(const Lever& lever, const std::vector<Obstacle>& obstacles,
                      const fcl::Transform3d& world, bool in_body_frame);

/// Their P's added up: they are too far apart to be hit at once.
double massOf(const std::vector<Obstacle>& obstacles, const Vector3d& centre);

std::vector<fcl::Transform3d> placed(const fcl::Transform3d& world,
                                     const std::vector<Obstacle>& obstacles);

/// A scene that lacks one number: P grows with it.
struct Draft {
  double least = 0.0, most = 1.0;
  std::function<JudgedScene(double)> make;
};

/// The scene of which P is about `probability`; not set if no size has it.
std::optional<JudgedScene> sized(const Draft& draft, double probability);

double logOdds(double probability);

}  // namespace fcl_prob_judge
