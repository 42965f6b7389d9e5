// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Seeds of what is drawn for different things.
#pragma once

#include <cstdint>

namespace fcl_prob::detail {

/// Between two of them: 2⁶⁴ over the golden ratio.
inline constexpr std::uint64_t kSeedsApart = 0x9e3779b97f4a7c15;

}  // namespace fcl_prob::detail
