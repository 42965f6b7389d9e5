// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The displacement of a robot relative to an obstacle, from that of the obstacle.
#pragma once

#include <utility>
#include <vector>

#include "fcl_prob/mixture.h"

namespace fcl_prob::detail {

inline GaussianDisplacement reversed(const GaussianDisplacement& displacement) {
  return displacement.reversed();
}

inline GaussianMixture reversed(const GaussianMixture& mixture) {
  std::vector<GaussianMixture::Component> components = mixture.components();
  for (auto& component : components) component.displacement = component.displacement.reversed();
  return GaussianMixture(std::move(components));
}

inline TruncatedGaussian reversed(const TruncatedGaussian& truncated) {
  return {truncated.gaussian().reversed(), truncated.deviations()};
}

}  // namespace fcl_prob::detail
