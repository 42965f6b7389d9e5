// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A displacement that stays within an ellipsoid: a ball of the whitened frame.
#pragma once

#include <vector>

#include "cells/cell_examiner.h"

namespace fcl_prob::detail {

/// Counts only what is in { |y| <= radius }; what is left out is not renormalised.
class BallTruncation {
 public:
  explicit BallTruncation(double radius) : radius_(radius) {}

  double radius() const { return radius_; }

  bool missesBall(const Cell& cell) const;
  bool isInBall(const Cell& cell) const;

  /// What an examination of `cell`, which the sphere cuts, says of the part within the ball. It
  /// stays open until its mass hardly matters; nothing of it is settled but what is free.
  Examination truncated(const Cell& cell, const std::vector<FrontPair>& inherited,
                        Examination&& whole) const;

  /// Certified mass of cell ∩ ball, between two half-spaces.
  Bounds massInBall(const Cell& cell) const;

 private:
  double radius_;
};

/// Mass of the ball { |y| <= radius } under N(0, I) in `rank` dimensions, and that of its
/// complement: certified, either keeps its relative accuracy.
struct BallMass {
  Bounds inside;
  Bounds outside;
};
BallMass ballMass(double radius, int rank);

}  // namespace fcl_prob::detail
