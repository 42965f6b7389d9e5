// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What the partition claims of which displacements, so that each claim can be checked by something
// that is not the partition: tests, and whoever reads a certificate.
#pragma once

#include "cells/covered_part.h"
#include "cells/crossing_witness.h"
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
  CoveredPart within;              ///< no planes: all of the cell
  std::optional<NodePair> pair{};  ///< of leaves, which touch everywhere in the set
  std::optional<CrossingProof> crossing{};
};

class ClaimObserver {
 public:
  virtual ~ClaimObserver() = default;

  /// All that follows is about this frame.
  virtual void frame(const Whitening& whitening, const GaussianDisplacement& displacement) = 0;

  virtual void claim(const Claim& claim) = 0;

  /// A cell of which something was claimed is divided: other claims, of its parts, take the place
  /// of those.
  virtual void divided(const Cell& /*cell*/) {}

  /// Whether the claims that stand at the end must account for all that is known of P: excuse() is
  /// of no use then, and what proves its bounds otherwise than by claims is left out.
  virtual bool needsAll() const { return false; }

  /// In the layer { from <= m·y <= to } of the cell contact may be claimed away: its mass is in the
  /// upper bound already.
  virtual void excuse(const Cell& cell, const Eigen::Vector3d& m, double from, double to) = 0;
};

/// Told what queries in this thread claim; null, as it is without tests and certificates, costs
/// nothing.
inline thread_local ClaimObserver* claim_observer = nullptr;

}  // namespace fcl_prob::detail
