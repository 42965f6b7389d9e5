// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Families of scenes: each goes to an extreme in one or two respects and is ordinary in the others.
#pragma once

#include <string>
#include <vector>

#include "random_mesh.h"
#include "scene.h"

namespace fcl_prob_audit {

/// What scenes of a family are like: chances and ranges.
struct Traits {
  std::vector<Kind> kinds_a, kinds_b;
  MeshStructure mesh;
  std::vector<fcl_prob::ProbabilityMethod> methods;
  double solid = 0.2;      ///< contact = solid
  double gradient = 0.1;   ///< a gradient is asked for
  double on_grid = 0.1;    ///< sizes and positions coincide
  double aligned = 0.2;    ///< poses and axes along the world's
  double by_matrix = 0.1;  ///< the covariance is passed as a matrix
  double with_mean = 0.5;  ///< the mean is not zero
  double threshold = 0.15;
  double near_rotation = 0.0;
  double thin = 0.0;       ///< of primitives: one or two sides to 1e-9
  double occupancy = 0.0;  ///< fields of occupancy other than the defaults
  double smaller = 0.0;    ///< A is much smaller than B, and near the middle of one of its parts
  double least_ratio = 0.02, most_ratio = 3.0;  ///< of deviation to size
  double condition = 1.0;                       ///< decades between the deviations, at most
  std::vector<int> ranks = {3, 3, 3, 3, 3, 3, 2, 2, 1, 1, 0};
  int scale_exponent = 0;  ///< lengths times 2^±this, at most
  int far_exponent = 0;    ///< both objects moved by up to 2^this
};

struct Family {
  std::string name;
  Traits traits;
  Question question = Question::pair;
  bool mixture = false, truncated = false;
  bool limited = false;  ///< all sorts of limits
};

/// Each in turn.
const std::vector<Family>& families();

/// Of scenes that take seconds each: by name only.
const std::vector<Family>& slowFamilies();

}  // namespace fcl_prob_audit
