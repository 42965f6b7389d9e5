// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Convex pieces of the oracle, and whether two of them meet.
#pragma once

#include <functional>

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

  /// A point of the shape, to within rounding, that is farthest along `direction`.
  LongVector support(const LongVector& direction) const;

  /// The largest product of `direction` and a point of the shape.
  Long supportValue(const LongVector& direction) const;

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
  LongVector support(const LongVector& direction) const;
  Long supportValue(const LongVector& direction) const;
};

/// B moved by -offset against A.
struct ConvexPair {
  ConvexSet a;
  ConvexSet b;
  LongVector offset;  ///< reference of A, displaced, less that of B
  LongVector error;   ///< bound on the error of a point of b - a - offset, for each axis
  std::function<ExactVector(int)> exact_a;  ///< the corner i of a hull in the world, displaced
  std::function<ExactVector(int)> exact_b;
};

/// Undecided only where one of the two is curved, and within a few `error` of touching.
Verdict meet(const ConvexPair& pair);

/// The same of two hulls in rationals; slow.
Verdict meetExactly(const ConvexPair& pair);

/// Sign of the determinant of three vectors of which every component is known to within `error`
/// of its axis; 0 if that leaves it open.
int certainSign(const LongVector& u, const LongVector& v, const LongVector& w,
                const LongVector& error);

}  // namespace oracle
