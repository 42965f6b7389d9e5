// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Whether a convex set has the origin, proved by four of its points or by a plane, in floating
// point of any precision with its errors counted.
#pragma once

#include <limits>
#include <vector>

#include "closest_point.h"
#include "convex_set.h"

namespace oracle {

template <typename Scalar>
Scalar magnitude(const Scalar& x) {
  return x < 0 ? Scalar(-x) : x;
}

/// Sign of the determinant of three vectors of which every component is known to within `error` of
/// its axis, which is also more than what their products are rounded by; 0 if that leaves it open.
template <typename Scalar>
int certainSign(const Vector<Scalar>& u, const Vector<Scalar>& v, const Vector<Scalar>& w,
                const Vector<Scalar>& error) {
  constexpr int kSafety = 4;
  Scalar value = 0;
  Scalar doubt = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    value += u[i] * (v[j] * w[k] - v[k] * w[j]);
    const Scalar vj = magnitude(v[j]) + error[j], vk = magnitude(v[k]) + error[k];
    const Scalar wj = magnitude(w[j]) + error[j], wk = magnitude(w[k]) + error[k];
    doubt += error[i] * (vj * wk + vk * wj) +
             magnitude(u[i]) * (error[j] * (wk + vk) + error[k] * (vj + wj));
  }
  doubt *= kSafety;
  if (value > doubt) return 1;
  return value < -doubt ? -1 : 0;
}

/// `Body` has a type Scalar, a point(direction) of the set that is farthest along it, a
/// value(direction) of that, and error(), a bound on the error of points for each axis.
template <typename Body>
class OriginSearch {
 public:
  using Scalar = typename Body::Scalar;
  using Point = Vector<Scalar>;

  explicit OriginSearch(const Body& body) : body_(body) {}

  /// Whether all of the set is certainly to one side of the origin along `direction`.
  bool isSeparatedAlong(const Point& direction) const {
    return isAhead(direction) || isAhead(negative(direction));
  }

  /// Gilbert, Johnson and Keerthi 1988; only certificates count, not what it converges to.
  Verdict run(const Point& start, int most_steps) {
    simplex_.points[0] = body_.point(start);
    simplex_.count = 1;
    reduce(simplex_);
    for (int step = 0; step < most_steps; ++step) {
      if (simplex_.count == 4) {
        const auto& p = simplex_.points;
        if (surround(p[0], p[1], p[2], p[3])) return Verdict::touching;
        break;
      }
      const Point closest = simplex_.closest;
      if (isAhead(closest)) return Verdict::apart;
      const Scalar square = dot(closest, closest);
      if (!(square > 0)) break;
      simplex_.points[static_cast<std::size_t>(simplex_.count++)] = body_.point(negative(closest));
      const Simplex<Scalar> before = simplex_;
      reduce(simplex_);
      if (simplex_.count < 4 && !(dot(simplex_.closest, simplex_.closest) < square)) {
        simplex_ = before;
        break;
      }
    }
    return lastResort();
  }

 private:
  static Point negative(const Point& v) { return {Scalar(-v[0]), Scalar(-v[1]), Scalar(-v[2])}; }

  bool isAhead(const Point& direction) const {
    constexpr int kSafety = 4;
    const Point& error = body_.error();
    Scalar doubt = 0;
    for (std::size_t k = 0; k < 3; ++k) doubt += magnitude(direction[k]) * error[k];
    return -body_.value(negative(direction)) > kSafety * doubt;
  }

  int sign(const Point& u, const Point& v, const Point& w) const {
    return certainSign(u, v, w, body_.error());
  }

  // Whether the tetrahedron certainly has the origin within.
  bool surround(const Point& p, const Point& q, const Point& r, const Point& s) const {
    const int first = sign(q, r, s);
    return first != 0 && sign(p, r, s) == -first && sign(p, q, s) == first &&
           sign(p, q, r) == -first;
  }

  bool anyFourSurround(const std::vector<Point>& points) const {
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

  // Across the faces of the last simplex; then, where the origin is on a face of all simplices met,
  // points around it in general position.
  Verdict lastResort() const {
    std::vector<Point> points(simplex_.points.begin(), simplex_.points.begin() + simplex_.count);
    std::vector<Point> normals;
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        for (std::size_t k = 0; k < j; ++k) {
          normals.push_back(cross(Point(points[i] - points[k]), Point(points[j] - points[k])));
          if (isSeparatedAlong(normals.back())) return Verdict::apart;
        }
      }
    }
    const auto probe = [&](const Point& direction) {
      points.push_back(body_.point(direction));
      points.push_back(body_.point(negative(direction)));
    };
    if (!normals.empty()) probe(normals.front());
    if (anyFourSurround(points)) return Verdict::touching;
    probe({Scalar(0.63), Scalar(0.31), Scalar(-0.71)});
    probe({Scalar(-0.42), Scalar(0.87), Scalar(0.26)});
    probe({Scalar(0.55), Scalar(-0.37), Scalar(0.75)});
    return anyFourSurround(points) ? Verdict::touching : Verdict::undecided;
  }

  const Body& body_;
  Simplex<Scalar> simplex_;
};

}  // namespace oracle
