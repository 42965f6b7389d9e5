// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The best-first queue over open cells, and the totals of everything settled.
#pragma once

#include <optional>
#include <vector>

#include "base/cell_queue.h"
#include "cells/cell_divider.h"
#include "cells/cell_sampling.h"
#include "fcl_prob/probability_request.h"
#include "fcl_prob/probability_result.h"

namespace fcl_prob::detail {

/// Gradient of P in the whitened frame, E[y 1_V], between bounds.
struct MomentBounds {
  Eigen::Vector3d lower;
  Eigen::Vector3d upper;
};

struct EngineEstimate {
  double value;
  double standard_error;
};

/// The boxes of a partition, as CellQueue divides them, and the totals of what is settled.
class PartitionEngine {
 public:
  /// Keeps references to all that the arguments refer to.
  PartitionEngine(const PartitionScene& scene, const ProbabilityRequest& request, Budget& budget,
                  ProbabilityStatistics& statistics);

  /// Divides cells until the request is satisfied or a limit is reached; says which. With
  /// `estimate` the cells need only be small enough for sampling them to give the standard error
  /// asked for. May be called again, after expectDeviation().
  ProbabilityStatus run(bool estimate);

  /// Certified; valid at every moment.
  Bounds interval() const;

  MomentBounds moment() const;

  /// The standard error asked for where P is about `probability`.
  double targetError(double probability) const;

  /// The certain part of P and what was sampled of the rest; where the interval says more than
  /// that, its middle and half its width.
  EngineEstimate estimate(const SampledMass& sampled) const;

  /// Whether all of the time is up, or the caller cancels.
  std::optional<ProbabilityStatus> interruption() const;

  /// How many samples of the open cells give about that error, or as many as are in proportion to
  /// the cells examined; none beyond the least if there is no time left.
  double samplesToDraw(ProbabilityStatus status) const;

  /// Samples turned out to deviate `factor` times as much as expected so far.
  void expectDeviation(double factor) { deviation_share_ *= factor; }

  const SettledMass& settled() const { return settled_; }
  const std::vector<OpenCell>& openCells() const { return queue_.cells(); }
  ObstacleTable& obstacles() { return obstacles_; }

  SettledMass coveredPart(const OpenCell& cell) const {
    return queue_.worker().divider.coveredPart(cell);
  }

 private:
  friend class CellQueue<PartitionEngine>;

  /// What thousands of boxes take about the time of waking a thread for: 32 at once, of which each
  /// examines about six cells and must not be cut short by the limit.
  static constexpr RoundSizes kRounds{4, 32, 8, 16, 2, 16};

  using Cell = OpenCell;

  /// Divides one cell at a time, and counts what it does besides.
  struct Worker {
    Worker(const PartitionScene& scene, ObstacleTable& obstacles)
        : divider(scene, obstacles, statistics) {}

    ProbabilityStatistics statistics;
    CellDivider divider;
  };

  struct Parts {
    Division division;
    CrossingWitness::Hint hint;
  };

  /// Over the open cells.
  struct Totals {
    Bounds open{0.0, 0.0};
    double deviation = 0.0;  ///< bounds on the deviations of one sample
    std::size_t memory = 0;

    void add(const OpenCell& cell);
    void remove(const OpenCell& cell);
  };

  using Queue = CellQueue<PartitionEngine>;

  std::unique_ptr<Worker> makeWorker() { return std::make_unique<Worker>(scene_, obstacles_); }
  bool isOneByOne() const;

  /// Whether those that were taken have to be divided in any case: if fewer were settled
  /// altogether, that would not be enough. Parts of the largest may have larger gaps than those
  /// that are much smaller.
  struct Enough {
    const PartitionEngine& engine;
    double needed;
    double target;
    double least;

    bool operator()(double taken, std::size_t count, double next) const;
  };

  Enough enough() const;
  void beginRound(std::vector<Queue::InRound>& round, std::size_t count);
  void divide(Worker& worker, OpenCell& cell, Parts& parts) const;
  void add(Parts& parts);
  void add(Division& division);
  void add(Examination&& examination);
  std::optional<ProbabilityStatus> satisfied();
  bool isOpenByBand(const Bounds& now) const;
  double samplesNeeded(double target) const;
  double samplesAffordable(std::size_t cells) const;
  void lookForStall();
  std::size_t memory() const { return obstacles_.memory() + queue_.totals().memory; }

  const PartitionScene scene_;
  const ProbabilityRequest& request_;
  ProbabilityStatistics& statistics_;
  ObstacleTable obstacles_;
  CrossingWitness::Hint hint_{-1, -1};           ///< of the last round
  CrossingWitness::Hint hint_of_round_{-1, -1};  ///< of the one before
  std::size_t most_cells_ = 0;                   ///< that dividing one of the round may examine
  SettledMass settled_;
  bool estimate_ = false;
  double deviation_share_ = 1.0;
  bool indivisible_ = false;
  std::shared_ptr<const BandMargin> band_;
  double left_by_band_ = 0.0;  ///< of the width of the interval: what bands or motions leave open
  bool stalled_ = false;       ///< more cells hardly settle more of what is open
  Bounds at_last_look_{0.0, 1.0};
  std::size_t next_look_;
  Queue queue_;
};

}  // namespace fcl_prob::detail
