// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Random numbers that depend on a seed and an index only, not on the order of drawing.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace fcl_prob::detail {

/// One of the 2^64 independent sequences of a seed.
struct RandomStream {
  std::uint64_t seed;
  std::uint64_t stream = 0;
};

/// Block `block` of sample `index`: four independent random words (Random123's Philox4x64-10).
/// \param purpose  tells apart what is drawn for different things from one stream
std::array<std::uint64_t, 4> randomWords(RandomStream stream, std::uint64_t index,
                                         std::uint64_t block = 0, std::uint64_t purpose = 0);

/// A word as a number in (0, 1), never 0 or 1: one of 2^53 that are equally far apart.
inline double unitUniform(std::uint64_t word) {
  return (static_cast<double>(word >> 11) + 0.5) * 0x1p-53;
}

/// The same with all bits of the word: near 0 the numbers are closer to each other.
double uniformFrom(std::uint64_t word);

/// Three independent standard normals from four words (Box-Muller).
Eigen::Vector3d standardNormalFrom(const std::array<std::uint64_t, 4>& words);

/// Between two of them: 2⁶⁴ over the golden ratio.
inline constexpr std::uint64_t kSeedsApart = 0x9e3779b97f4a7c15;

}  // namespace fcl_prob::detail
