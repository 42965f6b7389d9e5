// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Masses of solid parts by products of Gauss-Legendre rules with a proven bound on their error.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "base/constants.h"
#include "mass/solid_part.h"

namespace fcl_prob::detail {

/// A mass and a first moment ∫ y φ dy with bounds on their errors (of the moment: its length).
struct SolidSum {
  double mass = 0.0, error = 0.0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  double moment_error = 0.0;
};

/// What a cubature may cost and leave.
struct CubatureLimits {
  double tolerance;        ///< of a rule in one parameter, absolute
  std::size_t most_cells;  ///< of all parts; what is left then counts as error
};

/// Adds parts up. With Q = Q₀ Q₁ Q₂ the product of three rules and I that of the integrals, I - Q =
/// (I₀ - Q₀) I₁ I₂ + Q₀ (I₁ - Q₁) I₂ + Q₀ Q₁ (I₂ - Q₂), and the weights of a rule are positive and
/// add up to its length: so the error is no more than the sum over the parameters of the error of
/// one rule (gaussErrorBound()) for the largest integrand that the other two allow, times their
/// lengths. Where too many points would be needed a box is halved; there is no iteration to
/// converge.
class PartCubature {
 public:
  explicit PartCubature(const CubatureLimits& limits) : limits_(limits) {}

  void add(const AnyPart& part);

  /// Leaves off: nothing is known of the other parts.
  void leave() { sum_.error = sum_.moment_error = kInfinity; }

  const SolidSum& sum() const { return sum_; }

  /// Whether boxes were left because there were too many.
  bool exhausted() const { return cells_ >= limits_.most_cells; }

 private:
  template <class Part>
  void addPart(const Part& part);
  template <class Part>
  void addBox(const Part& part, const ParameterBox& box, int depth);

  CubatureLimits limits_;
  std::size_t cells_ = 0;
  std::array<std::size_t, 3> guess_{5, 5, 5};  ///< of ellipses
  SolidSum part_sum_, sum_;
};

/// About what parts weigh together, or up to ten times less: nothing is certain of it.
double roughMass(const std::vector<AnyPart>& parts);

}  // namespace fcl_prob::detail
