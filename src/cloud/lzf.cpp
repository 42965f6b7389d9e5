// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cloud/cloud_files.h"

namespace fcl_prob::detail {

// A control byte below 32 is followed by so many literal bytes and one more; of any other the upper
// three bits are a length (7: the next byte is added), the lower five and the next byte a distance.
std::optional<std::string> decompressLzf(std::string_view data, std::size_t size) {
  constexpr std::size_t kMostExpanded = 264;
  if (size / kMostExpanded > data.size()) return std::nullopt;
  std::string result;
  result.reserve(size);
  std::size_t at = 0;
  const auto next = [&] { return static_cast<unsigned char>(data[at++]); };
  while (at < data.size()) {
    const std::size_t control = next();
    if (control < 32) {
      const std::size_t count = control + 1;
      if (data.size() - at < count || size - result.size() < count) return std::nullopt;
      result.append(data.substr(at, count));
      at += count;
      continue;
    }
    std::size_t length = control >> 5;
    if (length == 7) {
      if (at >= data.size()) return std::nullopt;
      length += next();
    }
    length += 2;
    if (at >= data.size()) return std::nullopt;
    const std::size_t distance = ((control & 31) << 8) + next() + 1;
    if (distance > result.size() || size - result.size() < length) return std::nullopt;
    // The two may overlap.
    for (std::size_t i = 0; i < length; ++i) result.push_back(result[result.size() - distance]);
  }
  if (result.size() != size) return std::nullopt;
  return result;
}

}  // namespace fcl_prob::detail
