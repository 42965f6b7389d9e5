// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "mass/exact_hull.h"

#include <algorithm>
#include <cmath>

namespace fcl_prob::detail {
namespace {

using Points = std::vector<Eigen::Vector2d>;

/// a d - b c to within 2 units in its last place, so that its sign is never wrong (Jeannerod,
/// Louvet and Muller 2013, on Kahan's algorithm).
double differenceOfProducts(double a, double d, double b, double c) {
  const double product = b * c;
  const double rounding = std::fma(-b, c, product);
  return std::fma(a, d, -product) + rounding;
}

/// Appends the chain from the first to the last of the points but for the last, with the rest to
/// its left (Andrew 1979).
template <typename Iterator>
void appendChain(Iterator begin, Iterator end, Points& hull) {
  const std::size_t start = hull.size();
  for (Iterator it = begin; it != end; ++it) {
    while (hull.size() >= start + 2 && !turnsLeft(hull[hull.size() - 2], hull.back(), *it)) {
      hull.pop_back();
    }
    hull.push_back(*it);
  }
  hull.pop_back();
}

}  // namespace

bool turnsLeft(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const Eigen::Vector2d u = b - a;
  const Eigen::Vector2d v = c - a;
  return differenceOfProducts(u.x(), v.y(), u.y(), v.x()) > 0.0;
}

std::vector<Eigen::Vector2d> exactHull(std::vector<Eigen::Vector2d> points) {
  std::sort(points.begin(), points.end(), [](const Eigen::Vector2d& p, const Eigen::Vector2d& q) {
    return p.x() < q.x() || (p.x() == q.x() && p.y() < q.y());
  });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 2) return points;
  Points hull;
  appendChain(points.begin(), points.end(), hull);
  appendChain(points.rbegin(), points.rend(), hull);
  return hull;
}

}  // namespace fcl_prob::detail
