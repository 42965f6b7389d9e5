// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A mesh whose surface encloses a solid.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "geometry/box_tree.h"
#include "geometry/directed_edges.h"
#include "geometry/mesh_visitor.h"

namespace fcl_prob::detail {

/// Where a point is relative to a solid; `unknown` within rounding of its surface.
enum class Containment { inside, outside, unknown };

/// The surface of a mesh after welding vertices of equal coordinates.
struct WeldedSurface {
  explicit WeldedSurface(const MeshView& mesh);

  std::vector<int> welded;     ///< see weldVertices()
  std::vector<int> triangles;  ///< those with three different corners
  EdgePairing pairing;         ///< of their sides; the fault that keeps the mesh from being closed
};

/// A triangle mesh in which, after welding vertices of equal coordinates, every edge is shared by
/// exactly two triangles that walk it in opposite directions. It bounds the solid of all points
/// with a winding number other than zero: shells that overlap are united, a shell of the opposite
/// orientation inside another one is a cavity, and a mesh that is inside out as a whole is the same
/// solid. Triangles with equal corners bound nothing: they are points and segments beside the
/// solid, which another solid may contain. Immutable; keeps copies of what it needs.
class ClosedMesh {
 public:
  /// \throws OpenMesh naming an edge at which the surface is open, branches or changes its
  /// orientation.
  ClosedMesh(const MeshView& mesh, const std::string& name);

  /// The same where the surface of the mesh is already known.
  ClosedMesh(const MeshView& mesh, const WeldedSurface& surface, const std::string& name);

  /// Whether the solid contains `point` (metres, frame of the mesh), no coordinate of which is
  /// wrong by more than `error`. Never wrong: signs of determinants are used only where they exceed
  /// their rounding error, else the answer is `unknown`.
  Containment contains(const Eigen::Vector3d& point, double error = 0.0) const;

  /// One vertex of every connected part of the surface (metres, frame of the mesh), triangles with
  /// equal corners included. Where the surfaces of two solids do not meet, the solids overlap if
  /// and only if one of these points of either is in the other.
  const std::vector<Eigen::Vector3d>& partPoints() const { return part_points_; }

  /// Of every vertex of the mesh the connected part of the surface that it is in, an index of
  /// partPoints(); -1 of a vertex in no triangle.
  const std::vector<int>& partOfVertex() const { return part_of_vertex_; }

  /// Bytes.
  std::size_t memory() const {
    return triangles_.capacity() * sizeof(Triangle) + tree_.memory() +
           part_points_.capacity() * sizeof(Eigen::Vector3d) +
           part_of_vertex_.capacity() * sizeof(int);
  }

 private:
  struct Triangle {
    Eigen::Vector3d corners[3];
  };

  /// From a point to one end of the mesh, in the rotated frame.
  struct Ray {
    int axis;
    bool upwards;
    double length;
  };

  std::array<Ray, 3> raysFrom(const Eigen::Vector3d& point) const;
  std::optional<int> windingAlong(const Ray& ray, const Eigen::Vector3d& point,
                                  double margin) const;

  Eigen::Vector3d centre_;
  double radius_ = 0.0;              // largest coordinate of a vertex relative to centre_
  std::vector<Triangle> triangles_;  // rotated, relative to centre_
  BoxTree tree_;
  std::vector<Eigen::Vector3d> part_points_;
  std::vector<int> part_of_vertex_;
};

/// What keeps the mesh from being closed, in words; nothing if it is closed.
std::optional<std::string> opennessOf(const MeshView& mesh);

}  // namespace fcl_prob::detail
