// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/mixture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "fcl_prob/exceptions.h"
#include "gaussian/constants.h"
#include "gaussian/number_text.h"
#include "query/single_collide.h"

namespace fcl_prob {
namespace {

using detail::kEpsilon;

/// The first look at every component, to see which of them matter.
constexpr double kCoarse = 0.3;

class MixtureQuery {
 public:
  MixtureQuery(const PreparedQuery& query, const fcl::Transform3d& pose_a,
               const fcl::Transform3d& pose_b, const GaussianMixture& mixture,
               const ProbabilityRequest& request)
      : query_(query),
        pose_a_(pose_a),
        pose_b_(pose_b),
        components_(mixture.components()),
        request_(request),
        results_(components_.size()) {}

  ProbabilityResult answer() {
    const bool plain = components_.size() == 1;
    if (!plain && looksTwice()) {
      ProbabilityRequest coarse = of_one();
      coarse.relative_tolerance = std::max(kCoarse, request_.relative_tolerance);
      coarse.gradient = false;
      for (std::size_t i = 0; i < components_.size() && !finished(); ++i) ask(i, coarse);
    }
    ProbabilityRequest fine = of_one();
    if (plain) fine = request_;
    // Interval widths add up by weight: this bounds the sum of all of them.
    if (looksTwice() && !plain) {
      fine.absolute_tolerance =
          std::max(request_.absolute_tolerance, request_.relative_tolerance * interval().lower);
      fine.relative_tolerance = 0.0;
      if (!(fine.absolute_tolerance > 0.0)) fine.relative_tolerance = request_.relative_tolerance;
    }
    for (std::size_t i = 0; i < components_.size() && !finished(); ++i) {
      if (!isFine(i, fine)) ask(i, fine);
    }
    return sum();
  }

 private:
  /// Methods with a tolerance for their interval.
  bool looksTwice() const {
    return request_.method == ProbabilityMethod::automatic ||
           request_.method == ProbabilityMethod::interval;
  }

  /// The threshold is that of the sum, and so is the progress.
  ProbabilityRequest of_one() {
    ProbabilityRequest request = request_;
    request.threshold.reset();
    if (!request_.on_progress) return request;
    request.on_progress = [this](const ProbabilityProgress& of_component) {
      ProbabilityProgress progress = of_component;
      progress.interval = interval();
      cancelled_ = cancelled_ || !request_.on_progress(progress);
      return !cancelled_;
    };
    return request;
  }

  /// The coarse answer is good enough.
  bool isFine(std::size_t i, const ProbabilityRequest& fine) const {
    if (!results_[i] || request_.gradient || !results_[i]->lower || !results_[i]->upper) {
      return false;
    }
    return *results_[i]->upper - *results_[i]->lower <= fine.absolute_tolerance;
  }

  void ask(std::size_t i, const ProbabilityRequest& request) {
    ProbabilityResult result;
    query_.collisionProbability(pose_a_, pose_b_, components_[i].displacement, request, result);
    results_[i] = std::move(result);
  }

  bool finished() const { return cancelled_ || decided(); }

  bool decided() const {
    if (!request_.threshold) return false;
    const Bounds now = interval();
    return now.upper < *request_.threshold || now.lower > *request_.threshold;
  }

  Bounds interval() const {
    Bounds sum;
    for (std::size_t i = 0; i < components_.size(); ++i) {
      const double weight = components_[i].weight;
      sum.lower += weight * (results_[i] ? results_[i]->lower.value_or(0.0) : 0.0);
      sum.upper += weight * (results_[i] ? results_[i]->upper.value_or(1.0) : 1.0);
    }
    const double rounding = (4.0 + 2.0 * static_cast<double>(components_.size())) * kEpsilon;
    return {std::max(0.0, sum.lower * (1.0 - rounding)),
            std::min(1.0, sum.upper * (1.0 + rounding) + std::numeric_limits<double>::min())};
  }

  ProbabilityResult sum() const {
    ProbabilityResult total;
    const auto all = [this](auto field) {
      return std::all_of(results_.begin(), results_.end(), [field](const auto& result) {
        return result && ((*result).*field).has_value();
      });
    };
    const Bounds bounds = interval();
    if (finished() || all(&ProbabilityResult::lower)) total.lower = bounds.lower;
    if (finished() || all(&ProbabilityResult::upper)) total.upper = bounds.upper;
    if (all(&ProbabilityResult::estimate)) addEstimates(total);
    if (all(&ProbabilityResult::gradient)) addGradients(total);
    if (all(&ProbabilityResult::gradient_lower)) addGradientBounds(total);
    addStatistics(total);
    total.method = results_[0]->method;
    total.status = decided()    ? ProbabilityStatus::decided
                   : cancelled_ ? ProbabilityStatus::cancelled
                                : status(bounds);
    total.decision =
        detail::decisionOf({total.lower.value_or(0.0), total.upper.value_or(1.0)}, request_);
    total.plan.insert(total.plan.begin(), "mixture of " + std::to_string(components_.size()) +
                                              " Gaussians: the sum of their answers by weight");
    if (request_.gradient && !total.gradient) {
      total.plan.push_back("no gradient: not every component has one");
    }
    return total;
  }

