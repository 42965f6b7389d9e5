// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Geometries, poses and displacements of a family.
#pragma once

#include "families.h"

namespace fcl_prob_audit {

bool chance(RandomBodies& random, double probability);

template <typename T>
const T& anyOf(RandomBodies& random, const std::vector<T>& choices) {
  return choices[static_cast<std::size_t>(random.integer(0, static_cast<int>(choices.size()) - 1))];
}

/// About `size` wide.
Shape randomShape(RandomBodies& random, const Traits& traits, Kind kind, double size);

/// A point of the shape (frame of the shape): within a face, an edge or a corner of it.
Vector3d pointOf(RandomBodies& random, const Shape& shape);

/// A point that is inside of a part of it, often.
Vector3d middleOf(RandomBodies& random, const Shape& shape);

/// A rotation, or nearly one.
Matrix3d randomOrientation(RandomBodies& random, const Traits& traits);

/// Deviations for objects of about `size`.
Displacement randomDisplacement(RandomBodies& random, const Traits& traits, double size);

/// All lengths of the scene times 2^exponent.
void scaleShape(Shape& shape, double factor);
void scaleScene(Scene& scene, int exponent);

}  // namespace fcl_prob_audit
