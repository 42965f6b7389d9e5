// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// fcl_prob bench cloud: from rendered depth images to probabilities, against the true shapes; and
// real clouds, of which no truth is known.
#include <algorithm>
#include <filesystem>
#include <functional>

#include "base/stopwatch.h"
#include "bench/bench_clouds.h"
#include "bench/cloud_scenes.h"
#include "bench/depth_image.h"
#include "cli/number_text.h"

namespace fcl_prob::cli {
namespace {

constexpr std::size_t kScenesOfEach = 12;
constexpr double kDepths[] = {0.6, 1.2, 2.4};
constexpr double kCoverage = 0.95;

// Enough for 1 % of nearly all true shapes; where not, more has to be contained.
constexpr std::size_t kCellsWithoutBand = 30'000;

/// What came of one scene.
struct Outcome {
  Bounds truth;     ///< of the object itself
  Bounds plain;     ///< of its surface, without a band
  Bounds banded;    ///< what was not seen left free
  Bounds occupied;  ///< with the shadow
  double band = 0.0;
  double reconstruction_ms = 0.0;
  double query_ms = 0.0;
};

// What is certain of the truth must be in the interval, not merely touch it.
bool contains(const Bounds& interval, const Bounds& truth) {
  return interval.lower <= truth.lower && interval.upper >= truth.upper;
}

bool overlap(const Bounds& a, const Bounds& b) { return a.lower <= b.upper && a.upper >= b.lower; }

Outcome outcomeOf(const CloudScene& scene, const Geometry& finger, const SensorModel& sensor,
                  Uniforms& random) {
  const PointCloud cloud = renderedCloud(scene.object, DepthCamera(), sensor, random);
  ReconstructionRequest request;
  request.sensor = sensor;
  request.coverage = kCoverage;
  request.unseen = UnseenSpace::free;
  Outcome outcome;
  const detail::Stopwatch watch;
  const Reconstruction free = reconstruct(cloud, request);
  outcome.reconstruction_ms = watch.milliseconds();
  request.unseen = UnseenSpace::occupied;
  const Reconstruction occupied = reconstruct(cloud, request);

  const auto without_band = [&](const TriangleMesh& mesh) {
    ProbabilityRequest interval;
    interval.method = ProbabilityMethod::interval;
    interval.max_cells = kCellsWithoutBand;
    return askMesh(finger, scene.finger_pose, scene.displacement, mesh, interval).interval;
  };
  outcome.truth = without_band(scene.object);
  outcome.plain = without_band(free.surface);
  const CloudAnswer banded = askReconstruction(finger, scene.finger_pose, scene.displacement, free);
  outcome.banded = banded.interval;
  outcome.query_ms = banded.query_ms;
  outcome.occupied =
      askReconstruction(finger, scene.finger_pose, scene.displacement, occupied).interval;
  outcome.band = free.band.outward;
  return outcome;
}

class Row {
 public:
  explicit Row(std::vector<Outcome> outcomes) : outcomes_(std::move(outcomes)) {}

  double mean(const std::function<double(const Outcome&)>& value) const {
    double sum = 0.0;
    for (const Outcome& outcome : outcomes_) sum += value(outcome);
    return outcomes_.empty() ? 0.0 : sum / static_cast<double>(outcomes_.size());
  }

  std::size_t count(const std::function<bool(const Outcome&)>& holds) const {
    return static_cast<std::size_t>(std::count_if(outcomes_.begin(), outcomes_.end(), holds));
  }

  /// Median, 90 % and the worst.
  std::vector<double> spread(const std::function<double(const Outcome&)>& value) const {
    std::vector<double> values;
    for (const Outcome& outcome : outcomes_) values.push_back(value(outcome));
    return {quantile(values, 0.5), quantile(values, 0.9), quantile(values, 1.0)};
  }

  std::size_t scenes() const { return outcomes_.size(); }

