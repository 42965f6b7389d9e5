// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "bench/table1_rows.h"

#include <cmath>

#include "base/stopwatch.h"
#include "bench/fcl_loop.h"
#include "bench/uniforms.h"
#include "bench/volume_trees.h"
#include "cli/number_text.h"
#include "cli/parts_scene.h"
#include "cli/prior_runs.h"
#include "paper/part_bounding_tree.h"

namespace fcl_prob::cli {
namespace {

constexpr double kConfidence = 0.99;  // δ of the paper
constexpr std::size_t kOtherCounts[] = {2, 5, 12, 96};
constexpr std::size_t kMonteCarloSamples = 10'000;

const TriangleMesh& meshOf(const LoadedObject& object) {
  return std::get<TriangleMesh>(object.shape);
}

Table1Row plainRow(const std::string& name, RowKind kind, double value, double time_ms) {
  Table1Row row;
  row.method = name;
  row.kind = kind;
  row.value = value;
  row.time_ms = time_ms;
  return row;
}

double volumeOfLeaves(const PartTree& tree) {
  double sum = 0.0;
  for (std::size_t node = 0; node < tree.nodeCount(); ++node) {
    if (tree.tree().isLeaf(static_cast<int>(node))) sum += tree.volume(node);
  }
  return sum;
}

/// Both methods with spheres, in both reaches, and enlargement at 95 %.
std::vector<PriorRun> priorRuns() {
  using Method = PriorMethod;
  return {{Method::du_toit_burdick, PriorReach::objects},
          {Method::du_toit_burdick, PriorReach::trees},
          {Method::park, PriorReach::objects},
          {Method::park, PriorReach::trees},
          {Method::enlargement, PriorReach::objects, 0.95}};
}

/// Mean and standard error of numbers that come one by one.
class Mean {
 public:
  void add(double value) {
    sum_ += value;
    squares_ += value * value;
    ++count_;
  }
  double value() const { return sum_ / count_; }
  double standardError() const {
    return std::sqrt(std::max(0.0, squares_ / count_ - value() * value()) / count_);
  }

 private:
  double sum_ = 0.0;
  double squares_ = 0.0;
  double count_ = 0.0;
};

}  // namespace

struct Table1Scene::MeshPair {
  TriangleMesh a;
  TriangleMesh b;
  fcl::Transform3d pose_a;
  fcl::Transform3d pose_b;
  GaussianDisplacement displacement;

  MeshPair turned(const Eigen::Matrix3d& turn) const {
    MeshPair result{rotated(a, turn), rotated(b, turn), pose_a, pose_b, displacement.rotated(turn)};
    result.pose_a.translation() = turn * pose_a.translation();
    result.pose_b.translation() = turn * pose_b.translation();
    return result;
  }
};

struct Table1Scene::TreeBounds {
  double root_volume = 0.0;
  double level_volume = 0.0;
  GeneralPcdResult sum;
  GeneralPcdResult minimum;
  double sum_ms = 0.0;
  double minimum_ms = 0.0;
};

struct Table1Scene::PartsPair {
  ConvexParts a;
  ConvexParts b;

