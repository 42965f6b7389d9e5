// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "convex_set.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "closest_point.h"

namespace oracle {

namespace {

// Of what a sum of products is certain to exceed: the points' own errors and the sum's rounding.
constexpr Long kSafety = 4;

// Supports sought before a pair is left to what is exact. Each halves the distance to a curved
// boundary at least; 64 bits are used up long before.
constexpr int kMostSteps = 200;

Vector<Long> toArray(const LongVector& v) { return {v[0], v[1], v[2]}; }
LongVector toEigen(const Vector<Long>& v) { return {v[0], v[1], v[2]}; }

/// Points of b - a - offset, and what they prove.
class Difference {
 public:
  explicit Difference(const ConvexPair& pair) : pair_(pair) {}

  LongVector support(const LongVector& direction) const {
    return pair_.b.support(direction) - pair_.a.support(-direction) - pair_.offset;
  }

  /// Whether all of b - a - offset is certainly ahead of the origin along `direction`.
  bool isAhead(const LongVector& direction) const {
    const Long least = -pair_.b.supportValue(-direction) - pair_.a.supportValue(direction) -
                       direction.dot(pair_.offset);
    return least > kSafety * direction.cwiseAbs().dot(pair_.error);
  }

  bool separatedAlong(const LongVector& direction) const {
    return isAhead(direction) || isAhead(-direction);
  }

  /// Whether the tetrahedron of four such points certainly has the origin within.
  bool surround(const LongVector& p, const LongVector& q, const LongVector& r,
                const LongVector& s) const {
    const int sign = certainSign(q, r, s, pair_.error);
    return sign != 0 && certainSign(p, r, s, pair_.error) == -sign &&
           certainSign(p, q, s, pair_.error) == sign && certainSign(p, q, r, pair_.error) == -sign;
  }

  bool anyFourSurround(const std::vector<LongVector>& points) const {
    const std::size_t count = points.size();
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        for (std::size_t k = 0; k < j; ++k) {
          for (std::size_t l = 0; l < k; ++l) {
            if (surround(points[i], points[j], points[k], points[l])) return true;
          }
        }
      }
    }
    return false;
  }

 private:
  const ConvexPair& pair_;
};

// Where the origin is on a face of all simplices met: points around it in general position.
bool surroundedByProbes(const Difference& difference, const Simplex<Long>& simplex) {
  std::vector<LongVector> points;
  for (int i = 0; i < simplex.count; ++i) {
    points.push_back(toEigen(simplex.points[static_cast<std::size_t>(i)]));
  }
  const auto probe = [&](const LongVector& direction) {
    for (const Long sign : {1.0L, -1.0L}) points.push_back(difference.support(sign * direction));
  };
  if (points.size() >= 3) probe((points[1] - points[0]).cross(points[2] - points[0]));
  if (difference.anyFourSurround(points)) return true;
  probe({0.63L, 0.31L, -0.71L});
  probe({-0.42L, 0.87L, 0.26L});
  probe({0.55L, -0.37L, 0.75L});
  return difference.anyFourSurround(points);
}

Verdict lastResort(const Difference& difference, const Simplex<Long>& simplex) {
  if (simplex.count >= 3) {
    const LongVector a = toEigen(simplex.points[0]);
    const LongVector b = toEigen(simplex.points[1]);
    const LongVector c = toEigen(simplex.points[2]);
    if (difference.separatedAlong((b - a).cross(c - a))) return Verdict::apart;
  }
  return surroundedByProbes(difference, simplex) ? Verdict::touching : Verdict::undecided;
}

// Gilbert, Johnson and Keerthi 1988; only its certificates count, not where it converges to.
Verdict search(const ConvexPair& pair) {
  const Difference difference(pair);
  Simplex<Long> simplex;
  LongVector start = -pair.offset;
  if (start.isZero(0)) start = LongVector::UnitX();
  simplex.points[0] = toArray(difference.support(-start));
  simplex.count = 1;
  reduce(simplex);
  Long last = std::numeric_limits<Long>::infinity();
  for (int step = 0; step < kMostSteps; ++step) {
    const LongVector closest = toEigen(simplex.closest);
    if (simplex.count == 4) {
      const auto& p = simplex.points;
      if (difference.surround(toEigen(p[0]), toEigen(p[1]), toEigen(p[2]), toEigen(p[3]))) {
        return Verdict::touching;
      }
      break;
    }
    if (difference.isAhead(closest)) return Verdict::apart;
    const Long square = closest.squaredNorm();
    if (!(square < last)) break;
    last = square;
    const LongVector next = difference.support(-closest);
    simplex.points[static_cast<std::size_t>(simplex.count++)] = toArray(next);
    const Simplex<Long> before = simplex;
    reduce(simplex);
    const Long now = toEigen(simplex.closest).squaredNorm();
    if (simplex.count < 4 && !(now < square)) {
      simplex = before;
      break;
    }
  }
  return lastResort(difference, simplex);
}

