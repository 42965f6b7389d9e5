// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/convex_polytope.h"

namespace fcl_prob {

std::shared_ptr<fcl::Convexd> convexGeometry(const ConvexPolytope& polytope) {
  auto faces = std::make_shared<std::vector<int>>();
  for (const ConvexPolytope::Face& face : polytope.faces) {
    faces->push_back(static_cast<int>(face.vertices.size()));
    faces->insert(faces->end(), face.vertices.begin(), face.vertices.end());
  }
  const auto vertices = std::make_shared<const std::vector<fcl::Vector3d>>(
      polytope.vertices.begin(), polytope.vertices.end());
  auto convex = std::make_shared<fcl::Convexd>(vertices, static_cast<int>(polytope.faces.size()),
                                               std::move(faces));
  convex->computeLocalAABB();
  return convex;
}

}  // namespace fcl_prob
