// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fuzz_tally.h"

#include <cstdio>
#include <cstdlib>

namespace fcl_prob_fuzz {

Tally::~Tally() {
  std::fprintf(stderr, "fuzzed %s:", unit_.c_str());
  for (const auto& [stage, count] : counts_) {
    std::fprintf(stderr, " %s %llu;", stage.c_str(), static_cast<unsigned long long>(count));
  }
  std::fprintf(stderr, "\n");
}

void fail(const std::string& message) {
  std::fprintf(stderr, "fuzzing found: %s\n", message.c_str());
  std::abort();
}

std::uint64_t hashOf(const std::uint8_t* data, std::size_t size) {
  std::uint64_t hash = 14695981039346656037u;
  for (std::size_t i = 0; i < size; ++i) hash = (hash ^ data[i]) * 1099511628211u;
  return hash ^ (hash >> 32);
}

}  // namespace fcl_prob_fuzz
