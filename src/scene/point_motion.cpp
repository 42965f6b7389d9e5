// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene/point_motion.h"

#include <Eigen/Geometry>
#include <cmath>

namespace fcl_prob::detail {

double PointMotion::along(const Eigen::Vector3d& n, const Eigen::Vector3d& x) const {
  // A thousand times what the sums below may be rounded by.
  constexpr double kRounding = 1e-12;
  const Eigen::Vector3d lever = x - centre;
  const double size = x.norm() + centre.norm();
  double rounded = remainder * size + ball;
  double sum = 0.0;
  for (const Eigen::Vector3d& turn : turns) {
    rounded += turn.norm() * size;
    sum += std::fabs(n.dot(turn.cross(lever)));
  }
  for (const Eigen::Vector3d& shift : shifts) {
    rounded += shift.norm();
    sum += std::fabs(n.dot(shift));
  }
  return (sum + n.norm() * (remainder * lever.norm() + ball + kRounding * rounded)) *
         (1.0 + kRounding);
}

Eigen::Vector3d PointMotion::bound(const Eigen::Matrix3d& whitening,
                                   const Eigen::Vector3d& x) const {
  Eigen::Vector3d result;
  for (int k = 0; k < 3; ++k) result[k] = along(whitening.row(k).transpose(), x);
  return result;
}

double PointMotion::reach(double radius) const {
  double sum = ball + remainder * radius;
  for (const Eigen::Vector3d& turn : turns) sum += turn.norm() * radius;
  for (const Eigen::Vector3d& shift : shifts) sum += shift.norm();
  return sum;
}

}  // namespace fcl_prob::detail
