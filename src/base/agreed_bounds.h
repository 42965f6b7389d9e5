// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What two bounds on the same number say together.
#pragma once

#include <algorithm>

#include "fcl_prob/bounds.h"

namespace fcl_prob::detail {

/// Both are right, so their intersection is; were they to disagree, both would be kept.
inline Bounds agreed(const Bounds& a, const Bounds& b) {
  const Bounds both{std::max(a.lower, b.lower), std::min(a.upper, b.upper)};
  if (both.lower <= both.upper) return both;
  return {std::min(a.lower, b.lower), std::max(a.upper, b.upper)};
}

}  // namespace fcl_prob::detail
