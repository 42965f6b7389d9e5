// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "base/random_words.h"
#include "base/refuse_band.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/pose_probability.h"
#include "pose/configuration_estimate.h"
#include "pose/configuration_mixture.h"
#include "pose/sampled_configuration.h"
#include "sampling/placement_monte_carlo.h"
#include "sampling/sample_loop.h"

namespace fcl_prob {
namespace {

detail::ConfigurationMixture validatedMixture(
    const std::vector<ConfigurationQuery::Weighted>& mixture) {
  std::vector<detail::ConfigurationMixture::Component> components;
  double sum = 0.0;
  for (const auto& component : mixture) {
    if (!std::isfinite(component.weight) || component.weight < 0.0) {
      throw InvalidDistribution("weight of a configuration is " +
                                detail::numberText(component.weight));
    }
    if (!component.configuration) throw InvalidRequest("a configuration of the mixture is null");
    sum += component.weight;
    components.push_back({component.weight, component.configuration.get()});
  }
  if (!(std::abs(sum - 1.0) <= 1e-9)) {
    throw InvalidDistribution("weights of the configurations add up to " + detail::numberText(sum));
  }
  for (auto& component : components) component.weight /= sum;
  return detail::ConfigurationMixture(std::move(components));
}

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

  ProbabilityResult estimate(const detail::ConfigurationMixture& mixture,
                             const ProbabilityRequest& request) const {
    const auto answer = [this](const PlacedConfiguration& placed,
                               const ProbabilityRequest& of_one) {
      return answerAt(placed, of_one);
    };
    return detail::configurationEstimate(mixture, answer, a, b, request);
  }

  ProbabilityResult count(const detail::ConfigurationMixture& mixture,
                          const ProbabilityRequest& request) const {
    constexpr std::uint64_t kChoices = 0x6d697874;
    const auto sampler = [&](std::size_t index) {
      const double uniform =
          detail::uniformFrom(detail::randomWords({request.seed, kChoices}, index)[0]);
      const RandomConfiguration& configuration =
          *mixture.components()[mixture.chosenBy(uniform)].configuration;
      // From the request's first stream; block 0 is the displacement's.
      return detail::sampledAt(
          configuration,
          detail::standardNormals({request.seed}, index, configuration.dimension(), 1),
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

}  // namespace

double ConfigurationQuery::collisionProbability(const std::vector<Weighted>& mixture,
                                                const ProbabilityRequest& request,
                                                ProbabilityResult& result) const {
  validateRequest(request);
  detail::refuseBand(request, "random configurations");
  const detail::ConfigurationMixture validated = validatedMixture(mixture);
  if (request.method == ProbabilityMethod::monte_carlo) {
    result = implementation_->count(validated, request);
    return result.probability();
  }
  if (mixture.size() == 1 && validated.dimension() == 0) {
    result = implementation_->answerAt(mixture[0].configuration->at(Eigen::VectorXd()), request);
    return result.probability();
  }
  if (!isEstimate(request.method)) {
    throw UnsupportedGeometry("method " + toString(request.method) +
                              " has no answer for random configurations");
  }
  result = implementation_->estimate(validated, request);
  return result.probability();
}

}  // namespace fcl_prob
