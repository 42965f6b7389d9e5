// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "convex/flat_hull.h"

#include <algorithm>
#include <numeric>

namespace fcl_prob::detail {
namespace {

using PlanePoints = std::vector<Eigen::Vector2d>;

double turn(const PlanePoints& plane, int a, int b, int c) {
  const Eigen::Vector2d first = plane[b] - plane[a];
  const Eigen::Vector2d second = plane[c] - plane[b];
  return first.x() * second.y() - first.y() * second.x();
}

// One half of Andrew's monotone chain, over indices in the given order.
template <class Iterator>
void appendChain(const PlanePoints& plane, Iterator begin, Iterator end, std::vector<int>& hull) {
  const std::size_t start = hull.size();
  for (Iterator it = begin; it != end; ++it) {
    while (hull.size() >= start + 2 && turn(plane, hull[hull.size() - 2], hull.back(), *it) <= 0) {
      hull.pop_back();
    }
    hull.push_back(*it);
  }
  hull.pop_back();  // the first of the other half
}

}  // namespace

std::vector<int> flatHull(const std::vector<Eigen::Vector3d>& points, const SpanningFrame& frame) {
  if (frame.dimension == 0) return {0};
  PlanePoints plane;
  plane.reserve(points.size());
  for (const Eigen::Vector3d& point : points) {
    plane.push_back(frame.coordinates(point).head<2>());
  }
  const auto before = [&](int a, int b) {
    return plane[a].x() != plane[b].x() ? plane[a].x() < plane[b].x() : plane[a].y() < plane[b].y();
  };
  std::vector<int> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), before);
  const auto same = [&](int a, int b) { return plane[a] == plane[b]; };
  order.erase(std::unique(order.begin(), order.end(), same), order.end());
  if (order.size() < 2) return {0};

  std::vector<int> hull;
  appendChain(plane, order.begin(), order.end(), hull);
  appendChain(plane, order.rbegin(), order.rend(), hull);
  return hull;
}

}  // namespace fcl_prob::detail
