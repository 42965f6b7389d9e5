// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Scenes of errors of poses and joints whose P is known without asking the library.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fcl_prob/pose_probability.h"
#include "quadrature.h"

namespace fcl_prob_judge {

/// What is asked of the library, and an integrand whose mean is P.
struct Component {
  double weight = 1.0;
  std::shared_ptr<const fcl_prob::RandomConfiguration> configuration;
  Integrand truth;
};

/// One pair of geometries with a pose error, for the query of pairs.
struct PairError {
  fcl::Transform3d pose_a, pose_b;
  fcl_prob::PoseError error;
};

struct JudgedScene {
  std::string name;
  fcl_prob::GroupQuery::Geometries a, b;
  std::vector<Component> components;  ///< a mixture if there are several
  std::optional<PairError> pair;      ///< asked instead of the first component's configuration
  double truth = 0.0;                 ///< P

  double roughTruth() const;
  void findTruth();
};

/// A scene with what answers questions about it.
class AskableScene {
 public:
  explicit AskableScene(JudgedScene scene);

  const JudgedScene& scene() const { return scene_; }
  fcl_prob::ProbabilityResult ask(const fcl_prob::ProbabilityRequest& request) const;

 private:
  JudgedScene scene_;
  std::optional<fcl_prob::PreparedPoseQuery> pair_query_;
  std::optional<fcl_prob::ConfigurationQuery> query_;
  std::vector<fcl_prob::ConfigurationQuery::Weighted> mixture_;
};

/// Scenes that were found by trying: a turn of one or two angles decides contact.
std::vector<JudgedScene> knownScenes();

constexpr int kDrawnScenes = 40;

/// One of `kDrawnScenes` for each seed: of all families, the log-odds of P evenly spread between
/// those of 1e-4 and of 0.9999.
JudgedScene drawnScene(unsigned seed, int index);

}  // namespace fcl_prob_judge
