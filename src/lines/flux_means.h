// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Means over random lines of their mass and their flux, and what is known of the errors of these.
#pragma once

#include <vector>

#include "lines/motion_flux.h"
#include "lines/part_lines.h"

namespace fcl_prob::detail {

/// Where something touches on a line.
struct FluxEnd {
  std::size_t part;                          ///< of A
  Eigen::Matrix<double, 6, 1> per_velocity;  ///< flux by what the part's velocity is
  double steepness;  ///< one over what the normal has of the directions that move, >= 1
};

struct FluxLine {
  PartLines::Frequency frequency;
  double mass = 0.0;
  std::vector<FluxEnd> ends;
};

/// How fast the points of a part may move in whitened lengths, by one parameter.
struct PartSpeed {
  Eigen::Index parameter;
  double along;   ///< in the directions in which the displacement moves
  double across;  ///< in the others
};

/// One over the mean of |n·u| for a unit vector u of random direction, by its dimension.
inline constexpr double kCrofton[] = {0.0, 1.0, 1.5707963267948966, 2.0};

/// Mean and standard error of P, and of the flux by each parameter.
/// \param speeds  of each part, by those parameters that move it
MeanAndError meansOfLines(const PartLines& drawn, int rank, const std::vector<FluxLine>& lines,
                          const PartVelocities& velocities,
                          const std::vector<std::vector<PartSpeed>>& speeds);

}  // namespace fcl_prob::detail
