// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "bench/fcl_loop.h"

#include <fcl/narrowphase/collision.h>

#include "base/stopwatch.h"
#include "cli/random_displacement.h"

namespace fcl_prob::cli {
namespace {

std::vector<fcl::Transform3d> drawPoses(const PreparedScene& scene, std::size_t samples,
                                        std::uint64_t seed) {
  const Whitening whitening(scene.displacement());
  std::vector<fcl::Transform3d> poses(samples, scene.objectA().pose);
  for (std::size_t i = 0; i < samples; ++i) {
    poses[i].pretranslate(randomDisplacement(whitening, seed, i));
  }
  return poses;
}

}  // namespace

FclLoop timeFclLoop(const PreparedScene& scene, std::size_t samples, std::uint64_t seed) {
  constexpr int kLoops = 3;
  const Geometry a = buildGeometry(scene.objectA(), "obbrss");
  const Geometry b = buildGeometry(scene.objectB(), "obbrss");
  const std::vector<fcl::Transform3d> poses = drawPoses(scene, samples, seed);
  const fcl::Transform3d& pose_b = scene.objectB().pose;
  const fcl::CollisionRequestd request;

  FclLoop best;
  for (int loop = 0; loop < kLoops; ++loop) {
    FclLoop now{samples, 0, 0.0};
    const detail::Stopwatch watch;
    for (const fcl::Transform3d& pose_a : poses) {
      fcl::CollisionResultd result;
      if (fcl::collide(a.get(), pose_a, b.get(), pose_b, request, result) > 0) ++now.hits;
    }
    now.time_ms = watch.milliseconds();
    if (loop == 0 || now.time_ms < best.time_ms) best = now;
  }
  return best;
}

}  // namespace fcl_prob::cli
