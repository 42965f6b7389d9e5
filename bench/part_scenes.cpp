// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "bench/part_scenes.h"

#include <filesystem>
#include <utility>

#include "bench/pose_beside.h"
#include "fcl_prob/mesh_io.h"

namespace fcl_prob::cli {
namespace {

constexpr std::size_t kChecksOfPart = 10'000;
constexpr double kLeastOfPart = 1e-3;

/// Below the models folder, in the order of the names.
constexpr const char* kPartFiles[] = {
    "fetch_robot/fetch_description/meshes/l_gripper_finger_link.STL",
    "fetch_robot/fetch_description/meshes/gripper_link.STL",
    "fetch_robot/fetch_description/meshes/wrist_roll_link_collision.STL",
    "fetch_robot/fetch_description/meshes/wrist_flex_link_collision.STL",
    "fetch_robot/fetch_description/meshes/forearm_roll_link_collision.STL",
    "fetch_robot/fetch_description/meshes/shoulder_pan_link_collision.STL",
    "objects/coke_can_500.obj"};

}  // namespace

const std::vector<std::string>& PartScenes::names() {
  static const std::vector<std::string> all{"finger",  "gripper",      "wrist_roll", "wrist_flex",
                                            "forearm", "shoulder_pan", "can"};
  return all;
}

TriangleMesh armMesh(const std::string& models_folder) {
  const std::filesystem::path models(models_folder);
  return loadMeshIsolated((models / "human/human_arm_left_2000.obj").string());
}

PartScenes::PartScenes(const std::string& models_folder, std::uint64_t seed, TriangleMesh beside)
    : seed_(seed),
      random_(seed),
      beside_mesh_(std::move(beside)),
      beside_(buildTree(beside_mesh_, "obbrss")) {
  const std::filesystem::path models(models_folder);
  for (const char* file : kPartFiles) {
    meshes_.push_back(loadMeshIsolated((models / file).string()));
    geometries_.push_back(buildTree(meshes_.back(), "obbrss"));
  }
}

PartScene PartScenes::next(std::size_t part) {
  for (;;) {
    const double apart = random_.between(0.002, 0.08);
    const fcl::Transform3d pose =
        poseBeside(random_, geometries_[part], beside_mesh_, beside_, apart, 2.0, 30);
    const GaussianDisplacement error = randomError(random_, 0.01, 0.05);
    PartScene drawn{std::make_unique<PreparedScene>(
                        LoadedObject{meshes_[part], pose},
                        LoadedObject{beside_mesh_, fcl::Transform3d::Identity()}, error, "obbrss"),
                    {}};
    drawn.loop = timeFclLoop(*drawn.scene, kChecksOfPart, seed_ + drawn_);
    if (drawn.loop.estimate() < kLeastOfPart) continue;
    ++drawn_;
    return drawn;
  }
}

}  // namespace fcl_prob::cli
