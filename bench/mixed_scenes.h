// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Pairs of meshes as users have them: any two things, of any size, beside errors of centimetres.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "bench/fcl_loop.h"
#include "bench/uniforms.h"
#include "cli/prepared_scene.h"

namespace fcl_prob::cli {

/// Of the box around its vertices, along the axes.
double longestSide(const TriangleMesh& mesh);

struct MixedScene {
  std::string name;   ///< "wingnut 0.021 m, Head 0.35 m"
  double small_size;  ///< longest side of the smaller one over the largest deviation
  bool is_convex;     ///< one of the two is nearly convex
  std::unique_ptr<PreparedScene> scene;
  FclLoop loop;  ///< of 10,000
};

/// Draws one after another, fixed by a seed: CAD parts, cans, links of two robots, statues and
/// people, each scaled such that its longest side is 1 cm to 1 m (logarithms uniform), turned at
/// random; largest deviations of 2 to 50 mm, the others smaller by up to 6; 0.1 to 2.5 of the
/// largest apart; P of 1e-3 at least. None that is drawn is left out otherwise.
class MixedScenes {
 public:
  /// \throws FileError if a model is not there
  MixedScenes(const std::string& models_folder, std::uint64_t seed);

  MixedScene next();

 private:
  const TriangleMesh& mesh(const std::string& file);
  TriangleMesh drawnMesh(std::string& name);

  std::string models_folder_;
  std::uint64_t seed_;
  Uniforms random_;
  std::map<std::string, TriangleMesh> meshes_;
};

}  // namespace fcl_prob::cli
