// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "pose/pair_source.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/random_words.h"
#include "base/statistics.h"
#include "pose/sampled_configuration.h"
#include "sampling/sample_loop.h"

namespace fcl_prob::detail {
namespace {

// Streams of the request's seed that no other method draws from.
constexpr std::uint64_t kConfigurations = 0x706f7365;
constexpr std::uint64_t kSeedsOfAnswers = 0x696e6e72;
constexpr std::uint64_t kChoices = 0x6d697874;

// Work of an answer that counts no cells of its own, in cells: whitening, and the cheapest bounds.
constexpr std::size_t kCellsOfAnswer = 32;

// Of the variance of the mean, what single answers may make up: the less, the longer each takes.
constexpr double kInnerShare = 0.5;

// An answer need be no more accurate than this.
constexpr double kCoarsest = 0.3;

// Of the spread between configurations, what a single answer may have as its standard error.
constexpr double kInnerDeviation = 0.7;

// |∂P/∂mean| along an axis is at most that of a half-space across it through the mean.
Eigen::Vector3d largestGradient(const GaussianDisplacement& displacement) {
  Eigen::Vector3d inverse = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    const double sigma = displacement.standardDeviations()[k];
    if (sigma > 0.0) inverse += displacement.axes().col(k).cwiseAbs2() / (sigma * sigma);
  }
  return inverse.cwiseSqrt() / std::sqrt(2.0 * M_PI);
}

}  // namespace

PairSource::PairSource(const ConfigurationMixture& mixture, const ConditionalAnswer& answer,
                       const ProbabilityRequest& request, Budget& watch)
    : mixture_(mixture),
      answer_(answer),
      request_(request),
      watch_(watch),
      samples_({0.0, 1.0}, 0.5, 0.5, 0.5) {}

PairSource::Answer PairSource::answerAt(std::size_t index, double tolerance) const {
  Answer answer;
  if (!watch_.goOn()) return answer;
  const std::size_t pair = index / 2;
  const double choice = unitUniform(randomWords({request_.seed, kChoices}, pair)[0]);
  const RandomConfiguration& configuration =
      *mixture_.components()[mixture_.chosenBy(choice)].configuration;
  const Eigen::VectorXd z =
      standardNormals({request_.seed, kConfigurations}, pair, configuration.dimension());
  const PlacedConfiguration placed = configuration.at(index % 2 == 0 ? z : Eigen::VectorXd(-z));
  ProbabilityRequest request = request_;
  // Rare events are counted by fcl::collide, given the configuration; all else is estimated.
  if (request_.method != ProbabilityMethod::rare_event) {
    request.method = ProbabilityMethod::estimate;
  }
  request.relative_tolerance = std::min(
      kCoarsest, request_.relative_tolerance * std::sqrt(static_cast<double>(kLeastPairs)));
  request.absolute_tolerance = std::max(tolerance, std::numeric_limits<double>::min());
  request.threshold.reset();
  request.time_limit.reset();
  request.threads = 1;
  request.seed = randomWords({request_.seed, kSeedsOfAnswers}, index)[0];
  request.on_progress = [this](const ProbabilityProgress&) { return watch_.goOn(); };
  const ProbabilityResult result = answer_(placed, request);
  // Of what is no sample P is somewhere in an interval.
  const double p = result.probability();
  answer.value = result.standard_error ? Bounds{p, p} : Bounds{*result.lower, *result.upper};
  answer.gradient = result.gradient;
  answer.largest_gradient = largestGradient(placed.displacement);
  answer.statistics = result.statistics;
  answer.complete = result.status != ProbabilityStatus::cancelled;
  return answer;
}

void PairSource::drawTo(std::size_t count, double tolerance) {
  if (count <= pairs_) return;
  // Single answers have independent errors; none need be better than what is left of the tolerance
  // after dividing it among all, or than the spread between configurations makes worth while.
  const auto wanted = static_cast<double>(std::max(count, kLeastPairs));
  double inner = std::sqrt(kInnerShare * 2.0 * wanted) * tolerance;
  inner = std::min(inner, std::max(kCoarsest * samples_.mean(), kInnerShare * tolerance));
  if (pairs_ > 0) inner = std::max(inner, kInnerDeviation * samples_.deviation());
  const std::size_t first = pairs_;
  std::vector<Answer> answers(2 * (count - first));
  SampleLoop loop(request_.threads);
  loop.run(
      0, answers.size(), [&](std::size_t i) { answers[i] = answerAt(2 * first + i, inner); },
      [this](std::size_t) { return watch_.goOn(); });
  for (std::size_t i = 0; i < answers.size(); i += 2) {
    if (!answers[i].complete || !answers[i + 1].complete) break;
    add(answers[i], answers[i + 1]);
  }
}

void PairSource::add(const Answer& at_z, const Answer& at_opposite) {
  ++pairs_;
  samples_.add({0.5 * (at_z.value.lower + at_opposite.value.lower),
                0.5 * (at_z.value.upper + at_opposite.value.upper)},
               1.0);
  if (at_z.gradient && at_opposite.gradient) {
    const Eigen::Vector3d gradient = 0.5 * (*at_z.gradient + *at_opposite.gradient);
    ++gradients_;
    gradient_sum_ += gradient;
    gradient_squares_ += gradient.cwiseAbs2();
    largest_gradient_ = largest_gradient_.cwiseMax(at_z.largest_gradient);
  }
  addStatistics(at_z.statistics);
  addStatistics(at_opposite.statistics);
}

void PairSource::addStatistics(const ProbabilityStatistics& of_one) {
  // An answer without cells is work all the same: the limit on cells ends every query.
  watch_.spendCells(std::max(of_one.cells, kCellsOfAnswer));
  statistics_.cells += of_one.cells;
  statistics_.pairs_tested += of_one.pairs_tested;
  statistics_.leaf_pairs += of_one.leaf_pairs;
  statistics_.samples += of_one.samples;
  statistics_.peak_front = std::max(statistics_.peak_front, of_one.peak_front);
  statistics_.peak_memory = std::max(statistics_.peak_memory, of_one.peak_memory);
}

double PairSource::mostSamples() const {
  return static_cast<double>(request_.max_cells) / (2.0 * static_cast<double>(kCellsOfAnswer));
}

// As in MeanSequence, two unseen pairs with the largest gradient at one of their configurations
// join the spread.
void PairSource::fillGradient(ProbabilityResult& result) const {
  if (!request_.gradient || gradients_ < 2 || gradients_ < pairs_) return;
  const auto n = static_cast<double>(gradients_);
  const Eigen::Vector3d mean = gradient_sum_ / n;
  const Eigen::Vector3d variance =
      (gradient_squares_ / n - mean.cwiseAbs2()).cwiseMax(0.0) / (n - 1.0);
  result.gradient = mean;
  result.gradient_standard_error = (variance + (largest_gradient_ / n).cwiseAbs2()).cwiseSqrt();
}

void PairSource::describe(ProbabilityResult& result) const {
  detail::addStatistics(statistics_, result.statistics);
  result.plan.push_back(std::to_string(2 * pairs_) + " configurations of " +
                        std::to_string(mixture_.dimension()) +
                        " dimensions in antithetic pairs, each answered by itself");
}

}  // namespace fcl_prob::detail
