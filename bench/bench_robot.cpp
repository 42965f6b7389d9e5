// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// fcl_prob bench robot: decisions for the links of a robot beside an arm, groups of links, batches.
#include <fcl/narrowphase/collision.h>

#include <algorithm>
#include <filesystem>

#include "base/stopwatch.h"
#include "bench/benchmark.h"
#include "bench/uniforms.h"
#include "cli/geometry.h"
#include "cli/number_text.h"
#include "cli/random_frames.h"
#include "fcl_prob/batch.h"
#include "fcl_prob/group.h"
#include "fcl_prob/mesh_io.h"

namespace fcl_prob::cli {
namespace {

// Standard deviations of errors, metres.
constexpr double kLeastSigma = 0.005;
constexpr double kMostSigma = 0.05;

const std::vector<std::string>& linkNames() {
  static const std::vector<std::string> names{
      "shoulder_pan_link_collision",  "shoulder_lift_link_collision",
      "upperarm_roll_link_collision", "elbow_flex_link_collision",
      "forearm_roll_link_collision",  "wrist_flex_link_collision",
      "wrist_roll_link_collision",    "gripper_link",
      "l_gripper_finger_link",        "head_pan_link_collision"};
  return names;
}

struct Robot {
  std::vector<Geometry> links;
  TriangleMesh arm_mesh;
  Geometry arm;
};

Robot loadRobot(const std::string& models_folder) {
  const std::filesystem::path models(models_folder);
  Robot robot;
  for (const std::string& name : linkNames()) {
    const auto path = models / "fetch_robot/fetch_description/meshes" / (name + ".STL");
    robot.links.push_back(buildTree(loadMeshIsolated(path.string()), "obbrss"));
  }
  robot.arm_mesh = loadMeshIsolated((models / "human/human_arm_left_2000.obj").string());
  robot.arm = buildTree(robot.arm_mesh, "obbrss");
  return robot;
}

/// A pose near the arm: turned at random, up to `reach` metres from a vertex of the arm.
fcl::Transform3d poseNear(const TriangleMesh& arm, double reach, Uniforms& random) {
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.linear() = random.rotation();
  const Eigen::Vector3d& vertex = arm.vertices[random.below(arm.vertices.size())];
  pose.translation() = vertex + random.between(0.0, reach) * random.rotation().col(0);
  return pose;
}

/// The time of `count` calls of fcl::collide at displaced poses, milliseconds.
double timeCollide(const Geometry& a, const fcl::Transform3d& pose_a, const Geometry& b,
                   const GaussianDisplacement& displacement, std::uint64_t seed, int count) {
  const Whitening whitening(displacement);
  std::vector<fcl::Transform3d> poses(static_cast<std::size_t>(count), pose_a);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    poses[i].pretranslate(randomDisplacement(whitening, seed, i));
  }
  const fcl::CollisionRequestd request;
  const fcl::Transform3d identity = fcl::Transform3d::Identity();
  const detail::Stopwatch watch;
  for (const fcl::Transform3d& pose : poses) {
    fcl::CollisionResultd result;
    fcl::collide(a.get(), pose, b.get(), identity, request, result);
  }
  return watch.milliseconds();
}

class RobotTable {
 public:
  explicit RobotTable(const BenchOptions& options)
      : options_(options), robot_(loadRobot(options.models_folder)) {
    report_.title = "A robot beside an arm: decisions, groups, batches";
    report_.table = TextTable({"task", "scenes", "median / ms", "99 % / ms", "compared with",
                               "median ratio", "99 % ratio", "outcome"});
    report_.notes =
        "Trees and prepared queries are built beforehand; one thread but where two are named. A "
        "link\n"
        "stands at a random pose up to 30 cm from a point of the arm, its error has standard\n"
        "deviations from 5 to 50 mm along random axes. A ratio is the time over that of what it "
        "is\n"
        "compared with, scene by scene in the same run; for batches it is the speed-up. Links of "
        "groups are\n"
        "up to 1 m away. 99 % of fewer than 100 scenes is the largest.\n";
  }

  void addDecisions() {
    constexpr int kScenes = 1000;
    Uniforms random(options_.seed);
    std::vector<PreparedQuery> queries;
    for (const Geometry& link : robot_.links) queries.emplace_back(link, robot_.arm);
    std::vector<double> times, ratios;
    int above = 0, below = 0, from_roots = 0;
    for (int i = 0; i < kScenes; ++i) {
      const std::size_t link = random.below(queries.size());
      const fcl::Transform3d pose = poseNear(robot_.arm_mesh, 0.3, random);
      const GaussianDisplacement error = randomError(random, kLeastSigma, kMostSigma);
      ProbabilityRequest request;
      request.threshold = 0.05;
      request.relative_tolerance = 1e-3;
      ProbabilityResult result;
      const detail::Stopwatch watch;
      queries[link].collisionProbability(pose, fcl::Transform3d::Identity(), error, request,
                                         result);
      times.push_back(watch.milliseconds());
      const auto seed = options_.seed + static_cast<std::uint64_t>(i);
      ratios.push_back(times.back() /
                       timeCollide(robot_.links[link], pose, robot_.arm, error, seed, 100));
      above += result.decision == Decision::above;
      below += result.decision == Decision::below;
      from_roots += result.statistics.cells == 0;
    }
    add("link, P < 5 % or not", times, "100 fcl::collide", ratios,
        std::to_string(below) + " below (" + std::to_string(from_roots) +
            " by the root volumes alone), " + std::to_string(above) + " above");
  }

