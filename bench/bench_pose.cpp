// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// fcl_prob bench pose: errors of poses and joints against counting with fcl::collide.
#include <fcl/narrowphase/collision.h>

#include <cmath>
#include <filesystem>
#include <optional>
#include <sstream>

#include "base/stopwatch.h"
#include "bench/bench_scenes.h"
#include "bench/benchmark.h"
#include "bench/fetch_arm.h"
#include "cli/number_text.h"
#include "cli/random_displacement.h"
#include "fcl_prob/pose_probability.h"

namespace fcl_prob::cli {
namespace {

constexpr std::size_t kCounted = 10'000;
constexpr double kRadiansADegree = 0.017453292519943295;

// Metres between the arm and what is beside it: P is then between 1e-3 and 0.3 for all errors of
// joints that are asked about.
constexpr double kAside = 0.01;

ProbabilityRequest requestOf(ProbabilityMethod method, double tolerance, std::uint64_t seed) {
  ProbabilityRequest request;
  request.method = method;
  request.relative_tolerance = tolerance;
  request.absolute_tolerance = 0.0;
  request.seed = seed;
  return request;
}

/// Milliseconds that counting takes for a standard error: those of one sample times how many it
/// takes.
double countingTime(double sample_ms, double probability, double standard_error) {
  return sample_ms * probability * (1.0 - probability) / (standard_error * standard_error);
}

/// A benchmark scene whose A also turns.
class PoseScene {
 public:
  PoseScene(const BenchScene& scene, const std::string& models_folder)
      : prepared_(prepareBenchScene(scene, models_folder, "obbrss")),
        a_(buildGeometry(prepared_.objectA(), "obbrss")),
        b_(buildGeometry(prepared_.objectB(), "obbrss")),
        query_(a_, b_) {}

  PoseError error(double degrees) const {
    const double angle = degrees * kRadiansADegree;
    return PoseError::fromIndependent(prepared_.displacement(),
                                      angle * angle * Eigen::Matrix3d::Identity());
  }

  TimedResult query(const PoseError& error, const ProbabilityRequest& request) const {
    TimedResult timed;
    const detail::Stopwatch watch;
    query_.collisionProbability(prepared_.objectA().pose, prepared_.objectB().pose, error, request,
                                timed.result);
    timed.time_ms = watch.milliseconds();
    return timed;
  }

  /// Milliseconds a call of fcl::collide, at poses drawn before the clock starts.
  double sampleTime(const PoseError& error, std::uint64_t seed) const {
    const Whitening translation(prepared_.displacement());
    const Whitening rotation(GaussianDisplacement(Eigen::Vector3d::Zero(),
                                                  error.covariance().bottomRightCorner<3, 3>()));
    std::vector<fcl::Transform3d> poses;
    for (std::size_t i = 0; i < kCounted; ++i) {
      PoseError::Vector6 sample;
      sample << randomDisplacement(translation, seed, 2 * i),
          randomDisplacement(rotation, seed, 2 * i + 1);
      poses.push_back(displacedPose(prepared_.objectA().pose, error.convention(), sample));
    }
    const fcl::CollisionRequestd request;
    const detail::Stopwatch watch;
    for (const fcl::Transform3d& pose : poses) {
      fcl::CollisionResultd result;
      fcl::collide(a_.get(), pose, b_.get(), prepared_.objectB().pose, request, result);
    }
    return watch.milliseconds() / static_cast<double>(kCounted);
  }

 private:
  PreparedScene prepared_;
  Geometry a_;
  Geometry b_;
  PreparedPoseQuery query_;
};

class PoseTable {
 public:
  explicit PoseTable(const BenchOptions& options) : options_(options) {
    report_.title = "Errors of poses and joints against counting with fcl::collide";
    report_.table = TextTable({"scene", "σ of rotation", "method", "P", "error", "time / ms",
                               "counting / ms", "ratio", "calibration", "status"});
    report_.notes =
        "Translations have 1, 3 and 5 cm as in the other tables, rotations the same σ about every\n"
        "axis. `error`: relative standard error, or half the width of the interval relative to "
        "its\n"
        "middle. `counting`: the time of 10,000 calls of fcl::collide at random poses in the same\n"
        "run, scaled to the same standard error (for intervals: as it is). `calibration`: root "
        "mean\n"
        "square of (estimate - reference) / standard error over as many seeds as `--cases` says;\n"
        "the reference is an estimate to 0.1 %. One thread.\n";
  }

  bool addScene(const BenchScene& scene, const std::function<bool(const std::string&)>& goOn) {
    std::optional<PoseScene> pose_scene;
    for (const double degrees : {0.3, 1.0, 3.0, 10.0}) {
      const std::string name = labelOf(scene.name, degrees, "");
      if (!goOn(name)) return false;
      if (!isWanted(name + kInterval) && !isWanted(name + kEstimate)) continue;
      if (!pose_scene) pose_scene.emplace(scene, options_.models_folder);
      addAngle(scene.name, *pose_scene, degrees);
    }
    return true;
  }

