// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "geometry/geometry_kind.h"

namespace fcl_prob::detail {

GeometryKind kindOf(const fcl::CollisionGeometryd& geometry) {
  switch (geometry.getNodeType()) {
    case fcl::BV_AABB:
    case fcl::BV_OBB:
    case fcl::BV_RSS:
    case fcl::BV_kIOS:
    case fcl::BV_OBBRSS:
    case fcl::BV_KDOP16:
    case fcl::BV_KDOP18:
    case fcl::BV_KDOP24:
      return GeometryKind::mesh;
    case fcl::GEOM_BOX:
    case fcl::GEOM_SPHERE:
    case fcl::GEOM_ELLIPSOID:
    case fcl::GEOM_CAPSULE:
    case fcl::GEOM_CONE:
    case fcl::GEOM_CYLINDER:
    case fcl::GEOM_CONVEX:
    case fcl::GEOM_TRIANGLE:
      return GeometryKind::convex;
    case fcl::GEOM_PLANE:
    case fcl::GEOM_HALFSPACE:
      return GeometryKind::unbounded;
    case fcl::GEOM_OCTREE:
      return GeometryKind::octree;
    default:
      return GeometryKind::unsupported;
  }
}

std::string nodeTypeName(fcl::NODE_TYPE type) {
  switch (type) {
    case fcl::BV_AABB:
      return "BVHModel<AABB>";
    case fcl::BV_OBB:
      return "BVHModel<OBB>";
    case fcl::BV_RSS:
      return "BVHModel<RSS>";
    case fcl::BV_kIOS:
      return "BVHModel<kIOS>";
    case fcl::BV_OBBRSS:
      return "BVHModel<OBBRSS>";
    case fcl::BV_KDOP16:
      return "BVHModel<KDOP<16>>";
    case fcl::BV_KDOP18:
      return "BVHModel<KDOP<18>>";
    case fcl::BV_KDOP24:
      return "BVHModel<KDOP<24>>";
    case fcl::GEOM_BOX:
      return "Box";
    case fcl::GEOM_SPHERE:
      return "Sphere";
    case fcl::GEOM_ELLIPSOID:
      return "Ellipsoid";
    case fcl::GEOM_CAPSULE:
      return "Capsule";
    case fcl::GEOM_CONE:
      return "Cone";
    case fcl::GEOM_CYLINDER:
      return "Cylinder";
    case fcl::GEOM_CONVEX:
      return "Convex";
    case fcl::GEOM_PLANE:
      return "Plane";
    case fcl::GEOM_HALFSPACE:
      return "Halfspace";
    case fcl::GEOM_TRIANGLE:
      return "TriangleP";
    case fcl::GEOM_OCTREE:
      return "OcTree";
    default:
      return "geometry of unknown node type " + std::to_string(static_cast<int>(type));
  }
}

}  // namespace fcl_prob::detail
