// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What is deep in something else is likely in contact: proofs in tens of microseconds.
#pragma once

#include <array>
#include <vector>

#include "fcl_prob/gaussian_displacement.h"
#include "fcl_prob/probability_request.h"
#include "geometry/box_tree.h"
#include "geometry/mesh_visitor.h"
#include "query/prepared_geometry.h"
#include "robot/body_balls.h"

namespace fcl_prob::detail {

/// A mesh, searched for points of its surface and, if it is closed, for medial balls: balls in its
/// solid that touch the surface from inside. There is nothing to search in other geometries. Keeps
/// references. Const calls are safe on several threads.
class MedialBalls {
 public:
  explicit MedialBalls(const PreparedGeometry& geometry);

  struct SurfacePoint {
    Eigen::Vector3d point;  ///< of the surface up to slack(); metres, frame of the mesh
    int triangle = -1;      ///< none where there is no mesh
    double distance = 0.0;  ///< certainly no more than that of the surface
  };
  SurfacePoint nearestTo(const Eigen::Vector3d& point) const;

  /// Of the connected part of the surface that a point is of, one far away from it.
  const Eigen::Vector3d& farFrom(const SurfacePoint& point) const;

  /// That touches a triangle, about: certainly within the solid. Without one its radius is not
  /// above 0.
  Ball ballAt(int triangle) const;

  /// A few large ones that are apart from each other.
  const std::vector<Ball>& largest() const { return largest_; }

  /// Certainly in no point of the solid.
  bool isOutside(const Ball& ball) const;

  bool isClosed() const { return solid_ != nullptr; }
  const Ball& around() const { return around_; }

  /// More than what is rounded in places on it: metres.
  double slack() const { return slack_; }

 private:
  using Extremes = std::array<Eigen::Vector3d, 6>;

  void findExtremes();
  void findLargest();

  MeshView mesh_;
  const ClosedMesh* solid_ = nullptr;
  Ball around_;
  double slack_ = 0.0;
  BoxTree triangles_;
  std::vector<int> part_of_vertex_;
  std::vector<Extremes> extremes_;  ///< of the connected parts, along the axes
  std::vector<Ball> largest_;
};

struct PlacedBalls {
  const MedialBalls& balls;
  const fcl::Transform3d& pose;
};

/// Certainly not above P that a and b are in contact. While a point of one surface is in a ball of
/// the other solid, and a point that hangs together with it is out of that solid, the surfaces
/// cross; solids overlap wherever the second point is. So the C-obstacle contains a ball, whose
/// mass is known.
/// \param enough  where no more than this is in sight, 0 is told
double lowerByMedialBalls(const PlacedBalls& a, const PlacedBalls& b,
                          const GaussianDisplacement& of_a, ContactMeaning contact, double enough);

}  // namespace fcl_prob::detail
