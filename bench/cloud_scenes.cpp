// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "bench/cloud_scenes.h"

#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/bisection.h"
#include "base/stopwatch.h"
#include "fcl_prob/mesh_io.h"

namespace fcl_prob::cli {
namespace {

// Standard deviations of the displacement, and the gap that is left at its mean, metres.
constexpr double kLeastError = 0.005;
constexpr double kMostError = 0.02;
constexpr double kWidestGap = 0.02;

// What bands and shadows leave open is not worth more: an interval holds wherever it is stopped.
constexpr std::size_t kMostCells = 3000;

TriangleMesh centred(TriangleMesh mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& v : mesh.vertices) box.extend(v);
  for (Eigen::Vector3d& v : mesh.vertices) v -= box.center();
  return mesh;
}

/// 80 mm wide, 95 mm high, walls of 4 mm, no handle.
TriangleMesh mug() {
  constexpr int kAround = 48;
  const std::vector<std::array<double, 2>> profile{{0.0, 0.0},     {0.04, 0.0},    {0.04, 0.095},
                                                   {0.036, 0.095}, {0.036, 0.005}, {0.0, 0.005}};
  TriangleMesh mesh;
  for (const auto& [radius, height] : profile) {
    for (int i = 0; i < kAround; ++i) {
      const double angle = 2.0 * M_PI * i / kAround;
      mesh.vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), height);
    }
  }
  for (std::size_t ring = 0; ring + 1 < profile.size(); ++ring) {
    for (std::size_t i = 0; i < kAround; ++i) {
      const std::size_t a = ring * kAround + i, b = ring * kAround + (i + 1) % kAround;
      const std::size_t c = a + kAround, d = b + kAround;
      // The first and the last ring begin and end in a point.
      if (ring > 0) mesh.triangles.emplace_back(a, b, d);
      if (ring + 2 < profile.size()) mesh.triangles.emplace_back(a, d, c);
    }
  }
  return welded(mesh);
}

double distanceOf(const Geometry& a, const fcl::Transform3d& pose, const Geometry& b) {
  fcl::DistanceResultd result;
  return fcl::distance(a.get(), pose, b.get(), fcl::Transform3d::Identity(),
                       fcl::DistanceRequestd(), result);
}

}  // namespace

std::vector<NamedMesh> seenObjects(const std::filesystem::path& models) {
  const auto load = [&](const char* path) {
    return centred(loadMeshIsolated((models / path).string()));
  };
  return {{"bunny", load("benchmark/bunny_5110.obj")},
          {"mug", centred(mug())},
          {"arm", load("human/human_arm_left_2000.obj")}};
}

Geometry gripperFinger(const std::filesystem::path& models) {
  constexpr const char* kFinger = "fetch_robot/fetch_description/meshes/l_gripper_finger_link.STL";
  return buildTree(centred(loadMeshIsolated((models / kFinger).string())), "obbrss");
}

Eigen::Vector3d besideObject(const Geometry& finger, const Eigen::Matrix3d& turn,
                             const Geometry& object, const Eigen::Vector3d& place,
                             const Eigen::Vector3d& direction, double gap) {
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.linear() = turn;
  const auto isNear = [&](double away) {
    pose.translation() = place + away * direction;
    return distanceOf(finger, pose, object) < gap;
  };
  constexpr int kHalvings = 30;
  return place + detail::bisect({0.0, 1.0}, kHalvings, isNear).fails * direction;
}

CloudScene randomCloudScene(const TriangleMesh& mesh, const Geometry& finger, double depth,
                            Uniforms& random) {
  CloudScene scene;
  scene.object = mesh;
  const Eigen::Matrix3d turn = random.rotation();
  const Eigen::Vector3d place(random.between(-0.1, 0.1) * depth, random.between(-0.1, 0.1) * depth,
                              depth);
  for (Eigen::Vector3d& v : scene.object.vertices) v = place + turn * v;
  const Geometry object = buildTree(scene.object, "obbrss");
  scene.finger_pose.linear() = random.rotation();
  Eigen::Vector3d direction = random.rotation().col(0);
  if (direction.z() > 0.0) direction = -direction;
  direction = (direction - Eigen::Vector3d(0.0, 0.0, 0.7)).normalized();
  const double gap = random.between(0.0, kWidestGap);
  scene.finger_pose.translation() =
      besideObject(finger, scene.finger_pose.linear(), object, place, direction, gap);
  scene.displacement = randomError(random, kLeastError, kMostError);
  return scene;
}

CloudAnswer askMesh(const Geometry& finger, const fcl::Transform3d& pose,
                    const GaussianDisplacement& displacement, const TriangleMesh& mesh,
                    const ProbabilityRequest& request) {
  const detail::Stopwatch building;
  const Geometry object = buildTree(mesh, "obbrss");
  CloudAnswer answer;
  answer.tree_ms = building.milliseconds();
  const detail::Stopwatch asking;
  ProbabilityResult result;
  collisionProbability(finger.get(), pose, object.get(), fcl::Transform3d::Identity(), displacement,
                       request, result);
  answer.query_ms = asking.milliseconds();
  answer.interval = {*result.lower, *result.upper};
  return answer;
}

CloudAnswer askReconstruction(const Geometry& finger, const fcl::Transform3d& pose,
                              const GaussianDisplacement& displacement,
                              const Reconstruction& reconstruction) {
  ProbabilityRequest request;
  request.method = ProbabilityMethod::interval;
  request.band_b = reconstruction.band;
  request.max_cells = kMostCells;
  const CloudAnswer lower = askMesh(finger, pose, displacement, reconstruction.surface, request);
  if (reconstruction.obstacle_is_solid) request.contact = ContactMeaning::solid;
  const CloudAnswer upper = askMesh(finger, pose, displacement, reconstruction.obstacle, request);
  return {{lower.interval.lower, upper.interval.upper},
          lower.tree_ms + upper.tree_ms,
          lower.query_ms + upper.query_ms};
}

}  // namespace fcl_prob::cli
