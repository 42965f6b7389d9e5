// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#pragma once

#include <cstdint>

namespace fcl_prob::detail {

/// A random word as a number in (0, 1), never 0 or 1.
inline double unitUniform(std::uint64_t word) {
  return (static_cast<double>(word >> 11) + 0.5) * 0x1p-53;
}

}  // namespace fcl_prob::detail
