// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <algorithm>

#include "curved_support.h"

namespace oracle {

LongVector CurvedShape::magnitude() const {
  LongVector half(radii[0], radii[0], half_length);
  if (kind == Kind::ellipsoid) half = radii;
  if (kind == Kind::capsule) half[2] += radii[0];
  return linear.cwiseAbs() * half;
}

Long ConvexSet::supportValue(const LongVector& direction) const {
  if (curved) {
    return CurvedSupport<Long>(*curved).value({direction[0], direction[1], direction[2]});
  }
  Long highest = corner(0).dot(direction);
  for (int i = 1; i < count; ++i) highest = std::max(highest, corner(i).dot(direction));
  return highest;
}

}  // namespace oracle
