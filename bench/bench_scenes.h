// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The benchmark scenes: a mesh beside a rotated copy of itself.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/prepared_scene.h"

namespace fcl_prob::cli {

/// A mesh of longest side 1 m at the identity, and the same mesh with its vertices rotated by 0.7
/// rad about (1, 2, 3), moved along (1, 0.3, 0.2) until the two are `distance` apart.
struct BenchScene {
  std::string name;   ///< "bunny_1cm"
  std::string model;  ///< file below the models folder
  double distance;    ///< metres
  std::optional<double>
      offset;  ///< how far the copy is moved, metres; found by bisection if not set
};

/// bunny, dragon and buddha (5,110, 10,000 and 10,000 triangles), each at 1 cm and at 5 cm.
const std::vector<BenchScene>& benchScenes();

/// Larger meshes of the same shapes, to show how times grow.
const std::vector<BenchScene>& growthScenes();

/// Standard deviations of 1, 3 and 5 cm along rotated axes, zero mean.
GaussianDisplacement benchDisplacement();

/// \param models_folder  holds benchmark/*.obj
/// \param extra_offset   moves the copy further, metres
/// \throws FileError if the model is not there
PreparedScene prepareBenchScene(const BenchScene& scene, const std::string& models_folder,
                                const std::string& bounding_volume, double extra_offset = 0.0);

}  // namespace fcl_prob::cli
