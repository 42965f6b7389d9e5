// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/decide_with_errors.h"

#include "base/until_no.h"
#include "robot/interval_with_errors.h"
#include "robot/many_states.h"
#include "robot/state_with_errors.h"

namespace fcl_prob::detail {
namespace {

ProbableDecision decisionFrom(Decision decision, ProbableDecision below, ProbableDecision above) {
  if (decision == Decision::below) return below;
  return decision == Decision::above ? above : ProbableDecision::undecided;
}

}  // namespace

std::vector<ProbableDecision> decideWithErrors(const RobotQuery& query,
                                               const Eigen::MatrixXd& states,
                                               const RobotErrors& errors,
                                               const ProbabilityRequest& request,
                                               std::optional<double> chance_of_error) {
  const Eigen::MatrixXd covariance = validCovariance(query.among(), errors);
  const auto decide = [&](const Eigen::VectorXd& values, ProbabilityRequest of_one) {
    const double threshold = *of_one.threshold;
    if (upperWithErrors(query.among(), values, covariance, errors.base, threshold) < threshold) {
      return ProbableDecision::certainly_below;
    }
    if (!chance_of_error) {
      of_one.method = ProbabilityMethod::interval;
      return decisionFrom(query.state(values, errors, of_one).decision,
                          ProbableDecision::certainly_below, ProbableDecision::certainly_above);
    }
    of_one.method = ProbabilityMethod::automatic;
    of_one.confidence = 1.0 - *chance_of_error;
    return decisionFrom(query.state(values, errors, of_one).decision,
                        ProbableDecision::probably_below, ProbableDecision::probably_above);
  };
  return manyStates(states, ofOneCall(request), decide);
}

}  // namespace fcl_prob::detail
