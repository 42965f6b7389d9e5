// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Gauss-Legendre rules on [-1, 1].
#pragma once

#include <array>

namespace fcl_prob::detail {

struct GaussRule {
  static constexpr int kFewest = 2;
  static constexpr int kMost = 12;

  std::array<double, kMost> node{};
  std::array<double, kMost> weight{};

  /// The rule with `size` nodes, kFewest <= size <= kMost.
  static const GaussRule& ofSize(int size);
};

}  // namespace fcl_prob::detail
