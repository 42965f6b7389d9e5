// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/body_bounds.h"

#include <algorithm>

#include "bounds/convex_bound.h"
#include "geometry/occupancy.h"
#include "robot/sum_above.h"

namespace fcl_prob::detail {

BodyBounds::BodyBounds(const PreparedGeometries& geometries, const std::vector<PlacedBody>& bodies,
                       const PreparedGeometry& obstacle, const fcl::Transform3d& pose,
                       const GaussianDisplacement& of_bodies) {
  for (const PlacedBody& body : bodies) {
    const PreparedGeometry& geometry = *geometries[body.body];
    if (whyNeverInContact(geometry.geometry(), obstacle.geometry())) continue;
    double upper = 1.0;
    if (geometry.hasRootBody() && obstacle.hasRootBody()) {
      upper = halfSpaceUpper(geometry.hull(), body.pose, obstacle.hull(), pose, of_bodies);
    }
    bounds_.push_back({body, std::min(1.0, upper)});
  }
  std::stable_sort(bounds_.begin(), bounds_.end(),
                   [](const Bound& x, const Bound& y) { return x.upper > y.upper; });
}

double BodyBounds::sum() const {
  double sum = 0.0;
  for (const Bound& bound : bounds_) sum = sumAbove(sum, bound.upper);
  return std::min(1.0, sum);
}

std::vector<PlacedBody> BodyBounds::likelier(double most, double& left_out) const {
  left_out = 0.0;
  std::size_t count = bounds_.size();
  for (; count > 0; --count) {
    const double sum = sumAbove(left_out, bounds_[count - 1].upper);
    if (sum > most) break;
    left_out = sum;
  }
  std::vector<PlacedBody> bodies;
  for (std::size_t i = 0; i < count; ++i) bodies.push_back(bounds_[i].body);
  return bodies;
}

}  // namespace fcl_prob::detail
