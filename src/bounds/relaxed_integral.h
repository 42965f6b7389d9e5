// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The paper's bound: the normal density relaxed to one dimension, integrated by the divergence
// theorem.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "bounds/tail_mean.h"
#include "convex/c_obstacle.h"
#include "convex/face_set.h"

namespace fcl_prob::detail {

/// ∫_V (2π)^{-3/2} exp(-(n·y)²/2) dy, which is at least the mass of V because (n·y)² <= |y|²
/// (paper, Eq. 9). With F = -(1/4π) erfc(n·y/√2) n, whose divergence is the integrand, the
/// divergence theorem makes it a sum over the faces of V, each in closed form. (The paper prints
/// 1/2π, which is twice too much, and 1 + erf, which differs from -erfc by a constant field without
/// flux.)
struct RelaxedIntegral {
  double value = 0.0;
  double margin = 0.0;  ///< value + margin is above the true integral

  double upper() const { return value + margin; }
};

/// \param faces  of V, whitened
/// \param error  V reaches out of the faces by no more than the image of the unit ball under this
/// \param n      unit; most accurate if n·y >= 0 on V
/// \param work   memory, reused
RelaxedIntegral relaxedIntegral(const FaceSet& faces, const Eigen::Matrix3d& error,
                                const Eigen::Vector3d& n, std::vector<TailValue>& work);

/// The same for the image of a ball, by quadrature over its elliptic sections.
RelaxedIntegral relaxedIntegral(const Ellipsoid& ball, const PairFrame& frame,
                                const Eigen::Vector3d& n);

}  // namespace fcl_prob::detail
