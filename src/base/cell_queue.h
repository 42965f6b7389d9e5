// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The queue of open cells that every partition divides: boxes, convex polytopes, rotations.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "base/budget.h"
#include "base/round_workers.h"
#include "base/statistics.h"

namespace fcl_prob::detail {

/// How the cells with the largest gaps are divided at once.
struct RoundSizes {
  std::size_t least;
  std::size_t most;
  std::size_t open_of_one;        ///< one in so many of the open cells, between the two
  std::size_t cells_left_of_one;  ///< of the limit on cells, so that it cuts few short
  std::size_t cells_of_division;  ///< that dividing one adds at least
  std::size_t between_looks;      ///< cells that are divided between two looks at the clock
};

/// Best first: a heap by gap, divided in rounds by the threads of the request. What a round
/// divides, and in which order what comes of it is added, does not depend on them. The first cells,
/// of which there are few large ones, are divided one by one.
///
/// A Kind of cells has
///
///     using Cell     with double gap() const: what it leaves open of P
///     using Totals   sums over the open cells: add(cell), remove(cell)
///     using Parts    what comes of dividing a cell
///     using Worker   what a thread needs for itself; `statistics` of what it did
///     static constexpr RoundSizes kRounds
///
///     makeWorker()                     another one
///     isOneByOne()                     rounds are not worth waking threads for
///     enough()                         a function of (gaps taken, cells taken, next gap): whether
///                                      no more has to be divided in any case
///     beginRound(round, count)         by one thread, before
///     divide(worker, cell, parts)      by several
///     add(parts)                       by one thread, in order: pushes what is left open
///     satisfied()                      a status ends the run
///     interval(), memory()             at this moment
template <typename Kind>
class CellQueue {
 public:
  using Cell = typename Kind::Cell;
  using Totals = typename Kind::Totals;
  using Worker = typename Kind::Worker;

  struct InRound {
    Cell cell;
    typename Kind::Parts parts;
  };

  /// Keeps references to the request, the budget of the call and the statistics, where the work is
  /// added up.
  CellQueue(const ProbabilityRequest& request, Budget& budget, ProbabilityStatistics& statistics,
            unsigned threads, std::unique_ptr<Worker> first)
      : request_(request),
        budget_(budget),
        statistics_(statistics),
        workers_(threads, std::move(first)),
        round_(1) {}

  void push(Cell cell) {
    totals_.add(cell);
    heap_.push_back(std::move(cell));
    std::push_heap(heap_.begin(), heap_.end(), smallerGap);
  }

  bool empty() const { return heap_.empty(); }
  std::size_t size() const { return heap_.size(); }
  const Cell& largest() const { return heap_.front(); }
  const std::vector<Cell>& cells() const { return heap_; }
  const Totals& totals() const { return totals_; }

  Worker& worker() { return workers_.first(); }
  const Worker& worker() const { return workers_.first(); }
  bool areSeveralWorkers() const { return workers_.areSeveral(); }

  Budget& budget() const { return budget_; }

  /// That all that divide may examine together.
  std::size_t cellsLeft() const { return request_.max_cells - statistics_.cells; }

  /// Of the limit on cells.
  double fraction() const {
    return static_cast<double>(statistics_.cells) / static_cast<double>(request_.max_cells);
  }

  /// Divides cells until the kind is satisfied or a limit is reached; says which. May be called
  /// again. \param share  of the time limit
  ProbabilityStatus run(Kind& kind, double share = 1.0) {
    std::optional<ProbabilityStatus> status;
    ++changes_since_recount_;
    std::size_t divided = 0;
    std::size_t next_look = 0;
    while (!status) {
      if (changes_since_recount_ * 4 > heap_.size()) recount();
      status = kind.satisfied();
      if (status && changes_since_recount_ > 0) {
        recount();
        status = kind.satisfied();
      }
      if (!status) status = limited(kind);
      if (!status && divided >= next_look) {
        status = budget_.look(kind.interval(), fraction(), share);
        next_look = divided + Kind::kRounds.between_looks;
      }
      if (!status) {
        const std::size_t count = divideLargest(kind);
        divided += count;
        changes_since_recount_ += count;
      }
      statistics_.peak_memory = std::max(statistics_.peak_memory, kind.memory());
    }
    recount();
    statistics_.cells_open = heap_.size();
    return *status;
  }

  /// Adds what the workers did to the statistics.
  void collectStatistics() {
    workers_.visit([this](Worker& worker) {
      addStatistics(std::exchange(worker.statistics, {}), statistics_);
    });
  }

 private:
  static bool smallerGap(const Cell& x, const Cell& y) { return x.gap() < y.gap(); }

  Cell pop() {
    std::pop_heap(heap_.begin(), heap_.end(), smallerGap);
    Cell cell = std::move(heap_.back());
    heap_.pop_back();
    totals_.remove(cell);
    return cell;
  }

  // Sums of many additions and removals drift: every so often they are taken anew.
  void recount() {
    totals_ = {};
    for (const Cell& cell : heap_) totals_.add(cell);
    changes_since_recount_ = 0;
  }

  std::optional<ProbabilityStatus> limited(const Kind& kind) const {
    if (statistics_.cells + Kind::kRounds.cells_of_division > request_.max_cells) {
      return ProbabilityStatus::cell_limit;
    }
    if (kind.memory() >= request_.max_memory) return ProbabilityStatus::memory_limit;
    return std::nullopt;
  }

  std::size_t mostOfRound(const Kind& kind) const {
    if (kind.isOneByOne()) return 1;
    constexpr RoundSizes kSizes = Kind::kRounds;
    const std::size_t most =
        std::clamp(heap_.size() / kSizes.open_of_one, kSizes.least, kSizes.most);
    return std::clamp<std::size_t>(cellsLeft() / kSizes.cells_left_of_one, 1, most);
  }

  std::size_t takeLargest(const Kind& kind) {
    const std::size_t most = mostOfRound(kind);
    if (round_.size() < most) round_.resize(most);
    const auto isEnough = kind.enough();
    double taken = 0.0;
    std::size_t count = 0;
    do {
      taken += largest().gap();
      round_[count++].cell = pop();
    } while (count < most && !heap_.empty() && !isEnough(taken, count, largest().gap()));
    return count;
  }

  // How many were divided.
  std::size_t divideLargest(Kind& kind) {
    const std::size_t count = takeLargest(kind);
    kind.beginRound(round_, count);
    workers_.run(
        count, [&kind] { return kind.makeWorker(); },
        [&](Worker& worker, std::size_t i) {
          kind.divide(worker, round_[i].cell, round_[i].parts);
        });
    collectStatistics();
    for (std::size_t i = 0; i < count; ++i) kind.add(round_[i].parts);
    return count;
  }

  const ProbabilityRequest& request_;
  Budget& budget_;
  ProbabilityStatistics& statistics_;
  RoundWorkers<Worker> workers_;
  std::vector<InRound> round_;
  std::vector<Cell> heap_;
  Totals totals_;
  std::size_t changes_since_recount_ = 0;
};

}  // namespace fcl_prob::detail
