// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What is certain of P while a query is answered.
#pragma once

#include <algorithm>
#include <optional>

#include "base/decision.h"
#include "base/known_text.h"
#include "fcl_prob/bounds.h"

namespace fcl_prob::detail {

/// Both are right, so their intersection is; were they to disagree, both would be kept.
inline Bounds agreed(const Bounds& a, const Bounds& b) {
  const Bounds both{std::max(a.lower, b.lower), std::min(a.upper, b.upper)};
  if (both.lower <= both.upper) return both;
  return {std::min(a.lower, b.lower), std::max(a.upper, b.upper)};
}

/// Bounds on P, narrowed by whoever knows more; what they say of a request is said here only.
class Known {
 public:
  /// Keeps a reference.
  explicit Known(const ProbabilityRequest& request) : request_(request) {}

  const Bounds& interval() const { return interval_; }

  /// By certified bounds on the same P.
  void narrow(const Bounds& bounds) { interval_ = agreed(interval_, bounds); }

  /// By what a result is certain of, if it is of anything.
  void narrow(const ProbabilityResult& result) { narrow(boundsOf(result)); }

  Decision decision() const { return decisionOf(interval_, request_); }
  std::optional<ProbabilityStatus> satisfied() const {
    return detail::satisfied(interval_, request_);
  }

  void tell(ProbabilityResult& result) const {
    result.lower = interval_.lower;
    result.upper = interval_.upper;
    result.decision = decision();
  }

 private:
  const ProbabilityRequest& request_;
  Bounds interval_{0.0, 1.0};
};

}  // namespace fcl_prob::detail
