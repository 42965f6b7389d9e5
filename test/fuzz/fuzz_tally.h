// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// How many inputs got how far, printed when a fuzzer ends.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace fcl_prob_fuzz {

class Tally {
 public:
  /// \param unit  what one input is called
  explicit Tally(std::string unit) : unit_(std::move(unit)) {}
  ~Tally();
  Tally(const Tally&) = delete;
  Tally& operator=(const Tally&) = delete;

  void count(const std::string& stage) { ++counts_[stage]; }

 private:
  std::string unit_;
  std::map<std::string, std::uint64_t> counts_;
};

/// Ends the program with a message: what libFuzzer takes for a crash.
[[noreturn]] void fail(const std::string& message);

/// fail() unless `holds`.
inline void require(bool holds, const std::string& message) {
  if (!holds) fail(message);
}

/// A number that the bytes fix (FNV-1a): decides what to do with one input in so many.
std::uint64_t hashOf(const std::uint8_t* data, std::size_t size);

}  // namespace fcl_prob_fuzz
