// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The part of bench cloud that has no truth: real clouds from file to answer.
#include <filesystem>

#include "base/stopwatch.h"
#include "bench/bench_clouds.h"
#include "bench/cloud_scenes.h"
#include "cli/number_text.h"

namespace fcl_prob::cli {
namespace {

constexpr double kGap = 0.01;    // metres between the finger and the surface
constexpr double kSigma = 0.01;  // metres, along every axis

struct RealCloud {
  const char* name;
  const char* file;
};

constexpr RealCloud kClouds[] = {{"person", "kinect_person.pcd"},
                                 {"five people", "five_people.pcd"},
                                 {"mug", "table_scene_mug_stereo_textured.pcd"},
                                 {"milk", "milk.pcd"},
                                 {"bunny scan", "bun0.pcd"}};

/// On the sensor's side of the vertex that is nearest to the middle.
fcl::Transform3d fingerBeside(const Reconstruction& seen, const Eigen::Vector3d& sensor,
                              const Geometry& finger) {
  Eigen::Vector3d nearest = seen.surface.vertices.front();
  for (const Eigen::Vector3d& v : seen.surface.vertices) {
    if ((v - seen.reference).norm() < (nearest - seen.reference).norm()) nearest = v;
  }
  const Eigen::Vector3d direction = (sensor - nearest).normalized();
  const Geometry object = buildTree(seen.surface, "obbrss");
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.translation() = besideObject(finger, pose.linear(), object, nearest, direction, kGap);
  return pose;
}

void addCloud(const RealCloud& real, const std::filesystem::path& folder, const Geometry& finger,
              TextTable& table, BenchReport& report) {
  const detail::Stopwatch reading;
  const PointCloud cloud = loadPointCloud((folder / real.file).string());
  const double read_ms = reading.milliseconds();
  ReconstructionRequest request;
  request.unseen = UnseenSpace::free;
  const detail::Stopwatch meshing;
  const Reconstruction seen = reconstruct(cloud, request);
  const double mesh_ms = meshing.milliseconds();
  const fcl::Transform3d pose = fingerBeside(seen, cloud.sensor.translation(), finger);
  const auto displacement = GaussianDisplacement::fromStandardDeviations({kSigma, kSigma, kSigma});
  const CloudAnswer answer = askReconstruction(finger, pose, displacement, seen);
  const double all_ms = read_ms + mesh_ms + answer.tree_ms + answer.query_ms;
  const auto triangles = seen.surface.triangles.size() + seen.obstacle.triangles.size();
  table.add({real.name, std::to_string(cloud.points.size()), std::to_string(triangles),
             numberText(1e3 * seen.band.outward, 3), numberText(answer.interval.lower, 3),
             numberText(answer.interval.upper, 3), numberText(read_ms, 3), numberText(mesh_ms, 3),
             numberText(answer.tree_ms, 3), numberText(answer.query_ms, 3), numberText(all_ms, 3)});
  report.records.push_back({{"cloud", real.name},
                            {"points", cloud.points.size()},
                            {"triangles", triangles},
                            {"band", seen.band.outward},
                            {"lower", answer.interval.lower},
                            {"upper", answer.interval.upper},
                            {"read_ms", read_ms},
                            {"reconstruction_ms", mesh_ms},
                            {"tree_ms", answer.tree_ms},
                            {"query_ms", answer.query_ms},
                            {"all_ms", all_ms}});
}

}  // namespace

void addRealClouds(const Geometry& finger, const BenchOptions& options,
                   const BenchProgress& progress, BenchReport& report) {
  const std::filesystem::path models(options.models_folder);
  TextTable table({"cloud", "points", "triangles", "band / mm", "lower", "upper", "read / ms",
                   "reconstruction / ms", "trees / ms", "query / ms", "all / ms"});
  bool any = false;
  for (const RealCloud& real : kClouds) {
    const std::string what = std::string("real cloud ") + real.name;
    if (what.find(options.only) == std::string::npos) continue;
    if (!progress(1.0, what)) return;
    addCloud(real, models / "pointcloud", finger, table, report);
    any = true;
  }
  if (!any) return;
  report.notes +=
      "\nReal clouds, a finger 10 mm in front of their middle, σ = 10 mm; no truth is "
      "known. triangles: of both meshes.\n\n" +
      markdownOf(table);
}

}  // namespace fcl_prob::cli
