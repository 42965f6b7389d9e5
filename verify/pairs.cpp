// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

namespace verify {
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
  std::optional<Cone<T>> cone;
  std::set<std::array<std::size_t, 3>> seen;
  while (!cone || !cone->empty()) {
    const Least<T> found = least(corners, normal);
    if (accept(normal, found)) return true;
    const auto [l, k, q] = found.at;
    if (!seen.insert(found.at).second) return false;
    if (!cone) cone.emplace();
    V<T> point = minus(corners.l[l], corners.k[k]);
    for (int i = 0; i < 3; ++i) point[i] = point[i] * corners.times[q] - corners.q[q][i];
    cone->add(point);
    normal = cone->inner();
  }
  return false;
}

// By what is beyond rounding: 16 operations' errors are more than the few products and sums of
// which any of the terms is made.
bool separates_by_doubles(const Region& region, const Object& a, const Piece& k, const Object& b,
                          const Piece& l) {
  thread_local Corners<double> corners;  // keeps its memory
  corners.k.clear();
  corners.l.clear();
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

// An edge, and from one of its ends the third vertices of the faces at it.
struct Edge {
  BallVec along;
  std::vector<BallVec> sides;
  bool has_on_both_sides(const BallVec& normal) const {
    return sides.size() == 2 && dot(normal, sides[0]).sign() * dot(normal, sides[1]).sign() < 0;
  }
};

std::vector<Edge> edges_of(const Object& object, const Piece& piece) {
  std::map<std::pair<int, int>, Edge> edges;
  for (const Triangle& face : piece.faces) {
    for (int i = 0; i < 3; ++i) {
      const auto [from, to] = std::minmax(face[i], face[(i + 1) % 3]);
      Edge& edge = edges[{from, to}];
      edge.along = minus(object.exact[to], object.exact[from]);
      edge.sides.push_back(minus(object.exact[face[(i + 2) % 3]], object.exact[from]));
    }
  }
  std::vector<Edge> result;
  for (const auto& edge : edges) result.push_back(edge.second);
  return result;
}

}  // namespace

bool separates(const Frame& frame, const Region& region, const Object& a, const Piece& k,
               const Object& b, const Piece& l) {
  if (separates_by_doubles(region, a, k, b, l)) return true;
  Corners<Ball> corners;
  for (const int v : k.vertices) corners.k.push_back(a.exact[v]);
  for (const int v : l.vertices) corners.l.push_back(b.exact[v]);
  for (const BallVec& corner : region.exact) corners.q.push_back(frame.to_world(corner));
  corners.times = region.times;
  // Regions are open: on them a function that is not constant has no value that it has at a corner
  // only.
  const auto accept = [&](const BallVec& n, const Least<Ball>& found) {
    bool varies = false;
    for (int i = 0; i < frame.rank; ++i) varies |= dot(n, frame.columns[i]).sign() != 0;
    return varies ? found.weak : found.strict;
  };
  return search(corners, minus(corners.l[0], corners.k[0]), accept);
}

Faces::Faces(const Frame& frame, const Object& a, const Piece& k, const Object& b, const Piece& l) {
  std::vector<BallVec> of_k, of_l;
  for (const int v : k.vertices) of_k.push_back(a.exact[v]);
  for (const int v : l.vertices) of_l.push_back(b.exact[v]);
  const auto add = [&](const BallVec& normal) {
    const BallVec opposite{-normal[0], -normal[1], -normal[2]};
    std::size_t at = 0;
    Slab slab;
    slab.lo = least_of(normal, of_l, at) + least_of(opposite, of_k, at);
    slab.hi = -(least_of(opposite, of_l, at) + least_of(normal, of_k, at));
    for (int i = 0; i < frame.rank; ++i) slab.slope[i] = dot(normal, frame.columns[i]);
    slabs_.push_back(slab);
    // Of what is in a plane all edges are, and all normals are normal to it.
    has_inside_ = has_inside_ || slab.lo < slab.hi;
  };
  const std::vector<Edge> edges_k = edges_of(a, k), edges_l = edges_of(b, l);
  for (const auto& [object, piece] : {std::pair{&a, &k}, std::pair{&b, &l}}) {
    for (const Triangle& t : piece->faces) {
      const BallVec& from = object->exact[t[0]];
      add(cross(minus(object->exact[t[1]], from), minus(object->exact[t[2]], from)));
    }
  }
  // The plane along both edges supports K or L only if both faces at its edge are on one side.
  for (const Edge& e : edges_k) {
    for (const Edge& f : edges_l) {
      const BallVec normal = cross(e.along, f.along);
      if (!e.has_on_both_sides(normal) && !f.has_on_both_sides(normal)) add(normal);
    }
  }
}

bool Faces::contain(const Region& region) const {
  const slong all = Ball::bits;
  const auto inside = [&](const Slab& slab, std::size_t corner, slong bits) {
    const Precision precision(bits);
    const Ball height = dot(slab.slope, region.exact[corner]);
    const Ball& times = region.times[corner];
    return slab.lo * times <= height && height <= slab.hi * times;
  };
  for (const Slab& slab : slabs_) {
    for (std::size_t i = 0; i < region.exact.size(); ++i) {
      if (!inside(slab, i, 64) && !inside(slab, i, all)) return false;
    }
  }
  return has_inside_;
}

}  // namespace verify
