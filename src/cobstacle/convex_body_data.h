// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What a ConvexBody holds.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <variant>

#include "cobstacle/c_obstacle.h"
#include "fcl_prob/convex_body.h"

namespace fcl_prob::detail {

/// The two representations of a convex body that C-obstacles are built from.
struct ConvexBodyData {
  ConvexBodyData(const RoundedZonotope& body, int resolution_of_ball)
      : rounded(body), resolution(resolution_of_ball) {}
  explicit ConvexBodyData(std::unique_ptr<const ConvexSet> body) : set_(std::move(body)) {}

  /// Set for boxes and their roundings, whose C-obstacles have a known structure.
  std::optional<RoundedZonotope> rounded;
  int resolution = 0;

  /// The body as a convex set with its polytopes; made at the first call. Thread-safe.
  const ConvexSet& set() const;

  /// Length of the longest position vector of the body or the polytope around it.
  double size() const;

  /// The body reaches out of its polytope by no more than this (metres): 0 or rounding.
  double slack() const { return rounded ? 0.0 : set().slack(); }

 private:
  mutable std::once_flag once_;
  mutable std::unique_ptr<const ConvexSet> set_;
};

/// The frame of a pair of bodies. \throws InvalidPose if a pose is not finite or not rigid;
/// InvalidGeometry if both are too small to be measured (geometry/validation.h)
PairFrame pairFrame(const ConvexBody& a, const fcl::Transform3d& pose_a, const ConvexBody& b,
                    const fcl::Transform3d& pose_b, const GaussianDisplacement& displacement);

/// The C-obstacle of a pair by the structure that fits it best.
class PairObstacle {
 public:
  PairObstacle(const PairFrame& frame, const ConvexBodyData& a, const ConvexBodyData& b);

  const CObstacle& operator*() const;
  const CObstacle* operator->() const { return &**this; }

 private:
  std::variant<std::monostate, ZonotopeObstacle, ConvexSetObstacle> obstacle_;
};

}  // namespace fcl_prob::detail
