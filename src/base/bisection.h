// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Where a property changes between two numbers.
#pragma once

namespace fcl_prob::detail {

/// Two numbers between which a property is lost; either may be the larger.
struct Bracket {
  double holds;
  double fails;
};

/// Halves a bracket. Whatever the property is like, each end is where it was found or was given as,
/// so that what is proven at one of them stays so.
/// \param property  double → bool
template <class Property>
Bracket bisect(Bracket bracket, int halvings, const Property& property) {
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (bracket.holds + bracket.fails);
    (property(middle) ? bracket.holds : bracket.fails) = middle;
  }
  return bracket;
}

}  // namespace fcl_prob::detail
