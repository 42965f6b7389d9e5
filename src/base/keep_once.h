// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Leaving out what comes again.
#pragma once

#include <algorithm>

namespace fcl_prob::detail {

/// Leaves each of the items once, in ascending order.
template <typename Items>
void keepOnce(Items& items) {
  std::sort(items.begin(), items.end());
  items.erase(std::unique(items.begin(), items.end()), items.end());
}

}  // namespace fcl_prob::detail
