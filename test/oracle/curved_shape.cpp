// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <algorithm>
#include <cmath>

#include "convex_set.h"

namespace oracle {

namespace {

Long lengthAcross(const LongVector& v) { return std::hypot(v[0], v[1]); }

// A point of the disk of this radius around the z axis.
LongVector onDisk(Long radius, const LongVector& towards, Long z) {
  const Long length = lengthAcross(towards);
  if (!(length > 0)) return {0, 0, z};
  return {radius * (towards[0] / length), radius * (towards[1] / length), z};
}

Long norm(const LongVector& v) { return std::hypot(v[0], v[1], v[2]); }

}  // namespace

LongVector CurvedShape::support(const LongVector& direction) const {
  const LongVector g = linear.transpose() * direction;
  const Long end = std::copysign(half_length, g[2]);
  LongVector point = LongVector::Zero();
  switch (kind) {
    case Kind::ellipsoid: {
      const LongVector scaled_g = radii.cwiseProduct(g);
      const Long length = norm(scaled_g);
      if (length > 0) point = radii.cwiseProduct(scaled_g / length);
      break;
    }
    case Kind::capsule: {
      const Long length = norm(g);
      if (length > 0) point = (radii[0] / length) * g;
      point[2] += end;
      break;
    }
    case Kind::cylinder:
      point = onDisk(radii[0], g, end);
      break;
    case Kind::cone:
      point = half_length * g[2] > -half_length * g[2] + radii[0] * lengthAcross(g)
                  ? LongVector{0, 0, half_length}
                  : onDisk(radii[0], g, -half_length);
      break;
  }
  return linear * point;
}

Long CurvedShape::supportValue(const LongVector& direction) const {
  const LongVector g = linear.transpose() * direction;
  switch (kind) {
    case Kind::ellipsoid:
      return norm(radii.cwiseProduct(g));
    case Kind::capsule:
      return half_length * std::fabs(g[2]) + radii[0] * norm(g);
    case Kind::cylinder:
      return half_length * std::fabs(g[2]) + radii[0] * lengthAcross(g);
    case Kind::cone:
      break;
  }
  return std::max(half_length * g[2], -half_length * g[2] + radii[0] * lengthAcross(g));
}

LongVector CurvedShape::magnitude() const {
  LongVector half(radii[0], radii[0], half_length);
  if (kind == Kind::ellipsoid) half = radii;
  if (kind == Kind::capsule) half[2] += radii[0];
  return linear.cwiseAbs() * half;
}

LongVector ConvexSet::support(const LongVector& direction) const {
  if (curved) return curved->support(direction);
  int best = 0;
  Long highest = corner(0).dot(direction);
  for (int i = 1; i < count; ++i) {
    const Long height = corner(i).dot(direction);
    if (height > highest) {
      highest = height;
      best = i;
    }
  }
  return corner(best);
}

Long ConvexSet::supportValue(const LongVector& direction) const {
  if (curved) return curved->supportValue(direction);
  Long highest = corner(0).dot(direction);
  for (int i = 1; i < count; ++i) highest = std::max(highest, corner(i).dot(direction));
  return highest;
}

}  // namespace oracle
