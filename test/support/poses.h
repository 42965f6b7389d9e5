// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Poses that tests name often.
#pragma once

#include <fcl/common/types.h>

#include <Eigen/Geometry>

namespace fcl_prob_test {

inline const fcl::Transform3d kIdentity = fcl::Transform3d::Identity();

/// Not turned.
inline fcl::Transform3d at(const Eigen::Vector3d& position) {
  return fcl::Transform3d(Eigen::Translation3d(position));
}

inline fcl::Transform3d at(double x, double y, double z) { return at({x, y, z}); }

}  // namespace fcl_prob_test
