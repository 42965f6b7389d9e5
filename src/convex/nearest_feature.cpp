// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "convex/nearest_feature.h"

#include <Eigen/Geometry>

#include "base/constants.h"

namespace fcl_prob::detail {

namespace {

constexpr int kMostGilbertSteps = 32;

// Relative to the distance: no point is nearer than that.
constexpr double kGilbertTolerance = 1e-12;

// Of two features that are as near as each other the smaller one is taken.
constexpr double kNearer = 1.0 - 1e-12;

using FeaturePoints = std::vector<Eigen::Vector3d>;

// The point of an edge's line or a face's plane nearest to `from`, if it is in its inside.
bool footIn(const FeaturePoints& points, const std::array<int, 3>& feature, int count,
            const Eigen::Vector3d& from, Eigen::Vector3d& foot) {
  const Eigen::Vector3d& corner = points[feature[0]];
  if (count == 1) {
    foot = corner;
    return true;
  }
  const Eigen::Vector3d off = from - corner;
  const Eigen::Vector3d p = points[feature[1]] - corner;
  if (count == 2) {
    const double share = p.dot(off) / p.squaredNorm();
    foot = corner + share * p;
    return share > 0.0 && share < 1.0;
  }
  const Eigen::Vector3d q = points[feature[2]] - corner;
  const Eigen::Vector3d normal = p.cross(q);
  const double area = normal.squaredNorm();
  const double of_p = off.cross(q).dot(normal) / area;
  const double of_q = p.cross(off).dot(normal) / area;
  foot = corner + of_p * p + of_q * q;
  return of_p > 0.0 && of_q > 0.0 && of_p + of_q < 1.0;
}

// The nearest feature of a simplex of up to four points.
void nearestOfSimplex(const FeaturePoints& points, const std::array<int, 4>& simplex, int size,
                      const Eigen::Vector3d& from, NearestFeature& best) {
  double nearest = kInfinity;
  for (int count = 1; count <= 3; ++count) {
    for (int subset = 1; subset < 1 << size; ++subset) {
      std::array<int, 3> feature{};
      int members = 0;
      for (int i = 0; i < size; ++i) {
        if (!(subset >> i & 1)) continue;
        if (members < 3) feature[members] = simplex[i];
        ++members;
      }
      Eigen::Vector3d foot;
      if (members != count || !footIn(points, feature, count, from, foot)) continue;
      const double distance = (from - foot).norm();
      if (!(distance < nearest * kNearer)) continue;
      nearest = distance;
      best = {feature, count, foot, distance};
    }
  }
}

}  // namespace

NearestFeature nearestFeature(const FeaturePoints& points, const Eigen::Vector3d& from) {
  NearestFeature best{{0, 0, 0}, 1, points[0], (from - points[0]).norm()};
  for (int step = 0; step < kMostGilbertSteps; ++step) {
    const Eigen::Vector3d towards = from - best.nearest;
    int farthest = 0;
    double height = -kInfinity;
    for (int i = 0; i < static_cast<int>(points.size()); ++i) {
      const double along = towards.dot(points[i] - best.nearest);
      if (along <= height) continue;
      height = along;
      farthest = i;
    }
    if (height <= kGilbertTolerance * towards.squaredNorm()) break;
    std::array<int, 4> simplex{best.points[0], best.points[1], best.points[2], 0};
    simplex[best.count] = farthest;
    const double before = best.distance;
    nearestOfSimplex(points, simplex, best.count + 1, from, best);
    if (!(best.distance < before * kNearer)) break;
  }
  return best;
}

}  // namespace fcl_prob::detail
