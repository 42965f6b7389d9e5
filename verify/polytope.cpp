// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "polytope.h"

#include <algorithm>
#include <cmath>

namespace verify {
namespace {

// Doubles times the smallest power of two that makes all of them integers, which comes last.
std::vector<mpz_class> integers(const std::vector<double>& values) {
  std::vector<mpz_class> result;
  std::vector<int> exponents;
  int least = 0;
  for (const double value : values) {
    int exponent = 0;
    const double mantissa = std::frexp(value, &exponent);
    result.emplace_back(std::ldexp(mantissa, 53));
    exponents.push_back(value == 0 ? 0 : exponent - 53);
    if (value != 0) {
      const auto zeros = mpz_scan1(result.back().get_mpz_t(), 0);
      least = std::min(least, exponents.back() + static_cast<int>(zeros));
    }
  }
  for (std::size_t i = 0; i < result.size(); ++i) {
    const int shift = exponents[i] - least;
    if (shift >= 0) {
      result[i] <<= shift;
    } else {
      result[i] >>= -shift;
    }
  }
  result.push_back(mpz_class(1) << -least);
  return result;
}

// Keeps numbers short.
void reduce(ExactPoint& point) {
  mpz_class common = point.w;
  for (const mpz_class& x : point.x) common = gcd(common, x);
  if (common == 1) return;
  for (mpz_class& x : point.x) mpz_divexact(x.get_mpz_t(), x.get_mpz_t(), common.get_mpz_t());
  mpz_divexact(point.w.get_mpz_t(), point.w.get_mpz_t(), common.get_mpz_t());
}

}  // namespace

BallVec ExactPoint::ball() const {
  const Precision enough(std::min<slong>(Ball::bits, 512));
  const Ball times(w);
  return {Ball(x[0]) / times, Ball(x[1]) / times, Ball(x[2]) / times};
}

// Kuhn's simplices of a box: one for each order of the axes, along which to walk from corner to
// corner.
Polytope::Polytope(int rank, const Vec& lo, const Vec& hi) : rank_(rank) {
  for (int corner = 0; corner < 1 << rank; ++corner) {
    std::vector<double> sides;
    for (int i = 0; i < rank; ++i) sides.push_back((corner >> i & 1) != 0 ? hi[i] : lo[i]);
    const auto exact = integers(sides);
    ExactPoint vertex;
    std::copy(exact.begin(), exact.end() - 1, vertex.x.begin());
    vertex.w = exact.back();
    vertices_.push_back(vertex);
  }
  std::array<int, 3> order{0, 1, 2};
  do {
    Simplex simplex{};
    for (int i = 0; i < rank; ++i) simplex[i + 1] = simplex[i] | 1 << order[i];
    simplices_.push_back(simplex);
  } while (std::next_permutation(order.begin(), order.begin() + rank));
}

void Polytope::cut(const Plane& plane, int side) {
  crossings_.clear();
  normals_.push_back(plane.normal);
  is_box_ = is_box_ && std::count(plane.normal.begin(), plane.normal.end(), 0.0) >= 2;
  heights_.assign(vertices_.size(), 0);
  const auto exact = integers({plane.normal[0], plane.normal[1], plane.normal[2], plane.level});
  for (const int v : used()) {
    mpz_class& height = heights_[v];
    height = -exact[3] * vertices_[v].w;
    for (int i = 0; i < rank_; ++i) height += exact[i] * vertices_[v].x[i];
    if (side < 0) height = -height;
  }
  std::vector<Simplex> kept;
  for (const Simplex& simplex : simplices_) keep_positive(simplex, kept);
  simplices_ = std::move(kept);
}

// Cuts edges that cross the plane in two, and the simplex with them, until none does.
void Polytope::keep_positive(Simplex simplex, std::vector<Simplex>& kept) {
  int positive = -1, negative = -1;
  for (int i = 0; i <= rank_; ++i) {
    const int sign = sgn(heights_[simplex[i]]);
    if (sign > 0) positive = i;
    if (sign < 0) negative = i;
  }
  if (positive < 0) return;
  if (negative < 0) {
    kept.push_back(simplex);
    return;
  }
  const int between = crossing(simplex[positive], simplex[negative]);
  Simplex other = simplex;
  simplex[negative] = between;
  other[positive] = between;
  keep_positive(simplex, kept);
  keep_positive(other, kept);
}

int Polytope::crossing(int positive, int negative) {
  const auto [found, is_new] =
      crossings_.try_emplace({positive, negative}, static_cast<int>(vertices_.size()));
  if (!is_new) return found->second;
  const ExactPoint &from = vertices_[positive], &to = vertices_[negative];
  const mpz_class &above = heights_[positive], &below = heights_[negative];
  ExactPoint vertex;
  for (int i = 0; i < rank_; ++i) vertex.x[i] = above * to.x[i] - below * from.x[i];
  vertex.w = above * to.w - below * from.w;
  reduce(vertex);
  vertices_.push_back(vertex);
  heights_.emplace_back(0);
  return found->second;
}

std::vector<int> Polytope::used() const {
  std::vector<int> result;
  for (const Simplex& simplex : simplices_) {
    result.insert(result.end(), simplex.begin(), simplex.begin() + rank_ + 1);
  }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

Region::Region(const Polytope& polytope) : normals(polytope.normals()) {
  for (const int v : polytope.used()) {
    const ExactPoint& corner = polytope.vertices()[v];
    exact.push_back({Ball(corner.x[0]), Ball(corner.x[1]), Ball(corner.x[2])});
    times.emplace_back(corner.w);
    const BallVec point = corner.ball();
    center = plus(center, point);
    corners.push_back({point[0].nearest(), point[1].nearest(), point[2].nearest()});
    for (int i = 0; i < 3; ++i) bound[i] = std::max(bound[i], std::abs(corners.back()[i]));
  }
  for (Ball& x : center) x = x / Ball(static_cast<double>(corners.size()));
}

}  // namespace verify
