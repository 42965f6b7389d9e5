// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "bench/least_distance.h"

#include <Eigen/Geometry>

#include "cli/geometry.h"
#include "geometry/mesh_visitor.h"

namespace fcl_prob::cli {

std::shared_ptr<const fcl::CollisionGeometryd> padded(const fcl::CollisionGeometryd& geometry,
                                                      double padding) {
  TriangleMesh mesh = triangleMesh(detail::meshView(geometry));
  std::vector<Eigen::Vector3d> normals(mesh.vertices.size(), Eigen::Vector3d::Zero());
  for (const fcl::Triangle& triangle : mesh.triangles) {
    const Eigen::Vector3d& corner = mesh.vertices[triangle[0]];
    const Eigen::Vector3d normal =
        (mesh.vertices[triangle[1]] - corner).cross(mesh.vertices[triangle[2]] - corner);
    for (int c = 0; c < 3; ++c) normals[triangle[c]] += normal;
  }
  for (std::size_t i = 0; i < normals.size(); ++i) {
    mesh.vertices[i] += padding * normals[i].normalized();
  }
  return buildTree(mesh, "obbrss");
}

}  // namespace fcl_prob::cli
