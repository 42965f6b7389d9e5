// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/convex_body.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/sphere.h>

#include "convex/bounding_volumes.h"
#include "convex/convex_set.h"
#include "fcl_prob/exceptions.h"
#include "geometry/convex_vertices.h"
#include "geometry/geometry_kind.h"
#include "geometry/validation.h"

namespace fcl_prob {
namespace {

using detail::ConvexSet;
using detail::RoundedZonotope;
using detail::Zonotope;

constexpr int kLeastResolution = 8;

using SharedSet = std::shared_ptr<const ConvexSet>;

SharedSet sharedZonotope(const RoundedZonotope& body, int resolution = 0) {
  return std::make_shared<const ConvexSet>(body, resolution);
}

SharedSet sharedHull(const std::vector<Eigen::Vector3d>& points) {
  return std::make_shared<const ConvexSet>(detail::makeConvexMesh(points));
}

SharedSet sharedDop(const std::vector<detail::Slab>& slabs) {
  return std::make_shared<const ConvexSet>(detail::meshOfSlabs(slabs));
}

void requireResolution(int resolution) {
  if (resolution < kLeastResolution) {
    throw InvalidRequest("resolution of a convex body is " + std::to_string(resolution) +
                         ", must be at least " + std::to_string(kLeastResolution));
  }
}

RoundedZonotope capsule(const fcl::Capsuled& shape) {
  RoundedZonotope body{Zonotope(Eigen::Vector3d::Zero()), shape.radius};
  body.core.addGenerator(0.5 * shape.lz * Eigen::Vector3d::UnitZ());
  return body;
}

RoundedZonotope box(const fcl::Boxd& shape) {
  RoundedZonotope body;
  for (int k = 0; k < 3; ++k) {
    body.core.addGenerator(0.5 * shape.side[k] * Eigen::Vector3d::Unit(k));
  }
  return body;
}

SharedSet setOf(const fcl::CollisionGeometryd& shape, int resolution) {
  const Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  switch (shape.getNodeType()) {
    case fcl::GEOM_BOX:
      return sharedZonotope(box(static_cast<const fcl::Boxd&>(shape)));
    case fcl::GEOM_SPHERE:
      return sharedZonotope({Zonotope(origin), static_cast<const fcl::Sphered&>(shape).radius},
                            resolution);
    case fcl::GEOM_CAPSULE:
      return sharedZonotope(capsule(static_cast<const fcl::Capsuled&>(shape)), resolution);
    case fcl::GEOM_ELLIPSOID:
    case fcl::GEOM_CYLINDER:
    case fcl::GEOM_CONE:
      return std::make_shared<const ConvexSet>(detail::supportShape(shape), resolution);
    default:
      if (const auto vertices = detail::polytopeVertices(shape)) return sharedHull(*vertices);
      throw UnsupportedGeometry("not a bounded convex shape: " +
                                detail::nodeTypeName(shape.getNodeType()));
  }
}

}  // namespace

ConvexBody::ConvexBody(const fcl::CollisionGeometryd& shape, int resolution) {
  requireResolution(resolution);
  detail::validateGeometry(&shape, "convex body");
  set_ = setOf(shape, resolution);
}

ConvexBody::ConvexBody(const fcl::AABBd& box)
    : set_(sharedZonotope(detail::roundedZonotope(box))) {}
ConvexBody::ConvexBody(const fcl::OBBd& box) : set_(sharedZonotope(detail::roundedZonotope(box))) {}
ConvexBody::ConvexBody(const fcl::OBBRSSd& both) : ConvexBody(both.obb) {}
ConvexBody::ConvexBody(const fcl::kIOSd& kios) : ConvexBody(kios.obb) {}
ConvexBody::ConvexBody(const fcl::KDOPd<16>& dop) : set_(sharedDop(detail::slabsOf(dop))) {}
ConvexBody::ConvexBody(const fcl::KDOPd<18>& dop) : set_(sharedDop(detail::slabsOf(dop))) {}
ConvexBody::ConvexBody(const fcl::KDOPd<24>& dop) : set_(sharedDop(detail::slabsOf(dop))) {}
ConvexBody::ConvexBody(const Kdop26& dop) : set_(sharedDop(detail::slabsOf(dop))) {}
ConvexBody::ConvexBody(const std::vector<Eigen::Vector3d>& points) : set_(sharedHull(points)) {}

ConvexBody::ConvexBody(const fcl::RSSd& rss, int resolution) {
  requireResolution(resolution);
  set_ = sharedZonotope(detail::roundedZonotope(rss), resolution);
}

ConvexBody::ConvexBody(const SphereBv& sphere, int resolution) {
  requireResolution(resolution);
  set_ = sharedZonotope(detail::roundedZonotope(sphere), resolution);
}

bool ConvexBody::isPolytope() const { return set_->isPolytope(); }

Eigen::Vector3d ConvexBody::supportPoint(const Eigen::Vector3d& direction) const {
  return set_->supportPoint(direction);
}

}  // namespace fcl_prob
