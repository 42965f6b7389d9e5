// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "pose/counting_source.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/constants.h"
#include "base/random_words.h"
#include "fcl_prob/monte_carlo.h"
#include "pose/drawn_along.h"
#include "pose/sampled_configuration.h"
#include "sampling/sample_loop.h"

namespace fcl_prob::detail {
namespace {

// A stream of the request's seed that no other method draws from.
constexpr std::uint64_t kStreamOfCounts = 0x636f756e;

// The first coordinates are those of the translation.
constexpr int kTranslation = 3;

// So many samples are the work of a cell, of which a request has a limit.
constexpr std::size_t kSamplesACell = 4;

// Values that are kept at once: the more, the more memory; the fewer, the more often threads wait.
constexpr std::size_t kLargestBlock = 1 << 17;

// fcl::collide takes shapes for touching that are 1e-6 m apart: below this deviation that tells.
constexpr double kLeastDeviation = 1e-3;

// What the integral for the mass of a quadric may be wrong by; far more than it is.
constexpr double kMassError = 1e-9;

// Shares of samples drawn as the density has them that are chosen from: in between, the number of
// samples is nearly flat.
constexpr double kShares[] = {0.3, 0.45, 0.6, 0.75, 0.9};

// Points of the boundary for each coefficient of a quadric, at first and at most: beyond, less than
// an eighth of its variance is noise of the points, and more of them tell little.
constexpr int kFirstPoints = 2;
constexpr int kMostPoints = 8;

// Of the variance, what twice the points leave, about.
constexpr double kLeftOfVariance = 0.7;

// Of one sample near a model: the integral of the density times the weight over what lies between
// where contact was expected to begin and where it does.
double varianceNear(const BoundaryModel& model, double as_they_are) {
  constexpr int kParts = 8;
  double sum = 0.0;
  for (const BoundaryModel::Misfit& misfit : model.misfits()) {
    const DrawnAlong drawn(misfit.expected, model.spread(), as_they_are);
    const double part = (misfit.at - misfit.expected) / kParts;
    for (int i = 0; i < kParts; ++i) {
      const double s = misfit.expected + (i + 0.5) * part;
      sum += std::fabs(part) * normalDensity(s) * drawn.weightAt(s);
    }
  }
  return sum / static_cast<double>(std::max<std::size_t>(model.misfits().size(), 1));
}

}  // namespace

CountingSource::CountingSource(const ConfigurationMixture& mixture, const GeometryList& a,
                               const GeometryList& b, const ProbabilityRequest& request,
                               Budget& watch)
    : mixture_(mixture), request_(request), watch_(watch), collider_(a, b, request.contact) {
  double variance = 0.0;
  bool has_models = false;
  for (const auto& component : mixture.components()) {
    countings_.push_back(prepared(component, request.seed + countings_.size()));
    const Counting& counting = countings_.back();
    offset_ += component.weight * counting.mass;
    variance += component.weight * counting.variance;
    has_models = has_models || counting.model;
    weight_ = std::max(weight_, 1.0 / counting.as_they_are);
  }
  samples_.emplace(Bounds{has_models ? -weight_ : 0.0, weight_}, weight_, 0.0, std::sqrt(variance));
  watch_.spendCells(questions_ / kSamplesACell);
}

bool CountingSource::isFor(const ConfigurationMixture& mixture, const GeometryList& a,
                           const GeometryList& b, const ProbabilityRequest& request) {
  if (request.method == ProbabilityMethod::rare_event) return false;
  for (const auto& component : mixture.components()) {
    const Eigen::VectorXd middle = Eigen::VectorXd::Zero(component.configuration->dimension());
    const GaussianDisplacement displacement = component.configuration->at(middle).displacement;
    if (displacement.standardDeviations().maxCoeff() < kLeastDeviation) return false;
  }
  return std::all_of(a.begin(), a.end(), [&b](const auto& of_a) {
    return std::all_of(b.begin(), b.end(),
                       [&of_a](const auto& of_b) { return fclSupportsPair(*of_a, *of_b); });
  });
}

bool CountingSource::collidesAt(const RandomConfiguration& configuration,
                                const Eigen::VectorXd& x) const {
  return collider_.collides(
      sampledAt(configuration, x.tail(configuration.dimension()), x.head<kTranslation>()));
}

double CountingSource::samplesWith(double variance, double weight, double probability) const {
  double tolerance = request_.toleranceAt(probability);
  if (request_.threshold) {
    tolerance = std::max(tolerance, 0.25 * std::fabs(*request_.threshold - probability));
  }
  return MeanSequence::samplesFor(std::sqrt(variance), weight, tolerance);
}

// The share with which the fewest samples are needed, as far as the points of the boundary tell:
// none of the samples is asked, so that all have the same weights.
double CountingSource::chooseShare(Counting& counting) const {
  const double mass = counting.model->mass();
  double fewest = kInfinity;
  for (const double share : kShares) {
    const double variance = varianceNear(*counting.model, share);
    const double samples = samplesWith(variance, 1.0 / share, mass);
    if (samples < fewest || share == kShares[0]) {
      fewest = samples;
      counting.as_they_are = share;
      counting.variance = variance;
    }
  }
  return fewest;
}

// More points of the boundary, while they are likely to save more calls than they take.
// Returns how many samples are needed then.
double CountingSource::bend(BoundarySearch& search, Counting& counting) const {
  double samples = chooseShare(counting);
  for (int points = kFirstPoints; points <= kMostPoints && watch_.goOn(); points *= 2) {
    const double mass = counting.model->mass(), weight = 1.0 / counting.as_they_are;
    const double saved = samplesWith(counting.variance, weight, mass) -
                         samplesWith(kLeftOfVariance * counting.variance, weight, mass);
    if (!(saved > search.questionsOfBend(points))) break;
    search.bend(*counting.model, points);
    samples = chooseShare(counting);
  }
  return samples;
}

CountingSource::Counting CountingSource::prepared(const ConfigurationMixture::Component& component,
                                                  std::uint64_t seed) {
  Counting counting;
  counting.configuration = component.configuration;
  const BoundarySearch::Question question = [&](const Eigen::VectorXd& x) {
    return collidesAt(*component.configuration, x);
  };
  const Eigen::Index dimension = kTranslation + component.configuration->dimension();
  BoundarySearch search(question, dimension, seed);
  counting.model = search.plane();
  if (counting.model) {
    const double samples = bend(search, counting);
    const double mass = counting.model->mass(), plain = mass * (1.0 - mass);
    if (samples < samplesWith(plain, 1.0, mass)) {
      counting.mass = mass;
    } else {
      counting.variance = plain;
      counting.as_they_are = 1.0;
      counting.model.reset();
    }
  }
  questions_ += search.questions();
  return counting;
}

double CountingSource::mostSamples() const {
  return static_cast<double>(kSamplesACell) * static_cast<double>(request_.max_cells);
}

CountingSource::Counted CountingSource::countAt(std::size_t index) const {
  const RandomStream stream{request_.seed, kStreamOfCounts};
  const auto words = randomWords(stream, index);
  const std::size_t chosen = countings_.size() == 1 ? 0 : mixture_.chosenBy(unitUniform(words[1]));
  const Counting& counting = countings_[chosen];
  const Eigen::VectorXd normals =
      standardNormals(stream, index, kTranslation + counting.configuration->dimension(), 1);
  if (counting.model) return countNear(counting, normals, uniformFrom(words[0]));
  const bool hit = collidesAt(*counting.configuration, normals);
  return {hit ? 1.0 : 0.0, hit};
}

CountingSource::Counted CountingSource::countNear(const Counting& counting,
                                                  const Eigen::VectorXd& normals,
                                                  double uniform) const {
  const BoundaryModel& model = *counting.model;
  const Eigen::VectorXd across = normals.head(normals.size() - 1);
  const double level = model.level(across);
  const DrawnAlong drawn(level, model.spread(), counting.as_they_are);
  const double s = drawn.at(uniform);
  const bool hit = collidesAt(*counting.configuration, model.pointAt(across, s));
  const double wrong = (hit ? 1.0 : 0.0) - (s > level ? 1.0 : 0.0);
  return {wrong == 0.0 ? 0.0 : wrong * drawn.weightAt(s), hit};
}

void CountingSource::aim(double below, double above) {
  samples_->aim(below - offset_, above - offset_);
}

void CountingSource::drawTo(std::size_t count, double /*tolerance*/) {
  SampleLoop loop(request_.threads);
  std::vector<Counted> counted;
  bool goes_on = true;
  while (goes_on && drawn_ < count) {
    const std::size_t first = drawn_;
    const std::size_t last = std::min(count, first + kLargestBlock);
    counted.resize(last - first);
    drawn_ = loop.run(
        first, last, [&](std::size_t index) { counted[index - first] = countAt(index); },
        [&](std::size_t) { return goes_on = watch_.goOn(); });
    // Samples within a block have the same stake: what is 0 may be taken together.
    double zeros = 0.0;
    for (std::size_t i = 0; i < drawn_ - first; ++i) {
      hits_ += counted[i].hit ? 1 : 0;
      if (counted[i].value == 0.0) {
        zeros += 1.0;
      } else {
        samples_->add(counted[i].value);
      }
    }
    samples_->add({0.0, 0.0}, zeros);
    watch_.spendCells((drawn_ - first) / kSamplesACell);
  }
}

void CountingSource::describe(ProbabilityResult& result) const {
  result.statistics.samples += drawn_ + questions_;
  result.statistics.hits += hits_;
  const bool has_models = weight_ > 1.0;
  result.plan.push_back(
      std::to_string(drawn_) + " calls of fcl::collide at random configurations" +
      (has_models ? ", mostly near a quadric along the boundary of contact whose mass is known (" +
                        std::to_string(questions_) + " calls to find it)"
                  : "; no quadric along the boundary of contact saves any"));
}

}  // namespace fcl_prob::detail
