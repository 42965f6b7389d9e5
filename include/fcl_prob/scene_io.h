// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Two shapes, their poses, a displacement and a request, as a JSON file (docs/scene_format.md).
#pragma once

#include <fcl/geometry/collision_geometry.h>

#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "fcl_prob/band.h"
#include "fcl_prob/gaussian_displacement.h"
#include "fcl_prob/mesh_io.h"
#include "fcl_prob/pose_error.h"
#include "fcl_prob/probability_request.h"

namespace fcl_prob {

/// A mesh that is still in its file, or stands in the scene itself.
struct MeshFile {
  std::string path;
  MeshOptions options;
  std::shared_ptr<const TriangleMesh> given = nullptr;  ///< then nothing else counts

  /// In a process of its own: see loadMeshIsolated(). \throws FileError, InvalidGeometry
  TriangleMesh read() const { return given ? *given : loadMeshIsolated(path, options); }
};

/// One of FCL's primitives: Box, Sphere, Ellipsoid, Capsule, Cone, Cylinder, Halfspace or Plane.
using PrimitiveShape = std::shared_ptr<fcl::CollisionGeometryd>;

struct SceneObject {
  std::variant<MeshFile, PrimitiveShape> shape;
  fcl::Transform3d pose = fcl::Transform3d::Identity();  ///< metres, world frame
  Band band;  ///< metres, after scale and normalisation; of the request, too

  /// Of a reconstructed cloud: `shape` is what was seen, from which lower bounds follow, and this
  /// is what may be there, from which upper bounds follow.
  std::optional<MeshFile> possible = std::nullopt;
  bool possible_is_solid = false;  ///< it is closed, and what is inside it counts

  /// Errors that all of it shares, in its own frame, square metres: to be added to the
  /// displacement.
  Eigen::Matrix3d shared_covariance = Eigen::Matrix3d::Zero();
};

struct Scene {
  SceneObject a;
  SceneObject b;
  GaussianDisplacement displacement;  ///< of A relative to B, metres, world frame

  /// Of A's pose, instead of `displacement`, which then is its translation by itself.
  std::optional<PoseError> pose_error;
  ProbabilityRequest request;  ///< defaults where the file says nothing
};

/// Makes A's pose the one that is random: sets `pose_error` and, for what only knows translations,
/// `displacement`. The pose of A must be set before.
void setPoseError(const PoseError& error, Scene& scene);

/// An occupancy map (.bt, .ot), with its resolution as a band. \throws FileError
SceneObject octomapObject(const std::string& path, bool unknown_is_occupied);

/// What `fcl_prob reconstruct` made of a cloud: its JSON file. The meshes are not read.
/// \throws FileError
SceneObject cloudObject(const std::string& json_path);

/// Adds what the two objects' points share to the displacement. \throws InvalidRequest if the
/// scene has a pose_error
void addSharedErrors(Scene& scene);

/// Reads a scene file. Mesh paths are relative to the folder of the scene file; the meshes
/// themselves are not read. \throws FileError naming the file and the key: not JSON, a key that is
/// unknown, missing or given
///         twice, a value of the wrong kind or out of its range.
Scene loadScene(const std::string& path);

/// Writes a scene file that needs no other one, with whatever is in it as numbers that are read
/// back to the last bit (a covariance to its last digits): for reports of faults. Limits of time
/// and threads, and what is told of loading, are left out. \throws UnsupportedGeometry for
/// occupancy maps and reconstructed clouds; as MeshFile::read()
void writeScene(const Scene& scene, const std::string& description, std::ostream& out);

}  // namespace fcl_prob
