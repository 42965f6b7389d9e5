// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Convex pieces of the oracle, and whether two of them meet.
#pragma once

#include "exact.h"

namespace oracle {

/// What can be said of a displacement for certain.
enum class Verdict { apart, touching, undecided };

/// A shape with a curved surface, centred at the reference of its part.
struct CurvedShape {
  enum class Kind { ellipsoid, capsule, cylinder, cone };  ///< a ball is an ellipsoid

  Kind kind = Kind::ellipsoid;
  LongVector radii = LongVector::Zero();  ///< of all but ellipsoids: the first
  Long half_length = 0;  ///< along z; a cone has its apex at +, a capsule's balls are there
  LongMatrix linear = LongMatrix::Identity();

  /// Bound on the terms that the coordinates of its points are sums of.
  LongVector magnitude() const;
};

/// One convex piece: the hull of a few points, or a curved shape.
struct ConvexSet {
  const LongVector* vertices = nullptr;  ///< relative to the reference of the part
  const int* corners = nullptr;          ///< indices of vertices
  int count = 0;
  const CurvedShape* curved = nullptr;  ///< null: a hull

  const LongVector& corner(int i) const { return vertices[corners[i]]; }

  /// The largest product of `direction` and a point of it.
  Long supportValue(const LongVector& direction) const;
};

/// Where the corners of the hulls of a pair are kept.
class Corners {
 public:
  virtual ~Corners() = default;
  virtual ExactVector exactA(int i) const = 0;  ///< in the world, displaced
  virtual ExactVector exactB(int i) const = 0;
  virtual WideVector wideA(int i) const = 0;  ///< relative to the reference
  virtual WideVector wideB(int i) const = 0;
};

/// B moved by -offset against A.
struct ConvexPair {
  ConvexSet a;
  ConvexSet b;
  LongVector offset;  ///< reference of A, displaced, less that of B
  LongVector error;   ///< bound on the error of a point of b - a - offset, for each axis
  WideVector wide_offset;
  WideVector wide_error;
  const Corners* corners = nullptr;
};

/// Undecided only where one of the two is curved, and within a few `wide_error` of touching.
Verdict meet(const ConvexPair& pair);

/// The same of two hulls in rationals; slow.
Verdict meetExactly(const ConvexPair& pair);

}  // namespace oracle
