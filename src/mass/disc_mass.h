// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Mass of an ellipse under N(0, I), from quadrature over its chords.
#pragma once

#include <Eigen/Core>

#include "fcl_prob/bounds.h"
#include "mass/disc_rule.h"

namespace fcl_prob::detail {

/// Mass of [middle - half, middle + half] with an error in it.
struct ChordMass {
  double value;
  double error;
};

/// \param middle_error, half_error  absolute; half_error may not exceed half
ChordMass chordMass(double middle, double half, double middle_error, double half_error);

/// Certified mass of the disc; the error sought is `enough`, or a 1e-12 of the mass.
Bounds discMass(const WhitenedDisc& disc, double enough = 0.0);

}  // namespace fcl_prob::detail
