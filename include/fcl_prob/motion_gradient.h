// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// How the probability of contact changes as bodies move, and the joints that carry them.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "fcl_prob/probability_request.h"
#include "fcl_prob/probability_result.h"

namespace fcl_prob {

/// What the members of a group do while some parameters change, one matrix a member: a column for
/// each parameter, of the velocity of the point of the member that is at the world's origin
/// (metres) and the angular velocity (radians), world frame, per unit of the parameter. The
/// Jacobian of a link with respect to joint values is of this form.
using MemberVelocities = std::vector<Eigen::Matrix<double, 6, Eigen::Dynamic>>;

/// Each member by itself: parameters 6 i to 6 i + 5 move member i along the world's axes (metres)
/// and turn it about axes through the world's origin (radians).
MemberVelocities rigidMotions(std::size_t members);

struct MotionGradientRequest {
  /// Random lines: standard errors go with one over the square root of their number.
  std::size_t lines = 4096;

  std::uint64_t seed = 1;
  unsigned threads = 1;  ///< results do not depend on their number
  ContactMeaning contact = ContactMeaning::fcl;

  /// Seconds after which no more lines are begun.
  std::optional<double> time_limit;

  /// Called now and then from the calling thread; returning false cancels the query, whose result
  /// is that of the lines drawn by then (status `cancelled`). The interval that it is told is
  /// [0, 1]: nothing is certain of an estimate.
  std::function<bool(const ProbabilityProgress&)> on_progress;
};

/// Estimates from random lines through the displacement space, on which all contact is intervals:
/// the mass of these, and what moving them changes. Unbiased up to rounding (curved shapes: 1e-10
/// deviations), not certified.
///
/// Six standard errors hold with a chance of 1 - 1e-6 for each value, however few lines meet what
/// it is of: what a line can add is bounded, and so is what unseen lines may. Of a member that no
/// line has met the gradient is 0 with a standard error of what may have been missed; where that is
/// not known, as of turning planes without end, it is infinite (null in JSON). For meshes the bound
/// takes it that no line has more of a member than one that was seen, or enters and leaves it once.
/// Lines go where members may touch, so that P of 1e-4 and members that touch a thousandth as often
/// as others have gradients, too; where P is near 1 few lines meet a boundary, and standard errors
/// are as large as the values. Where two flat sides face each other exactly P may have a kink in
/// the angles; the gradient is then that of the middle of the touching sides.
struct MotionGradient {
  double probability = 0.0;
  double standard_error = 0.0;
  Eigen::VectorXd gradient;  ///< ∂P by parameter, 1 over the unit of that
  Eigen::VectorXd gradient_standard_error;
  std::size_t lines = 0;  ///< that were drawn: one for a displacement along a line, which tells all

  /// `sampled`, `time_limit` or `cancelled`; `exact` where nothing was to be drawn. What came
  /// before all lines were drawn leaves fewer of them, a few in any case, and larger standard
  /// errors.
  ProbabilityStatus status = ProbabilityStatus::sampled;
};

}  // namespace fcl_prob
