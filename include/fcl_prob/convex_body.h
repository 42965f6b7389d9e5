// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A convex shape or bounding volume, prepared for bounds on its collision probability.
#pragma once

#include <fcl/geometry/collision_geometry.h>
#include <fcl/math/bv/AABB.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/math/bv/kDOP.h>
#include <fcl/math/bv/kIOS.h>

#include <Eigen/Core>
#include <memory>
#include <utility>
#include <vector>

#include "fcl_prob/kdop26.h"
#include "fcl_prob/sphere_bv.h"

namespace fcl_prob {

namespace detail {
class ConvexSet;
}

/// A bounded convex solid in its own frame, metres. Immutable; copies share their data.
///
/// Support values are those of the shape itself. Where faces are needed, a curved shape is replaced
/// by a polytope around it (or inside it): see resolution.
class ConvexBody {
 public:
  static constexpr int kDefaultResolution = 92;

  /// \param shape  one of FCL's bounded convex shapes: Box, Sphere, Ellipsoid, Capsule, Cone,
  /// Cylinder, Convex (the hull of its vertices), TriangleP
  /// \param resolution  points on a ball (on a circle for Cone and Cylinder) of the polytopes that
  /// stand for a curved shape, at least 8
  ///
  /// \throws InvalidGeometry if the shape is malformed (a size that is not positive and finite,
  /// ...)
  ///
  /// \throws UnsupportedGeometry if it is no bounded convex shape
  ///
  /// \throws InvalidRequest if `resolution` is below 8
  explicit ConvexBody(const fcl::CollisionGeometryd& shape, int resolution = kDefaultResolution);

  /// A bounding volume. An OBBRSS counts as its OBB; so does a kIOS.
  explicit ConvexBody(const fcl::AABBd& box);
  explicit ConvexBody(const fcl::OBBd& box);
  explicit ConvexBody(const fcl::RSSd& rss, int resolution = kDefaultResolution);
  explicit ConvexBody(const fcl::OBBRSSd& both);
  explicit ConvexBody(const fcl::kIOSd& kios);
  explicit ConvexBody(const fcl::KDOPd<16>& dop);
  explicit ConvexBody(const fcl::KDOPd<18>& dop);
  explicit ConvexBody(const fcl::KDOPd<24>& dop);
  explicit ConvexBody(const Kdop26& dop);
  explicit ConvexBody(const SphereBv& sphere, int resolution = kDefaultResolution);

  /// The convex hull of points. \throws InvalidGeometry if there are none, or one is not finite.
  explicit ConvexBody(const std::vector<Eigen::Vector3d>& points);

  explicit ConvexBody(std::shared_ptr<const detail::ConvexSet> set) : set_(std::move(set)) {}

  /// Whether the body has flat sides only.
  bool isPolytope() const;

  /// A point of the body that lies farthest in a direction (any length).
  Eigen::Vector3d supportPoint(const Eigen::Vector3d& direction) const;

  const detail::ConvexSet& set() const { return *set_; }

 private:
  std::shared_ptr<const detail::ConvexSet> set_;
};

}  // namespace fcl_prob
