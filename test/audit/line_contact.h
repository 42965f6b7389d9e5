// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Where along a line of displacements two sets of convex pieces touch, in any arithmetic. Shares
// nothing with the library.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace fcl_prob_audit {

template <typename Real>
struct Vec {
  Real x{}, y{}, z{};

  Vec operator+(const Vec& o) const { return {x + o.x, y + o.y, z + o.z}; }
  Vec operator-(const Vec& o) const { return {x - o.x, y - o.y, z - o.z}; }
  Vec operator*(const Real& s) const { return {x * s, y * s, z * s}; }
  Real dot(const Vec& o) const { return x * o.x + y * o.y + z * o.z; }
  Vec cross(const Vec& o) const {
    return {y * o.z - z * o.y, z * o.x - x * o.z, x * o.y - y * o.x};
  }
};

template <typename Real>
struct Span {
  Real lo, hi;
};

/// The hull of points, or a ball around a single one.
template <typename Real>
struct Piece {
  std::vector<Vec<Real>> points;
  std::vector<Vec<Real>> edges;  ///< directions of the hull's edges, and perhaps others
  Real radius{0};
};

/// A closed surface that counts as what it encloses.
template <typename Real>
struct Enclosure {
  std::vector<std::array<Vec<Real>, 3>> triangles;
};

/// An object in the world.
template <typename Real>
struct PlacedSet {
  std::vector<Piece<Real>> pieces;
  std::vector<Enclosure<Real>> enclosures;
  /// A point of every connected part: either all of a part is in an enclosure, or its surface meets
  /// that of the enclosure, or none of it is.
  std::vector<Vec<Real>> part_points;
};

/// The displacements start + t·direction, t within [-reach, reach].
template <typename Real>
struct Line {
  Vec<Real> start, direction;
  Real reach;
};

template <typename Real>
bool isZero(const Vec<Real>& v) {
  return v.x == 0 && v.y == 0 && v.z == 0;
}

/// Directions among which there is a separating one of the Minkowski difference of two hulls, if
/// they are apart. (Superfluous ones do no harm: no direction separates what touches.)
template <typename Real>
std::vector<Vec<Real>> separatingDirections(const Piece<Real>& a, const Piece<Real>& b) {
  std::vector<Vec<Real>> edges = a.edges;
  edges.insert(edges.end(), b.edges.begin(), b.edges.end());
  std::vector<Vec<Real>> result = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  std::vector<Vec<Real>> crosses;
  Vec<Real> largest{};
  Real most{0};
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t j = i + 1; j < edges.size(); ++j) {
      const Vec<Real> n = edges[i].cross(edges[j]);
      if (isZero(n)) continue;
      // Long edges can hide short ones; flatness is judged by the sine.
      const Real sine = n.dot(n) / (edges[i].dot(edges[i]) * edges[j].dot(edges[j]));
      if (sine > most) {
        most = sine;
        largest = n;
      }
      crosses.push_back(n);
    }
  }
  result.insert(result.end(), crosses.begin(), crosses.end());
  for (const Vec<Real>& e : edges) {
    result.push_back(e);
    // Of a flat difference: its sides. Of a straight one: two directions across.
    if (most > 0) {
      result.push_back(largest.cross(e));
    } else {
      const Vec<Real> aside =
          std::min({e.x * e.x, e.y * e.y, e.z * e.z}) == e.x * e.x
              ? Vec<Real>{1, 0, 0}
              : (e.y * e.y < e.z * e.z ? Vec<Real>{0, 1, 0} : Vec<Real>{0, 0, 1});
      const Vec<Real> n = e.cross(aside);
      result.push_back(n);
      result.push_back(n.cross(e));
    }
  }
  return result;
}

template <typename Real>
Span<Real> extentAlong(const Piece<Real>& piece, const Vec<Real>& n) {
  Span<Real> span{n.dot(piece.points.front()), n.dot(piece.points.front())};
  for (const Vec<Real>& p : piece.points) {
    const Real value = n.dot(p);
    if (value < span.lo) span.lo = value;
    if (value > span.hi) span.hi = value;
  }
  return span;
}

