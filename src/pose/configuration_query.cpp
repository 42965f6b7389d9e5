// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <algorithm>
#include <cmath>
#include <functional>

#include "base/constants.h"
#include "base/decision.h"
#include "base/number_text.h"
#include "base/quantiles.h"
#include "base/random_words.h"
#include "base/refuse_band.h"
#include "base/stopwatch.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/pose_probability.h"
#include "montecarlo/placement_monte_carlo.h"
#include "montecarlo/sample_loop.h"
#include "pose/configuration_estimate.h"
#include "pose/sampled_configuration.h"

namespace fcl_prob {
namespace {

// Monte Carlo draws from the request's first stream; block 0 is the displacement's.
Eigen::VectorXd normalsOf(std::uint64_t seed, std::size_t index, int count) {
  Eigen::VectorXd z(count);
  for (int k = 0; k < count; k += 3) {
    const Eigen::Vector3d three = detail::standardNormalFrom(
        detail::randomWords({seed}, index, static_cast<std::uint64_t>(1 + k / 3)));
    z.segment(k, std::min(3, count - k)) = three.head(std::min(3, count - k));
  }
  return z;
}

std::vector<double> validatedWeights(const std::vector<ConfigurationQuery::Weighted>& mixture) {
  std::vector<double> weights;
  double sum = 0.0;
  for (const auto& component : mixture) {
    if (!std::isfinite(component.weight) || component.weight < 0.0) {
      throw InvalidDistribution("weight of a configuration is " +
                                detail::numberText(component.weight));
    }
    if (!component.configuration) throw InvalidRequest("a configuration of the mixture is null");
    sum += component.weight;
    weights.push_back(component.weight);
  }
  if (!(std::abs(sum - 1.0) <= 1e-9)) {
    throw InvalidDistribution("weights of the configurations add up to " + detail::numberText(sum));
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

// One random configuration of several: the first coordinate besides those of the largest chooses.
class Chosen {
 public:
  Chosen(const std::vector<ConfigurationQuery::Weighted>& mixture, std::vector<double> weights)
      : mixture_(mixture), weights_(std::move(weights)) {}

  const RandomConfiguration& at(double uniform) const {
    std::size_t i = 0;
    for (double left = uniform; i + 1 < weights_.size() && left > weights_[i]; ++i) {
      left -= weights_[i];
    }
    return *mixture_[i].configuration;
  }

 private:
  const std::vector<ConfigurationQuery::Weighted>& mixture_;
  std::vector<double> weights_;
};

}  // namespace

struct ConfigurationQuery::Implementation {
  GroupQuery::Geometries a;
  GroupQuery::Geometries b;
  GroupQuery group;

  Implementation(GroupQuery::Geometries group_a, GroupQuery::Geometries group_b)
      : a(std::move(group_a)), b(std::move(group_b)), group(a, b) {}

  ProbabilityResult answerAt(const PlacedConfiguration& placed,
                             const ProbabilityRequest& request) const {
    ProbabilityResult result;
    group.collisionProbability(placed.poses_a, placed.poses_b, placed.displacement, request,
                               result);
    return result;
  }

  ProbabilityResult estimate(const RandomConfiguration& configuration,
                             const ProbabilityRequest& request) const {
    if (configuration.dimension() == 0) {
      return answerAt(configuration.at(Eigen::VectorXd()), request);
    }
    const auto answer = [this](const PlacedConfiguration& placed,
                               const ProbabilityRequest& of_one) {
      return answerAt(placed, of_one);
    };
    return detail::configurationEstimate(configuration, answer, a, b, request);
  }

  ProbabilityResult count(const std::vector<Weighted>& mixture, const std::vector<double>& weights,
                          const ProbabilityRequest& request) const {
    constexpr std::uint64_t kChoices = 0x6d697874;
    const Chosen chosen(mixture, weights);
    const auto sampler = [&](std::size_t index) {
      const double uniform =
          detail::uniformFrom(detail::randomWords({request.seed, kChoices}, index)[0]);
      const RandomConfiguration& configuration = chosen.at(uniform);
      return detail::sampledAt(
          configuration, normalsOf(request.seed, index, configuration.dimension()),
          detail::standardNormalFrom(detail::randomWords({request.seed}, index, 0)));
    };
    return detail::placementMonteCarlo(a, b, sampler, request);
  }
};

ConfigurationQuery::ConfigurationQuery(GroupQuery::Geometries group_a,
                                       GroupQuery::Geometries group_b)
    : implementation_(std::make_unique<Implementation>(std::move(group_a), std::move(group_b))) {}

ConfigurationQuery::~ConfigurationQuery() = default;
ConfigurationQuery::ConfigurationQuery(ConfigurationQuery&&) noexcept = default;
ConfigurationQuery& ConfigurationQuery::operator=(ConfigurationQuery&&) noexcept = default;

double ConfigurationQuery::collisionProbability(const RandomConfiguration& configuration,
                                                const ProbabilityRequest& request,
                                                ProbabilityResult& result) const {
  const std::shared_ptr<const RandomConfiguration> unowned(std::shared_ptr<const void>(),
                                                           &configuration);
  return collisionProbability({{1.0, unowned}}, request, result);
}

namespace {

bool isEstimate(ProbabilityMethod method) {
  return method == ProbabilityMethod::automatic || method == ProbabilityMethod::estimate;
}

// The weighted sum of the answers for the components of a mixture, which are independent.
class MixtureSum {
 public:
  using AnswerOf =
      std::function<ProbabilityResult(const RandomConfiguration&, const ProbabilityRequest&)>;

  MixtureSum(const std::vector<ConfigurationQuery::Weighted>& mixture, std::vector<double> weights,
             AnswerOf answer, const ProbabilityRequest& request)
      : mixture_(mixture),
        weights_(std::move(weights)),
        answer_(std::move(answer)),
        request_(request) {}

  ProbabilityResult answer() {
    ProbabilityRequest of_one = request_;
    of_one.threshold.reset();
    of_one.relative_tolerance = std::max(kCoarse, request_.relative_tolerance);
    ask(of_one);
    // The weights' squares add up to 1 at most, and so do those of the standard errors.
    of_one.absolute_tolerance = request_.toleranceAt(*sum_.estimate);
    of_one.relative_tolerance = of_one.absolute_tolerance > 0.0 ? 0.0 : kCoarse;
    if (sum_.status == ProbabilityStatus::converged) ask(of_one);
    return std::move(sum_);
  }

 private:
  static constexpr double kCoarse = 0.2;

  void ask(ProbabilityRequest request) {
    ProbabilityResult sum;
    sum.method = ProbabilityMethod::estimate;
    sum.estimate = sum.standard_error = sum.lower = sum.upper = 0.0;
    for (std::size_t i = 0; i < mixture_.size(); ++i) {
      if (request_.time_limit) {
        request.time_limit = std::max(1e-9, *request_.time_limit - watch_.seconds());
      }
      add(weights_[i], answer_(*mixture_[i].configuration, request), sum);
    }
    sum_ = std::move(sum);
    decide();
  }

  static void add(double weight, const ProbabilityResult& part, ProbabilityResult& sum) {
    const double lower = part.lower.value_or(0.0);
    const double upper = part.upper.value_or(1.0);
    const double error = part.standard_error.value_or(0.5 * (upper - lower));
    sum.estimate = *sum.estimate + weight * part.probability();
    sum.standard_error = std::hypot(*sum.standard_error, weight * error);
    sum.lower = std::max(0.0, *sum.lower + weight * lower * (1.0 - kRounding) - detail::kUnderflow);
    sum.upper = std::min(1.0, *sum.upper + weight * upper * (1.0 + kRounding));
    if (part.gradient) {
      sum.gradient = sum.gradient.value_or(Eigen::Vector3d::Zero()) + weight * *part.gradient;
    }
    sum.statistics.cells += part.statistics.cells;
    sum.statistics.pairs_tested += part.statistics.pairs_tested;
    sum.statistics.leaf_pairs += part.statistics.leaf_pairs;
    sum.statistics.samples += part.statistics.samples;
    const bool complete =
        part.status == ProbabilityStatus::converged || part.status == ProbabilityStatus::exact;
    if (!complete) sum.status = part.status;
    sum.plan.insert(sum.plan.end(), part.plan.begin(), part.plan.end());
  }

  void decide() {
    const double tail = 0.5 * (1.0 - request_.confidence);
    const double reach = detail::normalQuantileAbove(tail) * *sum_.standard_error;
    const Bounds interval{std::max(0.0, *sum_.estimate - reach),
                          std::min(1.0, *sum_.estimate + reach)};
    sum_.confidence_interval = interval;
    sum_.decision = detail::decisionOf(interval, request_);
  }

  static constexpr double kRounding = 1e-14;

  const std::vector<ConfigurationQuery::Weighted>& mixture_;
  std::vector<double> weights_;
  AnswerOf answer_;
  const ProbabilityRequest& request_;
  detail::Stopwatch watch_;
  ProbabilityResult sum_;
};

}  // namespace

double ConfigurationQuery::collisionProbability(const std::vector<Weighted>& mixture,
                                                const ProbabilityRequest& request,
                                                ProbabilityResult& result) const {
  validateRequest(request);
  detail::refuseBand(request, "random configurations");
  const std::vector<double> weights = validatedWeights(mixture);
  if (request.method == ProbabilityMethod::monte_carlo) {
    result = implementation_->count(mixture, weights, request);
    return result.probability();
  }
  const bool translations = mixture.size() == 1 && mixture[0].configuration->dimension() == 0;
  if (!isEstimate(request.method) && !translations) {
    throw UnsupportedGeometry("method " + toString(request.method) +
                              " has no answer for random configurations");
  }
  if (mixture.size() == 1) {
    result = implementation_->estimate(*mixture[0].configuration, request);
    return result.probability();
  }
  const auto answer = [this](const RandomConfiguration& configuration,
                             const ProbabilityRequest& of_one) {
    return implementation_->estimate(configuration, of_one);
  };
  result = MixtureSum(mixture, weights, answer, request).answer();
  return result.probability();
}

}  // namespace fcl_prob
