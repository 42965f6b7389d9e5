// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/urdf_values.h"

#include <cmath>

#include "base/number_text.h"
#include "fcl_prob/exceptions.h"

namespace fcl_prob::detail {

Eigen::Vector3d vectorOf(const urdf::Vector3& vector, const std::string& where) {
  const Eigen::Vector3d result(vector.x, vector.y, vector.z);
  if (!result.allFinite()) {
    throw FileError(where + ": (" + numberText(vector.x) + ", " + numberText(vector.y) + ", " +
                    numberText(vector.z) + ") is not finite");
  }
  return result;
}

fcl::Transform3d poseOf(const urdf::Pose& pose, const std::string& where) {
  const urdf::Rotation& q = pose.rotation;
  const Eigen::Quaterniond rotation(q.w, q.x, q.y, q.z);
  if (!(std::fabs(rotation.norm() - 1.0) < 1e-6)) {
    throw FileError(where + ": angles of the origin are not finite");
  }
  fcl::Transform3d result = fcl::Transform3d::Identity();
  result.linear() = rotation.normalized().toRotationMatrix();
  result.translation() = vectorOf(pose.position, where + ": origin");
  return result;
}

double positive(double size, const std::string& where) {
  if (!(size > 0.0 && std::isfinite(size))) {
    throw FileError(where + " must be finite and > 0, is " + numberText(size));
  }
  return size;
}

}  // namespace fcl_prob::detail
