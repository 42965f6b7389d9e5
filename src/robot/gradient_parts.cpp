// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/gradient_parts.h"

#include <algorithm>

namespace fcl_prob::detail {
namespace {

// A time limit must be above 0.
constexpr double kLeastSeconds = 1e-6;

}  // namespace

MotionGradientRequest GradientParts::requestOf(std::size_t index) {
  MotionGradientRequest part = whole_;
  if (whole_.time_limit) {
    const double share =
        (*whole_.time_limit - watch_.seconds()) / static_cast<double>(count_ - index);
    part.time_limit = std::max(share, kLeastSeconds);
  }
  if (whole_.on_progress) {
    part.on_progress = [this, index](const ProbabilityProgress& progress) {
      return goOn(index, progress);
    };
  }
  return part;
}

bool GradientParts::goOn(std::size_t index, ProbabilityProgress progress) {
  if (cancelled_) return false;
  progress.fraction =
      (static_cast<double>(index) + progress.fraction) / static_cast<double>(count_);
  progress.seconds = watch_.seconds();
  cancelled_ = !whole_.on_progress(progress);
  return !cancelled_;
}

ProbabilityStatus statusOfBoth(ProbabilityStatus one, ProbabilityStatus other) {
  for (const ProbabilityStatus status :
       {ProbabilityStatus::cancelled, ProbabilityStatus::time_limit, ProbabilityStatus::sampled}) {
    if (one == status || other == status) return status;
  }
  return other;
}

}  // namespace fcl_prob::detail
