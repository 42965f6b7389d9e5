// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A round of independent pieces of work, on several threads.
#pragma once

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace fcl_prob::detail {

/// Workers have what a piece of work needs for itself, and what it must not share with another one
/// at the same time. What comes of a piece may not depend on which of them does it.
template <typename Worker>
class RoundWorkers {
 public:
  /// \param first  a worker, to which the caller may keep a reference; the others are made when
  /// they are first needed. More threads than the machine has would not run.
  RoundWorkers(unsigned threads, std::unique_ptr<Worker> first)
      : workers_(std::clamp<std::size_t>(
            threads, 1, static_cast<std::size_t>(tbb::info::default_concurrency()))) {
    workers_[0] = std::move(first);
  }

  /// Whether run() uses more than the calling thread.
  bool areSeveral() const { return workers_.size() > 1; }

  Worker& first() { return *workers_[0]; }
  const Worker& first() const { return *workers_[0]; }

  /// Calls `work(worker, i)` for every i below `count`, those in front first.
  /// \param make  another worker, as a std::unique_ptr
  template <typename Make, typename Work>
  void run(std::size_t count, const Make& make, const Work& work) {
    if (!areSeveral() || count < 2) {
      for (std::size_t i = 0; i < count; ++i) work(*workers_[0], i);
      return;
    }
    if (!arena_) arena_ = std::make_unique<tbb::task_arena>(static_cast<int>(workers_.size()));
    std::atomic<std::size_t> next{0};
    const auto work_on = [&](std::size_t) {
      std::unique_ptr<Worker>& worker =
          workers_[static_cast<std::size_t>(tbb::this_task_arena::current_thread_index())];
      if (!worker) worker = make();
      for (std::size_t i = next++; i < count; i = next++) work(*worker, i);
    };
    arena_->execute(
        [&] { tbb::parallel_for(std::size_t{0}, std::min(count, workers_.size()), work_on); });
  }

  /// Calls `function(worker)` for all that there are.
  template <typename Function>
  void visit(const Function& function) {
    for (const std::unique_ptr<Worker>& worker : workers_) {
      if (worker) function(*worker);
    }
  }

 private:
  std::vector<std::unique_ptr<Worker>> workers_;  ///< by the place of a thread in the arena
  std::unique_ptr<tbb::task_arena> arena_;
};

/// Calls `work(i)` for every i below `count`, on several threads, where no piece needs anything
/// that it must not share.
template <typename Work>
void onThreads(unsigned threads, std::size_t count, const Work& work) {
  struct None {};
  const auto none = [] { return std::make_unique<None>(); };
  RoundWorkers<None>(threads, none()).run(count, none, [&](None&, std::size_t i) { work(i); });
}

}  // namespace fcl_prob::detail
