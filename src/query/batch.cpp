// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/batch.h"

#include <mutex>
#include <string>
#include <variant>

#include "base/round_workers.h"
#include "fcl_prob/combined_bounds.h"
#include "fcl_prob/exceptions.h"
#include "geometry/validation.h"
#include "query/truncation.h"

namespace fcl_prob {
namespace {

class Batch {
 public:
  Batch(const PreparedQuery& query, const std::vector<Waypoint>& waypoints,
        const BatchRequest& request)
      : query_(query), waypoints_(waypoints), request_(request), of_one_(request.query) {
    // Looked at by a running query now and then, so that a long one ends soon.
    of_one_.on_progress = [this](const ProbabilityProgress&) { return !cancelled(); };
    of_one_.threads = 1;
    result_.waypoints.resize(waypoints.size());
  }

  BatchResult run() {
    detail::onThreads(request_.query.threads, waypoints_.size(), [this](std::size_t i) {
      if (!cancelled()) answer(i);
    });
    result_.cancelled = result_.done < waypoints_.size();
    result_.path = pathBounds();
    return std::move(result_);
  }

 private:
  bool cancelled() const {
    return stopped_.cancelled() || (request_.cancellation && request_.cancellation->cancelled());
  }

  void answer(std::size_t i) {
    const Waypoint& at = waypoints_[i];
    ProbabilityResult result;
    if (const auto* gaussian = std::get_if<GaussianDisplacement>(&at.displacement)) {
      query_.collisionProbability(at.pose_a, at.pose_b, *gaussian, of_one_, result);
    } else if (const auto* mixture = std::get_if<GaussianMixture>(&at.displacement)) {
      collisionProbability(query_, at.pose_a, at.pose_b, *mixture, of_one_, result);
    } else {
      collisionProbability(query_, at.pose_a, at.pose_b,
                           std::get<TruncatedGaussian>(at.displacement), of_one_, result);
    }
    if (result.status == ProbabilityStatus::cancelled) return;
    result_.waypoints[i] = std::move(result);
    report();
  }

  void report() {
    const std::lock_guard<std::mutex> lock(progress_);
    ++result_.done;
    if (!request_.on_progress || stopped_.cancelled()) return;
    if (!request_.on_progress({result_.done, waypoints_.size()})) stopped_.cancel();
  }

  Bounds pathBounds() const {
    std::vector<Bounds> all;
    all.reserve(result_.waypoints.size());
    for (const auto& waypoint : result_.waypoints) {
      all.push_back(waypoint ? Bounds{waypoint->lower.value_or(0.0), waypoint->upper.value_or(1.0)}
                             : Bounds{0.0, 1.0});
    }
    return anyOf(all);
  }

  const PreparedQuery& query_;
  const std::vector<Waypoint>& waypoints_;
  const BatchRequest& request_;
  ProbabilityRequest of_one_;
  CancellationToken stopped_;  ///< by on_progress
  std::mutex progress_;
  BatchResult result_;
};

}  // namespace

BatchResult collisionProbabilities(const PreparedQuery& query,
                                   const std::vector<Waypoint>& waypoints,
                                   const BatchRequest& request) {
  validateRequest(request.query);
  if (request.query.on_progress) {
    throw InvalidRequest("query.on_progress is set: a batch reports by its own on_progress");
  }
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    const std::string at = " at waypoint " + std::to_string(i);
    detail::validatePose(waypoints[i].pose_a, "object A" + at);
    detail::validatePose(waypoints[i].pose_b, "object B" + at);
    if (std::holds_alternative<TruncatedGaussian>(waypoints[i].displacement)) {
      detail::validateTruncatedRequest(request.query);
    }
  }
  return Batch(query, waypoints, request).run();
}

}  // namespace fcl_prob
