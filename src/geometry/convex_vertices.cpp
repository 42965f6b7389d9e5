// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "geometry/convex_vertices.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/triangle_p.h>

namespace fcl_prob::detail {
namespace {

std::vector<Eigen::Vector3d> boxCorners(const fcl::Boxd& box) {
  std::vector<Eigen::Vector3d> corners;
  for (double x : {-0.5, 0.5}) {
    for (double y : {-0.5, 0.5}) {
      for (double z : {-0.5, 0.5}) {
        corners.push_back(box.side.cwiseProduct(Eigen::Vector3d(x, y, z)));
      }
    }
  }
  return corners;
}

}  // namespace

std::optional<std::vector<Eigen::Vector3d>> polytopeVertices(
    const fcl::CollisionGeometryd& geometry) {
  switch (geometry.getNodeType()) {
    case fcl::GEOM_BOX:
      return boxCorners(static_cast<const fcl::Boxd&>(geometry));
    case fcl::GEOM_CONVEX:
      return static_cast<const fcl::Convexd&>(geometry).getVertices();
    case fcl::GEOM_TRIANGLE: {
      const auto& triangle = static_cast<const fcl::TrianglePd&>(geometry);
      return std::vector<Eigen::Vector3d>{triangle.a, triangle.b, triangle.c};
    }
    default:
      return std::nullopt;
  }
}

}  // namespace fcl_prob::detail
