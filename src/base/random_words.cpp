// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "base/random_words.h"

#include <Random123/philox.h>

#include <Random123/boxmuller.hpp>
#include <algorithm>

namespace fcl_prob::detail {

std::array<std::uint64_t, 4> randomWords(RandomStream stream, std::uint64_t index,
                                         std::uint64_t block, std::uint64_t purpose) {
  const r123::Philox4x64::ctr_type counter = {{index, block, purpose, 0}};
  const r123::Philox4x64::key_type key = {{stream.seed, stream.stream}};
  const r123::Philox4x64::ctr_type words = r123::Philox4x64()(counter, key);
  return {words[0], words[1], words[2], words[3]};
}

double uniformFrom(std::uint64_t word) {
  constexpr double kBelowOne = 1.0 - 0x1p-53;
  return std::min(r123::u01<double>(word), kBelowOne);
}

Eigen::Vector3d standardNormalFrom(const std::array<std::uint64_t, 4>& words) {
  const r123::double2 first = r123::boxmuller(words[0], words[1]);
  const r123::double2 second = r123::boxmuller(words[2], words[3]);
  return {first.x, first.y, second.x};
}

}  // namespace fcl_prob::detail
