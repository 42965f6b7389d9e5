// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A cell of the partition with what is still open in it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "cells/covered_part.h"
#include "scene/front_pair.h"

namespace fcl_prob::detail {

/// An unresolved cell. `part` of it certainly collides, and has none of what the plane covers.
struct OpenCell {
  /// What its plane tells of it.
  enum class PlaneTells {
    nothing,   ///< there is none
    possible,  ///< nothing below `possible_from` along its normal collides
    covered    ///< that, and that all above the plane collides
  };

  bool hasPlane() const { return tells != PlaneTells::nothing; }
  bool planeCovers() const { return tells == PlaneTells::covered; }

  Cell cell;
  std::vector<FrontPair> front;
  PlaneTells tells = PlaneTells::nothing;
  CellPlane plane;
  CoveredPart part;
  double possible_from = 0.0;
  double lower = 0.0;  ///< certified mass that collides
  double upper = 0.0;  ///< certified mass that may collide
  double drawn = 0.0;  ///< mass of the set from which samples of the open part are drawn

  double gap() const { return upper - lower; }

  /// Bound on the standard deviation of one sample of the open mass: it is drawn from a set of mass
  /// `drawn` and is 0 or that mass, with a mean of at most the gap. Root by root, since products of
  /// small masses vanish; of next to nothing none, since numbers of samples are divided by it.
  double samplingDeviation() const {
    constexpr double kNextToNothing = 1e-300;
    const double mean = std::clamp(gap(), 0.0, 0.5 * drawn);
    if (!(mean > kNextToNothing)) return 0.0;
    return std::sqrt(mean) * std::sqrt(drawn - mean);
  }
  std::size_t memory() const { return sizeof(OpenCell) + front.capacity() * sizeof(FrontPair); }
};

}  // namespace fcl_prob::detail
