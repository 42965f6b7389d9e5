// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The partition for convex objects beside a mesh: cells are convex polytopes that are divided
// along the planes of the C-obstacles themselves.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <vector>

#include "base/cell_queue.h"
#include "cells/cell_carver.h"

namespace fcl_prob::detail {

/// The convex polytopes of a partition, as CellQueue divides them, and the totals of what is
/// settled.
class CarvingEngine {
 public:
  /// Keeps references to all arguments.
  CarvingEngine(FatMembers& obstacles, const SolidContact* solids,
                const ProbabilityRequest& request, Budget& budget,
                ProbabilityStatistics& statistics);

  /// Divides cells until the request is satisfied or a limit is reached; says which.
  ProbabilityStatus run();

  /// Certified; valid at every moment.
  Bounds interval() const;

 private:
  friend class CellQueue<CarvingEngine>;

  static constexpr RoundSizes kRounds{8, 64, 8, 1, 1, 16};

  /// Looks at one cell at a time, and counts what it does besides.
  struct Worker {
    explicit Worker(CarvingEngine& engine)
        : carver(engine.obstacles_, engine.solids_, engine.request_, engine.list_memory_,
                 statistics) {}

    ProbabilityStatistics statistics;
    CellCarver carver;
  };

  /// The heap moves these, not the cells.
  struct Queued {
    double of_gap = 0.0;
    std::unique_ptr<CarvedCell> cell;

    double gap() const { return of_gap; }
  };

  using Cell = Queued;
  using Parts = Carving;

  /// Over the open cells.
  struct Totals {
    Bounds open{0.0, 0.0};
    std::size_t memory = 0;

    void add(const Queued& queued);
    void remove(const Queued& queued);
  };

  using Queue = CellQueue<CarvingEngine>;

  /// Whether those that were taken have to be divided in any case: if fewer were settled
  /// altogether, that would not be enough.
  struct Enough {
    double needed;
    bool operator()(double taken, std::size_t /*count*/, double /*next*/) const {
      return taken >= needed;
    }
  };

  std::unique_ptr<Worker> makeWorker() { return std::make_unique<Worker>(*this); }
  bool isOneByOne() const;
  Enough enough() const;
  void beginRound(std::vector<Queue::InRound>& round, std::size_t count);
  void divide(Worker& worker, Queued& queued, Carving& carving) const;
  void add(Carving& carving);
  void push(std::unique_ptr<CarvedCell> cell);
  std::optional<ProbabilityStatus> satisfied() const;
  std::size_t memory() const { return obstacles_.memory() + queue_.totals().memory + list_memory_; }

  FatMembers& obstacles_;
  const SolidContact* solids_;
  const ProbabilityRequest& request_;
  ProbabilityStatistics& statistics_;
  std::atomic<std::size_t> list_memory_{0};  // before the cells that refer to it
  Bounds settled_;
  double slivers_ = 0.0;  ///< what may lie between cells or belong to two
  double certain_ = 0.0;  ///< mass that was settled before the round
  Queue queue_;
};

}  // namespace fcl_prob::detail
