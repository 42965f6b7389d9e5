// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The estimate where convex meshes are taken whole: a mean over lines.
#pragma once

#include <cstddef>
#include <optional>

#include "base/budget.h"
#include "fcl_prob/bounds.h"
#include "fcl_prob/probability_request.h"
#include "fcl_prob/probability_result.h"
#include "lines/whole_body_lines.h"

namespace fcl_prob::detail {

struct LineEstimate {
  double value = 0.0;
  double standard_error = 0.0;
  double upper = 1.0;  ///< certain
  std::size_t lines = 0;
  std::size_t columns = 0;
  ProbabilityStatus status = ProbabilityStatus::converged;
};

/// P, as the mean over lines along the first axis of what they have of collisions: one of three
/// dimensions is exact, and over the other two the mean is of a function that is mostly smooth. The
/// space is divided into columns where a bound says that it matters; of each a few lines are drawn,
/// whose differences give the standard error. Nothing where more columns would be needed than pay.
std::optional<LineEstimate> lineEstimate(WholeBodyLines& lines, const ProbabilityRequest& request,
                                         Budget& budget);

}  // namespace fcl_prob::detail
