// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Displacements that stay within an ellipsoid: P(contact and inside) / P(inside).
#pragma once

#include "cells/ball_truncation.h"
#include "fcl_prob/mixture.h"
#include "fcl_prob/probability_request.h"
#include "fcl_prob/probability_result.h"

namespace fcl_prob::detail {

/// \throws InvalidRequest, UnsupportedGeometry for what truncated displacements do not have
void validateTruncatedRequest(const ProbabilityRequest& request);

/// One query of a truncated displacement, between the request of its caller and the one that is
/// answered.
class TruncatedQuery {
 public:
  /// \throws as validateTruncatedRequest(); keeps references
  TruncatedQuery(const TruncatedGaussian& displacement, const ProbabilityRequest& request);

  /// Nothing is cut off that could be noticed.
  bool isWhole() const;

  /// A query of P(contact) whose interval ofContact() turns into that of the conditional
  /// probability.
  ProbabilityRequest requestOfContact() const;
  void ofContact(ProbabilityResult& result) const;

  /// The same for a query of P(contact and inside), by a partition of the ball.
  ProbabilityRequest requestOfJoint() const;
  void ofJoint(ProbabilityResult& result) const;
  const BallTruncation& ball() const { return ball_; }

 private:
  Bounds joint(const Bounds& contact) const;
  Bounds conditional(const Bounds& joint) const;
  void makeConditional(const Bounds& of_joint, ProbabilityResult& result) const;

  const TruncatedGaussian& displacement_;
  const ProbabilityRequest& request_;
  BallTruncation ball_;
  BallMass mass_;
};

/// \param answer  of the Gaussian and a request: of P(contact), or of P(contact and inside) where a
///                ball is given
template <class Answer>
ProbabilityResult truncatedAnswer(const TruncatedGaussian& displacement,
                                  const ProbabilityRequest& request, const Answer& answer) {
  const TruncatedQuery truncated(displacement, request);
  ProbabilityResult result;
  if (truncated.isWhole()) {
    result = answer(displacement.gaussian(), truncated.requestOfContact(), nullptr);
    truncated.ofContact(result);
  } else {
    result = answer(displacement.gaussian(), truncated.requestOfJoint(), &truncated.ball());
    truncated.ofJoint(result);
  }
  return result;
}

}  // namespace fcl_prob::detail
