// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cells/fat_obstacles.h"

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

// Whether each corner of a polygon, seen along n, is to the left of all its sides but its own.
bool isConvexAround(const Eigen::Vector3d& n, const Eigen::Matrix3Xd& corners) {
  const Eigen::Index count = corners.cols();
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Vector3d along = corners.col((i + 1) % count) - corners.col(i);
    for (Eigen::Index j = 2; j < count; ++j) {
      const Eigen::Vector3d to = corners.col((i + j) % count) - corners.col(i);
      if (!(n.dot(along.cross(to)) > 64 * kEpsilon * along.norm() * to.norm())) return false;
    }
  }
  return true;
}

Eigen::Vector3d areaOf(const Eigen::Matrix3Xd& corners) {
  Eigen::Vector3d area = Eigen::Vector3d::Zero();
  for (Eigen::Index i = 2; i < corners.cols(); ++i) {
    const Eigen::Vector3d first = corners.col(i - 1) - corners.col(0);
    area += first.cross(corners.col(i) - corners.col(0));
  }
  return area;
}

}  // namespace

FatObstacles::FatObstacles(const WhitenedPair& pair, const PieceTree::Part& part,
                           const ConvexFan& fan, bool fan_is_a, const Eigen::Matrix3d& linear,
                           const WhitenedPolygons& pieces)
    : WhitenedFan(pair, part, fan, fan_is_a, linear),
      pieces_(pieces),
      details_(static_cast<std::size_t>(pieces.pieceCount())),
      memory_(leastMemory(details_.size())) {}

FatObstacles::Details& FatObstacles::details(int piece) {
  std::atomic<Details*>& slot = details_[static_cast<std::size_t>(piece)].details;
  Details* found = slot.load(std::memory_order_acquire);
  if (found) return *found;
  const std::lock_guard lock(mutexOf(piece));
  found = slot.load(std::memory_order_relaxed);
  if (!found) {
    found = newDetails(piece);
    slot.store(found, std::memory_order_release);
  }
  return *found;
}

FatObstacles::Details* FatObstacles::newDetails(int piece) {
  auto made = std::make_unique<Details>();
  made->offsets.resize(static_cast<std::size_t>(faceCount()));
  Eigen::Map<Eigen::VectorXd> of_faces(made->offsets.data(), faceCount());
  of_faces.setConstant(-kInfinity);
  pieces_.visitCorners(
      piece, [&](int vertex) { of_faces = of_faces.cwiseMax(heightsAlong(corner(vertex))); });
  of_faces += (offsets().array() + pieces_.offOf(piece)).matrix();
  ++built_;
  memory_ += sizeof(Details) + made->offsets.capacity() * sizeof(double);
  return made.release();
}

const std::vector<double>& FatObstacles::faceOffsets(int piece) { return details(piece).offsets; }

const std::vector<ObstaclePlane>& FatObstacles::otherPlanes(int piece) {
  Details& found = details(piece);
  if (!found.has_planes.load(std::memory_order_acquire)) {
    const std::lock_guard lock(mutexOf(piece));
    if (!found.has_planes.load(std::memory_order_relaxed)) {
      buildPlanes(piece, found);
      found.has_planes.store(true, std::memory_order_release);
    }
  }
  return found.planes;
}

void FatObstacles::buildPlanes(int piece, Details& into) {
  if (pieces_.isTriangle(piece)) {
    buildTriangle(piece, into);
  } else {
    buildPolygon(piece, into);
  }
  for (ObstaclePlane& plane : into.planes) plane.margin += into.loss;
  into.planes.shrink_to_fit();
  memory_ += into.planes.capacity() * sizeof(ObstaclePlane);
}

void FatObstacles::buildTriangle(int piece, Details& into) {
  const Eigen::Matrix3d t = corners(piece);
  addTriangleNormal(t, into);
  for (int edge = 0; edge < 3; ++edge) {
    const Eigen::Vector3d& from = t.col(edge);
    addEdge(t, 0.0, t.col((edge + 1) % 3) - from, t.col((edge + 2) % 3) - from, into);
  }
  if (!(into.loss < kNever)) failed_ = true;
}

// The pad is what an offset is rounded by (WhitenedFan). The outer plane has it added; the margin
// takes that off again and one pad more for each of the obstacle and the point that is compared.
ObstaclePlane FatObstacles::planeAcross(double extent, const Eigen::Vector3d& n,
                                        double of_p) const {
  const double pad = padding(n);
  return {n, of_p + extent + pad, share() * of_p + 3 * pad};
}

void FatObstacles::addTriangleNormal(const Eigen::Matrix3d& corners, Details& into) const {
  const Eigen::Vector3d first = corners.col(1) - corners.col(0);
  const Eigen::Vector3d second = corners.col(2) - corners.col(0);
  const Eigen::Vector3d across = first.cross(second);
  // Each component of a cross product is rounded by less than 8 ε of |first| |second|: that turns
  // the normal, and moves a plane within reach by so much of it.
  const double turned = 8 * kEpsilon * first.norm() * second.norm() / across.norm();
  if (!(turned < kPoorNormal)) {
    into.loss = kNever;
    return;
  }
  for (const double side : {1.0, -1.0}) {
    const Eigen::Vector3d n = side * across.normalized();
    into.planes.push_back(planeAcross((n.transpose() * corners).maxCoeff(), n, support(n)));
    into.planes.back().margin += turned * reach();
  }
  into.own = 2;
}

