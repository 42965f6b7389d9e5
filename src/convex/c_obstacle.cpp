// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "convex/c_obstacle.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

namespace fcl_prob::detail {
namespace {

/// Generators of the rhombic triacontahedron around the unit ball: the six diagonals of an
/// icosahedron. Its volume is 1.127 times that of the ball.
void addCircumscribedBall(double radius, Zonotope& zonotope) {
  const double golden = 0.5 * (1.0 + std::sqrt(5.0));
  const double scale = radius / (2.0 * (1.0 + golden));
  for (const double sign : {1.0, -1.0}) {
    zonotope.addGenerator(scale * Eigen::Vector3d(0.0, sign, golden));
    zonotope.addGenerator(scale * Eigen::Vector3d(sign, golden, 0.0));
    zonotope.addGenerator(scale * Eigen::Vector3d(golden, 0.0, sign));
  }
}

}  // namespace

Eigen::Vector3d Ellipsoid::nearestPoint(const PairFrame& frame) const {
  // Minimise x'Px over |x - c| <= r. In P's axes x_i = λ c_i / (p_i + λ); λ is the root of the
  // decreasing convex Σ (p_i c_i / (p_i + λ))² = r², found by Newton's method on 1/sqrt of it.
  const Eigen::Vector3d& p = frame.inverse_variances;
  const Eigen::Vector3d c = frame.principal_axes.transpose() * centre;
  if (c.squaredNorm() <= radius * radius) return Eigen::Vector3d::Zero();
  double multiplier = 0.0;
  for (int iteration = 0; iteration < 60; ++iteration) {
    const Eigen::Array3d denominator = p.array() + multiplier;
    const Eigen::Array3d step = p.array() * c.array() / denominator;
    const double squared = step.square().sum();
    const double slope = -2.0 * (step.square() / denominator).sum();
    const double distance = std::sqrt(squared);
    const double change = 2.0 * squared / slope * (radius > 0.0 ? 1.0 - distance / radius : 0.0);
    multiplier += change;
    if (!(std::abs(change) > 1e-14 * multiplier)) break;
  }
  Eigen::Vector3d x = multiplier * (c.array() / (p.array() + multiplier)).matrix();
  if (radius == 0.0) x = c;
  return frame.whitening * (frame.principal_axes * x);
}

double CObstacle::support(const Eigen::Vector3d& direction) const {
  const Eigen::Vector3d world = frame_.whitening.transpose() * direction;
  return world.dot(worldSupportPoint(world)) + frame_.error * world.norm();
}

Eigen::Vector3d CObstacle::supportPoint(const Eigen::Vector3d& direction) const {
  return frame_.whitening * worldSupportPoint(frame_.whitening.transpose() * direction);
}

EnclosingFaces CObstacle::outerFaces(ObstacleScratch& scratch) const {
  if (const auto defect = worldFaces(scratch)) {
    scratch.faces.transform(frame_.whitening, Eigen::Vector3d::Zero());
    return {frame_.error + *defect, false};
  }
  Eigen::Vector3d lower;
  Eigen::Vector3d upper;
  for (int k = 0; k < 3; ++k) {
    lower[k] = -support(-Eigen::Vector3d::Unit(k));
    upper[k] = support(Eigen::Vector3d::Unit(k));
  }
  setToBox(lower, upper, scratch.faces);
  return {0.0, true};
}

ZonotopeObstacle::ZonotopeObstacle(const PairFrame& frame, const RoundedZonotope& a,
                                   const RoundedZonotope& b)
    : CObstacle(frame),
      core_(frame.rotation_b * b.core.centre() - frame.rotation_a * a.core.centre() + frame.offset),
      radius_((a.radius + b.radius) * (1.0 + frame.ball_stretch)) {
  for (int i = 0; i < b.core.generatorCount(); ++i) {
    core_.addGenerator(frame.rotation_b * b.core.generator(i));
  }
  for (int i = 0; i < a.core.generatorCount(); ++i) {
    core_.addGenerator(frame.rotation_a * a.core.generator(i));
  }
}

std::optional<Ellipsoid> ZonotopeObstacle::ellipsoid() const {
  if (core_.generatorCount() > 0) return std::nullopt;
  return Ellipsoid{core_.centre(), radius_};
}

Eigen::Vector3d ZonotopeObstacle::worldSupportPoint(const Eigen::Vector3d& direction) const {
  Eigen::Vector3d point = core_.supportPoint(direction);
  const double length = direction.norm();
  if (radius_ == 0.0 || length == 0.0) return point;
  return point + (radius_ / length) * direction;
}

std::optional<double> ZonotopeObstacle::worldFaces(ObstacleScratch& scratch) const {
  if (radius_ == 0.0) return core_.faces(scratch.faces);
  Zonotope circumscribed = core_;
  addCircumscribedBall(radius_, circumscribed);
  return circumscribed.faces(scratch.faces);
}

Eigen::Vector3d ConvexSetObstacle::worldSupportPoint(const Eigen::Vector3d& direction) const {
  const Eigen::Matrix3d& rotation_a = frame().rotation_a;
  const Eigen::Matrix3d& rotation_b = frame().rotation_b;
  return rotation_b * b_.supportPoint(rotation_b.transpose() * direction) -
         rotation_a * a_.supportPoint(-(rotation_a.transpose() * direction)) + frame().offset;
}

std::optional<double> ConvexSetObstacle::worldFaces(ObstacleScratch& scratch) const {
  const bool outer = faces_ == Faces::outer;
  const ConvexMesh& mesh_a = outer ? a_.outerMesh() : a_.innerMesh();
  const ConvexMesh& mesh_b = outer ? b_.outerMesh() : b_.innerMesh();
  const Eigen::Matrix3d& rotation_b = frame().rotation_b;
  // The inverse, not the transpose: the matrices need not be rotations to the last bit.
  reflect(mesh_a, rotation_b.inverse() * frame().rotation_a, scratch.reflected);
  const auto defect =
      scratch.sum.compute(mesh_b, scratch.reflected, scratch.faces, scratch.interruption);
  scratch.faces.transform(rotation_b, frame().offset);
  return defect;
}

SlabObstacle::SlabObstacle(const PairFrame& frame, SlabScratch& scratch)
    : CObstacle(frame), world_faces_(scratch.faces) {
  setToSlabs(scratch.slabs, frame.error, scratch.work, scratch.faces);
  scratch.faces.transform(frame.rotation_b, frame.offset);
}

Eigen::Vector3d SlabObstacle::worldSupportPoint(const Eigen::Vector3d& direction) const {
  const Eigen::Vector3d* best = &world_faces_.vertices().front();
  for (const Eigen::Vector3d& v : world_faces_.vertices()) {
    if (direction.dot(v) > direction.dot(*best)) best = &v;
  }
  return *best;
}

std::optional<double> SlabObstacle::worldFaces(ObstacleScratch& scratch) const {
  scratch.faces = world_faces_;
  return 0.0;
}

}  // namespace fcl_prob::detail