  void addJoints(const std::string& name, double degrees) {
    if (!isWanted(labelOf(name, degrees, kEstimate))) return;
    const FetchArm arm(options_.models_folder);
    const RandomJoints joints = arm.configuration(degrees * kRadiansADegree, kAside);
    const auto answer = [&](const ProbabilityRequest& request) {
      TimedResult timed;
      const detail::Stopwatch watch;
      arm.query().collisionProbability(joints, request, timed.result);
      timed.time_ms = watch.milliseconds();
      return timed;
    };
    ProbabilityRequest counting = requestOf(ProbabilityMethod::monte_carlo, 1e-9, options_.seed);
    counting.samples = kCounted;
    const double sample_ms = answer(counting).time_ms / static_cast<double>(kCounted);
    for (const double tolerance : {0.01, 0.003}) {
      const auto timed = answer(requestOf(ProbabilityMethod::estimate, tolerance, options_.seed));
      addEstimate(name, degrees, tolerance, timed, sample_ms, "");
    }
  }

  BenchReport take() { return std::move(report_); }

 private:
  static constexpr const char* kInterval = "interval";
  static constexpr const char* kEstimate = "estimate";

  static std::string labelOf(const std::string& name, double degrees, const std::string& method) {
    return name + ", " + numberText(degrees, 2) + "°, " + method;
  }

  /// Whether a label has all the parts, which commas separate, of what is asked for.
  bool isWanted(const std::string& label) const {
    std::istringstream parts(options_.only);
    for (std::string part; std::getline(parts, part, ',');) {
      if (label.find(part) == std::string::npos) return false;
    }
    return true;
  }

  void addAngle(const std::string& name, const PoseScene& scene, double degrees) {
    const PoseError error = scene.error(degrees);
    const double sample_ms = scene.sampleTime(error, options_.seed);
    if (isWanted(labelOf(name, degrees, kInterval))) {
      ProbabilityRequest interval = requestOf(ProbabilityMethod::interval, 0.1, options_.seed);
      interval.time_limit = 30.0 * sample_ms * static_cast<double>(kCounted) / 1000.0;
      addInterval(name, degrees, scene.query(error, interval), sample_ms);
    }
    if (!isWanted(labelOf(name, degrees, kEstimate))) return;
    for (const double tolerance : {0.01, 0.003}) {
      const auto timed =
          scene.query(error, requestOf(ProbabilityMethod::estimate, tolerance, options_.seed));
      const bool calibrated = tolerance == 0.01 && options_.cases > 1;
      addEstimate(name, degrees, tolerance, timed, sample_ms,
                  calibrated ? numberText(calibration(scene, error), 3) : "");
    }
  }

  double calibration(const PoseScene& scene, const PoseError& error) const {
    const double truth =
        scene.query(error, requestOf(ProbabilityMethod::estimate, 0.001, ~options_.seed))
            .result.probability();
    double sum = 0.0;
    for (std::size_t i = 0; i < options_.cases; ++i) {
      const ProbabilityResult result =
          scene.query(error, requestOf(ProbabilityMethod::estimate, 0.01, options_.seed + i))
              .result;
      const double ratio = (*result.estimate - truth) / *result.standard_error;
      sum += ratio * ratio;
    }
    return std::sqrt(sum / static_cast<double>(options_.cases));
  }

  void addInterval(const std::string& name, double degrees, const TimedResult& timed,
                   double sample_ms) {
    const Bounds interval{*timed.result.lower, *timed.result.upper};
    add(name, degrees, "interval 10 %", interval.middle(),
        0.5 * interval.width() / interval.middle(), timed,
        sample_ms * static_cast<double>(kCounted), "");
  }

  void addEstimate(const std::string& name, double degrees, double tolerance,
                   const TimedResult& timed, double sample_ms, const std::string& calibration) {
    const double p = *timed.result.estimate;
    const double error = *timed.result.standard_error;
    add(name, degrees, "estimate " + numberText(100.0 * tolerance, 2) + " %", p, error / p, timed,
        countingTime(sample_ms, p, error), calibration);
  }

  void add(const std::string& name, double degrees, const std::string& method, double p,
           double error, const TimedResult& timed, double counting_ms,
           const std::string& calibration) {
    const std::string status = toString(timed.result.status);
    const double ratio = timed.time_ms / counting_ms;
    report_.table.add({name, numberText(degrees, 2) + "°", method, numberText(p, 4),
                       numberText(error, 2), numberText(timed.time_ms, 3),
                       numberText(counting_ms, 3), numberText(ratio, 2), calibration, status});
    report_.records.push_back({{"scene", name},
                               {"degrees", degrees},
                               {"method", method},
                               {"probability", p},
                               {"relative_error", error},
                               {"time_ms", timed.time_ms},
                               {"counting_ms", counting_ms},
                               {"ratio", ratio},
                               {"calibration", calibration},
                               {"status", status}});
  }

  const BenchOptions& options_;
  BenchReport report_;
};

}  // namespace

BenchReport benchPose(const BenchOptions& options, const BenchProgress& progress) {
  const std::string kJoints = "fetch_arm";
  PoseTable table(options);
  double done = 0.0;
  const auto goOn = [&](const std::string& what) { return progress(done++ / 28.0, what); };
  for (const BenchScene& scene : benchScenes()) {
    if (!table.addScene(scene, goOn)) return table.take();
  }
  for (const double degrees : {0.2, 0.5, 1.0, 2.0}) {
    if (!goOn(kJoints + ", " + numberText(degrees, 2) + "°")) break;
    table.addJoints(kJoints, degrees);
  }
  return table.take();
}

}  // namespace fcl_prob::cli
