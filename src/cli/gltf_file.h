// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Writing coloured triangle meshes as one glTF 2.0 file.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/gltf_container.h"
#include "fcl_prob/triangle_mesh.h"

namespace fcl_prob::cli {

/// Red, green, blue (linear) and opacity, each 0 to 1.
using Colour = Eigen::Vector4f;

/// A mesh in the world frame with a colour for each of its vertices.
struct ColouredMesh {
  std::string name;
  TriangleMesh mesh;
  std::vector<Colour> colours;
};

/// The meshes as one file without references to others. Normals are those of the faces, so that
/// edges look like edges.
std::string gltfOf(const std::vector<ColouredMesh>& meshes, GltfForm form);

/// A mesh of one colour at a pose of its own.
struct PlacedMesh {
  std::string name;
  std::shared_ptr<const TriangleMesh> mesh;  ///< in its own frame; what shares it is written once
  Colour colour;
  fcl::Transform3d pose = fcl::Transform3d::Identity();  ///< metres, world frame
  std::vector<fcl::Transform3d> path = {};  ///< at the times of the animation; empty: it stays
};

/// Meshes that a viewer shows or hides together.
struct MeshGroup {
  std::string name;
  std::vector<PlacedMesh> members;
  nlohmann::ordered_json notes = nullptr;  ///< for programs: the `extras` of its node
};

struct AnimatedScene {
  std::vector<MeshGroup> groups;
  std::vector<double> times = {};  ///< seconds, increasing from 0; empty: nothing moves
};

/// The same of a scene in which things move, linearly between the times.
std::string gltfOf(const AnimatedScene& scene, GltfForm form);

}  // namespace fcl_prob::cli
