// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Evaluating many independent samples on several threads, with a clock.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>

#include "base/stopwatch.h"

namespace fcl_prob::detail {

/// Runs samples in chunks, of one sample at first, that take a fraction of a second each; between
/// two chunks the calling thread may look at the clock and report progress. What a sample evaluates
/// to must depend on its index only.
class SampleLoop {
 public:
  static constexpr std::size_t kLargestChunk = 1 << 14;

  /// More threads than the machine has would not run.
  explicit SampleLoop(unsigned threads)
      : threads_(std::min(threads, static_cast<unsigned>(tbb::info::default_concurrency()))),
        arena_(static_cast<int>(threads_)) {}

  /// Calls `evaluate(i)` for every i in [first, last) and `goOn(done)` after each chunk; stops when
  /// that returns false. \return the end of the last chunk.
  template <typename Evaluate, typename GoOn>
  std::size_t run(std::size_t first, std::size_t last, const Evaluate& evaluate, const GoOn& goOn) {
    while (first < last) {
      const std::size_t end = std::min(last, first + chunk_);
      const Stopwatch watch;
      runChunk(first, end, evaluate);
      if (watch.seconds() < kChunkSeconds) chunk_ = std::min(2 * chunk_, kLargestChunk);
      first = end;
      if (!goOn(first)) break;
    }
    return first;
  }

 private:
  static constexpr double kChunkSeconds = 0.02;

  template <typename Evaluate>
  void runChunk(std::size_t first, std::size_t end, const Evaluate& evaluate) {
    if (threads_ == 1) {
      for (std::size_t i = first; i < end; ++i) evaluate(i);
      return;
    }
    arena_.execute([&] {
      tbb::parallel_for(tbb::blocked_range<std::size_t>(first, end, 8),
                        [&](const tbb::blocked_range<std::size_t>& range) {
                          for (std::size_t i = range.begin(); i < range.end(); ++i) evaluate(i);
                        });
    });
  }

  unsigned threads_;
  tbb::task_arena arena_;
  std::size_t chunk_ = 1;
};

}  // namespace fcl_prob::detail
