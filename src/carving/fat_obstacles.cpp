// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "carving/fat_obstacles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>

#include "base/constants.h"

namespace fcl_prob::detail {
namespace {

// An edge leaning less than this against both normals of an arc counts as parallel to it.
constexpr double kParallel = 1e-8;

// Planes across an edge whose other end lies in front by less than this, relative, are kept.
constexpr double kOnPlane = 1e-9;

// The normals of a sharper edge than this, added up, are no longer than this.
constexpr double kSharpest = 1e-3;

// A triangle whose normal is known no better than this covers nothing.
constexpr double kPoorNormal = 1e-6;

}  // namespace

FatObstacles::FatObstacles(const WhitenedPair& pair, const PieceTree::Part& part,
                           const ConvexFan& fan, bool fan_is_a, const Eigen::Matrix3d& linear)
    : WhitenedFan(pair, part, fan, fan_is_a, linear),
      details_(mesh().tree->triangles.size()),
      memory_(leastMemory(details_.size())) {}

FatObstacles::Details& FatObstacles::details(int triangle) {
  std::atomic<Details*>& slot = details_[static_cast<std::size_t>(triangle)].details;
  Details* found = slot.load(std::memory_order_acquire);
  if (found) return *found;
  const std::lock_guard lock(mutexOf(triangle));
  found = slot.load(std::memory_order_relaxed);
  if (!found) {
    found = newDetails(triangle);
    slot.store(found, std::memory_order_release);
  }
  return *found;
}

FatObstacles::Details* FatObstacles::newDetails(int triangle) {
  auto made = std::make_unique<Details>();
  made->offsets.resize(static_cast<std::size_t>(faceCount()));
  const Eigen::Matrix3d t = corners(triangle);
  Eigen::Map<Eigen::VectorXd> of_faces(made->offsets.data(), faceCount());
  of_faces = heightsAlong(t.col(0));
  for (int k = 1; k < 3; ++k) of_faces = of_faces.cwiseMax(heightsAlong(t.col(k)));
  of_faces += offsets();
  ++built_;
  memory_ += sizeof(Details) + made->offsets.capacity() * sizeof(double);
  return made.release();
}

const std::vector<double>& FatObstacles::faceOffsets(int triangle) {
  return details(triangle).offsets;
}

const std::vector<ObstaclePlane>& FatObstacles::otherPlanes(int triangle) {
  Details& found = details(triangle);
  if (!found.has_planes.load(std::memory_order_acquire)) {
    const std::lock_guard lock(mutexOf(triangle));
    if (!found.has_planes.load(std::memory_order_relaxed)) {
      buildPlanes(triangle, found);
      found.has_planes.store(true, std::memory_order_release);
    }
  }
  return found.planes;
}

void FatObstacles::buildPlanes(int triangle, Details& into) {
  const Eigen::Matrix3d t = corners(triangle);
  addTriangleNormal(t, into);
  for (int edge = 0; edge < 3; ++edge) addEdge(t, edge, into);
  if (!(into.loss < kNever)) failed_ = true;
  for (ObstaclePlane& plane : into.planes) plane.margin += into.loss;
  into.planes.shrink_to_fit();
  memory_ += into.planes.capacity() * sizeof(ObstaclePlane);
}

ObstaclePlane FatObstacles::planeAcross(const Eigen::Matrix3d& corners, const Eigen::Vector3d& n,
                                        double of_p) const {
  const double pad = padding(n);
  const double extent = (n.transpose() * corners).maxCoeff();
  return {n, of_p + extent + pad, share() * of_p + 3 * pad};
}

void FatObstacles::addTriangleNormal(const Eigen::Matrix3d& corners, Details& into) const {
  const Eigen::Vector3d first = corners.col(1) - corners.col(0);
  const Eigen::Vector3d second = corners.col(2) - corners.col(0);
  const Eigen::Vector3d across = first.cross(second);
  const double turned = 8 * kEpsilon * first.norm() * second.norm() / across.norm();
  if (!(turned < kPoorNormal)) {
    into.loss = kNever;
    return;
  }
  for (const double side : {1.0, -1.0}) {
    const Eigen::Vector3d n = side * across.normalized();
    into.planes.push_back(planeAcross(corners, n, support(n)));
    into.planes.back().margin += turned * reach();
  }
}

// Where the arc between the normals of two faces crosses the plane across an edge of the triangle,
// on the side away from the triangle, V has a facet.
void FatObstacles::addEdge(const Eigen::Matrix3d& corners, int edge, Details& into) {
  const Eigen::Vector3d& from = corners.col(edge);
  const Eigen::Vector3d along = corners.col((edge + 1) % 3) - from;
  const Eigen::Vector3d opposite = corners.col((edge + 2) % 3) - from;
  const double length = along.norm();
  if (!(length > 0.0)) {
    into.loss = kNever;
    return;
  }
  const Eigen::VectorXd on_normals = heightsAlong(along);
  const double parallel = kParallel * length;
  for (const auto& [f, g] : arcs()) {
    const double at_f = on_normals[f];
    const double at_g = on_normals[g];
    const double lean = std::fabs(at_f) + std::fabs(at_g);
    if (lean <= parallel) {
      const double sum = (normals()[f] + normals()[g]).norm();
      const double loss = sum > kSharpest ? 8 * (lean / length) * (2 / sum) * reach() : kNever;
      into.loss = std::max(into.loss, loss);
      continue;
    }
    if ((at_f > 0.0) == (at_g > 0.0)) continue;
    const double of_f = std::fabs(at_g);
    const double of_g = std::fabs(at_f);
    const Eigen::Vector3d crossing = of_f * normals()[f] + of_g * normals()[g];
    if (crossing.dot(opposite) > kOnPlane * crossing.norm() * opposite.norm()) continue;
    const double size = crossing.norm();
    if (!(size > kSharpest * lean)) {
      into.loss = kNever;
      continue;
    }
    const double of_p = (of_f * faceOffset(f) + of_g * faceOffset(g)) / size;
    ObstaclePlane plane = planeAcross(corners, crossing / size, of_p);
    const double gap = (normals()[f] - normals()[g]).norm();
    plane.margin += 64 * kEpsilon * gap * (length / lean) * (lean / size) * reach();
    into.planes.push_back(plane);
  }
}

}  // namespace fcl_prob::detail