Eigen::Vector3d FatObstacles::middle(int piece) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0.0;
  pieces_.visitCorners(piece, [&](int vertex) {
    sum += corner(vertex);
    count += 1.0;
  });
  return sum / count;
}

NodeBox FatObstacles::obstacleBoxOf(int piece) const {
  NodeBox result;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(k);
    result.lo[k] = box().lo[k] - extent(piece, -axis) - pad()[k];
    result.hi[k] = box().hi[k] + extent(piece, axis) + pad()[k];
  }
  return result;
}

// Those whose ends are on different sides, and all others that may be parallel to the edge, in
// order: most are neither.
std::vector<int> FatObstacles::arcsAcross(const Eigen::VectorXd& on_normals,
                                          double parallel) const {
  const auto faces = static_cast<std::size_t>(faceCount());
  std::vector<unsigned char> is_above(faces);
  for (std::size_t f = 0; f < faces; ++f) is_above[f] = on_normals[static_cast<int>(f)] > 0.0;
  const bool may_be_parallel = !(on_normals.cwiseAbs().minCoeff() > parallel);
  std::vector<int> found(arcs().size() + 1);
  std::size_t count = 0;
  for (std::size_t i = 0; i < arcs().size(); ++i) {
    const auto& [f, g] = arcs()[i];
    found[count] = static_cast<int>(i);
    count += may_be_parallel || is_above[f] != is_above[g] ? 1 : 0;
  }
  found.resize(count);
  return found;
}

// Where the arc between the normals of two faces of P crosses the plane across an edge of the other
// body, V may have a facet.
template <typename Corners>
void FatObstacles::addEdge(const Corners& corners, double off, const Eigen::Vector3d& along,
                           const Eigen::Vector3d& inward, Details& into) const {
  const double length = along.norm();
  if (!(length > 0.0)) {
    into.loss = kNever;
    return;
  }
  const Eigen::VectorXd on_normals = heightsAlong(along);
  for (const int arc : arcsAcross(on_normals, kParallel * length)) {
    const auto& [f, g] = arcs()[static_cast<std::size_t>(arc)];
    const double at_f = on_normals[f];
    const double at_g = on_normals[g];
    const double lean = std::fabs(at_f) + std::fabs(at_g);
    if (lean <= kParallel * length) {
      const double sum = (normals()[f] + normals()[g]).norm();
      const double loss =
          sum > kSharpest ? 8 * (lean / length) * (4 / (sum * sum)) * reach() : kNever;
      into.loss = std::max(into.loss, loss);
      continue;
    }
    if ((at_f > 0.0) == (at_g > 0.0)) continue;
    const double of_f = std::fabs(at_g);
    const double of_g = std::fabs(at_f);
    const Eigen::Vector3d crossing = of_f * normals()[f] + of_g * normals()[g];
    const double size = crossing.norm();
    if (crossing.dot(inward) > kOnPlane * size * inward.norm()) continue;
    if (!(size > kSharpest * lean)) {
      into.loss = kNever;
      return;
    }
    const double of_p = (of_f * faceOffset(f) + of_g * faceOffset(g)) / size;
    const Eigen::Vector3d n = crossing / size;
    ObstaclePlane plane = planeAcross((n.transpose() * corners).maxCoeff() + off, n, of_p);
    const double gap = (normals()[f] - normals()[g]).norm();
    // Rounded weights leave the crossing on its arc, but not quite across the edge: it is off by a
    // few ε of length / size along the arc, along which the normals differ by the gap.
    plane.margin += 64 * kEpsilon * gap * (length / size) * reach();
    into.planes.push_back(plane);
  }
}

// The corners are put into a plane across n along n. What is within all planes but for their
// margins is in Q ⊕ (1 - μ) P, with Q the polygon there, whose points are nowhere farther off its
// triangles than μ P is wide around 0.
void FatObstacles::buildPolygon(int piece, Details& into) {
  const double off = pieces_.offOf(piece);
  into.loss = mayTakePolygon(piece) ? lossOf(piece) : kNever;
  if (!(into.loss < kNever)) return;
  const Eigen::Matrix3Xd corners = cornersOf(piece);
  Eigen::Vector3d n = pieces_.normalOf(piece);
  if (n.dot(areaOf(corners)) < 0.0) n = -n;
  if (!isConvexAround(n, corners)) {
    into.loss = kNever;
    return;
  }
  for (const Eigen::Vector3d& across : {n, Eigen::Vector3d(-n)}) {
    into.planes.push_back(planeAcross(extent(piece, across), across, support(across)));
  }
  into.own = 2;
  for (int i = 0; i < corners.cols(); ++i) {
    Eigen::Vector3d along = corners.col((i + 1) % corners.cols()) - corners.col(i);
    along -= n.dot(along) * n;
    addEdge(corners, off, along, n.cross(along), into);
  }
}

Eigen::Matrix3Xd FatObstacles::cornersOf(int polygon) const {
  std::vector<Eigen::Vector3d> corners;
  pieces_.visitCorners(polygon, [&](int vertex) { corners.push_back(corner(vertex)); });
  return Eigen::Map<const Eigen::Matrix3Xd>(corners[0].data(), 3,
                                            static_cast<Eigen::Index>(corners.size()));
}

}  // namespace fcl_prob::detail
