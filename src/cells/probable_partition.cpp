// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cells/probable_partition.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/random_words.h"

namespace fcl_prob::detail {
namespace {

// Cells before the first samples, and by how many times more there are at every look.
constexpr std::size_t kFirstCells = 16;
constexpr std::size_t kMoreCells = 2;

// Samples of a look for every cell so far, and of its first batch.
constexpr std::size_t kSamplesOfCell = 24;
constexpr std::size_t kFirstBatch = 64;

// Σ 1/k² = π²/6
constexpr double kShareOfFirstLook = 0.60792710185402663;

// Of the masses of what planes cover, and of the sums of all that is certain.
constexpr double kCoveredAccuracy = 1e-5;
constexpr double kRoundedMasses = 1e-9;

// Cells are divided until a decision or a limit: an interval that is as narrow as rounding leaves
// it has met one, however small P is.
constexpr double kNoTolerance = 1e-15;

/// All that is random about one sample.
struct RandomSample {
  double cell;
  double counted;
  Eigen::Vector3d point;
};

RandomSample randomSample(std::uint64_t seed, std::uint64_t number) {
  const RandomStream stream{seed, 0x70726f62};
  const std::array<std::uint64_t, 4> point = randomWords(stream, number, 0);
  const std::array<std::uint64_t, 4> other = randomWords(stream, number, 1);
  return {unitUniform(other[0]),
          unitUniform(other[1]),
          {unitUniform(point[0]), unitUniform(point[1]), unitUniform(point[2])}};
}

// More of what one plane covers than the open cell counts.
double uncountedOf(const OpenCell& open) {
  if (!open.planeCovers()) return 0.0;
  const Bounds mass = cellHalfSpaceMass(open.cell, open.plane.m, open.plane.s, kCoveredAccuracy);
  return mass.upper - mass.lower;
}

}  // namespace

ProbablePartition::ProbablePartition(const PartitionObject& a, const PartitionObject& b,
                                     const GaussianDisplacement& displacement,
                                     const ProbabilityRequest& request, double error)
    : request_(request),
      error_(error),
      scene_(a, b, displacement, request),
      most_cells_(std::min(request.max_cells, kFirstCells)) {
  request_.relative_tolerance = kNoTolerance;
  request_.absolute_tolerance = 0.0;
  const PartitionScene boxes{scene_.pair(),
                             scene_.rank(),
                             scene_.solids(),
                             nullptr,
                             request_.gradient,
                             true,
                             request_.relative_tolerance};
  engine_ = std::make_unique<PartitionEngine>(boxes, request_, budget_, statistics_);
  tester_ = std::make_unique<PointTester>(scene_.pair(), engine_->obstacles(), scene_.solids());
}

std::optional<ProbabilityStatus> ProbablePartition::improve(const std::function<bool()>& enough) {
  const auto stopped = divide();
  if (enough()) return std::nullopt;
  if (engine_->openCells().empty()) return stopped ? stopped : ProbabilityStatus::exact;
  beginLook();
  const std::size_t most = kSamplesOfCell * statistics_.cells;
  std::size_t batch = std::min(kFirstBatch, most);
  while (batch > 0) {
    draw(batch);
    narrow();
    if (enough()) return std::nullopt;
    if (const auto interrupted = engine_->interruption()) return interrupted;
    batch = std::min(look_.sure.samples(), most - look_.sure.samples());
  }
  return stopped;
}

// A limit on the cells of this look only is none.
std::optional<ProbabilityStatus> ProbablePartition::divide() {
  const ProbabilityStatus status = engine_->run(false, most_cells_);
  certified_ = engine_->interval();
  narrowTo(certified_);
  if (status == ProbabilityStatus::decided) return std::nullopt;
  if (status == ProbabilityStatus::cell_limit && most_cells_ < request_.max_cells) {
    most_cells_ = std::min(request_.max_cells, kMoreCells * most_cells_);
    return std::nullopt;
  }
  return status == ProbabilityStatus::converged ? ProbabilityStatus::resolution_limit : status;
}

void ProbablePartition::beginLook() {
  const auto k = static_cast<double>(++looks_);
  look_ = {};
  look_.error = kShareOfFirstLook * error_ / (k * k);
  look_.certain = engine_->settled().mass;
  double sum = 0.0;
  for (const OpenCell& open : engine_->openCells()) {
    look_.certain.lower += open.lower;
    look_.certain.upper += open.lower + uncountedOf(open);
    sum += largestWeight(open);
    look_.so_far.push_back(sum);
  }
  look_.certain.lower = std::max(0.0, look_.certain.lower * (1.0 - kRoundedMasses));
  look_.certain.upper *= 1.0 + kRoundedMasses;
}

// Samples of one cell are tested together.
void ProbablePartition::draw(std::size_t count) {
  struct Drawn {
    std::size_t cell;
    RandomSample random;
  };
  std::vector<Drawn> drawn;
  for (std::size_t i = 0; i < count; ++i) {
    const RandomSample random = randomSample(request_.seed, drawn_++);
    const auto at = std::upper_bound(look_.so_far.begin(), look_.so_far.end(),
                                     random.cell * look_.so_far.back());
    const auto cell = static_cast<std::size_t>(at - look_.so_far.begin());
    drawn.push_back({std::min(cell, look_.so_far.size() - 1), random});
  }
  std::stable_sort(drawn.begin(), drawn.end(),
                   [](const Drawn& x, const Drawn& y) { return x.cell < y.cell; });
  std::size_t sure = 0, possible = 0;
  std::vector<TestedPoint> points;
  for (std::size_t i = 0; i < drawn.size();) {
    const std::size_t cell = drawn[i].cell;
    const OpenCell& open = engine_->openCells()[cell];
    const PartMeasure measure(open.cell);
    const double largest = largestWeight(open);
    points.clear();
    for (; i < drawn.size() && drawn[i].cell == cell; ++i) {
      const CellDraw one = drawFrom(open, drawn[i].random.point);
      const bool counted =
          drawn[i].random.counted * largest < one.weight && !measure.counts(open.part, one.point);
      if (counted) points.push_back({one.point, false, false});
    }
    tester_->test(open.front, points);
    for (const TestedPoint& point : points) {
      possible += point.collides;
      sure += point.collides && !point.doubtful;
    }
  }
  look_.sure.add(sure, count);
  look_.possible.add(possible, count);
  statistics_.samples += count;
  statistics_.hits += sure;
}

// Half of the chance for each end.
void ProbablePartition::narrow() {
  const double weight = look_.so_far.back();
  const double lower = look_.sure.interval(0.5 * look_.error).lower;
  const double upper = look_.possible.interval(0.5 * look_.error).upper;
  narrowTo({look_.certain.lower + weight * lower, look_.certain.upper + weight * upper});
}

// Where nothing is left one of the looks has failed: only what is certain is then kept.
void ProbablePartition::narrowTo(const Bounds& bounds) {
  probable_ = {std::max(probable_.lower, bounds.lower), std::min(probable_.upper, bounds.upper)};
  if (probable_.lower > probable_.upper) probable_ = certified_;
}

}  // namespace fcl_prob::detail
