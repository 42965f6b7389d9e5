// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "sweep/sweep.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "sweep/answer.h"
#include "sweep/results_file.h"

namespace fcl_prob::sweep {
namespace {

class Sweep {
 public:
  Sweep(const SweepOptions& options, const std::function<void(const SweepProgress&)>& on_progress,
        const std::function<bool()>& goes_on)
      : results_(options.output, options.resume),
        lines_(options.queries, options.shard, results_.done()),
        on_progress_(on_progress),
        goes_on_(goes_on) {
    progress_.total = lines_.total();
    progress_.done = lines_.total() - lines_.pending();
  }

  SweepProgress run(std::size_t threads) {
    const std::size_t count = std::clamp<std::size_t>(lines_.pending(), 1, threads);
    if (count > 1) loadMeshes();
    std::vector<std::thread> others;
    for (std::size_t i = 1; i < count; ++i) others.emplace_back([this] { work(); });
    work();
    for (std::thread& other : others) other.join();
    if (failure_) std::rethrow_exception(failure_);
    if (progress_.done == progress_.total) results_.finish();
    return progress_;
  }

 private:
  bool goesOn() const { return !stopped_ && goes_on_(); }

  /// Every mesh is read in a child process. That is forked while there is no other thread, which
  /// might hold a lock then that nobody opens again in the child.
  void loadMeshes() {
    for (auto line = lines_.next(); line && goesOn(); line = lines_.next()) {
      QueryLine query;
      try {
        readQueryLine(*line, lines_.folder(), query);
      } catch (const std::exception&) {
        continue;  // answer() says so
      }
      scenes_.loadMeshes(query);
    }
    lines_.rewind();
  }

  void work() {
    try {
      while (goesOn()) {
        const std::optional<NumberedLine> line = nextLine();
        if (!line) return;
        const auto record = answer(*line, lines_.folder(), scenes_, [this] { return goesOn(); });
        if (record) keep(*record);
      }
    } catch (...) {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
      stopped_ = true;
    }
  }

  std::optional<NumberedLine> nextLine() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return lines_.next();
  }

  void keep(const Record& record) {
    const std::lock_guard<std::mutex> lock(mutex_);
    results_.append(record.text);
    ++progress_.done;
    if (record.is_error) ++progress_.errors;
    on_progress_(progress_);
  }

  ResultsFile results_;
  PendingLines lines_;
  PreparedScenes scenes_;
  const std::function<void(const SweepProgress&)>& on_progress_;
  const std::function<bool()>& goes_on_;
  std::atomic<bool> stopped_{false};
  std::mutex mutex_;
  SweepProgress progress_;
  std::exception_ptr failure_;
};

}  // namespace

SweepProgress runSweep(const SweepOptions& options,
                       const std::function<void(const SweepProgress&)>& on_progress,
                       const std::function<bool()>& goes_on) {
  return Sweep(options, on_progress, goes_on).run(options.threads);
}

}  // namespace fcl_prob::sweep
