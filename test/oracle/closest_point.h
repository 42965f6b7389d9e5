// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The point of a simplex that is closest to the origin, over any kind of number (Ericson, Real-Time
// Collision Detection, 5.1); exact over rationals.
#pragma once

#include <array>

#include "exact.h"

namespace oracle {

/// Up to four points, and the point of their hull that is closest to the origin.
template <typename Scalar>
struct Simplex {
  std::array<Vector<Scalar>, 4> points;
  int count = 0;
  Vector<Scalar> closest;

  void keep(std::initializer_list<int> indices, const Vector<Scalar>& point) {
    int kept = 0;
    for (int i : indices) {
      points[static_cast<std::size_t>(kept++)] = points[static_cast<std::size_t>(i)];
    }
    count = kept;
    closest = point;
  }
};

template <typename Scalar>
void reduceSegment(Simplex<Scalar>& simplex) {
  const Vector<Scalar>& p = simplex.points[0];
  const Vector<Scalar>& q = simplex.points[1];
  const Vector<Scalar> pq = q - p;
  const Scalar t = -dot(p, pq);
  const Scalar length = dot(pq, pq);
  if (!(t > 0)) return simplex.keep({0}, p);
  if (!(t < length)) return simplex.keep({1}, q);
  simplex.keep({0, 1}, p + scaled(Scalar(t / length), pq));
}

template <typename Scalar>
void reduceTriangle(Simplex<Scalar>& simplex) {
  const Vector<Scalar> a = simplex.points[0], b = simplex.points[1], c = simplex.points[2];
  const Vector<Scalar> ab = b - a, ac = c - a;
  const Scalar d1 = -dot(ab, a), d2 = -dot(ac, a);
  if (!(d1 > 0) && !(d2 > 0)) return simplex.keep({0}, a);
  const Scalar d3 = -dot(ab, b), d4 = -dot(ac, b);
  if (!(d3 < 0) && !(d4 > d3)) return simplex.keep({1}, b);
  const Scalar d5 = -dot(ab, c), d6 = -dot(ac, c);
  if (!(d6 < 0) && !(d5 > d6)) return simplex.keep({2}, c);
  const Scalar vc = d1 * d4 - d3 * d2;
  if (!(vc > 0) && !(d1 < 0) && !(d3 > 0)) {
    return simplex.keep({0, 1}, a + scaled(Scalar(d1 / (d1 - d3)), ab));
  }
  const Scalar vb = d5 * d2 - d1 * d6;
  if (!(vb > 0) && !(d2 < 0) && !(d6 > 0)) {
    return simplex.keep({0, 2}, a + scaled(Scalar(d2 / (d2 - d6)), ac));
  }
  const Scalar va = d3 * d6 - d5 * d4;
  const Scalar to_b = d4 - d3, to_c = d5 - d6;
  if (!(va > 0) && !(to_b < 0) && !(to_c < 0)) {
    return simplex.keep({1, 2}, b + scaled(Scalar(to_b / (to_b + to_c)), Vector<Scalar>(c - b)));
  }
  const Scalar sum = va + vb + vc;
  const Vector<Scalar> along = scaled(Scalar(vb / sum), ab) + scaled(Scalar(vc / sum), ac);
  simplex.keep({0, 1, 2}, a + along);
}

/// Whether the origin and `other` are on the same side of the plane through a, b and c, or the
/// origin is on the plane.
template <typename Scalar>
bool sameSide(const Vector<Scalar>& a, const Vector<Scalar>& b, const Vector<Scalar>& c,
              const Vector<Scalar>& other) {
  const Vector<Scalar> n = cross(Vector<Scalar>(b - a), Vector<Scalar>(c - a));
  const Scalar of_origin = -dot(n, a);
  const Scalar of_other = dot(n, Vector<Scalar>(other - a));
  return !(of_origin > 0 && of_other < 0) && !(of_origin < 0 && of_other > 0);
}

template <typename Scalar>
void reduceTetrahedron(Simplex<Scalar>& simplex) {
  static constexpr std::size_t kFaces[4][4] = {
      {0, 1, 2, 3}, {0, 1, 3, 2}, {0, 2, 3, 1}, {1, 2, 3, 0}};
  const auto& p = simplex.points;
  Simplex<Scalar> best;
  for (const auto& face : kFaces) {
    if (sameSide(p[face[0]], p[face[1]], p[face[2]], p[face[3]])) continue;
    Simplex<Scalar> candidate;
    candidate.points = {p[face[0]], p[face[1]], p[face[2]], {}};
    candidate.count = 3;
    reduceTriangle(candidate);
    if (best.count == 0 ||
        dot(candidate.closest, candidate.closest) < dot(best.closest, best.closest)) {
      best = candidate;
    }
  }
  if (best.count > 0) {
    simplex = best;
  } else {
    simplex.closest = {Scalar(0), Scalar(0), Scalar(0)};
  }
}

/// Leaves the smallest face with the closest point; all four points if the origin is within.
template <typename Scalar>
void reduce(Simplex<Scalar>& simplex) {
  switch (simplex.count) {
    case 1:
      simplex.closest = simplex.points[0];
      break;
    case 2:
      reduceSegment(simplex);
      break;
    case 3:
      reduceTriangle(simplex);
      break;
    default:
      reduceTetrahedron(simplex);
  }
}

}  // namespace oracle