/// Two triangles: by the signs of determinants of their corners.
class TrianglePair {
 public:
  explicit TrianglePair(const ConvexPair& pair) : pair_(pair) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        corners_[i][j] = pair.b.corner(j) - pair.a.corner(i) - pair.offset;
      }
    }
    for (int i = 0; i < 3; ++i) {
      side_of_b_[i] = sign(corners_[i][0], corners_[i][1], corners_[i][2]);
      side_of_a_[i] = sign(corners_[0][i], corners_[1][i], corners_[2][i]);
    }
  }

  Verdict verdict() const {
    if (allAlike(side_of_a_) || allAlike(side_of_b_)) return Verdict::apart;
    const Difference difference(pair_);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        if (difference.separatedAlong(edgeOfA(i).cross(edgeOfB(j)))) return Verdict::apart;
      }
    }
    for (int i = 0; i < 3; ++i) {
      if (edgeOfAPierces(i) || edgeOfBPierces(i)) return Verdict::touching;
    }
    return Verdict::undecided;
  }

 private:
  int sign(const LongVector& u, const LongVector& v, const LongVector& w) const {
    return certainSign(u, v, w, pair_.error);
  }

  static bool allAlike(const int* signs) {
    return signs[0] != 0 && signs[0] == signs[1] && signs[1] == signs[2];
  }

  LongVector edgeOfA(int i) const { return pair_.a.corner((i + 1) % 3) - pair_.a.corner(i); }
  LongVector edgeOfB(int j) const { return pair_.b.corner((j + 1) % 3) - pair_.b.corner(j); }

  // The edge's ends are on either side of the other triangle, and its line passes through.
  bool edgeOfAPierces(int i) const {
    if (side_of_b_[i] * side_of_b_[(i + 1) % 3] != -1) return false;
    int around[3];
    for (int j = 0; j < 3; ++j) {
      around[j] = sign(edgeOfA(i), corners_[i][j], corners_[i][(j + 1) % 3]);
    }
    return allAlike(around);
  }

  bool edgeOfBPierces(int j) const {
    if (side_of_a_[j] * side_of_a_[(j + 1) % 3] != -1) return false;
    int around[3];
    for (int i = 0; i < 3; ++i) {
      around[i] = sign(edgeOfB(j), corners_[i][j], corners_[(i + 1) % 3][j]);
    }
    return allAlike(around);
  }

  const ConvexPair& pair_;
  LongVector corners_[3][3];  // b - a - offset
  int side_of_b_[3];          // of the corners of a, relative to the plane of b
  int side_of_a_[3];
};

}  // namespace

int certainSign(const LongVector& u, const LongVector& v, const LongVector& w,
                const LongVector& error) {
  Long value = 0;
  Long doubt = 0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    value += u[i] * (v[j] * w[k] - v[k] * w[j]);
    const Long vj = std::fabs(v[j]) + error[j], vk = std::fabs(v[k]) + error[k];
    const Long wj = std::fabs(w[j]) + error[j], wk = std::fabs(w[k]) + error[k];
    doubt += error[i] * (vj * wk + vk * wj) +
             std::fabs(u[i]) * (error[j] * (wk + vk) + error[k] * (vj + wj));
  }
  if (value > kSafety * doubt) return 1;
  return value < -kSafety * doubt ? -1 : 0;
}

Verdict meetExactly(const ConvexPair& pair) {
  std::vector<ExactVector> of_a, of_b;
  for (int i = 0; i < pair.a.count; ++i) of_a.push_back(pair.exact_a(i));
  for (int i = 0; i < pair.b.count; ++i) of_b.push_back(pair.exact_b(i));
  const auto farthest = [](const std::vector<ExactVector>& points, const ExactVector& along) {
    std::size_t best = 0;
    Rational highest = dot(points[0], along);
    for (std::size_t i = 1; i < points.size(); ++i) {
      const Rational height = dot(points[i], along);
      if (height > highest) {
        highest = height;
        best = i;
      }
    }
    return points[best];
  };
  Simplex<Rational> simplex;
  simplex.points[0] = of_b[0] - of_a[0];
  simplex.count = 1;
  reduce(simplex);
  // Every step comes closer, to one of finitely many faces, so that this ends.
  for (;;) {
    const ExactVector& closest = simplex.closest;
    const Rational square = dot(closest, closest);
    if (square == 0) return Verdict::touching;
    const ExactVector back{Rational(-closest[0]), Rational(-closest[1]), Rational(-closest[2])};
    const ExactVector next = farthest(of_b, back) - farthest(of_a, closest);
    // All of it is as far along as the closest point: then that is the closest of all.
    if (!(dot(next, closest) < square)) return Verdict::apart;
    simplex.points[static_cast<std::size_t>(simplex.count++)] = next;
    reduce(simplex);
  }
}

Verdict meet(const ConvexPair& pair) {
  const bool hulls = !pair.a.curved && !pair.b.curved;
  const bool triangles = hulls && pair.a.count == 3 && pair.b.count == 3;
  const Verdict verdict = triangles ? TrianglePair(pair).verdict() : search(pair);
  return verdict == Verdict::undecided && hulls ? meetExactly(pair) : verdict;
}

}  // namespace oracle
