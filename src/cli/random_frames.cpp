// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/random_frames.h"

#include <Eigen/Geometry>

#include "base/random_words.h"

namespace fcl_prob::cli {

Eigen::Matrix3d randomRotation(std::uint64_t seed, std::uint64_t index) {
  // Four normals have no preferred direction in the space of quaternions.
  const Eigen::Vector3d first = detail::standardNormalFrom(detail::randomWords({seed}, index, 0));
  const Eigen::Vector3d second = detail::standardNormalFrom(detail::randomWords({seed}, index, 1));
  return Eigen::Quaterniond(second.x(), first.x(), first.y(), first.z())
      .normalized()
      .toRotationMatrix();
}

Eigen::Vector3d randomDisplacement(const Whitening& whitening, std::uint64_t seed,
                                   std::uint64_t index) {
  Eigen::Vector3d y = detail::standardNormalFrom(detail::randomWords({seed}, index));
  y.tail(3 - whitening.rank()).setZero();
  return whitening.unapply(y);
}

TriangleMesh rotated(TriangleMesh mesh, const Eigen::Matrix3d& rotation) {
  for (fcl::Vector3d& vertex : mesh.vertices) vertex = rotation * vertex;
  return mesh;
}

}  // namespace fcl_prob::cli
