// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A seven-joint arm beside an obstacle, for the benchmark of joint errors.
#pragma once

#include <string>

#include "cli/geometry.h"
#include "fcl_prob/pose_probability.h"

namespace fcl_prob::cli {

/// The collision meshes of the Fetch robot's arm, gripper included, beside a human arm.
class FetchArm {
 public:
  /// \param models_folder  holds fetch_robot/ and human/
  explicit FetchArm(const std::string& models_folder);

  const ConfigurationQuery& query() const { return query_; }

  /// Independent errors of that standard deviation (radians) in all joints, and of 1 cm in the
  /// position of the human arm, which is so many metres aside from where it touches the wrist.
  RandomJoints configuration(double sigma, double aside) const;

 private:
  FetchArm(std::vector<Geometry> links, Geometry obstacle);

  std::vector<Geometry> links_;
  Geometry obstacle_;
  ConfigurationQuery query_;
};

}  // namespace fcl_prob::cli
