// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// From a scene's objects to geometries that can be queried.
#pragma once

#include <fcl/geometry/collision_geometry.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fcl_prob/scene_io.h"

namespace fcl_prob::cli {

using Geometry = std::shared_ptr<const fcl::CollisionGeometryd>;

/// The names that --bv takes: FCL's "obb", "aabb", ..., and ownVolumeNames().
const std::vector<std::string>& boundingVolumeNames();

/// The tree over `mesh` with FCL's bounding volumes of that name. \throws InvalidRequest,
/// InvalidGeometry
Geometry buildTree(const TriangleMesh& mesh, const std::string& bounding_volume);

/// An object whose file has been read; its tree is still to be built if it is a mesh.
struct LoadedObject {
  std::variant<TriangleMesh, PrimitiveShape> shape;
  fcl::Transform3d pose;

  /// See SceneObject.
  std::optional<TriangleMesh> possible = std::nullopt;
  bool possible_is_solid = false;
};

/// Reads the mesh file in a child process (see loadMeshIsolated()). \throws FileError,
/// InvalidGeometry
LoadedObject loadObject(const SceneObject& object);

/// The primitive itself, or the tree over the mesh.
Geometry buildGeometry(const LoadedObject& object, const std::string& bounding_volume);

}  // namespace fcl_prob::cli
