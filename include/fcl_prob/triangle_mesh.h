// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Triangles as plain arrays, and the fcl::BVHModel built from them.
#pragma once

#include <fcl/geometry/bvh/BVH_model.h>

#include <memory>
#include <string>
#include <vector>

#include "fcl_prob/exceptions.h"

namespace fcl_prob {

/// A set of triangles with shared vertices. Degenerate triangles are allowed: FCL tests them too.
struct TriangleMesh {
  std::vector<fcl::Vector3d> vertices;   ///< metres, in the mesh's own frame
  std::vector<fcl::Triangle> triangles;  ///< three indices into `vertices` each

  /// How far a coordinate may be from the one that was meant, metres: what a loader's single
  /// precision rounds. It is told and not part of any bound; 0 where the vertices are what they
  /// are.
  double coordinate_error = 0.0;

  /// What a loader passed over in the file without losing any surface that it could tell, as bytes
  /// behind the last triangle: sentences that begin with the file's name.
  std::vector<std::string> notes = {};
};

/// \throws InvalidGeometry if there is no triangle, an index is out of range or a coordinate is not
///         finite; the message begins with `name` and says which.
void validateMesh(const TriangleMesh& mesh, const std::string& name = "mesh");

/// The mesh moved so that the centre of its axis-aligned bounding box is the origin, and scaled so
/// that the longest side of that box is 1 m. \throws InvalidGeometry if all vertices coincide.
TriangleMesh normalized(const TriangleMesh& mesh);

/// Vertices whose coordinates are equal to the last bit become one, and vertices of no triangle are
/// left out. Formats such as STL store every triangle on its own; only shared vertices tell a
/// closed mesh.
TriangleMesh welded(const TriangleMesh& mesh);

/// FCL's tree over the mesh, ready for queries, for any of FCL's bounding volumes (or one's own).
/// \throws InvalidGeometry as validateMesh(), or if FCL reports a failure.
template <class BV>
std::shared_ptr<fcl::BVHModel<BV>> buildModel(const TriangleMesh& mesh) {
  validateMesh(mesh);
  auto model = std::make_shared<fcl::BVHModel<BV>>();
  const auto check = [](int code, const char* step) {
    if (code != fcl::BVH_OK) {
      throw InvalidGeometry(std::string("FCL refused the mesh: ") + step + " returned " +
                            std::to_string(code));
    }
  };
  check(model->beginModel(static_cast<int>(mesh.triangles.size()),
                          static_cast<int>(mesh.vertices.size())),
        "beginModel");
  check(model->addSubModel(mesh.vertices, mesh.triangles), "addSubModel");
  check(model->endModel(), "endModel");
  model->computeLocalAABB();
  return model;
}

}  // namespace fcl_prob
