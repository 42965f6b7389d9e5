// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The prior methods on a scene, with a clock.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/prepared_scene.h"
#include "fcl_prob/prior_methods.h"

namespace fcl_prob::cli {

enum class PriorMethod { du_toit_burdick, park, enlargement };

/// "du-toit-burdick", "park", "enlargement"
std::string toString(PriorMethod method);

/// What the spheres are put around.
enum class PriorReach {
  objects,  ///< one sphere around each object
  trees     ///< the nodes of trees of spheres over two meshes
};

struct PriorRun {
  PriorMethod method = PriorMethod::park;
  PriorReach reach = PriorReach::objects;

  /// Of the ellipsoid (enlargement), or δ (trees).
  double confidence = 0.99;

  GeneralPcdVariant variant = GeneralPcdVariant::sum;  ///< trees

  /// "whole objects", "trees, delta 0.99", "95 %"
  std::string budget() const;
};

/// Both methods with spheres, in both reaches, and enlargement, with several budgets.
std::vector<PriorRun> priorRunsOfComparison();

struct PriorAnswer {
  double value = 1.0;           ///< clipped at 1
  std::optional<double> raw;    ///< before that
  std::optional<double> upper;  ///< at least P; not set for approximations
  std::string remark;
  double time_ms = 0.0;
};

/// The geometries of a scene as the prior methods need them; building is not part of the times.
class PriorScene {
 public:
  explicit PriorScene(const PreparedScene& scene);

  /// \param contact  solid: methods that bound the contact of surfaces refuse meshes
  /// \throws what the method throws; UnsupportedGeometry for trees of what is no mesh
  PriorAnswer answer(const PriorRun& run, ContactMeaning contact = ContactMeaning::fcl) const;

 private:
  using SphereTree = std::shared_ptr<const fcl::BVHModel<SphereBv>>;

  PriorAnswer ofObjects(const PriorRun& run) const;
  PriorAnswer ofTrees(const PriorRun& run) const;
  PriorAnswer enlarged(double confidence) const;

  const PreparedScene& scene_;
  Geometry a_;
  Geometry b_;
  SphereTree tree_a_;  ///< null if it is not a mesh
  SphereTree tree_b_;
};

}  // namespace fcl_prob::cli
