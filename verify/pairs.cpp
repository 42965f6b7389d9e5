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

// What is near a ball has roots, which are never exact.
constexpr slong kSweptBits = 256;

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

// How far the balls by which K and L are swept reach along a normal, together, and where.
template <class T>
struct Swept {
  T height{};
  V<T> at{};
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
Least<T> least(const Corners<T>& corners, const V<T>& normal, const T& swept) {
  Least<T> result;
  const V<T> opposite{-normal[0], -normal[1], -normal[2]};
  const T apart = least_of(normal, corners.l, result.at[0]) +
                  least_of(opposite, corners.k, result.at[1]) - swept;
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
// is as far from the corners as can be. Beside balls there are corners without end.
template <class T, class Sweep, class Accept>
bool search(const Corners<T>& corners, V<T> normal, const Sweep& sweep, const Accept& accept) {
  constexpr int kMostSteps = 60;
  std::optional<Cone<T>> cone;
  std::set<std::array<std::size_t, 3>> seen;
  for (int step = 0; !cone || !cone->empty(); ++step) {
    const std::optional<Swept<T>> swept = sweep(normal);
    const Least<T> found = least(corners, normal, swept ? swept->height : T(0));
    if (accept(normal, found)) return true;
    const auto [l, k, q] = found.at;
    if (swept ? step == kMostSteps : !seen.insert(found.at).second) return false;
    if (!cone) cone.emplace();
    V<T> point = minus(corners.l[l], corners.k[k]);
    if (swept) point = minus(point, swept->at);
    for (int i = 0; i < 3; ++i) point[i] = point[i] * corners.times[q] - corners.q[q][i];
    cone->add(point);
    normal = cone->inner();
  }
  return false;
}

// By what is beyond rounding: 16 operations' errors are more than the few products and sums of
// which any of the terms is made.
bool separates_by_doubles(const Frame& frame, const Region& region, const Object& a, const Piece& k,
                          const Object& b, const Piece& l) {
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
  // In the world the normal is w = M'^-T n.
  const double radius = (k.radius + l.radius) * (1 + 4 * kUnit);
  const auto sweep = [&](const Vec& n) -> std::optional<Swept<double>> {
    if (radius == 0) return std::nullopt;
    Vec w{};
    double rounding = 0;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) w[j] += n[i] * frame.inverse[i][j];
      rounding += 16 * kUnit * std::abs(n[i]) * frame.reach[i];
    }
    const double length = std::sqrt(dot(w, w));
    Swept<double> swept{radius * (length + rounding) * (1 + 16 * kUnit), {}};
    for (int i = 0; i < 3; ++i) swept.at[i] = radius * dot(frame.inverse[i], w) / length;
    return swept;
  };
  const auto accept = [&](const Vec& n, const Least<double>& found) {
    const Vec size{std::abs(n[0]), std::abs(n[1]), std::abs(n[2])};
    return found.height > dot(size, error) * (1 + 1e-10) + DBL_MIN;
  };
  return search(corners, minus(minus(corners.l[0], corners.k[0]), corners.q[0]), sweep, accept);
}

// How much of each corner the point of a triangle has that is nearest to 0, up to rounding.
Vec nearest_weights(const std::array<Vec, 3>& t) {
  Vec best{};
  double least = HUGE_VAL;
  const auto consider = [&](const Vec& weights) {
    Vec point{};
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) point[j] += weights[i] * t[i][j];
    }
    const double distance = dot(point, point);
    if (!(distance < least)) return;
    least = distance;
    best = weights;
  };
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const Vec along = minus(t[j], t[i]);
    const double share = -dot(t[i], along) / dot(along, along);
    Vec weights{};
    weights[i] = 1;
    consider(weights);
    weights[i] = 1 - share;
    weights[j] = share;
    if (share > 0 && share < 1) consider(weights);
  }
  const Vec e = minus(t[1], t[0]), f = minus(t[2], t[0]);
  const double ee = dot(e, e), ef = dot(e, f), ff = dot(f, f), det = ee * ff - ef * ef;
  const double s = (dot(t[0], f) * ef - dot(t[0], e) * ff) / det;
  const double u = (dot(t[0], e) * ef - dot(t[0], f) * ee) / det;
  if (s > 0 && u > 0 && s + u < 1) consider({1 - s - u, s, u});
  return best;
}

