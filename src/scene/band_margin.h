// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What the bands around two shapes, and the sweeps of their parts, do to their C-obstacle.
#pragma once

#include <Eigen/Core>

#include "convex/slab_kernels.h"
#include "scene/swept_parts.h"
#include "scene/whitened_tree.h"

namespace fcl_prob::detail {

/// The C-obstacle of two convex pieces whose points move, continuously, by up to d_a and d_b lies
/// within V ⊕ ball(d_a + d_b), and it contains V ⊖ ball(d_a + d_b), whatever the movements: for y
/// in the latter, v ↦ v - F(s(v)) maps that ball into itself, F being the displaced differences
/// b - a - y and s a continuous choice of points of the two pieces whose difference is y + v
/// (Brouwer). Both are exact along the normals of V's slabs. Sweeps move the slabs outwards by what
/// depends on the pair and on the direction; what lies within counts as V, which is larger then.
class BandMargin {
 public:
  /// \param outward, inward  those of both shapes added up, metres
  /// \param whitening        W
  BandMargin(double outward, double inward, const Eigen::Matrix3d& whitening)
      : outward_(outward), inward_(inward), metres_(whitening.transpose()) {}

  /// Of sweeps only.
  BandMargin(const PartitionObject& a, const PartitionObject& b, const Eigen::Matrix3d& whitening)
      : outward_(0.0), inward_(0.0), metres_(whitening.transpose()), of_a_(a), of_b_(b) {}

  /// Whether it is all of sweeps: there is nothing between inside and outside then.
  bool isOfSweeps() const { return !of_a_.isEmpty() || !of_b_.isEmpty(); }

  /// By how much the C-obstacle of two nodes grows along a whitened direction (any length), rounded
  /// up.
  double outwardAlong(const Eigen::Vector3d& m, NodePair nodes) const;

  /// By how much it shrinks: sweeps do not make it smaller.
  double inwardAlong(const Eigen::Vector3d& m) const { return inward_ * lengthOf(m); }

  /// A displacement that moves two nodes about as far along a whitened direction as any does.
  Eigen::Vector3d wayAlong(const Eigen::Vector3d& m, NodePair nodes) const;

  /// Moves the slabs of two leaves outwards, and adds to their margins what the inside shrinks by.
  void widen(double* data, int count, NodePair leaves) const;

  /// How thick what it leaves open is along a whitened direction.
  double thicknessAlong(const Eigen::Vector3d& m) const {
    return (outward_ + inward_) * lengthOf(m);
  }

 private:
  double lengthOf(const Eigen::Vector3d& m) const { return (1.0 + 1e-12) * (metres_ * m).norm(); }

  double outward_;
  double inward_;
  Eigen::Matrix3d metres_;  ///< maps normals in the whitened frame to normals in metres
  SweptParts of_a_;
  SweptParts of_b_;
};

}  // namespace fcl_prob::detail
