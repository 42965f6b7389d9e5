// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "separation.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace verify {

Region::Region(int rank, const Vec& low, const Vec& high) {
  for (int i = 0; i < 3; ++i) bound[i] = std::max(std::abs(low[i]), std::abs(high[i]));
  for (int corner = 0; corner < 1 << rank; ++corner) {
    Vec point = low;
    for (int i = 0; i < rank; ++i) point[i] = corner >> i & 1 ? high[i] : low[i];
    corners.push_back(point);
  }
}

Region::Region(const Polytope& polytope, const Vec& low, const Vec& high,
               const std::vector<Plane>& planes)
    : Region(polytope.rank(), low, high) {
  for (const Plane& plane : planes) normals.push_back(plane.normal);
  corners.clear();
  for (const int v : polytope.used()) {
    exact.push_back(polytope.vertices()[v]);
    const Precision enough(128);
    const BallVec q = exact.back().ball();
    corners.push_back({q[0].nearest(), q[1].nearest(), q[2].nearest()});
  }
}

Region::Corner Region::exact_corner(std::size_t i) const {
  if (exact.empty()) return {balls(corners[i]), Ball(1)};
  const auto& x = exact[i].x;
  return {{Ball(x[0]), Ball(x[1]), Ball(x[2])}, Ball(exact[i].w)};
}

Heights::Heights(const Frame& frame, const Object& a, const Piece& k, const Object& b,
                 const Piece& l, const BallVec& normal)
    : constant(dot(normal, frame.mean)) {
  const auto range = [&](const Object& object, const Piece& piece, Ball& low, Ball& high) {
    for (std::size_t i = 0; i < piece.vertices.size(); ++i) {
      const Ball height = dot(normal, object.world(piece.vertices[i]));
      low = i == 0 ? height : min(low, height);
      high = i == 0 ? height : max(high, height);
    }
  };
  Ball k_lo, k_hi, l_lo, l_hi;
  range(a, k, k_lo, k_hi);
  range(b, l, l_lo, l_hi);
  lo = l_lo - k_hi;
  hi = l_hi - k_lo;
  for (int i = 0; i < frame.rank; ++i) slope[i] = dot(normal, frame.columns[i]);
}

namespace {

template <class T>
using V = std::array<T, 3>;

int sign_of(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }
int sign_of(const Ball& x) { return x.sign(); }

// Makes the largest entry about 1, exactly in balls.
void normalise(Vec& n) {
  const double most = std::max({std::abs(n[0]), std::abs(n[1]), std::abs(n[2])});
  for (double& x : n) x /= most;
}
void normalise(BallVec& n) {
  slong most = -ARF_PREC_EXACT;
  for (Ball& x : n) {
    if (x.sign() != 0) most = std::max(most, arf_abs_bound_lt_2exp_si(arb_midref(x.raw())));
  }
  if (most == -ARF_PREC_EXACT) return;
  for (Ball& x : n) arb_mul_2exp_si(x.raw(), x.raw(), -most);
}

// The n with n·w >= 0 for all points w, as what some rays span. Those of the part of it that is in
// one orthant are where two of the planes through 0 meet that are normal to points and to the axes.
template <class T>
class Cone {
 public:
  Cone() {
    for (int i = 0; i < 3; ++i) {
      V<T> axis{};
      axis[i] = T(1);
      normals_.push_back(axis);
      rays_.push_back(axis);
      axis[i] = T(-1);
      rays_.push_back(axis);
    }
  }
  void add(const V<T>& point) {
    const auto beyond = [&](const V<T>& ray) { return sign_of(dot(ray, point)) < 0; };
    rays_.erase(std::remove_if(rays_.begin(), rays_.end(), beyond), rays_.end());
    for (std::size_t i = 0; i < normals_.size(); ++i) {
      V<T> ray = cross(normals_[i], point);
      normalise(ray);
      for (int side = 0; side < 2; ++side) {
        bool inside = true;
        for (std::size_t j = 3; j < normals_.size() && inside; ++j) {
          inside = i == j || sign_of(dot(ray, normals_[j])) >= 0;
        }
        if (inside) rays_.push_back(ray);
        for (T& x : ray) x = -x;
      }
    }
    normals_.push_back(point);
  }
  bool empty() const { return rays_.empty(); }
  /// One that is on no side of the cone that all of it is not on: weights are all different, for
  /// opposite rays not to cancel.
  V<T> inner() const {
    V<T> sum{};
    double weight = 1;
    for (const V<T>& ray : rays_) {
      for (int i = 0; i < 3; ++i) sum[i] = sum[i] + ray[i] * T(weight);
      weight += 0.125;
    }
    return sum;
  }

