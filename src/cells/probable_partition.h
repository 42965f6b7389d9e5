// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A certified interval, and inside it one that holds but for a stated chance.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "cells/cell_draw.h"
#include "cells/partition_engine.h"
#include "gaussian/hit_sequence.h"
#include "scene/scene.h"

namespace fcl_prob::detail {

/// What is settled is certain; of what is open, samples are drawn.
///
/// Of a number of open cells a point is drawn from one, at random in proportion to the largest
/// weight of its draws, and counted with the share that its weight is of that: whether it is
/// counted and collides is a hit of chance (open mass that collides) / (sum of those weights),
/// independently of every other sample. A HitSequence of such samples holds at every moment. When
/// cells have been divided, another look begins; look k = 1, 2, ... may fail with a chance of
/// 6/π²k² of `error`, which adds up to `error` over all looks there may ever be.
class ProbablePartition {
 public:
  /// Keeps references to the objects. The request's tolerances count for nothing; bands and sweeps
  /// must not be asked for, and the displacement's rank not be 0.
  /// \param error  chance that probable() is ever wrong, in (0, 1)
  ProbablePartition(const PartitionObject& a, const PartitionObject& b,
                    const GaussianDisplacement& displacement, const ProbabilityRequest& request,
                    double error);

  /// Divides some cells, and draws samples of those that are then open. \param enough  asked in
  /// between; true ends it
  /// \return  what forbids to go on, if something does; `exact` if there is nothing left to do
  std::optional<ProbabilityStatus> improve(const std::function<bool()>& enough);

  Bounds certified() const { return certified_; }

  /// Within certified().
  Bounds probable() const { return probable_; }

  const ProbabilityStatistics& statistics() const { return statistics_; }

 private:
  /// What is sampled as long as no cells are divided.
  struct Look {
    Bounds certain;              ///< mass that collides besides
    std::vector<double> so_far;  ///< sums of the cells' largest weights
    double error;
    HitSequence sure;      ///< hits for certain
    HitSequence possible;  ///< those that rounding leaves open, too
  };

  std::optional<ProbabilityStatus> divide();
  void beginLook();
  void draw(std::size_t count);
  void narrow();
  void narrowTo(const Bounds& bounds);

  ProbabilityRequest request_;
  double error_;
  ProbabilityStatistics statistics_;
  QueryScene scene_;
  Budget budget_{request_};
  std::unique_ptr<PartitionEngine> engine_;
  std::unique_ptr<PointTester> tester_;
  std::size_t most_cells_;
  std::size_t looks_ = 0;
  std::uint64_t drawn_ = 0;
  Look look_{};
  Bounds certified_{0.0, 1.0};
  Bounds probable_{0.0, 1.0};
};

}  // namespace fcl_prob::detail
