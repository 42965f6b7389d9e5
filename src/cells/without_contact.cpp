// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cells/without_contact.h"

#include "base/decision.h"

namespace fcl_prob::detail {

ProbabilityResult withoutContact(const ProbabilityRequest& request, const std::string& why) {
  ProbabilityResult result;
  const bool automatic = request.method == ProbabilityMethod::automatic;
  result.method = automatic ? ProbabilityMethod::interval : request.method;
  result.status = ProbabilityStatus::exact;
  result.lower = 0.0;
  result.upper = 0.0;
  if (request.method == ProbabilityMethod::estimate) {
    result.estimate = 0.0;
    result.standard_error = 0.0;
  }
  if (request.gradient) {
    result.gradient = result.gradient_lower = result.gradient_upper = Eigen::Vector3d::Zero();
  }
  result.decision = decisionOf({0.0, 0.0}, request);
  result.plan.push_back(why);
  return result;
}

}  // namespace fcl_prob::detail
