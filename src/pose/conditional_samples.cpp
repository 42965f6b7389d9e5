// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "pose/conditional_samples.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>

#include "base/random_words.h"

namespace fcl_prob::detail {
namespace {

// Streams of the request's seed that no other method draws from.
constexpr std::uint64_t kConfigurations = 0x706f7365;
constexpr std::uint64_t kSeedsOfAnswers = 0x696e6e72;

}  // namespace

ConditionalSamples::ConditionalSamples(const RandomConfiguration& configuration,
                                       const ConditionalAnswer& answer,
                                       const ProbabilityRequest& request, RunWatch& watch)
    : configuration_(configuration), answer_(answer), request_(request), watch_(watch) {}

Eigen::VectorXd ConditionalSamples::normals(std::size_t pair) const {
  Eigen::VectorXd z(configuration_.dimension());
  for (Eigen::Index k = 0; k < z.size(); k += 3) {
    const Eigen::Vector3d three = standardNormalFrom(
        randomWords({request_.seed, kConfigurations}, pair, static_cast<std::uint64_t>(k / 3)));
    const Eigen::Index count = std::min<Eigen::Index>(3, z.size() - k);
    z.segment(k, count) = three.head(count);
  }
  return z;
}

ConditionalSamples::Answer ConditionalSamples::answerAt(std::size_t index,
                                                        const InnerTolerance& tolerance) const {
  Answer answer;
  if (!watch_.goOn()) return answer;
  const Eigen::VectorXd z = normals(index / 2);
  const PlacedConfiguration placed = configuration_.at(index % 2 == 0 ? z : Eigen::VectorXd(-z));
  ProbabilityRequest request = request_;
  // Rare events are counted by fcl::collide, given the configuration; all else is estimated.
  if (request_.method != ProbabilityMethod::rare_event) {
    request.method = ProbabilityMethod::estimate;
  }
  request.relative_tolerance = tolerance.relative;
  request.absolute_tolerance = tolerance.absolute;
  request.threshold.reset();
  request.time_limit.reset();
  request.threads = 1;
  request.seed = randomWords({request_.seed, kSeedsOfAnswers}, index)[0];
  request.on_progress = [this](const ProbabilityProgress&) { return watch_.goOn(); };
  const ProbabilityResult result = answer_(placed, request);
  answer.value = result.probability();
  // Of what is no sample the middle of an interval is taken.
  if (!result.standard_error) answer.doubt = 0.5 * (*result.upper - *result.lower);
  answer.may_jump = placed.displacement.rank() < 3;
  answer.gradient = result.gradient;
  answer.statistics = result.statistics;
  answer.complete = result.status != ProbabilityStatus::cancelled;
  return answer;
}

void ConditionalSamples::drawTo(std::size_t count, const InnerTolerance& tolerance) {
  const std::size_t first = pairs_.size();
  if (count <= first) return;
  std::vector<Answer> answers(2 * (count - first));
  const auto evaluate = [&](std::size_t i) { answers[i] = answerAt(2 * first + i, tolerance); };
  if (request_.threads == 1) {
    for (std::size_t i = 0; i < answers.size(); ++i) evaluate(i);
  } else {
    tbb::task_arena arena(static_cast<int>(request_.threads));
    arena.execute([&] {
      tbb::parallel_for(
          tbb::blocked_range<std::size_t>(0, answers.size(), 1),
          [&](const tbb::blocked_range<std::size_t>& range) {
            for (std::size_t i = range.begin(); i < range.end(); ++i) evaluate(i);
          },
          tbb::simple_partitioner());
    });
  }
  for (std::size_t i = 0; i < answers.size(); i += 2) {
    if (!answers[i].complete || !answers[i + 1].complete) break;
    add(first + i / 2, answers[i], answers[i + 1]);
  }
}

void ConditionalSamples::add(std::size_t pair, const Answer& at_z, const Answer& at_opposite) {
  pairs_.push_back({normals(pair), at_z.value, at_opposite.value});
  doubt_ += at_z.doubt + at_opposite.doubt;
  may_jump_ = may_jump_ || at_z.may_jump || at_opposite.may_jump;
  if (at_z.gradient && at_opposite.gradient) {
    gradients_.push_back(0.5 * (*at_z.gradient + *at_opposite.gradient));
  }
  addStatistics(at_z.statistics);
  addStatistics(at_opposite.statistics);
}

void ConditionalSamples::addStatistics(const ProbabilityStatistics& of_one) {
  // An answer without cells is work all the same: the limit on cells ends every query.
  const std::size_t cells = std::max<std::size_t>(of_one.cells, 1);
  watch_.addCells(cells);
  statistics_.cells += cells;
  statistics_.pairs_tested += of_one.pairs_tested;
  statistics_.leaf_pairs += of_one.leaf_pairs;
  statistics_.samples += of_one.samples;
  statistics_.peak_front = std::max(statistics_.peak_front, of_one.peak_front);
  statistics_.peak_memory = std::max(statistics_.peak_memory, of_one.peak_memory);
}

void ConditionalSamples::fillGradient(ProbabilityResult& result) const {
  if (!request_.gradient || gradients_.size() < 2 || gradients_.size() < pairs_.size()) return;
  const auto n = static_cast<double>(gradients_.size());
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& gradient : gradients_) sum += gradient;
  const Eigen::Vector3d mean = sum / n;
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& gradient : gradients_) squares += (gradient - mean).cwiseAbs2();
  result.gradient = mean;
  result.gradient_standard_error = (squares / (n * (n - 1.0))).cwiseSqrt();
}

}  // namespace fcl_prob::detail
