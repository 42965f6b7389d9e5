// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "bench/bench_scenes.h"

#include <fcl/narrowphase/distance.h>

#include <filesystem>

#include "base/bisection.h"
#include "bench/uniforms.h"

namespace fcl_prob::cli {
namespace {

constexpr double kLargestOffset = 3.0;  // metres: the meshes are 1 m long

Eigen::Vector3d offsetDirection() { return Eigen::Vector3d(1.0, 0.3, 0.2).normalized(); }

fcl::Transform3d offsetPose(double offset) {
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.translation() = offset * offsetDirection();
  return pose;
}

/// The offset at which the meshes are `distance` apart.
double findOffset(const TriangleMesh& a, const TriangleMesh& b, double distance) {
  const auto model_a = buildModel<fcl::OBBRSSd>(a);
  const auto model_b = buildModel<fcl::OBBRSSd>(b);
  const auto isNear = [&](double offset) {
    const fcl::DistanceRequestd request;
    fcl::DistanceResultd result;
    return fcl::distance(model_a.get(), fcl::Transform3d::Identity(), model_b.get(),
                         offsetPose(offset), request, result) < distance;
  };
  constexpr int kHalvings = 60;
  return detail::bisect({0.0, kLargestOffset}, kHalvings, isNear).fails;
}

}  // namespace

const std::vector<BenchScene>& benchScenes() {
  static const std::vector<BenchScene> scenes{
      {"bunny_1cm", "benchmark/bunny_5110.obj", 0.01, 0.721719322375},
      {"bunny_5cm", "benchmark/bunny_5110.obj", 0.05, 0.762542369236},
      {"dragon_1cm", "benchmark/dragon_10000.obj", 0.01, 0.695689118915},
      {"dragon_5cm", "benchmark/dragon_10000.obj", 0.05, 0.740313447305},
      {"buddha_1cm", "benchmark/buddha_10000.obj", 0.01, 0.402495043818},
      {"buddha_5cm", "benchmark/buddha_10000.obj", 0.05, 0.454372517893},
  };
  return scenes;
}

const std::vector<BenchScene>& growthScenes() {
  static const std::vector<BenchScene> scenes{
      {"bunny_69451_1cm", "benchmark/bunny_69451.obj", 0.01, std::nullopt},
      {"dragon_100000_1cm", "benchmark/dragon_100000.obj", 0.01, std::nullopt},
  };
  return scenes;
}

GaussianDisplacement benchDisplacement() {
  return GaussianDisplacement::fromStandardDeviations(
      {0.01, 0.03, 0.05}, Eigen::Quaterniond(0.5, 0.1, -0.7, 0.5).normalized());
}

PreparedScene prepareBenchScene(const BenchScene& scene, const std::string& models_folder,
                                const std::string& bounding_volume, double extra_offset) {
  MeshOptions options;
  options.normalize = true;
  const TriangleMesh a =
      loadMeshIsolated((std::filesystem::path(models_folder) / scene.model).string(), options);
  const Eigen::AngleAxisd turn(0.7, Eigen::Vector3d(1.0, 2.0, 3.0).normalized());
  const TriangleMesh b = rotated(a, turn.toRotationMatrix());
  const double offset = scene.offset ? *scene.offset : findOffset(a, b, scene.distance);
  return PreparedScene({a, fcl::Transform3d::Identity()}, {b, offsetPose(offset + extra_offset)},
                       benchDisplacement(), bounding_volume);
}

}  // namespace fcl_prob::cli
