// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// fcl_prob bench cloud: from rendered depth images to probabilities, against the true shapes; and
// real clouds, of which no truth is known.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "cli/bench_clouds.h"
#include "cli/benchmark.h"
#include "cli/depth_image.h"
#include "cli/geometry.h"
#include "cli/number_text.h"
#include "cli/stopwatch.h"
#include "cli/uniforms.h"
#include "fcl_prob/batch.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/mesh_io.h"
#include "fcl_prob/reconstruction.h"

#include <fcl/narrowphase/distance.h>

namespace fcl_prob::cli {
namespace {

constexpr std::size_t kScenesOfEach = 12;
constexpr double kDepths[] = {0.6, 1.2, 2.4};
constexpr double kCoverage = 0.95;

// Standard deviations of the displacement, and the gap that is left at its mean, metres.
constexpr double kLeastError = 0.005;
constexpr double kMostError = 0.02;
constexpr double kWidestGap = 0.02;

// What bands and shadows leave open is not worth more: an interval holds wherever it is stopped.
constexpr std::size_t kMostCells = 3000;

struct NamedMesh {
  std::string name;
  TriangleMesh mesh;
};

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

/// A gripper's finger near the object, on the sensor's side.
struct CloudScene {
  TriangleMesh object;
  fcl::Transform3d finger_pose = fcl::Transform3d::Identity();
  GaussianDisplacement displacement;
};

double distanceOf(const Geometry& a, const fcl::Transform3d& pose, const Geometry& b) {
  fcl::DistanceResultd result;
  return fcl::distance(a.get(), pose, b.get(), fcl::Transform3d::Identity(),
                       fcl::DistanceRequestd(), result);
}

CloudScene randomScene(const TriangleMesh& mesh, const Geometry& finger, double depth,
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
  double near = 0.0, far = 1.0;
  for (int step = 0; step < 30; ++step) {
    const double middle = 0.5 * (near + far);
    scene.finger_pose.translation() = place + middle * direction;
    (distanceOf(finger, scene.finger_pose, object) < gap ? near : far) = middle;
  }
  scene.finger_pose.translation() = place + far * direction;
  scene.displacement = randomError(random, kLeastError, kMostError);
  return scene;
}

struct Asked {
  Bounds interval;
  double milliseconds = 0.0;
};

Asked ask(const Geometry& finger, const CloudScene& scene, const TriangleMesh& mesh,
          const Band& band, ContactMeaning contact) {
  ProbabilityRequest request;
  request.method = ProbabilityMethod::interval;
  request.band_b = band;
  request.max_cells = kMostCells;
  request.contact = contact;
  const Geometry object = buildTree(mesh, "obbrss");
  const Stopwatch watch;
  ProbabilityResult result;
  collisionProbability(finger.get(), scene.finger_pose, object.get(), fcl::Transform3d::Identity(),
                       scene.displacement, request, result);
  return {{*result.lower, *result.upper}, watch.milliseconds()};
}

/// What is added up over the scenes of a row.
struct Row {
  std::size_t scenes = 0;
  std::size_t covered = 0;
  std::size_t covered_occupied = 0;
  std::size_t covered_without = 0;
  double truth = 0.0;
  double bias = 0.0;
  double width = 0.0;
  double width_occupied = 0.0;
  double band = 0.0;
  double triangles = 0.0;
  double reconstruction_ms = 0.0;
  double query_ms = 0.0;

