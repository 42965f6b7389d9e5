// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "unbounded_contact.h"

#include <algorithm>

namespace oracle {

namespace {

// What 237 bits leave open.
const Wide kWideRounding = ldexp(Wide(1), -210);

// Of curved shapes, which are computed in extended precision.
const Wide kLongRounding = ldexp(Wide(1), -56);

Wide absolutes(const WideVector& u, const WideVector& v) {
  return abs(u[0] * v[0]) + abs(u[1] * v[1]) + abs(u[2] * v[2]);
}

/// Heights normal·x - offset of the lowest and the highest point, each known to within `doubt`.
struct Heights {
  Wide lowest;
  Wide highest;
  Wide doubt;
};

Verdict verdictOf(const Heights& heights, bool surface) {
  if (heights.lowest > heights.doubt) return Verdict::apart;
  if (surface && heights.highest < -heights.doubt) return Verdict::apart;
  const bool reached = heights.lowest <= -heights.doubt;
  if (reached && (!surface || heights.highest >= heights.doubt)) return Verdict::touching;
  return Verdict::undecided;
}

Verdict hullMeetsExactly(const Part& part, int piece, const ExactVector& shift,
                         const UnboundedSet& set) {
  bool below = false, above = false;
  for (int corner = 0; corner < part.piece(piece).count; ++corner) {
    const ExactVector point = part.exactCorner(piece, corner) + shift;
    const Rational height = dot(set.exact_normal, point) - set.exact_offset;
    below = below || height <= 0;
    above = above || height >= 0;
  }
  return below && (above || !set.surface) ? Verdict::touching : Verdict::apart;
}

Verdict hullMeets(const Part& part, int piece, const Displacement& displacement, double sign,
                  const UnboundedSet& set) {
  const WideVector origin = part.reference() + scaled(Wide(sign), displacement.rounded());
  const Wide base = dot(set.normal, origin) - set.offset;
  const LongVector normal = toLong(set.normal);
  const ConvexSet hull = part.piece(piece);
  const Wide doubt =
      kLongRounding * Wide(normal.cwiseAbs().dot(part.extent() + part.error())) +
      Wide(4 * normal.cwiseAbs().dot(part.error())) +
      kWideRounding * (absolutes(set.normal, part.reference()) +
                       absolutes(set.normal, displacement.rounded()) + abs(set.offset));
  const Verdict verdict = verdictOf({Wide(base - Wide(hull.supportValue(-normal))),
                                     Wide(base + Wide(hull.supportValue(normal))), doubt},
                                    set.surface);
  if (verdict != Verdict::undecided) return verdict;
  return hullMeetsExactly(part, piece, scaled(Rational(sign), displacement.exact()), set);
}

Verdict curvedMeets(const ConvexSet& shape, const WideVector& centre, const UnboundedSet& set) {
  const LongVector normal = toLong(set.normal);
  const Wide middle = dot(set.normal, centre) - set.offset;
  const Wide up = Wide(shape.supportValue(normal));
  const Wide down = Wide(shape.supportValue(-normal));
  const Wide size = Wide(normal.cwiseAbs().dot(shape.curved->magnitude()));
  return verdictOf({Wide(middle - down), Wide(middle + up),
                    Wide(kLongRounding * size + kWideRounding * abs(set.offset))},
                   set.surface);
}

}  // namespace

Verdict meetsUnbounded(const Part& part, const Displacement& displacement, double sign,
                       const UnboundedSet& set) {
  const WideVector shift = scaled(Wide(sign), displacement.rounded());
  Verdict result = Verdict::apart;
  for (int i = 0; i < part.pieceCount(); ++i) {
    const ConvexSet piece = part.piece(i);
    const Verdict verdict = piece.curved ? curvedMeets(piece, part.reference() + shift, set)
                                         : hullMeets(part, i, displacement, sign, set);
    if (verdict == Verdict::touching) return verdict;
    if (verdict == Verdict::undecided) result = verdict;
  }
  return result;
}

Verdict unboundedMeet(const UnboundedSet& a, const UnboundedSet& b,
                      const Displacement& displacement) {
  const WideVector product = cross(a.normal, b.normal);
  // FCL's own measure, machine epsilon; either side of it is what it means.
  if (dot(product, product) >= ldexp(Wide(1), -52)) return Verdict::touching;
  const bool same_side = dot(a.normal, b.normal) > 0;
  if (same_side && !a.surface && !b.surface) return Verdict::touching;
  const Wide of_a = a.offset + dot(a.normal, displacement.rounded());
  // Along the normal of A: A reaches up to `of_a` or is there; where B begins.
  const Wide of_b = same_side ? b.offset : Wide(-b.offset);
  const Wide doubt =
      kWideRounding * (abs(of_a) + abs(of_b) + absolutes(a.normal, displacement.rounded()));
  if (abs(of_a - of_b) <= doubt) return Verdict::touching;
  if (a.surface && b.surface) return Verdict::apart;
  // B is above `of_b` if it faces A and below otherwise; a plane of B's is at it.
  const bool b_is_below = a.surface && same_side;
  const bool meet = b_is_below ? of_a < of_b : of_a > of_b;
  return meet ? Verdict::touching : Verdict::apart;
}

}  // namespace oracle
