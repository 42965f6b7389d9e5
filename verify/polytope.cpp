// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "polytope.h"

#include <algorithm>
#include <cmath>

namespace verify {
BallVec ball(const ExactPoint& point) {
  const Precision enough(std::min<slong>(Ball::bits, 320));
  BallVec result;
  for (int i = 0; i < 3; ++i) result[i] = Ball(point[i].get_num()) / Ball(point[i].get_den());
  return result;
}

// Kuhn's simplices of a box: one for each order of the axes, along which to walk from corner to
// corner.
Polytope::Polytope(int rank, const Vec& lo, const Vec& hi) : rank_(rank) {
  for (int corner = 0; corner < 1 << rank; ++corner) {
    ExactPoint vertex;
    for (int i = 0; i < rank; ++i) vertex[i] = (corner >> i & 1) != 0 ? hi[i] : lo[i];
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
  for (const int v : used()) {
    heights_[v] = -plane.level;
    for (int i = 0; i < rank_; ++i) heights_[v] += plane.normal[i] * vertices_[v][i];
    if (side < 0) heights_[v] = -heights_[v];
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
  const mpq_class part = heights_[positive] / (heights_[positive] - heights_[negative]);
  ExactPoint vertex;
  for (int i = 0; i < rank_; ++i) vertex[i] = from[i] + part * (to[i] - from[i]);
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
    const mpz_class common =
        lcm(lcm(corner[0].get_den(), corner[1].get_den()), corner[2].get_den());
    exact.emplace_back();
    for (int i = 0; i < 3; ++i) {
      exact.back()[i] = Ball(mpz_class(corner[i].get_num() * (common / corner[i].get_den())));
    }
    times.emplace_back(common);
    const BallVec point = ball(corner);
    center = plus(center, point);
    corners.push_back({point[0].nearest(), point[1].nearest(), point[2].nearest()});
    for (int i = 0; i < 3; ++i) bound[i] = std::max(bound[i], std::abs(corners.back()[i]));
  }
  for (Ball& x : center) x = x / Ball(static_cast<double>(corners.size()));
}

}  // namespace verify
