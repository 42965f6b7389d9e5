// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "benchmark_scenes.h"

#include <stdexcept>

#include "models.h"
#include "obj_file.h"

namespace fcl_prob_test {

namespace {

struct SceneRecord {
  const char* name;
  const char* model;
  double distance;
  double translation;  // length of B's translation, found by bisection on fcl::distance
  fcl_prob::Bounds reference;
  double estimate;
};

constexpr const char* kBunny = "benchmark/bunny_5110.obj";
constexpr const char* kDragon = "benchmark/dragon_10000.obj";
constexpr const char* kBuddha = "benchmark/buddha_10000.obj";

const SceneRecord kScenes[] = {
    {"bunny_1cm", kBunny, 0.01, 0.721719322375, {0.379282335, 0.379308638}, 0.379302},
    {"bunny_5cm", kBunny, 0.05, 0.762542369236, {0.101530829, 0.101536876}, 0.1015353},
    {"dragon_1cm", kDragon, 0.01, 0.695689118915, {0.417019658, 0.417054147}, 0.417045},
    {"dragon_5cm", kDragon, 0.05, 0.740313447305, {0.095891959, 0.095897046}, 0.0958954},
    {"buddha_1cm", kBuddha, 0.01, 0.402495043818, {0.376507618, 0.376659563}, 0.376618},
    {"buddha_5cm", kBuddha, 0.05, 0.454372517893, {0.068603932, 0.068631886}, 0.0686242},
};

const SceneRecord& findScene(const std::string& name) {
  for (const SceneRecord& scene : kScenes) {
    if (name == scene.name) return scene;
  }
  throw std::invalid_argument("no benchmark scene is named " + name);
}

}  // namespace

std::vector<std::string> benchmarkSceneNames() {
  std::vector<std::string> names;
  for (const SceneRecord& scene : kScenes) names.emplace_back(scene.name);
  return names;
}

fcl_prob::GaussianDisplacement benchmarkDisplacement() {
  return fcl_prob::GaussianDisplacement::fromStandardDeviations(
      {0.01, 0.03, 0.05}, Eigen::Quaterniond(0.5, 0.1, -0.7, 0.5).normalized());
}

std::optional<BenchmarkScene> benchmarkSceneOrSkip(const std::string& name) {
  const SceneRecord& record = findScene(name);
  const std::optional<std::string> path = modelOrSkip(record.model);
  if (!path) return std::nullopt;

  const Eigen::Isometry3d rotation_of_b(
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1.0, 2.0, 3.0).normalized()));
  BenchmarkScene scene{record.name,
                       normalized(readObj(*path)),
                       {},
                       fcl::Transform3d::Identity(),
                       fcl::Transform3d::Identity(),
                       record.distance,
                       benchmarkDisplacement(),
                       record.reference,
                       record.estimate};
  scene.b = transformed(scene.a, rotation_of_b);
  scene.pose_b.translation() = record.translation * Eigen::Vector3d(1.0, 0.3, 0.2).normalized();
  return scene;
}

}  // namespace fcl_prob_test
