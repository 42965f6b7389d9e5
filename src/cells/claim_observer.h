// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// For tests only: what the partition claims of which displacements, so that each claim can be
// checked against something that is not the partition.
#pragma once

#include "cells/covered_part.h"
#include "fcl_prob/gaussian_displacement.h"
#include "fcl_prob/whitening.h"

namespace fcl_prob::detail {

/// One verdict on all of cell ∩ within, a set of points of the whitened frame (its inside: what is
/// on the planes weighs nothing). It holds for the displacements ε = mean + A Rᵀ y with y in that
/// set, in exact arithmetic: A the displacement's axes that move, each times its standard
/// deviation, and R the rotation nearest to W A. Coordinates that do not move are left out.
struct Claim {
  const char* method;  ///< what proves it
  bool collides;       ///< every displacement of the set leads to contact, or none does
  Cell cell;
  CoveredPart within;  ///< no planes: all of the cell
};

class ClaimObserver {
 public:
  virtual ~ClaimObserver() = default;

  /// All that follows is about this frame.
  virtual void frame(const Whitening& whitening, const GaussianDisplacement& displacement) = 0;

  virtual void claim(const Claim& claim) = 0;

  /// In the layer { from <= m·y <= to } of the cell contact may be claimed away: its mass is in the
  /// upper bound already.
  virtual void excuse(const Cell& cell, const Eigen::Vector3d& m, double from, double to) = 0;
};

/// Told what queries in this thread claim; null, as it is outside of tests, costs nothing.
inline thread_local ClaimObserver* claim_observer = nullptr;

}  // namespace fcl_prob::detail
