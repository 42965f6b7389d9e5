// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The six benchmark scenes: bunny, dragon and buddha, each 1 cm and 5 cm from a rotated copy of
// itself.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fcl_prob/bounds.h"
#include "fcl_prob/gaussian_displacement.h"
#include "mesh_shapes.h"

namespace fcl_prob_test {

/// Two meshes of longest side 1 m. The rotation of B is in its vertices, so that both poses are
/// pure translations (that of A is the identity). `displacement` is that of A.
struct BenchmarkScene {
  std::string name;  ///< "bunny_1cm", ...
  TriangleMesh a;
  TriangleMesh b;
  fcl::Transform3d pose_a;
  fcl::Transform3d pose_b;
  double distance;  ///< between the meshes at their mean poses, metres
  fcl_prob::GaussianDisplacement displacement;

  /// P of the surface meaning (fcl::collide) from a long run of another implementation: certified
  /// to its numerical error, which is added; `estimate` is good to about 1e-5 relative.
  fcl_prob::Bounds reference;
  double estimate;
};

/// "bunny_1cm", "bunny_5cm", "dragon_1cm", ...
std::vector<std::string> benchmarkSceneNames();

/// The standard deviations 1, 3 and 5 cm along the benchmark's axes.
fcl_prob::GaussianDisplacement benchmarkDisplacement();

/// Prints SKIPPED and returns nothing when the model is not there (see models.h).
std::optional<BenchmarkScene> benchmarkSceneOrSkip(const std::string& name);

}  // namespace fcl_prob_test
