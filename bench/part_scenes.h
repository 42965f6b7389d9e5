// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Robot parts and a can beside a human arm, or anything else, scenes at random.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/fcl_loop.h"
#include "bench/uniforms.h"
#include "cli/prepared_scene.h"

namespace fcl_prob::cli {

struct PartScene {
  std::unique_ptr<PreparedScene> scene;
  FclLoop loop;  ///< of 10,000
};

/// Of 2,000 triangles. \throws FileError if it is not there
TriangleMesh armMesh(const std::string& models_folder);

/// Draws one after another, fixed by a seed: parts at random poses 2 to 80 mm from something;
/// standard deviations of 10 to 50 mm along random axes; P of at least 1e-3.
class PartScenes {
 public:
  /// \throws FileError if a model is not there
  PartScenes(const std::string& models_folder, std::uint64_t seed, TriangleMesh beside);

  /// Six parts of a Fetch, and a can.
  static const std::vector<std::string>& names();

  /// Of the part of that index.
  PartScene next(std::size_t part);

 private:
  std::uint64_t seed_;
  Uniforms random_;
  std::size_t drawn_ = 0;
  std::vector<TriangleMesh> meshes_;
  std::vector<Geometry> geometries_;
  TriangleMesh beside_mesh_;
  Geometry beside_;
};

}  // namespace fcl_prob::cli
