// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "polytope.h"

#include <arb_hypgeom.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace verify {
namespace {

constexpr int kMostNodes = 20;
constexpr double kNegligible = 2e-15;  // the rule's error that is aimed at, of the integral

// Nodes and weights on [0, 1], rounded.
struct Rule {
  std::vector<double> nodes, weights;
};

const Rule& rule(int count) {
  static const std::vector<Rule> rules = [] {
    std::vector<Rule> result(kMostNodes + 1);
    const Precision enough(128);
    for (int n = 2; n <= kMostNodes; ++n) {
      for (int k = 0; k < n; ++k) {
        Ball node, weight;
        arb_hypgeom_legendre_p_ui_root(node.raw(), weight.raw(), n, k, Ball::bits);
        result[n].nodes.push_back(((node + Ball(1)) * Ball(0.5)).nearest());
        result[n].weights.push_back((weight * Ball(0.5)).nearest());
      }
    }
    return result;
  }();
  return rules[count];
}

// e^x for |x| < 700 to a relative error of 2^-49 (1 + |x|): x = k ln 2 + r with |r| < 0.35, whose
// rounding is below 2^-52 (1 + |x|), and 14 terms of the series, of which the rest is below 2^-57.
inline double exponential(double x) {
  constexpr double kToInteger = 0x1.8p52;  // rounds what is added to it, and taken off again
  const double shifted = x * 1.4426950408889634 + kToInteger, k = shifted - kToInteger;
  const double r = (x - k * 0x1.62e42fee00000p-1) - k * 0x1.a39ef35793c76p-33;
  double sum = 1;
  for (const double c : {1 / 13.0, 1 / 12.0, 1 / 11.0, 1 / 10.0, 1 / 9.0, 1 / 8.0, 1 / 7.0, 1 / 6.0,
                         1 / 5.0, 1 / 4.0, 1 / 3.0, 1 / 2.0, 1.0}) {
    sum = sum * (r * c) + 1;
  }
  std::uint64_t bits, shift;
  std::memcpy(&bits, &sum, sizeof bits);
  std::memcpy(&shift, &shifted, sizeof shift);
  bits += shift << 52;  // adds k to the exponent; what kToInteger has above is shifted out
  std::memcpy(&sum, &bits, sizeof sum);
  return sum;
}

// A simplex as seen from the center.
struct Simplex {
  Vec corner[4];
};

class Integral {
 public:
  Integral(int rank, const Vec& center)
      : rank_(rank), center_(center), distance_(std::sqrt(dot(center, center))) {}
  /// The integral of exp(-center · s - |s|²/2) over the simplex, divided by its volume times rank!.
  Ball of(const Simplex& simplex, int depth = 0) const;

 private:
  double log_density(const Vec& s) const { return -dot(center_, s) - 0.5 * dot(s, s); }
  int nodes_needed(const Simplex& simplex, double length) const;
  double quadrature(const Simplex& simplex, int count) const;

