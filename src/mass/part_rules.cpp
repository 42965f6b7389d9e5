// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "mass/part_rules.h"

#include <utility>

namespace fcl_prob::detail {
namespace {

template <unsigned kPoints>
PartRule makePartRule() {
  PartRule rule;
  forEachGaussNode<kPoints>(0.0, 1.0, [&](double x, double weight) {
    rule.nodes.push_back(x);
    rule.weights.push_back(weight);
  });
  return rule;
}

template <unsigned... kPoints>
std::array<PartRule, kMostPartPoints + 1> makePartRules(
    std::integer_sequence<unsigned, kPoints...>) {
  return {PartRule{}, PartRule{{0.0}, {2.0}}, makePartRule<kPoints + 2>()...};
}

}  // namespace

const PartRule& partRule(double points) {
  static const auto rules =
      makePartRules(std::make_integer_sequence<unsigned, kMostPartPoints - 1>());
  return rules[static_cast<std::size_t>(points)];
}

double logOfEllipse(std::size_t ellipse) {
  static const auto logs = [] {
    std::array<double, kEllipses.size()> result{};
    for (std::size_t k = 0; k < result.size(); ++k) result[k] = std::log(kEllipses[k]);
    return result;
  }();
  return logs[ellipse];
}

}  // namespace fcl_prob::detail
