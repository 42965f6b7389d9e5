// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "pose/counting_source.h"

#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <string>

#include "base/constants.h"
#include "base/random_words.h"
#include "fcl_prob/monte_carlo.h"
#include "pose/query_costs.h"
#include "pose/sampled_configuration.h"

namespace fcl_prob::detail {
namespace {

// A stream of the request's seed that no other method draws from.
constexpr std::uint64_t kShiftWords = 0x736f626f;

// The first coordinates are those of the translation.
constexpr int kTranslation = 3;

constexpr std::size_t kFirstPoints = 32;

// The variance of counting at random points is assumed to be so many times as large before there
// are any.
constexpr double kExpectedGain = 6.0;

// Drawn beyond what the last look says is needed.
constexpr double kPointReserve = 1.1;

// So many samples are the work of a cell, of which a request has a limit.
constexpr std::size_t kSamplesACell = 16;

// fcl::collide takes shapes for touching that are 1e-6 m apart: below this deviation that tells.
constexpr double kLeastDeviation = 1e-3;

double quantileAt(std::uint64_t word) {
  return -std::sqrt(2.0) * boost::math::erfc_inv(2.0 * uniformFrom(word));
}

}  // namespace

CountingSource::CountingSource(const RandomConfiguration& configuration, const GeometryList& a,
                               const GeometryList& b, const ProbabilityRequest& request,
                               RunWatch& watch)
    : configuration_(configuration),
      a_(a),
      b_(b),
      request_(request),
      watch_(watch),
      cost_of_sample_(collideCost(a, b)),
      sequence_(static_cast<std::size_t>(kTranslation + configuration.dimension())),
      shifts_(static_cast<std::size_t>(kTranslation + configuration.dimension())) {
  for (std::size_t k = 0; k < shifts_.size(); ++k) {
    for (std::size_t shift = 0; shift < kShifts; ++shift) {
      shifts_[k][shift] = randomWords({request.seed, kShiftWords}, k, shift)[0];
    }
  }
}

bool CountingSource::isFor(const RandomConfiguration& configuration, const GeometryList& a,
                           const GeometryList& b, const ProbabilityRequest& request) {
  if (request.method == ProbabilityMethod::rare_event || request.gradient) return false;
  const Eigen::VectorXd middle = Eigen::VectorXd::Zero(configuration.dimension());
  const GaussianDisplacement displacement = configuration.at(middle).displacement;
  if (displacement.standardDeviations().maxCoeff() < kLeastDeviation) return false;
  return std::all_of(a.begin(), a.end(), [&b](const auto& of_a) {
    return std::all_of(b.begin(), b.end(),
                       [&of_a](const auto& of_b) { return fclSupportsPair(*of_a, *of_b); });
  });
}

CountingSource::Hits CountingSource::hitsAt(std::size_t point) const {
  boost::random::sobol sequence = sequence_;
  sequence.seed(point);
  std::vector<std::uint64_t> words(shifts_.size());
  sequence.generate(words.begin(), words.end());
  Hits hits = 0;
  Eigen::VectorXd normals(static_cast<Eigen::Index>(words.size()));
  for (std::size_t shift = 0; shift < kShifts; ++shift) {
    for (std::size_t k = 0; k < words.size(); ++k) {
      normals[static_cast<Eigen::Index>(k)] = quantileAt(words[k] ^ shifts_[k][shift]);
    }
    const SampledPlacement placement = sampledAt(
        configuration_, normals.tail(configuration_.dimension()), normals.head<kTranslation>());
    if (collider_->collides(placement)) hits |= Hits{1} << shift;
  }
  return hits;
}

// Twice as many each time: the sequence is even where its length is a power of two.
std::size_t CountingSource::pointsTo(double standard_error) const {
  if (!mean_) return kFirstPoints;
  const double ratio = mean_->standard_error / standard_error;
  const double wanted = kPointReserve * static_cast<double>(points_) * ratio * ratio;
  return wanted > 2.5 * static_cast<double>(points_) ? 4 * points_ : 2 * points_;
}

void CountingSource::draw(double standard_error) {
  if (!collider_) collider_.emplace(a_, b_, request_.contact);
  const std::size_t last = pointsTo(standard_error);
  std::vector<Hits> hits(last - points_);
  SampleLoop loop(request_.threads);
  const std::size_t first = points_;
  const std::size_t end = loop.run(
      first, last, [&](std::size_t point) { hits[point - first] = hitsAt(point); },
      [this](std::size_t) { return watch_.goOn(); });
  for (; points_ < end; ++points_) {
    for (std::size_t shift = 0; shift < kShifts; ++shift) {
      hits_[shift] += (hits[points_ - first] >> shift) & 1U;
    }
  }
  watch_.addCells((end - first) * kShifts / kSamplesACell);
  if (points_ >= kFirstPoints) takeMean();
}

void CountingSource::takeMean() {
  const auto points = static_cast<double>(points_);
  const auto shifts = static_cast<double>(kShifts);
  double sum = 0.0;
  for (const std::size_t hits : hits_) sum += static_cast<double>(hits) / points;
  EstimatedMean mean;
  mean.mean = sum / shifts;
  double squares = 0.0;
  for (const std::size_t hits : hits_) {
    const double off = static_cast<double>(hits) / points - mean.mean;
    squares += off * off;
  }
  mean.freedom = shifts - 1.0;
  // For Student's t with so many degrees of freedom E t² = ν / (ν - 2).
  const double variance = squares / mean.freedom / shifts * mean.freedom / (mean.freedom - 2.0);
  // Sets that all have the same hits, or none, say no more than that half a hit may be missing.
  mean.standard_error = std::hypot(std::sqrt(variance), 0.7 / (points * shifts));
  mean.deviation = mean.standard_error * std::sqrt(points * shifts);
  mean_ = mean;
}

double CountingSource::costOfFirst() const {
  return static_cast<double>(kFirstPoints * kShifts) * cost_of_sample_;
}

double CountingSource::costTo(double standard_error, double probability) const {
  double samples = 0.0;
  if (mean_) {
    const double ratio = mean_->standard_error / standard_error;
    samples = static_cast<double>(points_ * kShifts) * std::max(0.0, ratio * ratio - 1.0);
  } else {
    const double p = std::clamp(probability, 0.0, 1.0);
    const double wanted = p * (1.0 - p) / (kExpectedGain * standard_error * standard_error);
    samples = std::max(wanted, static_cast<double>(kFirstPoints * kShifts));
  }
  return samples * cost_of_sample_;
}

void CountingSource::describe(ProbabilityResult& result) const {
  std::size_t hits = 0;
  for (const std::size_t of_one : hits_) hits += of_one;
  result.statistics.samples += points_ * kShifts;
  result.statistics.hits += hits;
  result.plan.push_back("fcl::collide at " + std::to_string(points_) + " points of a Sobol " +
                        "sequence in " + std::to_string(shifts_.size()) + " dimensions, shifted " +
                        std::to_string(kShifts) + " times at random");
}

}  // namespace fcl_prob::detail
