// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Which pairs of displaced objects are near enough to be asked about.
#pragma once

#include <fcl/narrowphase/collision_object.h>

#include <Eigen/Geometry>
#include <cstddef>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

#include "fcl_prob/broadphase.h"
#include "geometry/box_tree.h"
#include "query/prepared_geometry.h"

namespace fcl_prob::detail {

/// How the request displaces an object.
GaussianDisplacement displacementOf(const fcl::CollisionObjectd& object,
                                    const BroadphaseRequest& request);

/// What is known of an object before any pair is looked at.
struct DisplacedObject {
  const fcl::CollisionObjectd* object;
  GaussianDisplacement displacement;
  std::shared_ptr<const PreparedGeometry> geometry;
  Eigen::AlignedBox3d box;    ///< world frame, undisplaced, rounding included
  Eigen::Vector3d deviation;  ///< of the displacement along the world's axes, metres

  bool isUnbounded() const { return !geometry->hasPieces(); }
};

/// Some objects (A) against others (B), of which some may be the same: each pair of different
/// objects once, but for those whose boxes are too far apart. Rests on the geometries and poses
/// only, not on the boxes that FCL's objects and managers keep. No pair may be missed: what is
/// unbounded is near everything.
class ObjectPairs {
 public:
  using Objects = std::vector<const fcl::CollisionObjectd*>;
  using Pair = std::pair<const DisplacedObject*, const DisplacedObject*>;

  /// Each list without repetitions. \throws InvalidRequest, InvalidPose, InvalidGeometry,
  /// UnsupportedGeometry
  ObjectPairs(const Objects& a, const Objects& b, const BroadphaseRequest& request);

  /// Those that may meet and are considered, in the order of A and then of B.
  const std::vector<Pair>& near() const { return near_; }

  /// How many pairs are left out as out of reach.
  std::size_t culled() const { return culled_; }

  /// No less than the sum of their probabilities.
  double culledUpper() const;

 private:
  struct Side {
    std::vector<const DisplacedObject*> objects;
    std::unordered_map<const DisplacedObject*, std::size_t> places;

    bool has(const DisplacedObject& object) const { return places.count(&object) > 0; }
  };

  /// B as it is searched.
  struct Targets {
    std::vector<std::size_t> unbounded, bounded;  ///< places in B
    BoxTree boxes;                                ///< of the bounded ones

    explicit Targets(const Side& side);
    std::vector<std::size_t> near(const DisplacedObject& object,
                                  const Eigen::AlignedBox3d& reach) const;
  };

  Side sideOf(const Objects& objects);
  DisplacedObject displaced(const fcl::CollisionObjectd& object);
  void find();
  std::size_t countAll() const;

  const BroadphaseRequest& request_;
  double deviations_;
  std::unordered_map<const fcl::CollisionGeometryd*,
                     std::pair<std::shared_ptr<const PreparedGeometry>, Eigen::AlignedBox3d>>
      geometries_;
  std::unordered_map<const fcl::CollisionObjectd*, std::unique_ptr<const DisplacedObject>> known_;
  Side a_, b_;
  std::vector<Pair> near_;
  std::size_t culled_ = 0;
};

}  // namespace fcl_prob::detail