  std::string counts() const {
    return std::to_string(a.size()) + " and " + std::to_string(b.size()) + " parts";
  }
};

std::string toString(RowKind kind) {
  switch (kind) {
    case RowKind::upper_bound:
      return "upper bound";
    case RowKind::interval:
      return "certified interval";
    case RowKind::estimate:
      return "estimate";
    case RowKind::approximation:
      return "approximation";
  }
  throw InvalidRequest("not a RowKind");
}

const std::vector<std::string>& volumesOfTable1() {
  static const std::vector<std::string> rows{"sphere", "aabb",   "rss",    "kios",
                                             "obb",    "obbrss", "kdop16", "kdop18",
                                             "kdop24", "kdop26", "convex"};
  return rows;
}

Table1Scene::Table1Scene(const PreparedScene& scene)
    : scene_(scene),
      enclosed_volume_(enclosedVolume(meshOf(scene.objectA()))),
      hull_volume_(hullVolume(meshOf(scene.objectA()))) {}

Table1Scene::MeshPair Table1Scene::meshes() const {
  return {meshOf(scene_.objectA()), meshOf(scene_.objectB()), scene_.objectA().pose,
          scene_.objectB().pose, scene_.displacement()};
}

Table1Scene::TreeBounds Table1Scene::boundByTrees(const std::string& volume,
                                                  const MeshPair& pair) const {
  const std::unique_ptr<VolumeTrees> trees = makeVolumeTrees(volume, pair.a, pair.b);
  const std::vector<double> volumes = trees->volumes(kBveLevel + 1);
  TreeBounds bounds;
  bounds.root_volume = volumes.front();
  bounds.level_volume = volumes.back();
  GeneralPcdRequest request;
  request.confidence = kConfidence;
  detail::Stopwatch watch;
  bounds.sum = trees->bound(pair.pose_a, pair.pose_b, pair.displacement, request);
  bounds.sum_ms = watch.milliseconds();
  request.variant = GeneralPcdVariant::minimum;
  watch = detail::Stopwatch();
  bounds.minimum = trees->bound(pair.pose_a, pair.pose_b, pair.displacement, request);
  bounds.minimum_ms = watch.milliseconds();
  return bounds;
}

Table1Row Table1Scene::rowOf(const std::string& name, const TreeBounds& bounds,
                             const std::string& published_as) const {
  Table1Row row = plainRow(name, RowKind::upper_bound, bounds.sum.upper, bounds.sum_ms);
  row.root_error = bounds.root_volume / enclosed_volume_;
  row.hull_error = bounds.root_volume / hull_volume_;
  row.level_error = bounds.level_volume / enclosed_volume_;
  row.raw_sum = bounds.sum.raw_sum;
  row.minimum = bounds.minimum.upper;
  row.minimum_time_ms = bounds.minimum_ms;
  row.published_as = published_as;
  return row;
}

Table1Row Table1Scene::volumeRow(const std::string& volume) const {
  return rowOf(volume + ", triangles", boundByTrees(volume, meshes()));
}

Table1Scene::PartsPair Table1Scene::parts(std::size_t count) const {
  DecompositionRequest request;
  request.max_parts = count;
  return {ConvexParts(meshOf(scene_.objectA()), request),
          ConvexParts(meshOf(scene_.objectB()), request)};
}

Table1Row Table1Scene::partsRow(const std::string& volume, const PartsPair& parts) const {
  const PartTree a(parts.a, partVolumeFromString(volume));
  const PartTree b(parts.b, partVolumeFromString(volume));
  const auto bound = [&](GeneralPcdVariant variant, double& time_ms) {
    GeneralPcdRequest request;
    request.confidence = kConfidence;
    request.variant = variant;
    const detail::Stopwatch watch;
    const GeneralPcdResult result = generalPcd(a, scene_.objectA().pose, b, scene_.objectB().pose,
                                               scene_.displacement(), request);
    time_ms = watch.milliseconds();
    return result;
  };
  TreeBounds bounds;
  bounds.root_volume = a.volume(0);
  bounds.sum = bound(GeneralPcdVariant::sum, bounds.sum_ms);
  bounds.minimum = bound(GeneralPcdVariant::minimum, bounds.minimum_ms);
  Table1Row row = rowOf(volume + ", parts", bounds, volume);
  row.level_error.reset();
  row.leaf_error = volumeOfLeaves(a) / enclosed_volume_;
  row.remark =
      parts.counts() + ", " + std::to_string(bounds.sum.pairs_summed) + " pairs in the sum";
  return row;
}

Table1Row Table1Scene::partsBoundsRow(const PartsPair& parts) const {
  const detail::Stopwatch watch;
  const PartsBoundsResult bounds = partsBounds(parts.a, scene_.objectA().pose, parts.b,
                                               scene_.objectB().pose, scene_.displacement());
  Table1Row row =
      plainRow(kPartsBounds, RowKind::upper_bound, bounds.any.upper, watch.milliseconds());
  row.raw_sum = bounds.sum;
  row.remark = parts.counts() + ", " + std::to_string(bounds.pairs) + " pairs, " +
               std::to_string(bounds.intersections) + " intersections; P of the parts at least " +
               numberText(bounds.any.lower, 4);
  return row;
}

std::vector<Table1Row> Table1Scene::partsRows() const {
  const PartsPair many = parts(DecompositionRequest().max_parts);
  std::vector<Table1Row> rows;
  for (const std::string& volume : volumesOfTable1()) rows.push_back(partsRow(volume, many));
  for (const std::size_t count : kOtherCounts) {
    rows.push_back(partsRow("convex", parts(count)));
    rows.back().method = "convex, " + std::to_string(count) + " parts";
  }
  rows.push_back(partsBoundsRow(many));
  return rows;
}

double Table1Scene::meanBoxVolume(std::size_t frames, std::uint64_t seed) const {
  const TriangleMesh& mesh = meshOf(scene_.objectA());
  Mean volume;
  for (std::size_t i = 0; i < frames; ++i) {
    const Eigen::Matrix3d turn = randomRotation(seed, i);
    Eigen::AlignedBox3d box;
    for (const fcl::Vector3d& vertex : mesh.vertices) box.extend(turn * vertex);
    volume.add(box.volume());
  }
  return volume.value();
}

Table1Row Table1Scene::frameRow(std::size_t frames, std::uint64_t seed) const {
  const MeshPair pair = meshes();
  Mean level, upper, sum, minimum, sum_ms, minimum_ms;
  for (std::size_t i = 0; i < frames; ++i) {
    const TreeBounds bounds = boundByTrees("aabb", pair.turned(randomRotation(seed, i)));
    level.add(bounds.level_volume);
    upper.add(bounds.sum.upper);
    sum.add(bounds.sum.raw_sum);
    minimum.add(bounds.minimum.upper);
    sum_ms.add(bounds.sum_ms);
    minimum_ms.add(bounds.minimum_ms);
  }
  TreeBounds mean;
  mean.root_volume = meanBoxVolume(std::max(frames, kBveFrames), seed);
  mean.level_volume = level.value();
  mean.sum.upper = upper.value();
  mean.sum.raw_sum = sum.value();
  mean.sum_ms = sum_ms.value();
  mean.minimum.upper = minimum.value();
  mean.minimum_ms = minimum_ms.value();
  Table1Row row = rowOf("aabb, random frames", mean);
  row.remark = "mean of " + std::to_string(frames) + " frames; raw sum ± " +
               numberText(sum.standardError(), 2) + ", min ± " +
               numberText(minimum.standardError(), 2);
  return row;
}

std::vector<Table1Row> Table1Scene::priorRows() const {
  const PriorScene prior(scene_);
  std::vector<Table1Row> rows;
  for (const PriorRun& run : priorRuns()) {
    const PriorAnswer answer = prior.answer(run);
    const bool approximates = run.method == PriorMethod::du_toit_burdick;
    Table1Row row = plainRow(toString(run.method) + ", " + run.budget(),
                             approximates ? RowKind::approximation : RowKind::upper_bound,
                             answer.value, answer.time_ms);
    row.raw_sum = answer.raw;
    row.remark = answer.remark;
    if (run.reach == PriorReach::trees) row.published_as = "sphere";
    if (run.method == PriorMethod::park && run.reach == PriorReach::trees) {
      PriorRun minimum = run;
      minimum.variant = GeneralPcdVariant::minimum;
      const PriorAnswer least = prior.answer(minimum);
      row.minimum = least.value;
      row.minimum_time_ms = least.time_ms;
    }
    rows.push_back(row);
  }
  return rows;
}

Table1Row Table1Scene::monteCarloRow(std::uint64_t seed) const {
  const FclLoop loop = timeFclLoop(scene_, kMonteCarloSamples, seed);
  Table1Row row = plainRow("10,000 fcl::collide", RowKind::estimate, loop.estimate(), loop.time_ms);
  row.published_as = "monte-carlo";
  const double p = loop.estimate();
  const double error = std::sqrt(p * (1.0 - p) / static_cast<double>(kMonteCarloSamples));
  row.remark = "standard error " + numberText(100.0 * error / p, 2) + " %";
  return row;
}

Table1Row Table1Scene::queryRow(const std::string& name, const ProbabilityRequest& request,
                                RowKind kind) const {
  const TimedResult timed = scene_.query(request);
  Table1Row row = plainRow(name, kind, timed.result.probability(), timed.time_ms);
  row.remark = toString(timed.result.status) + ", [" + numberText(*timed.result.lower, 6) + ", " +
               numberText(*timed.result.upper, 6) + "]";
  return row;
}

Table1Row Table1Scene::intervalRow(double relative_tolerance) const {
  ProbabilityRequest request;
  request.method = ProbabilityMethod::interval;
  request.relative_tolerance = relative_tolerance;
  request.absolute_tolerance = 0.0;
  return queryRow("interval " + numberText(100.0 * relative_tolerance, 2) + " %", request,
                  RowKind::interval);
}

Table1Row Table1Scene::estimateRow(double relative_tolerance, std::uint64_t seed) const {
  ProbabilityRequest request;
  request.method = ProbabilityMethod::estimate;
  request.relative_tolerance = relative_tolerance;
  request.absolute_tolerance = 0.0;
  request.seed = seed;
  return queryRow("estimate " + numberText(100.0 * relative_tolerance, 2) + " %", request,
                  RowKind::estimate);
}

}  // namespace fcl_prob::cli
