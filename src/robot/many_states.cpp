// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/many_states.h"

#include <atomic>
#include <mutex>

#include "base/number_text.h"
#include "base/round_workers.h"
#include "base/stopwatch.h"
#include "base/until_no.h"
#include "fcl_prob/exceptions.h"
#include "robot/interval_with_errors.h"
#include "robot/state_with_errors.h"

namespace fcl_prob::detail {
namespace {

class ManyStates {
 public:
  ManyStates(const Eigen::MatrixXd& states, const ProbabilityRequest& request,
             const StateDecision& decide)
      : states_(states),
        request_(request),
        decide_(decide),
        decisions_(states.cols(), ProbableDecision::undecided) {}

  std::vector<ProbableDecision> run() {
    onThreads(request_.threads, decisions_.size(), [this](std::size_t i) { answer(i); });
    return std::move(decisions_);
  }

 private:
  void answer(std::size_t i) {
    if (cancelled_) return;
    ProbabilityRequest of_one = request_;
    of_one.threads = 1;
    if (request_.time_limit) {
      const double left = *request_.time_limit - clock_.seconds();
      if (!(left > 0.0)) return;
      of_one.time_limit = left;
    }
    if (request_.on_progress) {
      of_one.on_progress = [this](const ProbabilityProgress& progress) { return tell(progress); };
    }
    decisions_[i] = decide_(states_.col(static_cast<Eigen::Index>(i)), of_one);
    ++done_;
    if (request_.on_progress) tell({});
  }

  /// What a state tells of itself says that there is one; how far all are is what counts.
  bool tell(ProbabilityProgress progress) {
    const std::lock_guard<std::mutex> lock(progress_);
    if (cancelled_) return false;
    progress.interval = {0.0, 1.0};
    progress.seconds = clock_.seconds();
    progress.fraction = static_cast<double>(done_) / static_cast<double>(states_.cols());
    if (!request_.on_progress(progress)) cancelled_ = true;
    return !cancelled_;
  }

  const Eigen::MatrixXd& states_;
  const ProbabilityRequest& request_;
  const StateDecision& decide_;
  Stopwatch clock_;
  std::atomic<bool> cancelled_{false};
  std::atomic<std::size_t> done_{0};
  std::mutex progress_;
  std::vector<ProbableDecision> decisions_;
};

ProbableDecision decisionFrom(Decision decision, ProbableDecision below, ProbableDecision above) {
  if (decision == Decision::below) return below;
  return decision == Decision::above ? above : ProbableDecision::undecided;
}

}  // namespace

ProbableDecision certain(Decision decision) {
  return decisionFrom(decision, ProbableDecision::certainly_below,
                      ProbableDecision::certainly_above);
}

void requireChance(double chance_of_error) {
  if (chance_of_error > 0.0 && chance_of_error < 1.0) return;
  throw InvalidRequest("the chance of a wrong decision must be above 0 and below 1, is " +
                       numberText(chance_of_error));
}

std::vector<Eigen::Index> movingRows(const Eigen::MatrixXd& states) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < states.rows(); ++i) {
    if ((states.row(i).array() != states(i, 0)).any()) rows.push_back(i);
  }
  return rows;
}

std::vector<ProbableDecision> manyStates(const Eigen::MatrixXd& states,
                                         const ProbabilityRequest& request,
                                         const StateDecision& decide) {
  return ManyStates(states, request, decide).run();
}

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
      return certain(query.state(values, errors, of_one).decision);
    }
    of_one.method = ProbabilityMethod::automatic;
    of_one.confidence = 1.0 - *chance_of_error;
    return decisionFrom(query.state(values, errors, of_one).decision,
                        ProbableDecision::probably_below, ProbableDecision::probably_above);
  };
  return manyStates(states, ofOneCall(request), decide);
}

}  // namespace fcl_prob::detail
