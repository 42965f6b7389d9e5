// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "convex_set.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "curved_support.h"
#include "origin_search.h"

namespace oracle {

namespace {

// Supports sought before a pair is left to more digits. Each halves the distance to a curved
// boundary at least: more than these never help.
constexpr int kMostSteps = 100;
constexpr int kMostWideSteps = 300;

Vector<Long> toArray(const LongVector& v) { return {v[0], v[1], v[2]}; }

int sign(const LongVector& u, const LongVector& v, const LongVector& w, const Vector<Long>& error) {
  return certainSign(toArray(u), toArray(v), toArray(w), error);
}

/// A piece over any kind of number.
template <typename S>
class Support {
 public:
  Support(const CurvedShape* curved, std::vector<Vector<S>> corners)
      : corners_(std::move(corners)) {
    if (curved) curved_.emplace(*curved);
  }

  Vector<S> point(const Vector<S>& direction) const {
    return curved_ ? curved_->point(direction) : corners_[farthest(direction)];
  }

  S value(const Vector<S>& direction) const {
    return curved_ ? curved_->value(direction) : dot(corners_[farthest(direction)], direction);
  }

 private:
  std::size_t farthest(const Vector<S>& direction) const {
    std::size_t best = 0;
    S highest = dot(corners_[0], direction);
    for (std::size_t i = 1; i < corners_.size(); ++i) {
      const S height = dot(corners_[i], direction);
      if (height > highest) {
        highest = height;
        best = i;
      }
    }
    return best;
  }

  std::optional<CurvedSupport<S>> curved_;
  std::vector<Vector<S>> corners_;
};

/// b - a - offset.
template <typename S>
class Difference {
 public:
  using Scalar = S;

  Difference(Support<S> a, Support<S> b, const Vector<S>& offset, const Vector<S>& error)
      : a_(std::move(a)), b_(std::move(b)), offset_(offset), error_(error) {}

  Vector<S> point(const Vector<S>& direction) const {
    return b_.point(direction) - a_.point(back(direction)) - offset_;
  }

  S value(const Vector<S>& direction) const {
    return b_.value(direction) + a_.value(back(direction)) - dot(direction, offset_);
  }

  const Vector<S>& error() const { return error_; }

 private:
  static Vector<S> back(const Vector<S>& v) { return {S(-v[0]), S(-v[1]), S(-v[2])}; }

  Support<S> a_;
  Support<S> b_;
  Vector<S> offset_;
  Vector<S> error_;
};

template <typename S>
Verdict search(const Difference<S>& difference, const Vector<S>& start, int most_steps) {
  const S square = dot(start, start);
  const Vector<S> unit{S(1), S(0), S(0)};
  return OriginSearch<Difference<S>>(difference).run(square > 0 ? start : unit, most_steps);
}

Support<Long> longSupport(const ConvexSet& set) {
  std::vector<Vector<Long>> corners;
  for (int i = 0; i < set.count; ++i) corners.push_back(toArray(set.corner(i)));
  return {set.curved, std::move(corners)};
}

Verdict searchInLong(const ConvexPair& pair) {
  const Difference<Long> difference(longSupport(pair.a), longSupport(pair.b), toArray(pair.offset),
                                    toArray(pair.error));
  return search(difference, toArray(pair.offset), kMostSteps);
}

Verdict searchInWide(const ConvexPair& pair) {
  std::vector<WideVector> of_a, of_b;
  for (int i = 0; i < pair.a.count; ++i) of_a.push_back(pair.corners->wideA(i));
  for (int i = 0; i < pair.b.count; ++i) of_b.push_back(pair.corners->wideB(i));
  const Difference<Wide> difference({pair.a.curved, std::move(of_a)},
                                    {pair.b.curved, std::move(of_b)}, pair.wide_offset,
                                    pair.wide_error);
  return search(difference, pair.wide_offset, kMostWideSteps);
}

/// Two triangles: by the signs of determinants of their corners.
class TrianglePair {
 public:
  explicit TrianglePair(const ConvexPair& pair) : pair_(pair), error_(toArray(pair.error)) {
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
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        if (separatedAlong(edgeOfA(i).cross(edgeOfB(j)))) return Verdict::apart;
      }
    }
    for (int i = 0; i < 3; ++i) {
      if (edgeOfAPierces(i) || edgeOfBPierces(i)) return Verdict::touching;
    }
    return Verdict::undecided;
  }

 private:
  int sign(const LongVector& u, const LongVector& v, const LongVector& w) const {
    return oracle::sign(u, v, w, error_);
  }

  static bool allAlike(const int* signs) {
    return signs[0] != 0 && signs[0] == signs[1] && signs[1] == signs[2];
  }

  bool separatedAlong(const LongVector& direction) const {
    Long least = std::numeric_limits<Long>::infinity(), most = -least;
    for (const auto& row : corners_) {
      for (const LongVector& corner : row) {
        const Long along = direction.dot(corner);
        least = std::min(least, along);
        most = std::max(most, along);
      }
    }
    const Long doubt = 4 * direction.cwiseAbs().dot(pair_.error);
    return least > doubt || most < -doubt;
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
  Vector<Long> error_;
  LongVector corners_[3][3];  // b - a - offset
  int side_of_b_[3];          // of the corners of a, relative to the plane of b
  int side_of_a_[3];
};

}  // namespace

Verdict meetExactly(const ConvexPair& pair) {
  std::vector<ExactVector> of_a, of_b;
  for (int i = 0; i < pair.a.count; ++i) of_a.push_back(pair.corners->exactA(i));
  for (int i = 0; i < pair.b.count; ++i) of_b.push_back(pair.corners->exactB(i));
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
  const Verdict verdict = triangles ? TrianglePair(pair).verdict() : searchInLong(pair);
  if (verdict != Verdict::undecided) return verdict;
  return hulls ? meetExactly(pair) : searchInWide(pair);
}

}  // namespace oracle
