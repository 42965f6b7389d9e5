// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Writing coloured triangle meshes as one glTF 2.0 file.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

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

/// The meshes as a binary glTF container (.glb): one file without references to others. Normals are
/// those of the faces, so that edges look like edges.
std::string glbOf(const std::vector<ColouredMesh>& meshes);

}  // namespace fcl_prob::cli
