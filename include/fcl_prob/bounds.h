// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A number known only between two others.
#pragma once

namespace fcl_prob {

/// `lower <= true value <= upper`. Whether that holds by construction (certified) or with a stated
/// confidence is said where a Bounds is returned.
struct Bounds {
  double lower = 0.0;
  double upper = 0.0;

  double width() const { return upper - lower; }
  double middle() const { return 0.5 * (lower + upper); }
  bool contains(double value) const { return lower <= value && value <= upper; }
};

}  // namespace fcl_prob
