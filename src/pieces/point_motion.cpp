// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "pieces/point_motion.h"

#include <Eigen/Geometry>
#include <cmath>

namespace fcl_prob::detail {

Eigen::Vector3d PointMotion::bound(const Eigen::Matrix3d& whitening,
                                   const Eigen::Vector3d& x) const {
  // A thousand times what the sums below may be rounded by.
  constexpr double kRounding = 1e-12;
  const Eigen::Vector3d lever = x - centre;
  const double size = x.norm() + centre.norm();
  double rounded = remainder * size + ball;
  for (const Eigen::Vector3d& turn : turns) rounded += turn.norm() * size;
  for (const Eigen::Vector3d& shift : shifts) rounded += shift.norm();
  Eigen::Vector3d result;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d row = whitening.row(k);
    double sum = row.norm() * (remainder * lever.norm() + ball + kRounding * rounded);
    for (const Eigen::Vector3d& turn : turns) sum += std::fabs(row.dot(turn.cross(lever)));
    for (const Eigen::Vector3d& shift : shifts) sum += std::fabs(row.dot(shift));
    result[k] = sum * (1.0 + kRounding);
  }
  return result;
}

double PointMotion::reach(double radius) const {
  double sum = ball + remainder * radius;
  for (const Eigen::Vector3d& turn : turns) sum += turn.norm() * radius;
  for (const Eigen::Vector3d& shift : shifts) sum += shift.norm();
  return sum;
}

}  // namespace fcl_prob::detail
