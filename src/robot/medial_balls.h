// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What is deep in something else is likely in contact: proofs in some tens of microseconds.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "fcl_prob/gaussian_displacement.h"
#include "fcl_prob/probability_request.h"
#include "geometry/box_tree.h"
#include "geometry/mesh_visitor.h"
#include "query/prepared_geometry.h"
#include "robot/body_balls.h"

namespace fcl_prob::detail {

/// A geometry, searched for its points and for medial balls: balls in its solid that touch the
/// surface from inside. A mesh has points of its surface, and balls if it is closed; of a box,
/// sphere, capsule or cylinder a capsule in it is searched. Others have neither. Keeps
/// references. Const calls are safe on several threads.
class MedialBalls {
 public:
  explicit MedialBalls(const PreparedGeometry& geometry);

  bool hasPoints() const { return mesh_.triangle_count > 0 || core_; }
  bool hasBalls() const { return !largest_.empty(); }

  struct NearPoint {
    Eigen::Vector3d point;  ///< one of it, up to slack(); metres, frame of the geometry
    int triangle = -1;      ///< of a mesh
    double distance = 0.0;  ///< of a mesh: certainly no more than that of the surface
  };
  NearPoint nearestTo(const Eigen::Vector3d& point) const;

  /// One far away that hangs together with a point.
  const Eigen::Vector3d& farFrom(const NearPoint& point) const;

  /// A ball that touches the surface near a point, certainly within the solid. Without one its
  /// radius is not above 0.
  Ball ballNear(const Eigen::Vector3d& point) const;

  /// A few large ones that are apart from each other.
  const std::vector<Ball>& largest() const { return largest_; }

  /// Whether its surface is all that counts: then what is in a ball has to reach out of it.
  bool isSurface(ContactMeaning contact) const { return !core_ && contact == ContactMeaning::fcl; }

  /// Of a closed mesh: certainly in no point of the solid.
  bool isOutside(const Ball& ball) const;

  const Ball& around() const { return around_; }

  /// More than what is rounded in places on it: metres.
  double slack() const { return slack_; }

 private:
  using Extremes = std::array<Eigen::Vector3d, 6>;

  struct Capsule {
    Eigen::Vector3d half_axis;  ///< from its middle, the origin, to the centre of an end
    double radius;
  };

  void searchMesh(const PreparedGeometry& geometry);
  void searchShape(const PreparedGeometry& geometry);
  void findExtremes();
  void findLargest();
  Ball ballAt(int triangle) const;

  MeshView mesh_;
  std::optional<Capsule> core_;  ///< of a shape
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

/// Displacements of a, seen from their mean (metres, world frame), at all of which a and b are in
/// contact.
struct ContactBall {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius = 0.0;
  double error = 0.0;  ///< of the centre
  double mass = 0.0;   ///< about
};

/// The heaviest that is soon found; none has no mass. While a point of one surface is in a ball of
/// the other solid, and a point that hangs together with it is out of that solid, the surfaces
/// cross; with solids and shapes it does not matter where the second point is.
/// \param enough  about the mass that is sought
ContactBall contactBall(const PlacedBalls& a, const PlacedBalls& b,
                        const GaussianDisplacement& of_a, ContactMeaning contact, double enough);

/// Certainly not above P that a and b are in contact: the mass of contactBall(), 0 where that is
/// hardly `enough`.
double lowerByMedialBalls(const PlacedBalls& a, const PlacedBalls& b,
                          const GaussianDisplacement& of_a, ContactMeaning contact, double enough);

}  // namespace fcl_prob::detail
