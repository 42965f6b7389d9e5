// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/batch.h"

#include <tbb/blocked_range.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <mutex>
#include <string>
#include <variant>

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
    if (request_.query.threads == 1) {
      for (std::size_t i = 0; i < waypoints_.size() && !cancelled(); ++i) answer(i);
    } else {
      tbb::task_arena arena(static_cast<int>(std::min(
          request_.query.threads, static_cast<unsigned>(tbb::info::default_concurrency()))));
      // Each waypoint is a task of its own: their costs differ by orders of magnitude.
      arena.execute([this] {
        tbb::parallel_for(
            tbb::blocked_range<std::size_t>(0, waypoints_.size(), 1),
            [this](const tbb::blocked_range<std::size_t>& range) {
              for (std::size_t i = range.begin(); i < range.end() && !cancelled(); ++i) answer(i);
            },
            tbb::simple_partitioner());
      });
    }
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
