// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A checksum of the bits of results: equal hashes mean equal results.
#pragma once

#include <boost/crc.hpp>
#include <string>

#include "fcl_prob/probability_result.h"

namespace fcl_prob::cli {

class ResultHash {
 public:
  /// Lower, upper, estimate and standard error.
  void add(const ProbabilityResult& result);

  /// Eight hexadecimal digits.
  std::string text() const;

 private:
  boost::crc_32_type crc_;
};

}  // namespace fcl_prob::cli
