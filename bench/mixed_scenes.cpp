// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "bench/mixed_scenes.h"

#include <algorithm>
#include <filesystem>
#include <vector>

#include "bench/pose_beside.h"
#include "cli/number_text.h"
#include "fcl_prob/convex_polytope.h"
#include "fcl_prob/mesh_io.h"
#include "geometry/enclosed_volume.h"

namespace fcl_prob::cli {
namespace {

constexpr std::size_t kFclChecks = 10'000;
constexpr double kLeastProbability = 1e-3;

const std::vector<std::string>& models() {
  static const std::vector<std::string> all{"cad/wingnut.obj",
                                            "cad/featuretype.ply",
                                            "cad/fixed_top.ply",
                                            "objects/coke_can_500.obj",
                                            "objects/coke_can.obj",
                                            "kuka_iiwa/meshes/link_1.stl",
                                            "kuka_iiwa/meshes/link_4.stl",
                                            "kuka_iiwa/meshes/link_7.stl",
                                            "benchmark/bunny_5110.obj",
                                            "benchmark/dragon_10000.obj",
                                            "benchmark/buddha_10000.obj",
                                            "human/human_man_4980.obj",
                                            "human/human_arm_left_2000.obj",
                                            "human/hand_lowres.obj",
                                            "human_urdf/meshes/Head.stl",
                                            "human_urdf/meshes/RightHand.stl"};
  return all;
}

// Most of its hull is within it.
bool isNearlyConvex(const TriangleMesh& mesh) {
  constexpr double kNearly = 0.9;
  const ConvexPolytope hull = convexHull(mesh.vertices);
  TriangleMesh around;
  around.vertices = hull.vertices;
  for (const ConvexPolytope::Face& face : hull.faces) {
    for (std::size_t i = 2; i < face.vertices.size(); ++i) {
      around.triangles.emplace_back(face.vertices[0], face.vertices[i - 1], face.vertices[i]);
    }
  }
  return detail::enclosedVolume(mesh) > kNearly * detail::enclosedVolume(around);
}

}  // namespace

double longestSide(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& vertex : mesh.vertices) box.extend(vertex);
  return box.sizes().maxCoeff();
}

MixedScenes::MixedScenes(const std::string& models_folder, std::uint64_t seed)
    : models_folder_(models_folder), seed_(seed), random_(seed) {}

const TriangleMesh& MixedScenes::mesh(const std::string& file) {
  const auto known = meshes_.find(file);
  if (known != meshes_.end()) return known->second;
  const std::string path = (std::filesystem::path(models_folder_) / file).string();
  return meshes_.emplace(file, loadMeshIsolated(path)).first->second;
}

TriangleMesh MixedScenes::drawnMesh(std::string& name) {
  const std::string& file = models()[random_.below(models().size())];
  TriangleMesh drawn = mesh(file);
  const double size = random_.logBetween(0.01, 1.0);
  const double scale = size / longestSide(drawn);
  for (Eigen::Vector3d& vertex : drawn.vertices) vertex *= scale;
  name = std::filesystem::path(file).stem().string() + " " + numberText(size, 2) + " m";
  return drawn;
}

MixedScene MixedScenes::next() {
  for (;;) {
    std::string name_a, name_b;
    const TriangleMesh a = drawnMesh(name_a), b = drawnMesh(name_b);
    const double most = random_.logBetween(0.002, 0.05);
    const GaussianDisplacement error = randomError(random_, most / 6.0, most);
    const double deviation = error.standardDeviations().maxCoeff();
    const double apart = random_.between(0.1, 2.5) * deviation;
    const Geometry tree_a = buildTree(a, "obbrss"), tree_b = buildTree(b, "obbrss");
    const fcl::Transform3d pose = poseBeside(random_, tree_a, b, tree_b, apart, 4.0, 40);
    auto scene = std::make_unique<PreparedScene>(
        LoadedObject{a, pose}, LoadedObject{b, fcl::Transform3d::Identity()}, error, "obbrss");
    const FclLoop loop = timeFclLoop(*scene, kFclChecks, seed_);
    if (loop.estimate() < kLeastProbability) continue;
    const bool is_convex = isNearlyConvex(a) || isNearlyConvex(b);
    const double small = std::min(longestSide(a), longestSide(b));
    return {name_a + ", " + name_b, small / deviation, is_convex, std::move(scene), loop};
  }
}

}  // namespace fcl_prob::cli