 private:
  std::vector<Outcome> outcomes_;
};

std::string spreadText(const std::vector<double>& spread, int digits) {
  return numberText(spread[0], digits) + " / " + numberText(spread[1], digits) + " / " +
         numberText(spread[2], digits);
}

void report(const std::string& object, const std::string& sensor, const std::string& depth,
            const Row& row, BenchReport& report) {
  const double truth = row.mean([](const Outcome& o) { return o.truth.middle(); });
  const double bias =
      row.mean([](const Outcome& o) { return o.plain.middle() - o.truth.middle(); });
  const double band = row.mean([](const Outcome& o) { return o.band; });
  const std::size_t covered =
      row.count([](const Outcome& o) { return contains(o.banded, o.truth); });
  const std::size_t with_shadow =
      row.count([](const Outcome& o) { return contains(o.occupied, o.truth); });
  const std::size_t without = row.count([](const Outcome& o) { return overlap(o.plain, o.truth); });
  const auto width = row.spread([](const Outcome& o) { return o.banded.width(); });
  const auto width_occupied = row.spread([](const Outcome& o) { return o.occupied.width(); });
  const auto reconstruction = row.spread([](const Outcome& o) { return o.reconstruction_ms; });
  const auto query = row.spread([](const Outcome& o) { return o.query_ms; });
  report.table.add({object, sensor, depth, std::to_string(row.scenes()), numberText(truth, 3),
                    numberText(bias, 2), std::to_string(covered), std::to_string(with_shadow),
                    std::to_string(without), numberText(1e3 * band, 3), spreadText(width, 2),
                    spreadText(width_occupied, 2), spreadText(reconstruction, 3),
                    spreadText(query, 3)});
  report.records.push_back({{"object", object},
                            {"sensor", sensor},
                            {"depth", depth},
                            {"scenes", row.scenes()},
                            {"mean_probability", truth},
                            {"bias", bias},
                            {"covered", covered},
                            {"covered_occupied", with_shadow},
                            {"covered_without_band", without},
                            {"band", band},
                            {"width", width},
                            {"width_occupied", width_occupied},
                            {"reconstruction_ms", reconstruction},
                            {"query_ms", query}});
}

}  // namespace

BenchReport benchCloud(const BenchOptions& options, const BenchProgress& progress) {
  const std::filesystem::path models(options.models_folder);
  const Geometry finger = gripperFinger(models);
  BenchReport result;
  result.title = "Rendered depth images, a gripper's finger beside what was reconstructed";
  result.table = TextTable({"object", "sensor", "depth / m", "scenes", "P", "bias", "covered",
                            "occupied", "no band", "band / mm", "width", "width occupied",
                            "reconstruction / ms", "query / ms"});
  result.notes =
      "P: of the true shape, mean. bias: of the surface without a band. covered: in so many scenes "
      "the interval with a 95 % band, unseen space left free, contains all of the true shape's "
      "interval at 1 %; occupied: with the shadow as obstacle; no band: the plain surface's "
      "interval at 1 % overlaps it. width: of those intervals. Widths and times: median / 90 % / "
      "worst.\n";
  const std::vector<std::string> sensors{"kinect-nguyen", "kinect-khoshelham", "stereo"};
  const std::vector<NamedMesh> objects = seenObjects(models);
  const std::size_t scenes = options.quick ? 2 : kScenesOfEach;
  const double all = 27.0 * static_cast<double>(scenes);
  Uniforms random(options.seed);
  std::vector<Outcome> total;
  for (const NamedMesh& object : objects) {
    for (const std::string& name : sensors) {
      for (const double depth : kDepths) {
        const std::string what = object.name + " " + name + " " + numberText(depth, 2);
        if (what.find(options.only) == std::string::npos) continue;
        const SensorModel sensor = sensorModelFromString(name, DepthCamera().focal_length);
        std::vector<Outcome> outcomes;
        for (std::size_t i = 0; i < scenes; ++i) {
          if (!progress(static_cast<double>(total.size() + i) / all, what)) return result;
          const CloudScene scene = randomCloudScene(object.mesh, finger, depth, random);
          outcomes.push_back(outcomeOf(scene, finger, sensor, random));
        }
        total.insert(total.end(), outcomes.begin(), outcomes.end());
        report(object.name, name, numberText(depth, 2), Row(std::move(outcomes)), result);
      }
    }
  }
  if (!total.empty()) report("all", "", "", Row(std::move(total)), result);
  addRealClouds(finger, options, progress, result);
  return result;
}

}  // namespace fcl_prob::cli
