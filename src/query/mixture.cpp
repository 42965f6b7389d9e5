// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/mixture.h"

#include <cmath>

#include "base/number_text.h"
#include "fcl_prob/exceptions.h"

namespace fcl_prob {
namespace {

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
