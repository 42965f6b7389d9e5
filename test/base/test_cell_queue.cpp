// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "base/cell_queue.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <utility>

#include "base/decision.h"

using namespace fcl_prob;
using namespace fcl_prob::detail;

namespace {

/// The share of [0, 1] where x² < 0.3: sqrt(0.3), by halving intervals.
class Halving {
 public:
  explicit Halving(const ProbabilityRequest& request) : request_(request), budget_(request) {
    queue_.push({0.0, 1.0});
  }

  ProbabilityStatus run() { return queue_.run(*this); }
  Bounds interval() const { return {settled_, settled_ + queue_.totals().open}; }
  const std::vector<double>& order() const { return order_; }

  ProbabilityStatistics statistics;

 private:
  friend class CellQueue<Halving>;

  struct Cell {
    double from = 0.0;
    double to = 0.0;
    double gap() const { return to - from; }
  };
  struct Totals {
    double open = 0.0;
    void add(const Cell& cell) { open += cell.gap(); }
    void remove(const Cell& cell) { open -= cell.gap(); }
  };
  struct Worker {
    ProbabilityStatistics statistics;
  };
  struct Parts {
    double settled = 0.0;
    std::vector<Cell> open;
  };
  using Queue = CellQueue<Halving>;

  static constexpr RoundSizes kRounds{2, 8, 1, 1, 1, 4};

  static std::unique_ptr<Worker> makeWorker() { return std::make_unique<Worker>(); }
  bool isOneByOne() const { return statistics.cells < 4; }
  static auto enough() {
    return [](double, std::size_t, double) { return false; };
  }
  void beginRound(std::vector<Queue::InRound>& round, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      order_.push_back(round[i].cell.from);
      round[i].parts = {};
    }
  }
  static void divide(Worker& worker, const Cell& cell, Parts& parts) {
    ++worker.statistics.cells;
    const double middle = 0.5 * (cell.from + cell.to);
    for (const Cell& part : {Cell{cell.from, middle}, Cell{middle, cell.to}}) {
      if (part.to * part.to < 0.3) {
        parts.settled += part.gap();
      } else if (part.from * part.from < 0.3) {
        parts.open.push_back(part);
      }
    }
  }
  void add(Parts& parts) {
    settled_ += parts.settled;
    for (const Cell& cell : parts.open) queue_.push(cell);
  }
  std::optional<ProbabilityStatus> satisfied() const {
    return detail::satisfied(interval(), request_);
  }
  static std::size_t memory() { return 100; }

  const ProbabilityRequest& request_;
  Budget budget_;
  double settled_ = 0.0;
  std::vector<double> order_;
  Queue queue_{request_, budget_, statistics, request_.threads, makeWorker()};
};

ProbabilityRequest requestFor(double tolerance, unsigned threads) {
  ProbabilityRequest request;
  request.relative_tolerance = 0.0;
  request.absolute_tolerance = tolerance;
  request.threads = threads;
  return request;
}

}  // namespace

TEST_CASE("cells are divided until the request is satisfied") {
  const ProbabilityRequest request = requestFor(1e-6, 1);
  Halving halving(request);
  CHECK(halving.run() == ProbabilityStatus::converged);
  CHECK(halving.interval().contains(std::sqrt(0.3)));
  CHECK(halving.interval().width() <= 1e-6);
  CHECK(halving.statistics.cells_open == 1);
}

TEST_CASE("a run that met its limit goes on where it stopped") {
  ProbabilityRequest request = requestFor(1e-6, 1);
  const std::size_t all = std::exchange(request.max_cells, 5);
  Halving halving(request);
  CHECK(halving.run() == ProbabilityStatus::cell_limit);
  CHECK(halving.statistics.cells == 5);
  const Bounds before = halving.interval();
  CHECK(before.contains(std::sqrt(0.3)));
  request.max_cells = all;
  CHECK(halving.run() == ProbabilityStatus::converged);
  CHECK(halving.interval().lower >= before.lower);
  CHECK(halving.interval().upper <= before.upper);
}

TEST_CASE("which cells are divided does not depend on the number of threads") {
  const ProbabilityRequest one = requestFor(1e-9, 1), four = requestFor(1e-9, 4);
  Halving alone(one), together(four);
  alone.run();
  together.run();
  CHECK(alone.order() == together.order());
  CHECK(alone.interval().lower == together.interval().lower);
}

TEST_CASE("memory and the caller end a run, with bounds that hold") {
  ProbabilityRequest request = requestFor(1e-12, 1);
  request.max_memory = 50;
  Halving poor(request);
  CHECK(poor.run() == ProbabilityStatus::memory_limit);
  request.max_memory = 1000;
  int asked = 0;
  request.on_progress = [&](const ProbabilityProgress& progress) {
    CHECK(progress.interval.contains(std::sqrt(0.3)));
    return ++asked < 3;
  };
  Halving cancelled(request);
  CHECK(cancelled.run() == ProbabilityStatus::cancelled);
  CHECK(cancelled.interval().contains(std::sqrt(0.3)));
  CHECK(cancelled.statistics.cells >= 8);
}
