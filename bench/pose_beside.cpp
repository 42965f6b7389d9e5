// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "bench/pose_beside.h"

#include <fcl/narrowphase/distance.h>

#include "base/bisection.h"

namespace fcl_prob::cli {

fcl::Transform3d poseBeside(Uniforms& random, const Geometry& a, const TriangleMesh& mesh_b,
                            const Geometry& b, double apart, double farthest, int halvings) {
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.linear() = random.rotation();
  const Eigen::Vector3d middle = a->aabb_local.center();
  const Eigen::Vector3d vertex = mesh_b.vertices[random.below(mesh_b.vertices.size())];
  const Eigen::Vector3d direction = random.rotation().col(0);
  const auto place = [&](double away) {
    pose.translation() = vertex + away * direction - pose.linear() * middle;
  };
  const auto isNear = [&](double away) {
    place(away);
    const fcl::DistanceRequestd request;
    fcl::DistanceResultd result;
    return fcl::distance(a.get(), pose, b.get(), fcl::Transform3d::Identity(), request, result) <
           apart;
  };
  place(detail::bisect({0.0, farthest}, halvings, isNear).fails);
  return pose;
}

}  // namespace fcl_prob::cli
