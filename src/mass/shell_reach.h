// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// How far a convex body reaches out of a closed surface through some of its points.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "mass/long_polytope.h"

namespace fcl_prob::detail {

using LongPoints = std::vector<LongVector3>;

/// The hull of all differences b - a + origin of two sets of points.
struct DifferenceBody {
  LongPoints of_b, minus_a;
  LongVector3 origin;

  /// The largest n·y.
  long double reach(const LongVector3& direction) const;
};

/// A convex body V and a closed surface S through points of it, both as seen from a point c within:
/// for every y in V the way from c meets S at c + λ(y - c) or later, 1/λ - 1 being the share. So S
/// goes once around all of c + λ(V - c); the rest of V is the shell. There S goes around a point
/// once or not at all, but for once more or less at each triangle that is not seen from c, where S
/// folds over: slivers of ties.
class ShellReach {
 public:
  /// \param rounding  of a point along each axis; all arguments outlive this
  ShellReach(const LongPolytope& surface, const LongVector3& middle,
             const Eigen::Vector3d& rounding);

  /// Along a normal n a face is exceeded by V no more than the largest n·y tells. Nothing if it is
  /// not a share of a body of some height.
  std::optional<double> share(const DifferenceBody& body);

  /// No less than what the shell weighs under N(0, I) before and behind triangles that may fold.
  double foldMass(double share) const;

 private:
  struct Triangle {
    LongVector3 p, q, r;  ///< from the middle
  };

  long double shareAlong(std::size_t f, std::size_t g) const;
  double foldMass(const Triangle& triangle, double share) const;
  long double roundingOfVolume(const Triangle& triangle) const;
  LongVector3 fromMiddle(int vertex) const;

  const LongPolytope& surface_;
  const LongVector3& middle_;
  LongVector3 rounding_;
  std::vector<long double> reach_;  ///< of V along the normal of each face
};

}  // namespace fcl_prob::detail
