// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene.h"

#include <algorithm>
#include <cmath>
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
  const T apart = least_of(normal, corners.l, result.at[0]) +
                  least_of(opposite(normal), corners.k, result.at[1]) - swept;
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
  const auto sweep = [&](const Vec& n) -> std::optional<Swept<double>> {
    if (k.radius + l.radius == 0) return std::nullopt;
    const Vec w = frame.normal_in_world(n);
    double rounding = 0;  // of w
    for (int i = 0; i < 3; ++i) rounding += 32 * kUnit * std::abs(n[i]) * frame.reach[i];
    Swept<double> swept;
    for (const Piece* piece : {&k, &l}) {
      const double size = piece->radius * piece->size_of_rotation();
      swept.height += piece->radius * length(piece->turned_back(w)) * (1 + 32 * kUnit) +
                      size * (rounding + 32 * kUnit * length(w));
      const Vec at = piece->turned(piece->farthest_swept(w));
      for (int i = 0; i < 3; ++i) swept.at[i] += dot(frame.inverse[i], at);
    }
    return swept;
  };
  const auto accept = [&](const Vec& n, const Least<double>& found) {
    const Vec size{std::abs(n[0]), std::abs(n[1]), std::abs(n[2])};
    return found.height > dot(size, error) * (1 + 1e-10) + DBL_MIN;
  };
  return search(corners, minus(minus(corners.l[0], corners.k[0]), corners.q[0]), sweep, accept);
}

// A point of L - K, as seen from the corner that is looked for.
struct Sum {
  Vec seen{};     // in the coordinates of points, rounded
  BallVec exact;  // in the world, times a positive number
};

// Whether one corner of a region is in L - K: it is if it is in a simplex of four points of it.
class Enclosure {
 public:
  Enclosure(const Frame& frame, const Object& a, const Piece& k, const Object& b, const Piece& l)
      : frame_(frame), a_(a), b_(b), k_(k), l_(l) {}

  bool holds(const Vec& corner, const BallVec& exact, const Ball& times) {
    corner_ = corner;
    times_ = &times;
    const slong all = Ball::bits;
    for (const slong bits : {slong{128}, all}) {
      const Precision precision(bits);
      exact_ = frame_.to_world(exact);
      // The mean of all vertices, and others where it is in line with what should not be.
      for (int attempt = 0; attempt < 4; ++attempt) {
        if (is_inside(middle(attempt))) return true;
      }
    }
    return false;
  }

 private:
  // The first vertices count for so much more; `weight_of_middle_` is by what it is multiplied.
  Sum middle(int more) {
    const auto mean = [&](const Object& object, const Piece& piece, Vec& rounded, BallVec& total) {
      const double count = static_cast<double>(piece.vertices.size()) + more;
      for (std::size_t v = 0; v < piece.vertices.size(); ++v) {
        const double share = v == 0 ? 1 + more : 1;
        const int vertex = piece.vertices[v];
        for (int i = 0; i < 3; ++i) {
          rounded[i] += share / count * object.points[vertex][i];
          total[i] = total[i] + Ball(share) * object.exact[vertex][i];
        }
      }
      return Ball(count);
    };
    Vec of_k{}, of_l{};
    BallVec all_k, all_l;
    const Ball k_count = mean(a_, k_, of_k, all_k), l_count = mean(b_, l_, of_l, all_l);
    weight_of_middle_ = k_count * l_count;
    Sum sum;
    sum.seen = minus(minus(of_l, of_k), corner_);
    for (int i = 0; i < 3; ++i) {
      sum.exact[i] =
          (all_l[i] * k_count - all_k[i] * l_count) * *times_ - exact_[i] * weight_of_middle_;
    }
    return sum;
  }

  // The farthest along a normal.
  Sum farthest(const Vec& n) const {
    int at_k = 0, at_l = 0;
    double highest = -HUGE_VAL, lowest = HUGE_VAL;
    for (const int v : l_.vertices) {
      const double height = dot(n, b_.points[v]);
      if (height > highest) at_l = v;
      highest = std::max(highest, height);
    }
    for (const int v : k_.vertices) {
      const double height = dot(n, a_.points[v]);
      if (height < lowest) at_k = v;
      lowest = std::min(lowest, height);
    }
    Sum sum;
    sum.seen = minus(minus(b_.points[at_l], a_.points[at_k]), corner_);
    BallVec exact = minus(b_.exact[at_l], a_.exact[at_k]);
    if (k_.radius + l_.radius > 0) {
      const Vec w = frame_.normal_in_world(n);
      const Vec of_k = k_.farthest_swept(opposite(w)), of_l = l_.farthest_swept(w);
      const Vec moved = minus(l_.turned(of_l), k_.turned(of_k));
      for (int i = 0; i < 3; ++i) sum.seen[i] += dot(frame_.inverse[i], moved);
      exact = plus(exact, minus(l_.turned(balls(of_l)), k_.turned(balls(of_k))));
    }
    for (int i = 0; i < 3; ++i) sum.exact[i] = exact[i] * *times_ - exact_[i];
    return sum;
  }

