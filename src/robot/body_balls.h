// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Bodies that are too far away to matter, told by balls around them.
#pragma once

#include "fcl_prob/robot_query.h"
#include "query/prepared_geometry.h"

namespace fcl_prob::detail {

struct Ball {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< metres
  double radius = 0.0;  ///< < 0: there is nothing; infinite: it has no end

  Ball placed(const fcl::Transform3d& pose) const;

  /// Around this one and another one in the same frame.
  Ball with(const Ball& other) const;
};

/// Around all of a geometry, in its own frame; widened by what computing it rounds.
Ball ballAround(const PreparedGeometry& geometry);

/// Certainly not below P(body ∩ obstacle ≠ ∅) where the obstacle moves by `displacement`: the
/// balls would have to meet, which they do not beyond a plane between them.
double farContactUpper(const Ball& body, const Ball& obstacle, const Displacement& displacement);

}  // namespace fcl_prob::detail
