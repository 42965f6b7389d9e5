// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A scene's objects as convex parts.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/geometry.h"
#include "fcl_prob/part_tree.h"
#include "fcl_prob/parts_bounds.h"
#include "fcl_prob/probability_request.h"
#include "fcl_prob/probability_result.h"

namespace fcl_prob::cli {

/// What convex parts are used for.
enum class PartsUse {
  none,
  leaves,  ///< at the leaves of general-pcd's trees: --leaves parts
  bounds   ///< method parts-bounds: Hunter's and Bonferroni's
};

/// The method that is not one of ProbabilityMethod.
inline constexpr const char* kPartsBounds = "parts-bounds";

/// Decomposes the meshes of a scene once, and bounds with their parts.
class PartsScene {
 public:
  /// \param bounding_volume  of the trees: one of boundingVolumeNames()
  /// \throws UnsupportedGeometry for what is neither a mesh nor a bounded convex shape
  PartsScene(const LoadedObject& a, const LoadedObject& b, const GaussianDisplacement& displacement,
             const std::string& bounding_volume);

  /// \throws UnsupportedGeometry where solids count, or (leaves) for what is no mesh;
  /// InvalidRequest for a method that has no leaves
  ProbabilityResult answer(PartsUse use, const ProbabilityRequest& request) const;

 private:
  struct Object {
    Object(const LoadedObject& object, PartVolume volume);

    std::vector<ConvexBody> bodies;
    std::optional<PartTree> tree;  ///< of a mesh
    bool covers_solid = true;      ///< the bodies contain the inside of the object, too
    fcl::Transform3d pose;
  };

  ProbabilityResult sum(const ProbabilityRequest& request) const;
  ProbabilityResult bothSides(const ProbabilityRequest& request) const;

  GaussianDisplacement displacement_;
  Object a_;
  Object b_;
};

/// \throws InvalidRequest if there is no such bounding volume
PartVolume partVolumeFromString(const std::string& bounding_volume);

}  // namespace fcl_prob::cli