  void addGroups() {
    constexpr int kScenes = 20;
    constexpr std::size_t kLinks = 20;
    Uniforms random(options_.seed + 1);
    GroupQuery::Geometries links;
    for (std::size_t i = 0; i < kLinks; ++i) links.push_back(robot_.links[i % robot_.links.size()]);
    const GroupQuery group(links, {robot_.arm});
    ProbabilityRequest request;
    request.absolute_tolerance = 1e-4;
    request.max_cells = 50'000;
    std::vector<double> times, ratios;
    double most_of_sum = 0.0;
    for (int scene = 0; scene < kScenes; ++scene) {
      std::vector<fcl::Transform3d> poses;
      for (std::size_t i = 0; i < kLinks; ++i) {
        poses.push_back(poseNear(robot_.arm_mesh, 1.0, random));
      }
      const GaussianDisplacement error = randomError(random, kLeastSigma, kMostSigma);
      ProbabilityResult result;
      const detail::Stopwatch watch;
      group.collisionProbability(poses, {fcl::Transform3d::Identity()}, error, request, result);
      times.push_back(watch.milliseconds());
      double dearest = 0.0, sum = 0.0;
      for (std::size_t i = 0; i < kLinks; ++i) {
        const PreparedQuery single(links[i], robot_.arm);
        ProbabilityResult of_one;
        const detail::Stopwatch single_watch;
        single.collisionProbability(poses[i], fcl::Transform3d::Identity(), error, request, of_one);
        dearest = std::max(dearest, single_watch.milliseconds());
        sum += *of_one.upper;
      }
      ratios.push_back(times.back() / dearest);
      most_of_sum = std::max(most_of_sum, *result.lower / sum);
    }
    add("20 links as one group, 1 % or 1e-4", times, "its dearest pair", ratios,
        "P at most " + numberText(most_of_sum, 3) + " of the sum");
  }

  void addBatches() {
    constexpr std::size_t kPoses = 10'000;
    Uniforms random(options_.seed + 2);
    const PreparedQuery query(robot_.links[7], robot_.arm);
    std::vector<Waypoint> waypoints(kPoses);
    for (Waypoint& waypoint : waypoints) {
      waypoint.pose_a = poseNear(robot_.arm_mesh, 0.3, random);
      waypoint.displacement = randomError(random, kLeastSigma, kMostSigma);
    }
    BatchRequest request;
    request.query.threshold = 0.05;
    request.query.max_cells = 500;
    double times[2];
    BatchResult results[2];
    for (const unsigned threads : {1u, 2u}) {
      request.query.threads = threads;
      const detail::Stopwatch watch;
      results[threads - 1] = collisionProbabilities(query, waypoints, request);
      times[threads - 1] = watch.milliseconds();
    }
    bool same = true;
    for (std::size_t i = 0; i < kPoses; ++i) {
      same = same && results[0].waypoints[i]->lower == results[1].waypoints[i]->lower &&
             results[0].waypoints[i]->upper == results[1].waypoints[i]->upper;
    }
    add("10,000 decisions of at most 500 cells, two threads", {times[1]}, "the same on one",
        {times[0] / times[1]}, same ? "identical results" : "RESULTS DIFFER");
  }

  BenchReport take() { return std::move(report_); }

 private:
  void add(const std::string& task, const std::vector<double>& times, const std::string& reference,
           const std::vector<double>& ratios, const std::string& outcome) {
    const double median = quantile(times, 0.5), slow = quantile(times, 0.99);
    const double median_ratio = quantile(ratios, 0.5), slow_ratio = quantile(ratios, 0.99);
    report_.table.add({task, std::to_string(times.size()), numberText(median, 3),
                       numberText(slow, 3), reference, numberText(median_ratio, 3),
                       numberText(slow_ratio, 3), outcome});
    report_.records.push_back({{"task", task},
                               {"scenes", times.size()},
                               {"median_ms", median},
                               {"slow_ms", slow},
                               {"compared_with", reference},
                               {"median_ratio", median_ratio},
                               {"slow_ratio", slow_ratio},
                               {"outcome", outcome}});
  }

  const BenchOptions& options_;
  Robot robot_;
  BenchReport report_;
};

}  // namespace

BenchReport benchRobot(const BenchOptions& options, const BenchProgress& progress) {
  struct Part {
    std::string name;
    void (RobotTable::*run)();
  };
  static const std::vector<Part> parts{{"decisions", &RobotTable::addDecisions},
                                       {"groups", &RobotTable::addGroups},
                                       {"batches", &RobotTable::addBatches}};
  RobotTable table(options);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].name.find(options.only) == std::string::npos) continue;
    const double fraction = static_cast<double>(i) / static_cast<double>(parts.size());
    if (!progress(fraction, parts[i].name)) break;
    (table.*parts[i].run)();
  }
  return table.take();
}

}  // namespace fcl_prob::cli
