// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A scene that is ready to be queried, and queries with a clock.
#pragma once

#include <iosfwd>
#include <memory>
#include <string>

#include "cli/geometry.h"
#include "cli/nominal_answer.h"
#include "cli/parts_scene.h"
#include "cli/tree_pair.h"
#include "fcl_prob/collision_probability.h"
#include "fcl_prob/pose_probability.h"

namespace fcl_prob::cli {

/// A result and how long it took.
struct TimedResult {
  ProbabilityResult result;
  double time_ms = 0.0;
};

/// Loads the objects of a scene, builds their trees and prepares the query.
class PreparedScene {
 public:
  /// \param bounding_volume  one of boundingVolumeNames()
  /// \param parts            decomposes the meshes, and answers with their parts only
  /// \throws what the loader, the trees and the query throw
  PreparedScene(const Scene& scene, const std::string& bounding_volume,
                PartsUse parts = PartsUse::none);

  /// The same for objects that are loaded already.
  PreparedScene(LoadedObject a, LoadedObject b, const GaussianDisplacement& displacement,
                const std::string& bounding_volume, PartsUse parts = PartsUse::none,
                const std::optional<PoseError>& pose_error = std::nullopt);

  /// The query alone, without loading and building.
  /// \throws InvalidRequest if the bounding volume is not FCL's and the method not general-pcd
  TimedResult query(const ProbabilityRequest& request) const;

  /// The same as an interval with its certificate: see certifiedProbability().
  /// \throws InvalidRequest for parts, own volumes, errors of poses and reconstructed clouds
  TimedResult certified(const ProbabilityRequest& request, std::ostream& certificate) const;

  /// Building the trees and preparing the query, milliseconds.
  double buildTime() const { return build_ms_; }

  /// FCL's own answer with A at its mean displacement.
  NominalAnswer nominal() const;

  const LoadedObject& objectA() const { return a_; }
  const LoadedObject& objectB() const { return b_; }
  const GaussianDisplacement& displacement() const { return displacement_; }

  /// Of A's pose, where it is more than a displacement.
  const std::optional<PoseError>& poseError() const { return pose_error_; }

 private:
  /// What the loader passed over, and what it rounded where that is not small beside the standard
  /// deviations and the tolerance.
  std::vector<std::string> importNotes(const ProbabilityRequest& request,
                                       const ProbabilityResult& result) const;

  void addImportNotes(const ProbabilityRequest& request, ProbabilityResult& result) const;

  /// Lower bounds by what was seen, upper ones by what may be there.
  ProbabilityResult betweenTwo(const ProbabilityRequest& request) const;

  ProbabilityResult boundByOwnTrees(const ProbabilityRequest& request) const;

  LoadedObject a_;
  LoadedObject b_;
  GaussianDisplacement displacement_;
  std::optional<PoseError> pose_error_;
  double build_ms_ = 0.0;
  Geometry geometry_a_;  ///< null where only own trees or parts are needed
  Geometry geometry_b_;
  bool measures_distance_ = false;  ///< fcl::distance can walk their trees
  std::unique_ptr<PreparedQuery> query_;
  std::unique_ptr<PreparedPoseQuery> pose_query_;  ///< instead, with a pose error
  std::unique_ptr<PreparedQuery> possible_query_;  ///< besides, where a cloud is among the objects
  TreePair own_trees_;                             ///< of bounding volumes that FCL does not have
  std::unique_ptr<PartsScene> parts_;
  PartsUse use_of_parts_;
};

/// A limit came before what was asked for; the result is valid all the same.
bool stoppedByLimit(ProbabilityStatus status);

}  // namespace fcl_prob::cli
