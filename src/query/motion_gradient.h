// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// From requests for gradients to lines, and back.
#pragma once

#include <optional>

#include "base/budget.h"
#include "fcl_prob/motion_gradient.h"
#include "lines/motion_flux.h"

namespace fcl_prob::detail {

/// \throws InvalidRequest
void validateVelocities(const MemberVelocities& velocities, std::size_t members);
void validateGradient(const MotionGradientRequest& request);

/// Lines within the limits of a request. The clock starts when this is made.
class LimitedLines {
 public:
  explicit LimitedLines(const MotionGradientRequest& request);

  /// Refers to this object.
  LineDraws draws();

  /// `sampled`, or what stopped the draws.
  ProbabilityStatus status() const { return interruption_.value_or(ProbabilityStatus::sampled); }

 private:
  bool goOn(std::size_t drawn);

  const MotionGradientRequest& request_;
  ProbabilityRequest limits_;
  Budget budget_{limits_};
  std::optional<ProbabilityStatus> interruption_;
};

MotionGradient gradientFrom(const MeanAndError& flux, ProbabilityStatus status);

/// Where nothing can touch.
MotionGradient withoutGradient(Eigen::Index parameters);

}  // namespace fcl_prob::detail
