// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What bench cloud asks about: a gripper's finger beside an object that a depth sensor sees.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/uniforms.h"
#include "cli/geometry.h"
#include "fcl_prob/collision_probability.h"
#include "fcl_prob/gaussian_displacement.h"
#include "fcl_prob/reconstruction.h"
#include "fcl_prob/triangle_mesh.h"

namespace fcl_prob::cli {

struct NamedMesh {
  std::string name;
  TriangleMesh mesh;  ///< about the origin
};

/// Bunny, mug and a human arm; the mug is made here.
std::vector<NamedMesh> seenObjects(const std::filesystem::path& models);

/// A finger of the Fetch robot's gripper, about the origin.
Geometry gripperFinger(const std::filesystem::path& models);

/// An object in the sensor's frame, and a finger beside it.
struct CloudScene {
  TriangleMesh object;
  fcl::Transform3d finger_pose = fcl::Transform3d::Identity();
  GaussianDisplacement displacement;
};

/// The mesh turned at random at a depth (metres), and a finger beside it on the sensor's side.
CloudScene randomCloudScene(const TriangleMesh& mesh, const Geometry& finger, double depth,
                            Uniforms& random);

/// Where the finger is `gap` (metres) away from the object, from `place` towards `direction`.
Eigen::Vector3d besideObject(const Geometry& finger, const Eigen::Matrix3d& turn,
                             const Geometry& object, const Eigen::Vector3d& place,
                             const Eigen::Vector3d& direction, double gap);

struct CloudAnswer {
  Bounds interval;
  double tree_ms = 0.0;
  double query_ms = 0.0;
};

/// A certified interval for the finger and a mesh.
CloudAnswer askMesh(const Geometry& finger, const fcl::Transform3d& pose,
                    const GaussianDisplacement& displacement, const TriangleMesh& mesh,
                    const ProbabilityRequest& request);

/// Lower bound by the surface, upper bound by the obstacle; what these meshes leave open is not
/// worth many cells.
CloudAnswer askReconstruction(const Geometry& finger, const fcl::Transform3d& pose,
                              const GaussianDisplacement& displacement,
                              const Reconstruction& reconstruction);

}  // namespace fcl_prob::cli