  /// Of the components if they agree; else the first that was stopped, unless the sum is good
  /// enough all the same.
  ProbabilityStatus status(const Bounds& bounds) const {
    const double tolerance =
        std::max(request_.absolute_tolerance, request_.relative_tolerance * bounds.upper);
    ProbabilityStatus status = results_[0]->status;
    for (const auto& result : results_) {
      const bool fine = result->status == ProbabilityStatus::exact ||
                        result->status == ProbabilityStatus::converged;
      if (!fine) return bounds.width() <= tolerance ? ProbabilityStatus::converged : result->status;
      if (result->status != status) status = ProbabilityStatus::converged;
    }
    return status;
  }

  void addEstimates(ProbabilityResult& total) const {
    double variance = 0.0;
    total.estimate = 0.0;
    for (std::size_t i = 0; i < components_.size(); ++i) {
      *total.estimate += components_[i].weight * *results_[i]->estimate;
      variance += std::pow(components_[i].weight * results_[i]->standard_error.value_or(0.0), 2);
    }
    total.standard_error = std::sqrt(variance);
  }

  void addGradients(ProbabilityResult& total) const {
    total.gradient = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < components_.size(); ++i) {
      *total.gradient += components_[i].weight * *results_[i]->gradient;
    }
  }

  void addGradientBounds(ProbabilityResult& total) const {
    Eigen::Vector3d lower = Eigen::Vector3d::Zero(), upper = lower, size = lower;
    for (std::size_t i = 0; i < components_.size(); ++i) {
      const double weight = components_[i].weight;
      lower += weight * *results_[i]->gradient_lower;
      upper += weight * *results_[i]->gradient_upper;
      size += weight * results_[i]->gradient_lower->cwiseAbs().cwiseMax(
                           results_[i]->gradient_upper->cwiseAbs());
    }
    size *= (4.0 + 2.0 * static_cast<double>(components_.size())) * kEpsilon;
    total.gradient_lower = lower - size;
    total.gradient_upper = upper + size;
  }

  void addStatistics(ProbabilityResult& total) const {
    ProbabilityStatistics& sum = total.statistics;
    for (const auto& result : results_) {
      if (!result) continue;
      const ProbabilityStatistics& one = result->statistics;
      sum.cells += one.cells;
      sum.cells_open += one.cells_open;
      sum.pairs_tested += one.pairs_tested;
      sum.leaf_pairs += one.leaf_pairs;
      sum.peak_front = std::max(sum.peak_front, one.peak_front);
      sum.peak_memory = std::max(sum.peak_memory, one.peak_memory);
      sum.samples += one.samples;
      sum.hits += one.hits;
      sum.seconds.insert(sum.seconds.end(), one.seconds.begin(), one.seconds.end());
    }
  }

  const PreparedQuery& query_;
  const fcl::Transform3d& pose_a_;
  const fcl::Transform3d& pose_b_;
  const std::vector<GaussianMixture::Component>& components_;
  const ProbabilityRequest& request_;
  std::vector<std::optional<ProbabilityResult>> results_;  ///< the latest of each component
  bool cancelled_ = false;
};

/// One query of two objects by whatever kind of displacement.
template <typename Displacement>
double ofObjects(const fcl::CollisionObjectd* a, const fcl::CollisionObjectd* b,
                 const Displacement& displacement, const ProbabilityRequest& request,
                 ProbabilityResult& result) {
  if (a == nullptr) throw InvalidGeometry("object A is null");
  if (b == nullptr) throw InvalidGeometry("object B is null");
  const PreparedQuery query(a->collisionGeometry(), b->collisionGeometry());
  return collisionProbability(query, a->getTransform(), b->getTransform(), displacement, request,
                              result);
}

}  // namespace

GaussianMixture::GaussianMixture(std::vector<Component> components)
    : components_(std::move(components)) {
  if (components_.empty()) throw InvalidDistribution("a mixture without components");
  double sum = 0.0;
  for (const Component& component : components_) {
    if (!(component.weight >= 0.0) || std::isinf(component.weight)) {
      throw InvalidDistribution("weight of a mixture: " + detail::numberText(component.weight));
    }
    sum += component.weight;
  }
  if (!(std::fabs(sum - 1.0) <= 1e-9)) {
    throw InvalidDistribution("the weights of a mixture add up to " + detail::numberText(sum));
  }
  for (Component& component : components_) component.weight /= sum;
}

TruncatedGaussian::TruncatedGaussian(const GaussianDisplacement& gaussian, double deviations)
    : gaussian_(gaussian), deviations_(deviations) {
  if (!(deviations > 0.0)) {
    throw InvalidDistribution("truncated at " + detail::numberText(deviations) + " deviations");
  }
}

double collisionProbability(const PreparedQuery& query, const fcl::Transform3d& pose_a,
                            const fcl::Transform3d& pose_b, const GaussianMixture& displacement,
                            const ProbabilityRequest& request, ProbabilityResult& result) {
  validateRequest(request);
  result = MixtureQuery(query, pose_a, pose_b, displacement, request).answer();
  return result.probability();
}

double collisionProbability(const fcl::CollisionObjectd* a, const fcl::CollisionObjectd* b,
                            const GaussianMixture& displacement, const ProbabilityRequest& request,
                            ProbabilityResult& result) {
  return ofObjects(a, b, displacement, request, result);
}

double collisionProbability(const fcl::CollisionObjectd* a, const fcl::CollisionObjectd* b,
                            const TruncatedGaussian& displacement,
                            const ProbabilityRequest& request, ProbabilityResult& result) {
  return ofObjects(a, b, displacement, request, result);
}

}  // namespace fcl_prob
