// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The parts of one answer, as obstacles, waypoints or components of a mixture, asked within the
// limits of the whole.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "base/budget.h"
#include "base/statistics.h"
#include "fcl_prob/bounds.h"

namespace fcl_prob::detail {

/// Parts borrow from the limits of the whole: each an even share of what is left, and what one of
/// them does not use is there for the others. A part whose share is used up leaves the others
/// theirs, and is asked again with more where something is left in the end; only a limit of the
/// whole ends the whole. Parts that leave most open come first, whatever their order.
class PartsLoop {
 public:
  using Ask = std::function<ProbabilityResult(std::size_t part, const ProbabilityRequest& request)>;

  /// What bounds of the parts say of the whole.
  using Combine = std::function<Bounds(const std::vector<Bounds>& parts)>;

  /// What is to be asked of a part, but for the limits and on_progress; nothing: it is known well
  /// enough.
  using Wanted = std::function<std::optional<ProbabilityRequest>(std::size_t part)>;

  /// Keeps references to `whole`, `ask` and `combine`. The clock starts when this is made.
  /// \param known    certified bounds of the parts: as many as there are, [0, 1] without any
  /// \param weights  of the widths of the parts in that of the whole; empty: all alike
  PartsLoop(const ProbabilityRequest& whole, const Ask& ask, const Combine& combine,
            std::vector<Bounds> known, std::vector<double> weights = {});
  PartsLoop(const PartsLoop&) = delete;
  PartsLoop& operator=(const PartsLoop&) = delete;

  /// Asks every part of which something is wanted once.
  /// \param of_limits  the share of what is left that all of them together may use
  void askEach(const Wanted& wanted, double of_limits = 1.0);

  /// Asks those that used up their shares again, as long as something is wanted of them and they
  /// can have more than they had.
  void askAgain(const Wanted& wanted);

  /// Asks the part that leaves most open, of those that may still be narrowed, for a quarter of its
  /// width. \return false if there is none
  bool narrowWidest(const ProbabilityRequest& request);

  /// A limit of the whole has been reached, or the caller has cancelled it: nothing is asked any
  /// more.
  bool isOut();
  std::optional<ProbabilityStatus> out() const { return out_; }

  /// Asked before every part: the whole is known well enough.
  void endWhen(std::function<bool()> enough) { enough_ = std::move(enough); }

  /// The best of all that was told, certified.
  const std::vector<Bounds>& bounds() const { return bounds_; }

  /// The best answer of each part; empty if it was not asked. `lower` and `upper` are those of
  /// bounds() where it has both, and the statistics those of all its answers.
  const std::vector<std::optional<ProbabilityResult>>& answers() const { return answers_; }

 private:
  bool mayGoOn();
  std::vector<std::size_t> widestFirst() const;
  double openOf(std::size_t part) const;
  void ask(std::size_t part, ProbabilityRequest request);
  void keep(std::size_t part, ProbabilityResult answer);
  bool ranDry(std::size_t part) const;
  bool enlargeShare(std::size_t part, std::size_t parts, ProbabilityRequest& request) const;
  void reportTo(std::size_t part, ProbabilityRequest& request);

  const ProbabilityRequest& whole_;
  const Ask& ask_;
  const Combine& combine_;
  Budget budget_;
  std::vector<Bounds> bounds_;
  std::vector<double> weights_;
  std::vector<std::optional<ProbabilityResult>> answers_;
  std::vector<std::optional<ProbabilityStatus>> last_;  ///< why the last answer of a part ended
  std::vector<Allowance> shares_;                       ///< that its last answer could use
  std::vector<bool> stuck_;  ///< a narrower interval was asked for, and did not come
  std::function<bool()> enough_;
  std::optional<ProbabilityStatus> out_;
  std::size_t asked_ = 0;
  double fraction_ = 0.0;  ///< told last
};

}  // namespace fcl_prob::detail
