// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/kdop26.h"

#include <algorithm>

#include "convex/slab_polytope.h"

namespace fcl_prob {

Kdop26::Kdop26() {
  lower_.fill(std::numeric_limits<double>::infinity());
  upper_.fill(-std::numeric_limits<double>::infinity());
}

const Eigen::Vector3d& Kdop26::direction(int k) { return detail::dopDirections()[k]; }

Kdop26& Kdop26::operator+=(const Eigen::Vector3d& point) {
  for (int k = 0; k < kSlabs; ++k) {
    const double height = direction(k).dot(point);
    lower_[k] = std::min(lower_[k], height);
    upper_[k] = std::max(upper_[k], height);
  }
  return *this;
}

Kdop26& Kdop26::operator+=(const Kdop26& other) {
  for (int k = 0; k < kSlabs; ++k) {
    lower_[k] = std::min(lower_[k], other.lower_[k]);
    upper_[k] = std::max(upper_[k], other.upper_[k]);
  }
  return *this;
}

Kdop26 Kdop26::operator+(const Kdop26& other) const {
  Kdop26 sum = *this;
  return sum += other;
}

bool Kdop26::overlap(const Kdop26& other) const {
  for (int k = 0; k < kSlabs; ++k) {
    if (lower_[k] > other.upper_[k] || other.lower_[k] > upper_[k]) return false;
  }
  return true;
}

bool Kdop26::contain(const Eigen::Vector3d& point) const {
  for (int k = 0; k < kSlabs; ++k) {
    const double height = direction(k).dot(point);
    if (height < lower_[k] || height > upper_[k]) return false;
  }
  return true;
}

Eigen::Vector3d Kdop26::center() const {
  return 0.5 * Eigen::Vector3d(lower_[0] + upper_[0], lower_[1] + upper_[1], lower_[2] + upper_[2]);
}

}  // namespace fcl_prob
