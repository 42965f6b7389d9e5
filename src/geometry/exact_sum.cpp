// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "geometry/exact_sum.h"

#include <cmath>

namespace fcl_prob::detail {

void ExactSum::add(double x) {
  int kept = 0;
  for (int i = 0; i < count_; ++i) {
    const double part = parts_[i];
    const double sum = x + part;
    const double of_part = sum - x;
    const double lost = (x - (sum - of_part)) + (part - of_part);
    if (lost != 0.0) parts_[kept++] = lost;
    x = sum;
  }
  if (x != 0.0) parts_[kept++] = x;
  count_ = kept;
}

void ExactSum::addProduct(double x, double y) {
  const double product = x * y;
  add(product);
  add(std::fma(x, y, -product));
}

long double ExactSum::value() const {
  long double sum = 0.0L;
  for (int i = 0; i < count_; ++i) sum += static_cast<long double>(parts_[i]);
  return sum;
}

void ExactPosition::add(const Eigen::Vector3d& v, double sign) {
  for (int k = 0; k < 3; ++k) sums_[k].add(sign * v[k]);
}

void ExactPosition::add(const fcl::Transform3d& pose, const Eigen::Vector3d& point, double sign) {
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < 3; ++j) sums_[k].addProduct(sign * pose.linear()(k, j), point[j]);
  }
  add(pose.translation(), sign);
}

LongVector ExactPosition::value() const {
  return {sums_[0].value(), sums_[1].value(), sums_[2].value()};
}

}  // namespace fcl_prob::detail
