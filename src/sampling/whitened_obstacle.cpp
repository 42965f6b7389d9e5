// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "sampling/whitened_obstacle.h"

#include <fcl/narrowphase/distance.h>

#include <algorithm>

#include "fcl_prob/exceptions.h"
#include "geometry/geometry_kind.h"
#include "geometry/length.h"
#include "geometry/outer_mesh.h"

namespace fcl_prob::detail {
namespace {

/// Displacements beyond so many standard deviations have no mass in double precision.
constexpr double kReach = 40.0;

/// By how much a curved shape may be exceeded, whitened units.
constexpr double kExcess = 0.02;

/// fcl::collide may report shapes as colliding that are so far apart (metres): its GJK tolerance.
constexpr double kCollideTolerance = 2e-6;

/// Of a coordinate of a vertex, for what transforming it rounds away.
constexpr double kRelativeMargin = 1e-12;

/// A coordinate in which A does not move counts so many times more than one in which it does.
constexpr double kStiffness = 1e3;

struct Side {
  const fcl::CollisionGeometryd& geometry;
  const fcl::Transform3d& pose;

  bool unbounded() const { return kindOf(geometry) == GeometryKind::unbounded; }
};

Eigen::AlignedBox3d boxOf(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& v : mesh.vertices) box.extend(v);
  return box;
}

void transform(TriangleMesh& mesh, const Eigen::Matrix3d& matrix) {
  for (Eigen::Vector3d& v : mesh.vertices) v = matrix * v;
}

void requirePositions(const TriangleMesh& mesh) {
  for (const Eigen::Vector3d& v : mesh.vertices) {
    if (isPosition(v)) continue;
    throw InvalidRequest("rare-event sampling: the objects are too many standard deviations large");
  }
}

/// Both objects as triangles relative to a common origin (world frame), A moved by the mean. An
/// unbounded one is cut off where the other cannot get to.
struct Meshes {
  TriangleMesh a;
  TriangleMesh b;
};

TriangleMesh placedMesh(const Side& side, double tolerance, const Eigen::Vector3d& around,
                        double reach, const Eigen::Vector3d& origin) {
  TriangleMesh mesh = outerMesh(side.geometry, {tolerance, side.pose.inverse() * around, reach});
  for (Eigen::Vector3d& v : mesh.vertices) v = side.pose * v - origin;
  return mesh;
}

Meshes placedMeshes(const Side& a, const Side& b, const GaussianDisplacement& displacement) {
  const Eigen::Vector3d& sigma = displacement.standardDeviations();
  const double tolerance = kExcess * sigma[displacement.rank() - 1];
  const Eigen::Vector3d& mean = displacement.mean();
  Eigen::Vector3d origin = b.pose.translation();
  if (!a.unbounded()) origin = a.pose.translation() + mean;
  if (!a.unbounded() && !b.unbounded()) {
    return {placedMesh(a, tolerance, origin, 0.0, origin - mean),
            placedMesh(b, tolerance, origin, 0.0, origin)};
  }
  double size = 0.0;  // of the bounded one, from the origin
  for (const Side* side : {&a, &b}) {
    if (side->unbounded()) continue;
    for (const auto& v :
         placedMesh(*side, tolerance, origin, 0.0, side->pose.translation()).vertices) {
      size = std::max(size, v.norm());
    }
  }
  const double reach = 2.0 * (size + kReach * sigma[0]);
  return {placedMesh(a, tolerance, origin - mean, reach, origin - mean),
          placedMesh(b, tolerance, origin, reach, origin)};
}

/// The displacement at which the nearest points of two meshes meet; nothing if the meshes touch.
std::optional<Eigen::Vector3d> nearestDisplacement(const Meshes& meshes) {
  const auto model_a = buildModel<fcl::OBBRSSd>(meshes.a);
  const auto model_b = buildModel<fcl::OBBRSSd>(meshes.b);
  const fcl::Transform3d identity = fcl::Transform3d::Identity();
  fcl::DistanceRequestd request;
  request.enable_nearest_points = true;
  fcl::DistanceResultd result;
  fcl::distance(model_a.get(), identity, model_b.get(), identity, request, result);
  if (!(result.min_distance > 0.0)) return std::nullopt;
  return Eigen::Vector3d(result.nearest_points[1] - result.nearest_points[0]);
}

/// Rounded down by what the distance query and the collision query may be off.
double distanceBound(double distance, const GaussianDisplacement& displacement) {
  const double least_sigma = displacement.standardDeviations()[displacement.rank() - 1];
  const double bound = (1.0 - 1e-3) * distance - kCollideTolerance / least_sigma;
  return std::clamp(bound, 0.0, kReach - 3.0);
}

Eigen::Vector3d marginOf(const Meshes& meshes, const Whitening& whitening) {
  const Eigen::AlignedBox3d a = boxOf(meshes.a);
  const Eigen::AlignedBox3d b = boxOf(meshes.b);
  const Eigen::Vector3d largest = a.min().cwiseAbs().cwiseMax(a.max().cwiseAbs()) +
                                  b.min().cwiseAbs().cwiseMax(b.max().cwiseAbs());
  return kCollideTolerance * whitening.matrix().rowwise().norm() +
         Eigen::Vector3d::Constant(kRelativeMargin * largest.maxCoeff());
}

}  // namespace

WhitenedObstacle whitenedObstacle(const fcl::CollisionGeometryd& a, const fcl::Transform3d& pose_a,
                                  const fcl::CollisionGeometryd& b, const fcl::Transform3d& pose_b,
                                  const GaussianDisplacement& displacement, ContactMeaning contact,
                                  bool collides_at_mean, const Interruption& interruption) {
  const int rank = displacement.rank();
  const double unit = displacement.standardDeviations()[rank - 1] / kStiffness;
  WhitenedObstacle obstacle{Whitening(displacement, unit), std::nullopt, {}};
  Meshes meshes = placedMeshes({a, pose_a}, {b, pose_b}, displacement);
  transform(meshes.a, obstacle.whitening.matrix());
  transform(meshes.b, obstacle.whitening.matrix());
  requirePositions(meshes.a);
  requirePositions(meshes.b);
  const bool approach = !collides_at_mean && !isDue(interruption);
  const auto nearest = approach ? nearestDisplacement(meshes) : std::nullopt;
  if (nearest) {
    const Whitening rotated = obstacle.whitening.rotatedTo(*nearest);
    const Eigen::Matrix3d rotation = rotated.matrix() * obstacle.whitening.inverse();
    transform(meshes.a, rotation);
    transform(meshes.b, rotation);
    obstacle.whitening = rotated;
    obstacle.nearest = rotation * *nearest;
    for (int k = rank; k < 3; ++k) (*obstacle.nearest)[k] = 0.0;
  }
  const auto surface = [contact](const fcl::CollisionGeometryd& geometry) {
    return contact == ContactMeaning::fcl && kindOf(geometry) == GeometryKind::mesh;
  };
  const auto tree_a = buildModel<fcl::AABBd>(meshes.a);
  const auto tree_b = buildModel<fcl::AABBd>(meshes.b);
  obstacle.cover = coverByBoxes({*tree_a, surface(a)}, {*tree_b, surface(b)}, rank,
                                marginOf(meshes, obstacle.whitening), interruption);
  if (nearest && !obstacle.cover.empty()) {
    const ObstacleCover shell = coverByShell(distanceBound(nearest->norm(), displacement), rank);
    if (shell.mass < obstacle.cover.mass && shell.shell_radius > 0.0) obstacle.cover = shell;
  }
  return obstacle;
}

}  // namespace fcl_prob::detail
