// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "polytope.h"

#include <algorithm>
#include <numeric>

namespace verify {

// Kuhn's simplices of a box: one for each order of the axes, along which to walk from corner to
// corner.
Polytope::Polytope(int rank, const Vec& lo, const Vec& hi) : rank_(rank) {
  for (int corner = 0; corner < 1 << rank; ++corner) {
    RationalVec vertex;
    for (int i = 0; i < rank; ++i) vertex[i] = corner >> i & 1 ? hi[i] : lo[i];
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
  heights_.assign(vertices_.size(), 0);
  for (const int v : used()) {
    mpq_class height = -mpq_class(plane.level);
    for (int i = 0; i < rank_; ++i) height += mpq_class(plane.normal[i]) * vertices_[v][i];
    heights_[v] = side > 0 ? height : mpq_class(-height);
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
  const mpq_class part = heights_[positive] / (heights_[positive] - heights_[negative]);
  RationalVec vertex;
  for (int i = 0; i < rank_; ++i) {
    const mpq_class& from = vertices_[positive][i];
    const mpq_class& to = vertices_[negative][i];
    vertex[i] = from == to ? from : mpq_class(from + part * (to - from));
  }
  vertices_.push_back(vertex);
  heights_.emplace_back(0);
  return found->second;
}

RationalVec Polytope::center() const {
  RationalVec sum{0, 0, 0};
  const auto which = used();
  for (const int v : which) {
    for (int k = 0; k < rank_; ++k) sum[k] += vertices_[v][k];
  }
  for (mpq_class& x : sum) x /= static_cast<unsigned long>(which.size());
  return sum;
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

}  // namespace verify
