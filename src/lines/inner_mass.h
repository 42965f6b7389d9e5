// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What lines along the first axis have of a convex mesh, put to one point of the other one.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lines/node_spans.h"
#include "scene/whitened_fan.h"

namespace fcl_prob::detail {

class InnerMass {
 public:
  /// Keeps a reference to the fan.
  explicit InnerMass(const WhitenedFan& fan);

  /// A part of what one line has of P put to a point, nearly all of it; lo > hi: nothing. Certain.
  LineSpan on(const Eigen::Vector2d& u, const Eigen::Vector3d& point) const;

 private:
  double leftOf(int face, const Eigen::Vector3d& from) const;

  /// Faces at which lines enter P, or leave it: where the line at u = 0 does, with P put to 0, and
  /// how much later beside it.
  struct Ends {
    Eigen::ArrayXd at, first, second;
  };

  Ends endsOf(double sign) const;

  const WhitenedFan& fan_;
  Ends entries_, exits_;
  std::vector<int> along_;  ///< faces that are neither
};

}  // namespace fcl_prob::detail
