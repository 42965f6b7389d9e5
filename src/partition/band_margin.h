// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What the bands around two shapes, and the sweeps of their parts, do to their C-obstacle.
#pragma once

#include <Eigen/Core>

#include "partition/open_cell.h"
#include "partition/slab_kernels.h"
#include "partition/swept_parts.h"

namespace fcl_prob::detail {

/// The C-obstacle of two convex pieces whose points move, continuously, by up to d_a and d_b lies
/// within V ⊕ ball(d_a + d_b), and it contains V ⊖ ball(d_a + d_b), whatever the movements: for y
/// in the latter, v ↦ v - F(s(v)) maps that ball into itself, F being the displaced differences
/// b - a - y and s a continuous choice of points of the two pieces whose difference is y + v
/// (Brouwer). Both are exact along the normals of V's slabs. Sweeps are bands outwards whose width
/// depends on the pair and on the direction.
class BandMargin {
 public:
  /// \param outward, inward  those of both shapes added up, metres
  /// \param whitening        W
  BandMargin(double outward, double inward, const Eigen::Matrix3d& whitening)
      : outward_(outward), inward_(inward), metres_(whitening.transpose()) {}

  /// Of sweeps only.
  BandMargin(const PartitionObject& a, const PartitionObject& b, const Eigen::Matrix3d& whitening)
      : outward_(0.0), inward_(0.0), metres_(whitening.transpose()), of_a_(a), of_b_(b) {}

  /// Whether it is all of sweeps, which whoever asks can make shorter.
  bool isOfSweeps() const { return !of_a_.isEmpty() || !of_b_.isEmpty(); }

  /// By how much the C-obstacle of two nodes grows along a whitened direction (any length), rounded
  /// up.
  double outwardAlong(const Eigen::Vector3d& m, NodePair nodes) const;

  /// By how much it shrinks: sweeps do not make it smaller.
  double inwardAlong(const Eigen::Vector3d& m) const { return inward_ * lengthOf(m); }

  /// Moves the slabs of two leaves outwards, and adds to their margins what the inside shrinks by.
  void widen(double* data, int count, NodePair leaves) const;

  /// Whether dividing an open cell would hardly settle more of it: it is small beside the band, or
  /// what is open of it is a layer hardly thicker than that. Steers; no bound depends on it.
  bool isAllThatIsLeft(const OpenCell& open) const;

 private:
  double lengthOf(const Eigen::Vector3d& m) const { return (1.0 + 1e-12) * (metres_ * m).norm(); }
  double thicknessAlong(const Eigen::Vector3d& m, const OpenCell& open) const;

  double outward_;
  double inward_;
  Eigen::Matrix3d metres_;  ///< maps normals in the whitened frame to normals in metres
  SweptParts of_a_;
  SweptParts of_b_;
};

}  // namespace fcl_prob::detail