 private:
  std::vector<V<T>> normals_;  // axes, then points
  std::vector<V<T>> rays_;
};

// Corners of K, of L and of the region; the latter are to be divided by `times`.
template <class T>
struct Corners {
  std::vector<V<T>> k, l, q;
  std::vector<T> times;
};

// Where l - k - q, times a positive number, is least along a normal.
template <class T>
struct Least {
  T height;
  bool weak = true, strict = true;  // whether it is certainly >= 0 everywhere; > 0
  std::array<std::size_t, 3> at{};  // of l, k, q
};

template <class T>
T least_of(const V<T>& normal, const std::vector<V<T>>& points, std::size_t& at) {
  using std::min;
  T bound = dot(normal, points[0]), least = bound;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const T height = dot(normal, points[i]);
    bound = min(bound, height);
    if (!(height < least)) continue;
    least = height;
    at = i;
  }
  return bound;
}

template <class T>
Least<T> least(const Corners<T>& corners, const V<T>& normal) {
  Least<T> result;
  const V<T> opposite{-normal[0], -normal[1], -normal[2]};
  const T apart =
      least_of(normal, corners.l, result.at[0]) + least_of(opposite, corners.k, result.at[1]);
  for (std::size_t i = 0; i < corners.q.size(); ++i) {
    const T height = apart * corners.times[i] - dot(normal, corners.q[i]);
    result.weak = result.weak && T(0) <= height;
    result.strict = result.strict && T(0) < height;
    const std::size_t best = result.at[2];
    if (i > 0 && !(height * corners.times[best] < result.height * corners.times[i])) continue;
    result.height = height;
    result.at[2] = i;
  }
  return result;
}

// Tries one normal after the other: one that is on the right side of all corners seen so far. If
// there is a hyperplane, with exact numbers one is found: of what is in the inside of the cone all
// is as far from the corners as can be.
template <class T, class Accept>
bool search(const Corners<T>& corners, V<T> normal, const Accept& accept) {
  Cone<T> cone;
  std::set<std::array<std::size_t, 3>> seen;
  while (!cone.empty()) {
    const Least<T> found = least(corners, normal);
    if (accept(normal, found)) return true;
    const auto [l, k, q] = found.at;
    if (!seen.insert(found.at).second) return false;
    V<T> point = minus(corners.l[l], corners.k[k]);
    for (int i = 0; i < 3; ++i) point[i] = point[i] * corners.times[q] - corners.q[q][i];
    cone.add(point);
    normal = cone.inner();
  }
  return false;
}

// By what is beyond rounding: 16 operations' errors are more than the few products and sums of
// which any of the terms is made.
bool separates_by_doubles(const Region& region, const Object& a, const Piece& k, const Object& b,
                          const Piece& l) {
  Corners<double> corners;
  for (const int v : k.vertices) corners.k.push_back(a.points[v]);
  for (const int v : l.vertices) corners.l.push_back(b.points[v]);
  corners.q = region.corners;
  corners.times.assign(corners.q.size(), 1);
  Vec error;
  for (int i = 0; i < 3; ++i) {
    error[i] = a.error[i] + b.error[i] + 16 * kUnit * (a.bound[i] + b.bound[i] + region.bound[i]);
  }
  const auto accept = [&](const Vec& n, const Least<double>& found) {
    const Vec size{std::abs(n[0]), std::abs(n[1]), std::abs(n[2])};
    return found.height > dot(size, error) * (1 + 1e-10) + DBL_MIN;
  };
  return search(corners, minus(minus(corners.l[0], corners.k[0]), corners.q[0]), accept);
}

bool separates_exactly(const Frame& frame, const Region& region, const Object& a, const Piece& k,
                       const Object& b, const Piece& l) {
  Corners<Ball> corners;
  for (const int v : k.vertices) corners.k.push_back(a.world(v));
  for (const int v : l.vertices) corners.l.push_back(minus(b.world(v), frame.mean));
  for (std::size_t i = 0; i < region.corners.size(); ++i) {
    const Region::Corner corner = region.exact_corner(i);
    corners.q.push_back(frame.to_world(corner.point));
    corners.times.push_back(corner.times);
  }
  // Regions are open: on them a function that is not constant has no value that it has at a corner
  // only.
  const auto accept = [&](const BallVec& n, const Least<Ball>& found) {
    bool varies = false;
    for (int i = 0; i < frame.rank; ++i) varies |= dot(n, frame.columns[i]).sign() != 0;
    return varies ? found.weak : found.strict;
  };
  return search(corners, minus(corners.l[0], corners.k[0]), accept);
}

}  // namespace

bool separates(const Frame& frame, const Region& region, const Object& a, const Piece& k,
               const Object& b, const Piece& l) {
  return separates_by_doubles(region, a, k, b, l) || separates_exactly(frame, region, a, k, b, l);
}

}  // namespace verify