// An edge, and from one of its ends the third vertices of the faces at it.
struct Edge {
  BallVec from, along;
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
      edge.from = object.exact[from];
      edge.along = minus(object.exact[to], edge.from);
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
  if (separates_by_doubles(frame, region, a, k, b, l)) return true;
  const Ball radius = Ball(k.radius) + Ball(l.radius);
  const Precision precision(radius.is_zero() ? Ball::bits : kSweptBits);
  const auto sweep = [&](const BallVec& n) -> std::optional<Swept<Ball>> {
    if (radius.is_zero()) return std::nullopt;
    const Ball length = sqrt(dot(n, n)), share = radius / length;
    return Swept<Ball>{radius * length, {share * n[0], share * n[1], share * n[2]}};
  };
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
  return search(corners, minus(corners.l[0], corners.k[0]), sweep, accept);
}

Faces::Faces(const Frame& frame, const Object& a, const Piece& k, const Object& b, const Piece& l)
    : frame_(frame), radius_(Ball(k.radius) + Ball(l.radius)) {
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
  if (!radius_.is_zero()) add_surface(a, k, b, l);
}

// Of the surface of L - K, and if it is flat of all of it, triangles.
void Faces::add_surface(const Object& a, const Piece& k, const Object& b, const Piece& l) {
  for (const Triangle& t : l.faces) {
    for (const int v : k.vertices) {
      surface_.emplace_back();
      for (int i = 0; i < 3; ++i) surface_.back()[i] = minus(b.exact[t[i]], a.exact[v]);
    }
  }
  for (const Triangle& t : k.faces) {
    for (const int v : l.vertices) {
      surface_.emplace_back();
      for (int i = 0; i < 3; ++i) surface_.back()[i] = minus(b.exact[v], a.exact[t[i]]);
    }
  }
  for (const Edge& e : edges_of(a, k)) {
    for (const Edge& f : edges_of(b, l)) {
      const BallVec corner = minus(f.from, e.from),
                    opposite = minus(plus(corner, f.along), e.along);
      surface_.push_back({corner, plus(corner, f.along), opposite});
      surface_.push_back({corner, minus(corner, e.along), opposite});
    }
  }
}

// Whether a corner is no farther from the surface than the ball reaches.
bool Faces::is_near(const BallVec& corner, const Ball& times) const {
  const Precision precision(kSweptBits);
  const BallVec at = frame_.to_world(corner);
  for (const std::array<BallVec, 3>& triangle : surface_) {
    std::array<BallVec, 3> seen;  // from the corner, times `times`
    std::array<Vec, 3> rounded;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        seen[i][j] = triangle[i][j] * times - at[j];
        rounded[i][j] = (seen[i][j] / times).nearest();
      }
    }
    const Vec weights = nearest_weights(rounded);
    BallVec sum;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) sum[j] = sum[j] + Ball(weights[i]) * seen[i][j];
    }
    const Ball reach = radius_ * times * (Ball(weights[0]) + Ball(weights[1]) + Ball(weights[2]));
    if (dot(sum, sum) <= reach * reach) return true;
  }
  return false;
}

bool Faces::contain(const Region& region) const {
  const slong all = Ball::bits;
  const auto inside = [&](const Slab& slab, std::size_t corner, slong bits) {
    const Precision precision(bits);
    const Ball height = dot(slab.slope, region.exact[corner]);
    const Ball& times = region.times[corner];
    return slab.lo * times <= height && height <= slab.hi * times;
  };
  for (std::size_t i = 0; i < region.exact.size(); ++i) {
    const bool within =
        has_inside_ && std::all_of(slabs_.begin(), slabs_.end(), [&](const Slab& slab) {
          return inside(slab, i, 64) || inside(slab, i, all);
        });
    if (!within && (radius_.is_zero() || !is_near(region.exact[i], region.times[i]))) return false;
  }
  return true;
}

}  // namespace verify
