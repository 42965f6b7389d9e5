// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// GeneralPCD on the six benchmark scenes: every row is above the certified probability.
#include <cstdio>

#include "benchmark_scenes.h"
#include "catch.h"
#include "fcl_prob/general_pcd.h"

namespace {

using namespace fcl_prob_test;
using namespace fcl_prob;

template <typename Tree>
void checkRow(const BenchmarkScene& scene, const char* name, const Tree& a, const Tree& b) {
  GeneralPcdRequest request;
  request.max_pairs = 20000;  // an upper bound wherever it stops
  const GeneralPcdResult sum =
      generalPcd(a, scene.pose_a, b, scene.pose_b, scene.displacement, request);
  request.variant = GeneralPcdVariant::minimum;
  request.max_pairs = 3000;
  const GeneralPcdResult minimum =
      generalPcd(a, scene.pose_a, b, scene.pose_b, scene.displacement, request);
  std::printf("%-10s %-8s P %.4f  sum %8.2f%s  root %.4f  minimum %.4f  pairs %zu\n",
              scene.name.c_str(), name, scene.estimate, sum.raw_sum, sum.complete ? " " : "+",
              sum.root, minimum.upper, sum.pairs_bounded);
  INFO(scene.name << " " << name);
  CHECK(sum.upper >= scene.reference.lower);
  CHECK(minimum.upper >= scene.reference.lower);
  CHECK(minimum.upper <= sum.root);
}

template <typename BV>
void checkModel(const BenchmarkScene& scene, const char* name) {
  checkRow(scene, name, *makeModel<BV>(scene.a), *makeModel<BV>(scene.b));
}

void checkEveryRow(const BenchmarkScene& scene) {
  checkModel<SphereBv>(scene, "sphere");
  checkModel<fcl::AABBd>(scene, "AABB");
  checkModel<fcl::OBBd>(scene, "OBB");
  checkModel<fcl::RSSd>(scene, "RSS");
  checkModel<fcl::OBBRSSd>(scene, "OBBRSS");
  checkModel<fcl::kIOSd>(scene, "kIOS");
  checkModel<fcl::KDOPd<16>>(scene, "16-DOP");
  checkModel<fcl::KDOPd<18>>(scene, "18-DOP");
  checkModel<fcl::KDOPd<24>>(scene, "24-DOP");
  checkModel<Kdop26>(scene, "26-DOP");
  const ConvexHullTree a(*makeModel<fcl::OBBd>(scene.a));
  const ConvexHullTree b(*makeModel<fcl::OBBd>(scene.b));
  checkRow(scene, "hull", a, b);
}

TEST_CASE("on a benchmark scene every bound of every bounding volume is above P", "[slow]") {
  const std::optional<BenchmarkScene> scene = benchmarkSceneOrSkip("bunny_5cm");
  if (scene) checkEveryRow(*scene);
  std::fflush(stdout);
}

TEST_CASE("on all six benchmark scenes the bounds of boxes and 26-DOPs are above P", "[slow]") {
  for (const std::string& name : benchmarkSceneNames()) {
    const std::optional<BenchmarkScene> scene = benchmarkSceneOrSkip(name);
    if (!scene) continue;
    checkModel<fcl::OBBd>(*scene, "OBB");
    checkModel<Kdop26>(*scene, "26-DOP");
  }
  std::fflush(stdout);
}

TEST_CASE("on all six benchmark scenes every bound is above P", "[long]") {
  for (const std::string& name : benchmarkSceneNames()) {
    const std::optional<BenchmarkScene> scene = benchmarkSceneOrSkip(name);
    if (scene) checkEveryRow(*scene);
  }
  std::fflush(stdout);
}

}  // namespace
