// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "bench/result_hash.h"

#include <iomanip>
#include <sstream>

namespace fcl_prob::cli {

void ResultHash::add(const ProbabilityResult& result) {
  for (const auto& number : {result.lower, result.upper, result.estimate, result.standard_error}) {
    const double value = number.value_or(0.0);
    crc_.process_bytes(&value, sizeof value);
  }
}

std::string ResultHash::text() const {
  std::ostringstream text;
  text << std::hex << std::setw(8) << std::setfill('0') << crc_.checksum();
  return text.str();
}

}  // namespace fcl_prob::cli
