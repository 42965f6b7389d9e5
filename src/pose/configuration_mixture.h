// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// One of several random configurations, each with its probability.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "fcl_prob/random_configuration.h"

namespace fcl_prob::detail {

class ConfigurationMixture {
 public:
  struct Component {
    double weight;
    const RandomConfiguration* configuration;
  };

  /// \param components  at least one; weights add up to 1
  explicit ConfigurationMixture(std::vector<Component> components)
      : components_(std::move(components)) {}

  const std::vector<Component>& components() const { return components_; }

  /// The number of the component that a uniform number chooses.
  std::size_t chosenBy(double uniform) const {
    std::size_t i = 0;
    for (; i + 1 < components_.size() && uniform > components_[i].weight; ++i) {
      uniform -= components_[i].weight;
    }
    return i;
  }

  /// Of the component that has the most.
  int dimension() const {
    int most = 0;
    for (const Component& component : components_) {
      most = std::max(most, component.configuration->dimension());
    }
    return most;
  }

 private:
  std::vector<Component> components_;
};

}  // namespace fcl_prob::detail