  int rank_;
  Vec center_;
  double distance_;
};

// The integrand g(u, v, w) = f(a + u b + u v c + u v w d) u² v is entire in each variable. A rule
// of n nodes integrates polynomials of degree 2 n - 1, and the k-th Chebyshev coefficient on [0, 1]
// of what is bounded by M in the ellipse with half-axes (ρ ± 1/ρ)/4 is at most 2 M ρ^-k, so that
// the rule's error is below 32/15 M ρ^-2n / (1 - ρ^-2) for n >= 2 (Trefethen, Approximation Theory
// and Practice, Theorem 19.3), once for each variable. There |Im s| <= (ρ - 1/ρ)/4 L, where L is
// the length of the longest edge, and Re s is within (ρ + 1/ρ - 2)/4 L of an edge's line in the
// simplex, so that M follows from |exp(-c·s - s·s/2)| = exp(-c·Re s - |Re s|²/2 + |Im s|²/2). The
// logarithms need not be better than 1e-6.
int Integral::nodes_needed(const Simplex& simplex, double length) const {
  double linear = -DBL_MAX, least = DBL_MAX;  // of -c·s, and of the logarithm, which is concave
  for (int i = 0; i <= rank_; ++i) {
    linear = std::max(linear, -dot(center_, simplex.corner[i]));
    least = std::min(least, log_density(simplex.corner[i]));
  }
  int best = kMostNodes + 1;
  for (const double rho : {2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 16.0, 24.0, 32.0, 48.0, 64.0, 100.0}) {
    const double imaginary = (rho - 1 / rho) / 4 * length;
    const double beyond = (rho + 1 / rho - 2) / 4 * length;
    double log_bound = linear + distance_ * beyond + 0.5 * imaginary * imaginary - least;
    log_bound += 3 * std::log((rho + 1 / rho + 2) / 4);                // |u² v|
    log_bound += std::log(6 * 3 * 32 / 15.0 / (1 - 1 / (rho * rho)));  // of ∫ u² v = 1/6
    const double count = (log_bound + 1e-3 - std::log(kNegligible)) / (2 * std::log(rho));
    best = std::min(best, std::max(2, static_cast<int>(std::ceil(std::min(count, 1e3)))));
  }
  return best;
}

double Integral::quadrature(const Simplex& simplex, int count) const {
  const Rule& r = rule(count);
  const Vec* v = simplex.corner;
  const Vec e1 = minus(v[1], v[0]), e2 = minus(v[2], v[1]);
  const Vec e3 = rank_ == 3 ? minus(v[3], v[2]) : Vec{};
  double total = 0;
  for (int i = 0; i < count; ++i) {
    double middle = 0;
    for (int j = 0; j < count; ++j) {
      const double first = r.nodes[i], second = first * r.nodes[j];
      Vec s;
      for (int k = 0; k < 3; ++k) s[k] = v[0][k] + first * e1[k] + second * e2[k];
      if (rank_ == 2) {
        middle += r.weights[j] * exponential(log_density(s));
        continue;
      }
      double inner = 0;
      for (int l = 0; l < count; ++l) {
        const double third = second * r.nodes[l];
        const Vec at{s[0] + third * e3[0], s[1] + third * e3[1], s[2] + third * e3[2]};
        inner += r.weights[l] * exponential(log_density(at));
      }
      middle += r.weights[j] * second * inner;
    }
    total += r.weights[i] * r.nodes[i] * middle;
  }
  return total;
}

Ball Integral::of(const Simplex& simplex, int depth) const {
  double length = 0, size = 0;
  int from = 0, to = 1;
  for (int i = 0; i <= rank_; ++i) {
    size = std::max(size, std::sqrt(dot(simplex.corner[i], simplex.corner[i])));
    for (int j = 0; j < i; ++j) {
      const Vec edge = minus(simplex.corner[i], simplex.corner[j]);
      const double here = std::sqrt(dot(edge, edge)) * (1 + 1e-14);
      if (here > length) from = i, to = j;
      length = std::max(length, here);
    }
  }
  const int count = nodes_needed(simplex, length);
  if (count > kMostNodes) {
    Simplex one = simplex, other = simplex;
    for (int k = 0; k < 3; ++k) {
      const double middle = 0.5 * (simplex.corner[from][k] + simplex.corner[to][k]);
      one.corner[from][k] = other.corner[to][k] = middle;
    }
    return (of(one, depth + 1) + of(other, depth + 1)) * Ball(0.5);
  }
  // Corners are off by (depth + 2) kUnit of their size, points by some 16 more, and the logarithm
  // of the density by their product with its slope and by its own rounding; e^x as said there; sums
  // of positive terms by one kUnit a term in each of the three loops, weights and nodes by a few.
  const double slope = distance_ + size;
  const double rounding =
      kUnit * (size * slope * (depth + 48) + 16 * (1 + size * slope) + 3.0 * count + 40);
  const double sum = quadrature(simplex, count);
  Ball result(sum);
  arb_add_error(result.raw(), Ball(sum * (kNegligible + rounding) * (1 + 1e-10)).raw());
  return result;
}

Ball gaussian_constant(int rank) {
  Ball result(1), pi;
  arb_const_pi(pi.raw(), Ball::bits);
  pi = sqrt(pi * Ball(2));
  for (int i = 0; i < rank; ++i) result = result / pi;
  return result;
}

// Of [x, ∞), x >= 0.
Ball upper_tail(const Ball& x) {
  Ball result;
  arb_hypgeom_erfc(result.raw(), (x / sqrt(Ball(2))).raw(), Ball::bits);
  return result * Ball(0.5);
}

// Of what is between a and b, whichever is less, on one side of 0 or not.
Ball segment_mass(const Ball& a, const Ball& b) {
  Ball result;
  if (a.sign() * b.sign() >= 0) {
    result = upper_tail(abs(a)) - upper_tail(abs(b));
  } else {
    result = Ball(1) - upper_tail(abs(a)) - upper_tail(abs(b));
  }
  return abs(result);
}

// The volume of a simplex times rank!.
Ball volume(const std::vector<BallVec>& points, const Polytope::Simplex& simplex, int rank) {
  BallVec e[3];
  for (int i = 0; i < 3; ++i) {
    if (i < rank) {
      e[i] = minus(points[simplex[i + 1]], points[simplex[0]]);
    } else {
      e[i][i] = Ball(1);
    }
  }
  return abs(dot(e[0], cross(e[1], e[2])));
}

// A polytope that is not too large for the density to vary much in it.
Ball small_polytope(const Polytope& polytope, const Vec& center) {
  const std::size_t count = polytope.vertices().size();
  std::vector<BallVec> points(count);
  std::vector<Vec> seen(count);
  for (const int v : polytope.used()) {
    points[v] = minus(ball(polytope.vertices()[v]), balls(center));
    for (int k = 0; k < polytope.rank(); ++k) seen[v][k] = points[v][k].nearest();
  }
  const Integral integral(polytope.rank(), center);
  Ball sum, norm, scale;
  for (const auto& s : polytope.simplices()) {
    Simplex simplex{};
    for (int i = 0; i <= polytope.rank(); ++i) simplex.corner[i] = seen[s[i]];
    sum = sum + volume(points, s, polytope.rank()) * integral.of(simplex);
  }
  for (const double c : center) norm = norm + Ball(c) * Ball(c);
  arb_exp(scale.raw(), (norm * Ball(-0.5)).raw(), Ball::bits);
  return sum * scale * gaussian_constant(polytope.rank());
}

// The least and the largest coordinates of the polytope, which is not empty.
std::pair<BallVec, BallVec> extent(const Polytope& polytope) {
  std::pair<BallVec, BallVec> result;
  bool first = true;
  for (const int v : polytope.used()) {
    const BallVec point = ball(polytope.vertices()[v]);
    for (int i = 0; i < 3; ++i) {
      result.first[i] = first ? point[i] : min(result.first[i], point[i]);
      result.second[i] = first ? point[i] : max(result.second[i], point[i]);
    }
    first = false;
  }
  return result;
}

}  // namespace

