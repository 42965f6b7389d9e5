// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "pose/counting_source.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/constants.h"
#include "base/random_words.h"
#include "fcl_prob/monte_carlo.h"
#include "gaussian/normal_density.h"
#include "pose/boundary_search.h"
#include "pose/drawn_along.h"
#include "pose/query_costs.h"
#include "pose/sampled_configuration.h"

namespace fcl_prob::detail {
namespace {

// A stream of the request's seed that no other method draws from.
constexpr std::uint64_t kShiftWords = 0x736f626f;

// The first coordinates are those of the translation.
constexpr int kTranslation = 3;

constexpr std::size_t kFirstPoints = 8;

// The variance of counting at random points is assumed to be so many times as large before there
// are any.
constexpr double kExpectedGain = 30.0;

// Evenly spread points take so many times fewer than random ones where contacts are counted as they
// are.
constexpr double kGainOfPoints = 7.0;

// Rare samples of large weight show in the spread of sets of some length only: this share of what
// counting at random takes before a first look, and before an answer; and no more than so many
// points.
constexpr double kFirstShare = 0.012;
constexpr double kLeastShare = 0.04;
constexpr std::size_t kMostFirstPoints = 256;

// Drawn beyond what the last look says is needed.
constexpr double kPointReserve = 1.1;

// So many samples are the work of a cell, of which a request has a limit.
constexpr std::size_t kSamplesACell = 16;

// fcl::collide takes shapes for touching that are 1e-6 m apart: below this deviation that tells.
constexpr double kLeastDeviation = 1e-3;

// Below that contacts elsewhere, which no sample shows, may well be all there are.
constexpr double kRarest = 1e-5;

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

bool CountingSource::collidesAt(const Eigen::VectorXd& x) const {
  return collider_->collides(
      sampledAt(configuration_, x.tail(configuration_.dimension()), x.head<kTranslation>()));
}

void CountingSource::findBoundary(double standard_error) {
  const BoundarySearch::Question question = [this](const Eigen::VectorXd& x) {
    return collidesAt(x);
  };
  BoundarySearch search(question, dimension(), request_.seed);
  model_ = search.plane();
  if (model_) {
    mass_ = model_->mass();
    standard_error = std::max(standard_error, request_.toleranceAt(mass_));
    const double samples = varianceNear() / (standard_error * standard_error);
    if (samples > 2.0 * BoundarySearch::questionsOfBend(dimension())) {
      search.bend(*model_);
      mass_ = model_->mass();
    }
    is_close_ = varianceNear() < mass_ * (1.0 - mass_) / kGainOfPoints;
  }
  if (model_ && mass_ < kRarest) {
    model_.reset();
    mass_ = 0.0;
    is_close_ = false;
  }
  questions_ = search.questions();
}

// Of one sample, by what the points are off that tell: the integral of the density times the weight
// over what is between.
double CountingSource::varianceNear() const {
  constexpr int kParts = 8;
  double sum = 0.0;
  for (const BoundaryModel::Misfit& misfit : model_->misfits()) {
    const DrawnAlong drawn(misfit.expected, model_->spread());
    const double part = (misfit.at - misfit.expected) / kParts;
    for (int i = 0; i < kParts; ++i) {
      const double s = misfit.expected + (i + 0.5) * part;
      sum += std::fabs(part) * normalDensity(s) * drawn.weightAt(s);
    }
  }
  return sum / static_cast<double>(std::max<std::size_t>(model_->misfits().size(), 1));
}

CountingSource::CountedShifts CountingSource::countAt(std::size_t point) const {
  boost::random::sobol sequence = sequence_;
  sequence.seed(point);
  std::vector<std::uint64_t> words(shifts_.size());
  sequence.generate(words.begin(), words.end());
  CountedShifts counted;
  Eigen::VectorXd uniform(dimension());
  for (std::size_t shift = 0; shift < kShifts; ++shift) {
    for (std::size_t k = 0; k < words.size(); ++k) {
      uniform[static_cast<Eigen::Index>(k)] = uniformFrom(words[k] ^ shifts_[k][shift]);
    }
    counted[shift] = countOne(uniform);
  }
  return counted;
}

CountingSource::Counted CountingSource::countOne(const Eigen::VectorXd& uniform) const {
  if (!model_) {
    const bool hit = collidesAt(uniform.unaryExpr(&quantileOf));
    return {hit ? 1.0 : 0.0, 0.0, hit};
  }
  const Eigen::VectorXd across = uniform.tail(dimension() - 1).unaryExpr(&quantileOf);
  if (is_close_) return countNear(across, uniform[0]);
  const double s = quantileOf(uniform[0]);
  const bool hit = collidesAt(model_->pointAt(across, s));
  const double expected = s > model_->level(across) ? 1.0 : 0.0;
  return {hit ? 1.0 : 0.0, expected - mass_, hit};
}

CountingSource::Counted CountingSource::countNear(const Eigen::VectorXd& across,
                                                  double uniform) const {
  const double level = model_->level(across);
  const DrawnAlong drawn(level, model_->spread());
  const double s = drawn.at(uniform);
  const bool hit = collidesAt(model_->pointAt(across, s));
  const double wrong = (hit ? 1.0 : 0.0) - (s > level ? 1.0 : 0.0);
  return {wrong * drawn.weightAt(s), 0.0, hit};
}

std::size_t CountingSource::pointsOfShare(double share) const {
  if (!model_) return kFirstPoints;
  const double tolerance = request_.toleranceAt(mass_);
  const double counting = mass_ * (1.0 - mass_) / (tolerance * tolerance);
  std::size_t points = kFirstPoints;
  while (points < kMostFirstPoints && static_cast<double>(points * kShifts) < share * counting) {
    points *= 2;
  }
  return points;
}

std::size_t CountingSource::leastPoints() const {
  return pointsOfShare(is_close_ ? kLeastShare : kFirstShare);
}

bool CountingSource::isAnswer() const { return mean_ && points_ >= leastPoints(); }

// The sequence is even where its length is a power of two, and nearly so at half of the way.
std::size_t CountingSource::pointsTo(double standard_error) const {
  if (!mean_) return pointsOfShare(kFirstShare);
  const double ratio = mean_->standard_error / standard_error;
  const double halves = std::clamp(2.0 * kPointReserve * ratio * ratio, 3.0, 8.0);
  return std::max(leastPoints(), points_ * static_cast<std::size_t>(std::ceil(halves)) / 2);
}

void CountingSource::draw(double standard_error) {
  if (!collider_) {
    collider_.emplace(a_, b_, request_.contact);
    findBoundary(standard_error);
    watch_.addCells(questions_ / kSamplesACell);
  }
  const std::size_t last = pointsTo(standard_error);
  std::vector<CountedShifts> counted(last - points_);
  SampleLoop loop(request_.threads);
  const std::size_t first = points_;
  const std::size_t end = loop.run(
      first, last, [&](std::size_t point) { counted[point - first] = countAt(point); },
      [this](std::size_t) { return watch_.goOn(); });
  for (; points_ < end; ++points_) {
    for (std::size_t shift = 0; shift < kShifts; ++shift) {
      const Counted& of_one = counted[points_ - first][shift];
      values_[static_cast<Eigen::Index>(shift)] += of_one.value;
      controls_[static_cast<Eigen::Index>(shift)] += of_one.control;
      largest_ = std::max(largest_, std::fabs(of_one.value));
      hits_ += of_one.hit ? 1 : 0;
    }
  }
  watch_.addCells((end - first) * kShifts / kSamplesACell);
  if (points_ >= kFirstPoints) takeMean();
  if (is_close_ && mean_ && !deviationPays()) {
    countAll();
    draw(standard_error);
  }
}

// Rare samples of large weight may make up for all that the others save.
bool CountingSource::deviationPays() const {
  const double p = std::clamp(mean_->mean, 0.0, 1.0);
  return mean_->deviation * mean_->deviation < p * (1.0 - p) / kGainOfPoints;
}

void CountingSource::countAll() {
  is_close_ = false;
  values_.setZero();
  controls_.setZero();
  hits_ = 0;
  questions_ += points_ * kShifts;
  points_ = 0;
  mean_.reset();
}

void CountingSource::takeMean() {
  const auto points = static_cast<double>(points_);
  const auto shifts = static_cast<double>(kShifts);
  const Sums values = values_ / points, controls = controls_ / points;
  const Sums off = values - values.mean(), control_off = controls - controls.mean();
  const double squares = control_off.square().sum();
  const double slope = squares > 0.0 ? (off * control_off).sum() / squares : 0.0;
  EstimatedMean mean;
  mean.mean = values.mean() - slope * controls.mean() + (is_close_ ? mass_ : 0.0);
  mean.freedom = shifts - (squares > 0.0 ? 2.0 : 1.0);
  // For Student's t with so many degrees of freedom E t² = ν / (ν - 2). The mean of the controls
  // is known: it is off by what the slope is off, too.
  const double residual = (off - slope * control_off).square().sum();
  const double leverage =
      squares > 0.0 ? controls.mean() * controls.mean() * shifts / squares : 0.0;
  const double variance = residual / shifts / (mean.freedom - 2.0) * (1.0 + leverage);
  // Sets that all have the same hits, or none, say no more than that half a hit may be missing.
  const double unseen = 0.7 * (is_close_ && largest_ > 0.0 ? std::min(largest_, 1.0) : 1.0);
  mean.standard_error = std::hypot(std::sqrt(variance), unseen / (points * shifts));
  mean.deviation = mean.standard_error * std::sqrt(points * shifts);
  mean_ = mean;
}

double CountingSource::costOfFirst() const {
  return (BoundarySearch::questionsOfPlane(dimension()) +
          static_cast<double>(kFirstPoints * kShifts)) *
         cost_of_sample_;
}

double CountingSource::costTo(double standard_error, double probability) const {
  if (!mean_) {
    const double p = std::clamp(probability, 0.0, 1.0);
    const double wanted = p * (1.0 - p) / (kExpectedGain * standard_error * standard_error);
    return costOfFirst() + wanted * cost_of_sample_;
  }
  const double ratio = mean_->standard_error / standard_error;
  const double samples =
      static_cast<double>(points_ * kShifts) * std::max(0.0, ratio * ratio - 1.0);
  return samples * cost_of_sample_;
}

void CountingSource::describe(ProbabilityResult& result) const {
  result.statistics.samples += points_ * kShifts + questions_;
  result.statistics.hits += hits_;
  if (model_) {
    result.plan.push_back("a quadric along the boundary of contact, by " +
                          std::to_string(questions_) +
                          " calls of fcl::collide, instead of which points near it are counted");
  }
  result.plan.push_back("fcl::collide at " + std::to_string(points_) + " points of a Sobol " +
                        "sequence in " + std::to_string(shifts_.size()) + " dimensions, shifted " +
                        std::to_string(kShifts) + " times at random");
}

}  // namespace fcl_prob::detail