  static bool holds(const Bounds& interval, const Bounds& truth) {
    return interval.lower <= truth.upper && interval.upper >= truth.lower;
  }
};

void addToRow(const CloudScene& scene, const Geometry& finger, const SensorModel& sensor,
              Uniforms& random, Row& row) {
  const PointCloud cloud = renderedCloud(scene.object, DepthCamera(), sensor, random);
  ReconstructionRequest request;
  request.sensor = sensor;
  request.coverage = kCoverage;
  request.unseen = UnseenSpace::free;
  const Stopwatch watch;
  const Reconstruction free = reconstruct(cloud, request);
  row.reconstruction_ms += watch.milliseconds();
  request.unseen = UnseenSpace::occupied;
  const Reconstruction occupied = reconstruct(cloud, request);

  const Bounds truth = ask(finger, scene, scene.object, {}, ContactMeaning::fcl).interval;
  const Asked plain = ask(finger, scene, free.surface, {}, ContactMeaning::fcl);
  const Asked lower = ask(finger, scene, free.surface, free.band, ContactMeaning::fcl);
  const Asked upper = ask(finger, scene, free.obstacle, free.band, ContactMeaning::fcl);
  const Asked shadow = ask(finger, scene, occupied.obstacle, occupied.band, ContactMeaning::solid);
  const Bounds banded{lower.interval.lower, upper.interval.upper};
  const Bounds solid{lower.interval.lower, shadow.interval.upper};
  ++row.scenes;
  row.covered += Row::holds(banded, truth);
  row.covered_occupied += Row::holds(solid, truth);
  row.covered_without += Row::holds(plain.interval, truth);
  row.truth += truth.middle();
  row.bias += plain.interval.middle() - truth.middle();
  row.width += banded.width();
  row.width_occupied += solid.width();
  row.band += free.band.outward;
  row.triangles += static_cast<double>(free.surface.triangles.size());
  row.query_ms += lower.milliseconds + upper.milliseconds;
}

std::string shareText(std::size_t part, std::size_t all) {
  return numberText(all == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(all),
                    3);
}

void report(const std::string& object, const std::string& sensor, const std::string& depth,
            const Row& row, BenchReport& report) {
  const double n = static_cast<double>(std::max<std::size_t>(row.scenes, 1));
  report.table.add({object, sensor, depth, std::to_string(row.scenes), numberText(row.truth / n, 3),
                    numberText(row.bias / n, 2), shareText(row.covered, row.scenes),
                    shareText(row.covered_occupied, row.scenes),
                    shareText(row.covered_without, row.scenes), numberText(1e3 * row.band / n, 3),
                    numberText(row.width / n, 3), numberText(row.width_occupied / n, 3),
                    numberText(row.triangles / n, 4), numberText(row.reconstruction_ms / n, 3),
                    numberText(row.query_ms / n, 3)});
  report.records.push_back({{"object", object},
                            {"sensor", sensor},
                            {"depth", depth},
                            {"scenes", row.scenes},
                            {"mean_probability", row.truth / n},
                            {"bias", row.bias / n},
                            {"covered", row.covered},
                            {"covered_occupied", row.covered_occupied},
                            {"covered_without_band", row.covered_without},
                            {"band", row.band / n},
                            {"width", row.width / n},
                            {"width_occupied", row.width_occupied / n},
                            {"reconstruction_ms", row.reconstruction_ms / n},
                            {"query_ms", row.query_ms / n}});
}

Row& operator+=(Row& sum, const Row& row) {
  sum.scenes += row.scenes;
  sum.covered += row.covered;
  sum.covered_occupied += row.covered_occupied;
  sum.covered_without += row.covered_without;
  sum.truth += row.truth;
  sum.bias += row.bias;
  sum.width += row.width;
  sum.width_occupied += row.width_occupied;
  sum.band += row.band;
  sum.triangles += row.triangles;
  sum.reconstruction_ms += row.reconstruction_ms;
  sum.query_ms += row.query_ms;
  return sum;
}

std::vector<NamedMesh> objectsIn(const std::filesystem::path& models) {
  const auto load = [&](const char* path) {
    return centred(loadMeshIsolated((models / path).string()));
  };
  return {{"bunny", load("benchmark/bunny_5110.obj")},
          {"mug", centred(mug())},
          {"arm", load("human/human_arm_left_2000.obj")}};
}

}  // namespace

BenchReport benchCloud(const BenchOptions& options, const BenchProgress& progress) {
  const std::filesystem::path models(options.models_folder);
  const Geometry finger = buildTree(
      centred(loadMeshIsolated(
          (models / "fetch_robot/fetch_description/meshes/l_gripper_finger_link.STL").string())),
      "obbrss");
  BenchReport result;
  result.title = "Rendered depth images, a gripper's finger beside what was reconstructed";
  result.table = TextTable({"object", "sensor", "depth / m", "scenes", "P", "bias", "covered / %",
                            "occupied / %", "no band / %", "band / mm", "width", "width occupied",
                            "triangles", "reconstruction / ms", "query / ms"});
  const std::vector<std::string> sensors{"kinect-nguyen", "kinect-khoshelham", "stereo"};
  const std::vector<NamedMesh> objects = objectsIn(models);
  const std::size_t scenes = options.quick ? 2 : kScenesOfEach;
  const double all = 27.0 * static_cast<double>(scenes);
  Uniforms random(options.seed);
  Row total;
  std::size_t done = 0;
  for (const NamedMesh& object : objects) {
    for (const std::string& name : sensors) {
      for (const double depth : kDepths) {
        const std::string what = object.name + " " + name + " " + numberText(depth, 2);
        if (what.find(options.only) == std::string::npos) continue;
        const SensorModel sensor = sensorModelFromString(name, DepthCamera().focal_length);
        Row row;
        for (std::size_t i = 0; i < scenes; ++i) {
          if (!progress(static_cast<double>(done++) / all, what)) return result;
          const CloudScene scene = randomScene(object.mesh, finger, depth, random);
          addToRow(scene, finger, sensor, random, row);
        }
        report(object.name, name, numberText(depth, 2), row, result);
        total += row;
      }
    }
  }
  report("all", "", "", total, result);
  result.notes =
      "P: of the true shape, mean. bias: of the surface without a band. covered: the interval with "
      "a "
      "95 % band, unseen space left free, holds the true shape's P; occupied: with the shadow as "
      "obstacle; no band: the plain surface's interval at 1 %. width: of those intervals.\n";
  return result;
}

}  // namespace fcl_prob::cli
