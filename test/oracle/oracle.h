// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Does A, displaced, touch B? An answer that shares no code with the library, nor with
// fcl::collide.
//
// Poses, vertices and sizes are exactly the doubles that are passed in; a matrix that is not quite
// a rotation is used as it is. Sets are closed: to touch at one point is to touch. Polytopes,
// meshes and octrees are decided exactly: in extended precision where its error bounds allow,
// otherwise in rationals. Curved shapes are decided by four points of b - a around the origin or by
// a plane with all of it on one side, either certain in extended precision or in 237 bits; within
// some 1e-30 of the size of the two beside the boundary they stay undecided. A half-space or plane
// is placed as fcl::transform does: normal R n, offset d + (R n)·t.
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <memory>
#include <vector>

#include "part.h"

namespace oracle {

/// How far A is displaced, metres in the world.
class Displacement {
 public:
  Displacement(const Eigen::Vector3d& exact);  // NOLINT: a double is a displacement
  explicit Displacement(const ExactVector& exact);

  /// \param rounded  to 237 bits
  /// \param exact  called only where those do not decide
  Displacement(const WideVector& rounded, std::function<ExactVector()> exact)
      : rounded_(rounded), exact_(std::move(exact)) {}

  const WideVector& rounded() const { return rounded_; }
  ExactVector exact() const { return exact_(); }

 private:
  WideVector rounded_;
  std::function<ExactVector()> exact_;
};

/// One geometry where it stands without being displaced.
struct Placed {
  const fcl::CollisionGeometryd* geometry;
  fcl::Transform3d pose;
};

/// What was asked to answer so far.
struct Effort {
  std::size_t pairs = 0;  ///< of pieces that were looked at closely
  std::size_t exact = 0;  ///< questions that only rationals could answer
};

/// Two objects, either of one geometry or of several that move as one. Not thread-safe: it counts.
class Scene {
 public:
  /// Keeps pointers to the geometries. With Contact::solid all meshes are solids.
  /// \throws std::invalid_argument  for a mesh that then is open, and for what is no geometry
  Scene(const Placed& a, const Placed& b, Contact contact);
  Scene(const std::vector<Placed>& a, const std::vector<Placed>& b, Contact contact);

  /// Whether A, displaced, touches B: what fcl::collide means, occupancies included
  /// (cost_density >= threshold_occupied, and the cells of an octree), and with Contact::solid also
  /// where one is within a closed mesh of the other. A closed mesh is filled where its surface
  /// winds around a point, in whatever direction and however often, but not 0 times on balance.
  Verdict touches(const Displacement& displacement) const;

  const Effort& effort() const { return effort_; }

 private:
  Verdict touches(const Part& a, const Part& b, const Displacement& displacement) const;
  Verdict surfacesTouch(const Part& a, const Part& b, const Displacement& displacement) const;

  std::vector<Part> a_;
  std::vector<Part> b_;
  mutable Effort effort_;
};

}  // namespace oracle
