// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "benchmark_scenes.h"

#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/distance.h>

#include "catch.h"
#include "obj_file.h"

namespace {

using namespace fcl_prob_test;

TEST_CASE("the benchmark scenes have the distance they are named after") {
  for (const std::string& name : benchmarkSceneNames()) {
    const std::optional<BenchmarkScene> scene = benchmarkSceneOrSkip(name);
    if (!scene) continue;
    INFO(name);
    const auto a = makeModel<fcl::OBBRSSd>(scene->a);
    const auto b = makeModel<fcl::OBBRSSd>(scene->b);
    fcl::DistanceRequestd request;
    fcl::DistanceResultd result;
    fcl::distance(a.get(), scene->pose_a, b.get(), scene->pose_b, request, result);
    CHECK(result.min_distance == Approx(scene->distance).epsilon(1e-6));
    CHECK(meshVolume(scene->a) == Approx(meshVolume(scene->b)).epsilon(1e-9));
    CHECK(meshVolume(scene->a) > 0.01);
  }
}

}  // namespace
