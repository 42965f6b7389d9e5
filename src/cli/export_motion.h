// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// fcl_prob export of a robot's scene.
#pragma once

#include <optional>
#include <string>

#include "cli/gltf_container.h"

namespace fcl_prob::cli {

struct MotionExportArguments {
  std::string scene;
  std::string motion;  ///< file of waypoints in place of the scene's; empty: none
  std::optional<double> largest_step;
  std::size_t poses = 5;
  bool still = false;
  bool allow_outside_limits = false;
  std::string output;
  GltfForm form = GltfForm::binary;
};

/// Whether the file is a scene of a robot. \throws FileError if it cannot be read or is not JSON
bool isRobotScene(const std::string& path);

/// Writes the glTF file. \returns the exit code
int exportMotion(const MotionExportArguments& arguments);

}  // namespace fcl_prob::cli
