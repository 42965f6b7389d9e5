// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Placed bodies against one obstacle, as far as they have been looked at for a probable decision.
#pragma once

#include <memory>
#include <optional>

#include "lines/line_bets.h"
#include "robot/probable_answer.h"

namespace fcl_prob::detail {

class ObstacleSampling {
 public:
  /// \param most_far  what bodies that balls show to be far may add up to
  ObstacleSampling(const ProbableScene& scene, const PreparedRobot& robot, double most_far);

  Bounds certified() const { return certified_; }
  Bounds probable() const { return probable_; }
  bool isDone() const { return scene_.bodies.empty(); }
  std::size_t columns() const { return lines_ ? lines_->columns() : 0; }
  std::size_t samples() const { return lines_ ? lines_->lines() : 0; }

  /// Half-spaces between bodies and obstacle; those that hardly matter need no samples.
  /// \param most_left_out  what they may add up to
  /// \param enough         a bound that is lower is of no more use
  void boundByHalfSpaces(double most_left_out, double enough);

  /// Makes what tells by lines. False where there are no lines.
  /// \param chance  of an error of theirs
  bool beginLines(const ProbabilityRequest& request, double chance);
  bool hasLines() const { return lines_ != nullptr; }

  /// P, about; before there are lines, half of its upper bound.
  double likely() const;

  /// As LineBets::improve().
  bool improveByLines(bool above, double target);

 private:
  void place(const ProbabilityRequest& request);
  Bounds within(const Bounds& of_near, const Bounds& known) const;

  ProbableScene scene_;
  const PreparedRobot& robot_;
  GaussianDisplacement displacement_;  ///< of the bodies
  double far_ = 0.0;
  std::shared_ptr<const PieceTree> tree_;
  PartitionObject bodies_{};
  PartitionObject obstacle_{};
  std::unique_ptr<LineBets> lines_;
  Bounds certified_;
  Bounds probable_;
};

}  // namespace fcl_prob::detail
