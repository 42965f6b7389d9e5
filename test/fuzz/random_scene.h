// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Small scenes out of a fuzzer's bytes, many of them touching, coplanar, flat or far away.
#pragma once

#include <fcl/geometry/collision_geometry.h>
#include <fuzzer/FuzzedDataProvider.h>

#include <memory>

#include "fcl_prob/gaussian_displacement.h"
#include "fcl_prob/probability_request.h"

namespace fcl_prob_fuzz {

using Geometry = std::shared_ptr<const fcl::CollisionGeometryd>;

/// Everything that one query of a pair is asked.
struct PairScene {
  Geometry a;
  fcl::Transform3d pose_a;
  Geometry b;
  fcl::Transform3d pose_b;
  fcl_prob::GaussianDisplacement displacement;
  fcl_prob::ProbabilityRequest request;
};

/// At most eight triangles in a mesh, and limits that keep a query below some milliseconds.
/// \throws fcl_prob::InvalidGeometry if the bytes are no geometry
PairScene sceneFrom(FuzzedDataProvider& input);

}  // namespace fcl_prob_fuzz
