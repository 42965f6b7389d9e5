// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The probability of any of several collisions, from those of each.
#pragma once

#include <vector>

#include "fcl_prob/bounds.h"

namespace fcl_prob {

/// P(any) from certified intervals of the single events, whatever their dependence: at least the
/// largest lower bound, at most the sum of the upper bounds (Boole) and 1. No event: 0. Certified,
/// rounding included. \throws InvalidRequest if an interval is not within [0, 1] or empty
Bounds anyOf(const std::vector<Bounds>& events);

/// P(any) of independent events, 1 - Π(1 - P), with the intervals carried through. Certified,
/// rounding included; keeps its relative accuracy for small probabilities. Certain only as far as
/// the events are independent: obstacles whose displacements are, not the links of one robot.
/// \throws InvalidRequest if an interval is not within [0, 1] or empty
Bounds anyOfIndependent(const std::vector<Bounds>& events);

}  // namespace fcl_prob
