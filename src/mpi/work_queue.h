// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Who answers which query, and where the results go: on the rank that has the files.
#pragma once

#include <mutex>
#include <string>
#include <vector>

#include "sweep/pending_lines.h"
#include "sweep/results_file.h"
#include "sweep/sweep.h"

namespace fcl_prob::mpi {

/// How queries are dealt out.
enum class Schedule {
  queue,   ///< a few at a time to whoever has none left, fewer towards the end
  shards,  ///< every rank its share from the beginning, as --shard does: for comparison
};

/// Some queries, or some results.
using Lines = std::vector<sweep::NumberedLine>;

/// May be used by several threads.
class WorkQueue {
 public:
  /// \throws FileError
  WorkQueue(const sweep::SweepOptions& options, Schedule schedule, int ranks);

  /// What a rank is to answer next; nothing if it is done.
  Lines next(int rank);

  /// \param is_error  by record \throws FileError
  void keep(const std::vector<std::string>& records, std::size_t errors);

  /// Puts the results in order. \returns what was done
  sweep::SweepProgress finish();

  std::string folder() const { return lines_.folder().string(); }

 private:
  Lines chunk(std::size_t most);

  sweep::ResultsFile results_;
  sweep::PendingLines lines_;
  Schedule schedule_;
  std::size_t ranks_;
  std::size_t left_;  ///< not yet dealt out
  sweep::SweepProgress progress_;
  std::vector<Lines> shares_;
  std::mutex mutex_;
};

}  // namespace fcl_prob::mpi
