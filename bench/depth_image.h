// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What a depth sensor would see of a mesh, with its noise.
#pragma once

#include "bench/uniforms.h"
#include "fcl_prob/point_cloud.h"
#include "fcl_prob/sensor_model.h"
#include "fcl_prob/triangle_mesh.h"

namespace fcl_prob::cli {

struct DepthCamera {
  int width = 640;
  int height = 480;
  double focal_length = 525.0;  ///< pixels
};

/// The depth image of a mesh (sensor frame: at the origin, looking along z) as an organised cloud.
/// Every pixel looks along a ray that is off by the lateral noise, and its depth by the axial one.
PointCloud renderedCloud(const TriangleMesh& mesh, const DepthCamera& camera,
                         const SensorModel& sensor, Uniforms& random);

}  // namespace fcl_prob::cli
