// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The partition for convex objects beside a mesh: cells are convex polytopes that are divided
// along the planes of the C-obstacles themselves.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <vector>

#include "base/engine_limits.h"
#include "base/round_workers.h"
#include "carving/cell_carver.h"

namespace fcl_prob::detail {

/// The queue of cells, largest gaps first, and the totals. As in PartitionEngine the first cells
/// are looked at one by one, and then the largest ones at once, in rounds that do not depend on the
/// number of threads.
class CarvingEngine {
 public:
  /// Keeps references to all arguments.
  CarvingEngine(FatMembers& obstacles, const SolidContact* solids,
                const ProbabilityRequest& request, ProbabilityStatistics& statistics);

  /// Divides cells until the request is satisfied or a limit is reached; says which.
  ProbabilityStatus run();

  /// Certified; valid at every moment.
  Bounds interval() const;

 private:
  /// Looks at one cell at a time, and counts what it does besides.
  struct Worker {
    explicit Worker(CarvingEngine& engine)
        : carver(engine.obstacles_, engine.solids_, engine.request_, engine.list_memory_,
                 statistics) {}

    ProbabilityStatistics statistics;
    CellCarver carver;
  };

  /// One of the cells of a round.
  struct Divided {
    std::unique_ptr<CarvedCell> cell;
    Carving carving;
  };

  /// The heap moves these, not the cells.
  struct Queued {
    double gap;
    std::unique_ptr<CarvedCell> cell;

    bool operator<(const Queued& other) const { return gap < other.gap; }
  };

  void push(std::unique_ptr<CarvedCell> cell);
  std::size_t divideLargest();
  std::size_t mostOfRound() const;
  std::size_t takeLargest();
  void divideTaken(std::size_t count);
  void recount();
  std::optional<ProbabilityStatus> satisfied() const;
  std::optional<ProbabilityStatus> limited() const;
  std::size_t memory() const { return obstacles_.memory() + cell_memory_ + list_memory_; }

  FatMembers& obstacles_;
  const SolidContact* solids_;
  const ProbabilityRequest& request_;
  ProbabilityStatistics& statistics_;
  std::atomic<std::size_t> list_memory_{0};  // before the cells that refer to it
  RoundWorkers<Worker> workers_;
  std::vector<Divided> round_;
  std::vector<Queued> queue_;  ///< a heap
  Bounds settled_;
  double slivers_ = 0.0;  ///< what may lie between cells or belong to two
  Bounds open_;
  std::size_t cell_memory_ = 0;
  std::size_t changes_since_recount_ = 0;
  EngineLimits limits_;
};

}  // namespace fcl_prob::detail