const Ball& Masses::above(double x) {
  const auto [found, is_new] = above_.try_emplace(x);
  if (is_new) found->second = upper_tail(Ball(x));
  return found->second;
}

Ball Masses::interval(double lo, double hi) {
  if (lo >= 0) return above(lo) - above(hi);
  if (hi <= 0) return above(-hi) - above(-lo);
  return Ball(1) - above(-lo) - above(hi);
}

Ball Masses::box(int rank, const Vec& lo, const Vec& hi) {
  const Precision precision(bits_);
  Ball result(1);
  for (int i = 0; i < rank; ++i) result = result * interval(lo[i], hi[i]);
  return result;
}

// Halves what is large, the half nearer to the origin first: beside it the other one may be
// negligible.
void Masses::add_polytope(const Polytope& polytope, Vec lo, Vec hi, Ball& sum) {
  if (polytope.empty()) return;
  const auto [least, most] = extent(polytope);
  Vec center{}, half{};
  int longest = 0;
  for (int i = 0; i < polytope.rank(); ++i) {
    lo[i] = std::max(lo[i], least[i].outward(-1));
    hi[i] = std::min(hi[i], most[i].outward(1));
    center[i] = 0.5 * (lo[i] + hi[i]);
    half[i] = 0.5 * (hi[i] - lo[i]);
    if (half[i] > half[longest]) longest = i;
  }
  const double size = std::sqrt(dot(half, half));
  if (size * (size + std::sqrt(dot(center, center))) < 20) {
    sum = sum + small_polytope(polytope, center);
    return;
  }
  const Ball bound = box(polytope.rank(), lo, hi);
  if (bound <= sum * Ball(1e-17)) {
    arb_add_error(sum.raw(), bound.raw());
    return;
  }
  Plane middle;
  middle.normal[longest] = 1;
  middle.level = center[longest];
  for (const int side : {center[longest] > 0 ? -1 : 1, center[longest] > 0 ? 1 : -1}) {
    Polytope part = polytope;
    part.cut(middle, side);
    Vec low = lo, high = hi;
    (side > 0 ? low : high)[longest] = middle.level;
    add_polytope(part, low, high, sum);
  }
}

Ball Masses::polytope(const Polytope& polytope, const Vec& lo, const Vec& hi) {
  const Precision precision(256);
  Ball result;
  if (polytope.empty()) return result;
  if (!polytope.is_box()) {
    add_polytope(polytope, lo, hi, result);
    return result;
  }
  const auto [least, most] = extent(polytope);
  result = Ball(1);
  for (int i = 0; i < polytope.rank(); ++i) result = result * segment_mass(least[i], most[i]);
  return result;
}

}  // namespace verify