/// Cuts `t` to where start + t·rate is within the span; says whether anything is left.
template <typename Real>
bool cut(Span<Real>& t, const Span<Real>& within, const Real& start, const Real& rate) {
  if (rate == 0) return within.lo <= start && start <= within.hi;
  Real first = (within.lo - start) / rate, last = (within.hi - start) / rate;
  if (first > last) std::swap(first, last);
  if (first > t.lo) t.lo = first;
  if (last < t.hi) t.hi = last;
  return t.lo <= t.hi;
}

template <typename Real>
std::optional<Span<Real>> ballsTouch(const Piece<Real>& a, const Piece<Real>& b,
                                     const Line<Real>& line) {
  using std::sqrt;
  const Vec<Real> from = a.points[0] + line.start - b.points[0];
  const Real r = a.radius + b.radius;
  const Real square = line.direction.dot(line.direction);
  if (square == 0) {
    if (from.dot(from) > r * r) return std::nullopt;
    return Span<Real>{-line.reach, line.reach};
  }
  const Real middle = -from.dot(line.direction) / square;
  const Vec<Real> nearest = from + line.direction * middle;
  const Real left = r * r - nearest.dot(nearest);
  if (left < 0) return std::nullopt;
  const Real half = sqrt(Real(left / square));
  return Span<Real>{middle - half, middle + half};
}

/// Two hulls, or two balls.
template <typename Real>
std::optional<Span<Real>> piecesTouch(const Piece<Real>& a, const Piece<Real>& b,
                                      const Line<Real>& line) {
  if (a.radius > 0 && b.radius > 0) return ballsTouch(a, b, line);
  Span<Real> t{-line.reach, line.reach};
  const auto survives = [&](const Vec<Real>& n) {
    const Span<Real> of_a = extentAlong(a, n), of_b = extentAlong(b, n);
    const Span<Real> allowed{of_b.lo - of_a.hi, of_b.hi - of_a.lo};
    return cut(t, allowed, Real(n.dot(line.start)), Real(n.dot(line.direction)));
  };
  for (const Vec<Real>& n : {Vec<Real>{1, 0, 0}, Vec<Real>{0, 1, 0}, Vec<Real>{0, 0, 1}}) {
    if (!survives(n)) return std::nullopt;
  }
  for (const Vec<Real>& n : separatingDirections(a, b)) {
    if (!survives(n)) return std::nullopt;
  }
  return t;
}

template <typename Real>
std::vector<Span<Real>> united(std::vector<Span<Real>> spans) {
  std::sort(spans.begin(), spans.end(),
            [](const Span<Real>& x, const Span<Real>& y) { return x.lo < y.lo; });
  std::vector<Span<Real>> result;
  for (const Span<Real>& span : spans) {
    if (!result.empty() && span.lo <= result.back().hi) {
      if (span.hi > result.back().hi) result.back().hi = span.hi;
    } else {
      result.push_back(span);
    }
  }
  return result;
}

/// How often the enclosure winds around a point; nothing where no ray of some can tell.
template <typename Real>
std::optional<int> windingAround(const Enclosure<Real>& enclosure, const Vec<Real>& point,
                                 const Real& least_sine) {
  using std::sqrt;
  for (int attempt = 0; attempt < 8; ++attempt) {
    const Vec<Real> ray{Real(0.8142 + 0.11 * attempt), Real(0.2931 - 0.23 * attempt),
                        Real(0.4127 + 0.31 * attempt * attempt)};
    int winding = 0;
    bool certain = true;
    for (const auto& triangle : enclosure.triangles) {
      const Vec<Real> p = triangle[0] - point, q = triangle[1] - point, r = triangle[2] - point;
      std::array<Real, 3> sides{ray.dot(p.cross(q)), ray.dot(q.cross(r)), ray.dot(r.cross(p))};
      const Real size = p.dot(p) + q.dot(q) + r.dot(r);
      const Real margin = least_sine * size;
      bool above = false, below = false, near = false;
      for (const Real& side : sides) {
        above = above || side > margin;
        below = below || side < -margin;
        near = near || (side <= margin && side >= -margin);
      }
      if (above && below) continue;
      const Vec<Real> normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
      if (isZero(normal)) continue;  // no area
      if (near) {
        certain = false;
        break;
      }
      const Real height = normal.dot(p);
      const Real slope = normal.dot(ray);
      if ((height > 0) == (slope > 0)) winding += slope > 0 ? 1 : -1;
    }
    if (certain) return winding;
  }
  return std::nullopt;
}

}  // namespace fcl_prob_audit
