// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A band around a surface within which the true one lies.
#pragma once

namespace fcl_prob {

/// How far the true shape S' of an object may be from the geometry S that is passed in, metres:
///
/// - every point of S' is within `outward` of some point of S;
/// - S' contains a continuous image f(S) in which no point has moved by more than `inward`:
///   |f(x) - x| <= inward for all x of S.
///
/// Nothing else is assumed: S' may be rough, differ in topology, and be another one at every
/// displacement. A certified interval of a query with bands holds for every pair of such shapes:
/// `upper` rests on the first line, `lower` on the second. The second is what a hole would break: a
/// surface with a gap in it, however narrow, may lie within any distance of the model and touch
/// nothing. What is a solid in S (shapes, octree cells) is deformed as a solid; of a closed mesh
/// that counts as one, the surface is, and what is within it follows.
struct Band {
  double outward = 0.0;
  double inward = 0.0;

  /// "Right to within so much", on both sides.
  static Band within(double distance) { return {distance, distance}; }

  bool isZero() const { return outward == 0.0 && inward == 0.0; }
};

}  // namespace fcl_prob
