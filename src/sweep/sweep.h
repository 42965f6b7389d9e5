// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Many queries from a file, on all cores.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "sweep/pending_lines.h"

namespace fcl_prob::sweep {

struct SweepOptions {
  std::string queries;
  std::string output;
  bool resume = false;
  Shard shard;
  std::size_t threads = 1;
};

struct SweepProgress {
  std::size_t done = 0;    ///< results in the file
  std::size_t total = 0;   ///< queries
  std::size_t errors = 0;  ///< among the results of this run
};

/// Answers every query that has no result yet. The file of results is the same to the byte for any
/// number of threads, and however often the run was killed and taken up again.
/// \param goes_on  told after every result, from any thread but never from two at once; asked now
///                 and then besides
/// \throws FileError, InvalidRequest before any work; FileError if a result cannot be written
SweepProgress runSweep(const SweepOptions& options,
                       const std::function<void(const SweepProgress&)>& on_progress,
                       const std::function<bool()>& goes_on);

}  // namespace fcl_prob::sweep