  // The ray from the middle to the corner leads through a triangle of points, or beside it: then on
  // the other side of the plane of two of them and the middle there is a third one. While the
  // corner is beyond it the triangle is moved outwards (Snethen, XenoCollide, 2008).
  bool is_inside(const Sum& middle) const {
    Sum p = farthest(middle.seen == Vec{} ? Vec{1, 0, 0} : opposite(middle.seen));
    const auto is_zero = [](const Ball& x) { return x.is_zero(); };
    if (std::all_of(p.exact.begin(), p.exact.end(), is_zero)) return true;
    Sum q = farthest(normal_to(p.seen, middle.seen));
    Sum r = farthest(cross(minus(p.seen, middle.seen), minus(q.seen, middle.seen)));
    const std::array<Sum*, 3> corners{&p, &q, &r};
    for (int step = 0; step < kMostSteps; ++step) {
      const Side side = side_of({&middle.exact, &p.exact, &q.exact, &r.exact});
      if (side == kInside || side == kUnclear) return side == kInside;
      if (side == kBeyond) {
        if (!move_outwards(middle, p, q, r)) return false;
        continue;
      }
      Sum& replaced = *corners[side];
      const Sum &one = *corners[(side + 1) % 3], &two = *corners[(side + 2) % 3];
      const Vec n = cross(minus(one.seen, middle.seen), minus(two.seen, middle.seen));
      const bool flip = dot(n, minus(replaced.seen, middle.seen)) > 0;
      replaced = farthest(flip ? opposite(n) : n);
    }
    return false;
  }

  // False where no point is farther.
  bool move_outwards(const Sum& middle, Sum& p, Sum& q, Sum& r) const {
    Vec n = cross(minus(q.seen, p.seen), minus(r.seen, p.seen));
    if (dot(n, minus(p.seen, middle.seen)) < 0) {
      std::swap(q, r);
      n = opposite(n);
    }
    const Sum beyond = farthest(n);
    if (!(dot(n, beyond.seen) > dot(n, p.seen))) return false;
    const Vec across = cross(beyond.seen, middle.seen);
    if (dot(p.seen, across) > 0) {
      (dot(q.seen, across) > 0 ? p : r) = beyond;
    } else {
      (dot(r.seen, across) > 0 ? q : p) = beyond;
    }
    return true;
  }

  // Some direction across both.
  static Vec normal_to(const Vec& a, const Vec& b) {
    const Vec n = cross(a, b);
    if (dot(n, n) > 1e-20 * dot(a, a) * dot(b, b)) return n;  // not in line
    const Vec c = std::abs(a[0]) < std::abs(a[1]) ? Vec{1, 0, 0} : Vec{0, 1, 0};
    return cross(a, c);
  }

  // Where the corner is: within the simplex of the middle and three points, beside it where the
  // first, second or third of them is not, beyond them, or that cannot be told.
  enum Side { kFirst, kSecond, kThird, kBeyond, kInside, kUnclear };

  Side side_of(const std::array<const BallVec*, 4>& points) const {
    const auto& [m, p, q, r] = points;
    // The corner is the mean of the points by these weights, volumes.
    const BallVec of_middle = cross(*q, *r);
    const Ball weights[] = {-dot(*m, of_middle), dot(*m, cross(*p, *r)), -dot(*m, cross(*p, *q)),
                            dot(*p, of_middle) * weight_of_middle_};
    const int side = (weights[0] + weights[1] + weights[2] + weights[3]).sign();
    if (side == 0) return kUnclear;
    for (int i = 0; i < 4; ++i) {
      const Ball weight = side > 0 ? weights[i] : -weights[i];
      if (weight.sign() < 0) return static_cast<Side>(i);
      if (!(Ball(0) <= weight)) return kUnclear;
    }
    return kInside;
  }

  static constexpr int kMostSteps = 100;

  const Frame& frame_;
  const Object &a_, &b_;
  const Piece &k_, &l_;
  Vec corner_{};
  BallVec exact_;  // the corner in the world, times `times_`
  const Ball* times_ = nullptr;
  Ball weight_of_middle_;
};

}  // namespace

bool separates(const Frame& frame, const Region& region, const Object& a, const Piece& k,
               const Object& b, const Piece& l) {
  if (separates_by_doubles(frame, region, a, k, b, l)) return true;
  const bool is_swept = k.radius + l.radius > 0;
  const Precision precision(is_swept ? kSweptBits : Ball::bits);
  const auto sweep = [&](const BallVec& n) -> std::optional<Swept<Ball>> {
    if (!is_swept) return std::nullopt;
    Swept<Ball> swept;
    for (const Piece* piece : {&k, &l}) {
      if (piece->radius == 0) continue;
      const BallVec back = piece->turned_back(n);
      const Ball size = sqrt(dot(back, back)), share = Ball(piece->radius) / size;
      swept.height = swept.height + share * dot(back, back);
      swept.at =
          plus(swept.at, piece->turned(BallVec{share * back[0], share * back[1], share * back[2]}));
    }
    return swept;
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

bool contains(const Frame& frame, const Region& region, const Object& a, const Piece& k,
              const Object& b, const Piece& l) {
  Enclosure enclosure(frame, a, k, b, l);
  for (std::size_t i = 0; i < region.corners.size(); ++i) {
    if (!enclosure.holds(region.corners[i], region.exact[i], region.times[i])) return false;
  }
  return true;
}

}  // namespace verify
