// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The best-first queue over open cells, and the totals of everything settled.
#pragma once

#include <optional>
#include <vector>

#include "base/engine_limits.h"
#include "base/round_workers.h"
#include "fcl_prob/probability_request.h"
#include "fcl_prob/probability_result.h"
#include "partition/cell_divider.h"
#include "partition/cell_sampling.h"

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

/// The cells with the largest gaps are divided at once, in rounds, by the threads of the request:
/// what a round divides, and in which order what comes of it is added, does not depend on them. The
/// first cells, of which there are few large ones, are divided one by one.
class PartitionEngine {
 public:
  /// Keeps references to all that the arguments refer to.
  PartitionEngine(const PartitionScene& scene, const ProbabilityRequest& request,
                  ProbabilityStatistics& statistics);

  /// Divides cells until the request is satisfied or a limit is reached; says which. With
  /// `estimate` the cells need only be small enough for sampling them to give the standard error
  /// asked for. May be called again after expectDeviation().
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

  /// Samples will take less time, so that fewer cells are to be divided for them.
  void expectQuickSamples() { quick_samples_ = true; }

  /// Samples turned out to deviate `factor` times as much as expected so far.
  void expectDeviation(double factor) { deviation_share_ *= factor; }

  const SettledMass& settled() const { return settled_; }
  const std::vector<OpenCell>& openCells() const { return queue_; }
  ObstacleTable& obstacles() { return obstacles_; }

  SettledMass coveredPart(const OpenCell& cell) const {
    return workers_.first().divider.coveredPart(cell);
  }

 private:
  /// Divides one cell at a time, and counts what it does besides.
  struct Worker {
    Worker(const PartitionScene& scene, ObstacleTable& obstacles)
        : divider(scene, obstacles, statistics) {}

    ProbabilityStatistics statistics;
    CellDivider divider;
  };

  /// One of the cells of a round.
  struct Divided {
    OpenCell cell;
    Division division;
    CrossingWitness::Hint hint;
  };

  std::size_t divideLargest(bool estimate);
  std::size_t mostOfRound() const;
  std::size_t takeLargest(bool estimate);
  void divideTaken(std::size_t count);
  void collectStatistics();
  void add(Division& division);
  void add(Examination&& examination);
  void remove(const OpenCell& cell);
  void recount();
  std::optional<ProbabilityStatus> satisfied(bool estimate) const;
  bool isOpenByBand(const Bounds& now) const;
  double samplesNeeded(double target) const;
  double samplesAffordable(std::size_t cells) const;
  std::optional<ProbabilityStatus> limited(bool estimate) const;
  void lookForStall();
  bool hasCellsLeft() const;
  std::size_t memory() const;

  const PartitionScene scene_;
  const ProbabilityRequest& request_;
  ProbabilityStatistics& statistics_;
  ObstacleTable obstacles_;
  RoundWorkers<Worker> workers_;
  std::vector<Divided> round_;
  CrossingWitness::Hint hint_{-1, -1};  ///< of the last round
  std::vector<OpenCell> queue_;         ///< a heap by gap
  SettledMass settled_;
  Bounds open_;                  ///< sums over queue_
  double open_deviation_ = 0.0;  ///< sum over queue_ of bounds on the deviation of one sample
  double deviation_share_ = 1.0;
  bool quick_samples_ = false;
  bool indivisible_ = false;
  std::shared_ptr<const BandMargin> band_;
  double left_by_band_ = 0.0;  ///< of the width of the interval: what bands or motions leave open
  bool stalled_ = false;       ///< more cells hardly settle more of what is open
  Bounds at_last_look_{0.0, 1.0};
  std::size_t next_look_;
  std::size_t cell_memory_ = 0;
  std::size_t changes_since_recount_ = 0;
  EngineLimits limits_;
};

}  // namespace fcl_prob::detail
