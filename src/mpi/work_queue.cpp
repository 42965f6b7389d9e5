// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "mpi/work_queue.h"

#include <algorithm>

namespace fcl_prob::mpi {

WorkQueue::WorkQueue(const sweep::SweepOptions& options, Schedule schedule, int ranks)
    : results_(options.output, options.resume),
      lines_(options.queries, options.shard, results_.done()),
      schedule_(schedule),
      ranks_(static_cast<std::size_t>(ranks)),
      left_(lines_.pending()) {
  progress_.total = lines_.total();
  progress_.done = lines_.total() - lines_.pending();
  if (schedule_ == Schedule::queue) return;
  shares_.resize(ranks_);
  std::size_t number = 0;
  while (auto line = lines_.next()) shares_[number++ % ranks_].push_back(std::move(*line));
}

Lines WorkQueue::next(int rank) {
  // Few enough that none is left with much while the others have nothing, and enough that asking
  // for them is nothing beside answering them.
  constexpr std::size_t kMost = 32;
  const std::lock_guard<std::mutex> lock(mutex_);
  if (schedule_ == Schedule::queue) {
    return chunk(std::clamp<std::size_t>(left_ / (4 * ranks_), 1, kMost));
  }
  Lines& share = shares_[static_cast<std::size_t>(rank)];
  const std::size_t count = std::min(kMost, share.size());
  const Lines some(std::make_move_iterator(share.begin()),
                   std::make_move_iterator(share.begin() + static_cast<std::ptrdiff_t>(count)));
  share.erase(share.begin(), share.begin() + static_cast<std::ptrdiff_t>(count));
  return some;
}

Lines WorkQueue::chunk(std::size_t most) {
  Lines some;
  while (some.size() < most) {
    auto line = lines_.next();
    if (!line) break;
    some.push_back(std::move(*line));
    --left_;
  }
  return some;
}

void WorkQueue::keep(const std::vector<std::string>& records, std::size_t errors) {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const std::string& record : records) results_.append(record);
  progress_.done += records.size();
  progress_.errors += errors;
}

sweep::SweepProgress WorkQueue::finish() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (progress_.done == progress_.total) results_.finish();
  return progress_;
}

}  // namespace fcl_prob::mpi
