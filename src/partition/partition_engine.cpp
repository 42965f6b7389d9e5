// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "partition/partition_engine.h"

#include <algorithm>
#include <cmath>

#include "gaussian/constants.h"
#include "partition/band_margin.h"
#include "partition/cell_split.h"
#include "partition/rounded_sum.h"
#include "partition/turning_margin.h"

namespace fcl_prob::detail {

namespace {

bool smallerGap(const OpenCell& x, const OpenCell& y) { return x.gap() < y.gap(); }

// A child with more than this share of its ancestor's gap is divided with it. Measured: from 0.1 to
// 0.4 all scenes are 5 to 15 % faster than with none.
constexpr double kSoon = 0.2;

// Not deeper than this, so that limits are looked at often enough.
constexpr int kSoonLevels = 4;

// Samples drawn for every cell examined. Measured on the benchmark scenes: with 25 an estimate
// takes half the time that it takes with the least number; from 15 to 40 it hardly matters.
constexpr double kSamplesPerCell = 25;

// The same for samples that are tested against convex objects taken whole, which takes a third of
// the time. Measured on robot parts beside an arm: 25, 50, 100 and 200 take 9.9, 8.8, 9.4 and 11
// ms.
constexpr double kQuickSamplesPerCell = 50;

// The standard deviation of samples, which lie evenly in their cells, over the bound on that of
// samples drawn anywhere in them. Measured on the benchmark scenes: 0.4 to 0.7. Where it turns out
// larger more samples are drawn, so that a little more than half is quickest.
constexpr double kDeviationShare = 0.6;

// With bands around the shapes, cells after which the interval is looked at, again whenever there
// are twice as many: what has left this share of its width is all that bands leave.
constexpr std::size_t kFirstLookAtBand = 4000;
constexpr double kStalled = 0.97;

// Sweeps can be made shorter, which helps more than cells once they are about half of the width:
// without them twice as many cells leave about 0.6 of it.
constexpr std::size_t kFirstLookAtSweeps = 500;
constexpr double kStalledBySweeps = 0.75;

// The density changes over one standard deviation, a smaller C-obstacle over its own width.
Eigen::Vector3d scalesOf(const WhitenedPair& pair) {
  const NodeBox box = obstacleBox(pair, {0, 0});
  Eigen::Vector3d scales;
  for (int k = 0; k < 3; ++k) scales[k] = std::clamp(box.hi[k] - box.lo[k], 1e-100, 1.0);
  return scales;
}

}  // namespace

PartitionEngine::PartitionEngine(const WhitenedPair& pair, int rank, const SolidContact* solids,
                                 const BallTruncation* ball, const ProbabilityRequest& request,
                                 ProbabilityStatistics& statistics)
    : request_(request),
      statistics_(statistics),
      obstacles_(pair),
      examiner_(pair, obstacles_, solids, request.gradient, statistics),
      ball_(ball),
      scales_(scalesOf(pair)),
      band_(pair.band),
      turning_(pair.turning),
      next_look_(band_ && band_->isOfSweeps() ? kFirstLookAtSweeps : kFirstLookAtBand),
      limits_(request, statistics) {
  Cell root{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), rank};
  const double reach = ball ? std::min(kReach, 1.001 * ball->radius()) : kReach;
  for (int i = 0; i < rank; ++i) {
    root.lo[i] = -reach;
    root.hi[i] = reach;
  }
  // Two single pieces are a pair of leaves from the start: there is nothing to expand.
  const NodePair roots{0, 0};
  add(examine(root, {{roots, areLeaves(pair, roots) ? obstacles_.find(roots) : -1}}));
}

Examination PartitionEngine::examine(const Cell& cell, const std::vector<FrontPair>& inherited) {
  if (!ball_ || ball_->isInBall(cell)) return examiner_.examine(cell, inherited);
  if (ball_->missesBall(cell)) return {};
  return ball_->truncated(cell, inherited, examiner_.examine(cell, inherited));
}

void PartitionEngine::add(Examination&& examination) {
  settled_ += examination.settled;
  if (!examination.open) return;
  OpenCell& cell = *examination.open;
  if ((band_ && band_->isAllThatIsLeft(cell)) || (turning_ && turning_->isAllThatIsLeft(cell))) {
    left_by_band_ += cell.gap();
    return settleAsItIs(cell);
  }
  open_.lower += cell.lower;
  open_.upper += cell.upper;
  open_deviation_ += cell.samplingDeviation();
  cell_memory_ += cell.memory();
  queue_.push_back(std::move(cell));
  std::push_heap(queue_.begin(), queue_.end(), smallerGap);
}

// Its gap stays for good.
void PartitionEngine::settleAsItIs(const OpenCell& cell) {
  settled_.mass.lower += cell.lower;
  settled_.mass.upper += cell.upper;
  settled_.moment_error += cell.upper * (1.0 + kReach);
}

void PartitionEngine::remove(const OpenCell& cell) {
  open_.lower -= cell.lower;
  open_.upper -= cell.upper;
  open_deviation_ -= cell.samplingDeviation();
  cell_memory_ -= cell.memory();
}

void PartitionEngine::divideLargest() {
  std::pop_heap(queue_.begin(), queue_.end(), smallerGap);
  const OpenCell largest = std::move(queue_.back());
  queue_.pop_back();
  remove(largest);
  divide(largest, kSoon * largest.gap(), kSoonLevels, 0);
}

// Children whose gap is not much smaller would soon be taken from the queue: dividing them at once,
// as long as the data of their front are at hand, saves most of the memory traffic.
void PartitionEngine::divide(const OpenCell& parent, double soon, int levels, std::size_t awaited) {
  const CellSplit split = chooseSplit(parent, scales_);
  if (split.axis < 0) {
    indivisible_ = true;
    return settleAsItIs(parent);
  }
  for (const bool upper : {false, true}) {
    Cell half = parent.cell;
    (upper ? half.lo : half.hi)[split.axis] = split.at;
    Examination examination = examine(half, parent.front);
    // The other half is still to be examined.
    const std::size_t then = upper ? awaited : awaited + 1;
    if (examination.open && levels > 0 && examination.open->gap() > soon && hasCellsLeft(then)) {
      const OpenCell child = std::move(*examination.open);
      examination.open.reset();
      add(std::move(examination));
      divide(child, soon, levels - 1, then);
    } else {
      add(std::move(examination));
    }
  }
}

// Sums of many additions and removals drift: every so often they are taken anew.
void PartitionEngine::recount() {
  open_ = {0.0, 0.0};
  open_deviation_ = 0.0;
  for (const OpenCell& cell : queue_) {
    open_.lower += cell.lower;
    open_.upper += cell.upper;
    open_deviation_ += cell.samplingDeviation();
  }
  changes_since_recount_ = 0;
}

// The sums of up to `cells` rounded terms each, with up to as many removals since the last recount.
Bounds PartitionEngine::interval() const {
  return roundedSum(settled_.mass.lower + open_.lower, settled_.mass.upper + open_.upper,
                    4.0 * static_cast<double>(statistics_.cells) + 16.0);
}

MomentBounds PartitionEngine::moment() const {
  MomentBounds bounds{settled_.moment, settled_.moment};
  // What is no double here may be one after the division by a deviation.
  double error = settled_.moment_error + kUnderflow;
  for (const OpenCell& open : queue_) {
    const SettledMass part = examiner_.coveredPart(open);
    error += part.moment_error;
    for (int k = 0; k < open.cell.rank; ++k) {
      bounds.lower[k] += part.moment[k] + std::min(open.cell.lo[k], 0.0) * open.gap();
      bounds.upper[k] += part.moment[k] + std::max(open.cell.hi[k], 0.0) * open.gap();
    }
  }
  bounds.lower.array() -= error;
  bounds.upper.array() += error;
  return bounds;
}

std::optional<ProbabilityStatus> PartitionEngine::satisfied(bool estimate) const {
  const Bounds now = interval();
  if (request_.threshold) {
    if (now.upper < *request_.threshold || now.lower > *request_.threshold) {
      return ProbabilityStatus::decided;
    }
  }
  if (queue_.empty() && !(left_by_band_ > 0.0)) {
    return indivisible_ ? ProbabilityStatus::resolution_limit : ProbabilityStatus::exact;
  }
  const double tolerance = request_.toleranceAt(now.upper);
  if (now.width() <= tolerance) return ProbabilityStatus::converged;
  const bool all_is_band = queue_.empty() || now.width() - left_by_band_ <= tolerance || stalled_;
  if ((band_ || turning_) && all_is_band) return ProbabilityStatus::band_limit;
  if (estimate && samplesNeeded() <= samplesAffordable()) return ProbabilityStatus::converged;
  return std::nullopt;
}

double PartitionEngine::targetError(double probability) const {
  return request_.toleranceAt(probability);
}

EngineEstimate PartitionEngine::estimate(const SampledMass& sampled) const {
  const Bounds bounds = interval();
  const double error = std::hypot(sampled.standardError(), 0.5 * settled_.mass.width());
  if (!(error < 0.5 * bounds.width())) return {bounds.middle(), 0.5 * bounds.width()};
  double mass = settled_.mass.middle() + sampled.mass;
  for (const OpenCell& cell : queue_) mass += cell.lower;
  return {std::clamp(mass, bounds.lower, bounds.upper), error};
}

// With n_i samples in cell i in proportion to the deviations s_i, the variance is (Σ s_i)² / Σ n_i
// (Neyman 1934).
double PartitionEngine::samplesNeeded() const {
  if (!(open_deviation_ > 0.0)) return 0.0;  // the target may be 0, too: P below the least double
  const double ratio =
      kDeviationShare * deviation_share_ * open_deviation_ / targetError(interval().middle());
  return ratio * ratio;
}

double PartitionEngine::samplesAffordable() const {
  return (quick_samples_ ? kQuickSamplesPerCell : kSamplesPerCell) *
         static_cast<double>(statistics_.cells);
}

double PartitionEngine::samplesToDraw(ProbabilityStatus status) const {
  if (status == ProbabilityStatus::time_limit || status == ProbabilityStatus::cancelled) return 0.0;
  return std::min(samplesNeeded(), samplesAffordable());
}

std::size_t PartitionEngine::memory() const { return obstacles_.memory() + cell_memory_; }

std::optional<ProbabilityStatus> PartitionEngine::interruption() const {
  return limits_.interruption(interval());
}

// Dividing a cell examines two.
bool PartitionEngine::hasCellsLeft(std::size_t awaited) const {
  return statistics_.cells < request_.max_cells &&
         request_.max_cells - statistics_.cells >= awaited + 2;
}

std::optional<ProbabilityStatus> PartitionEngine::limited(bool estimate) const {
  if (memory() >= request_.max_memory) return ProbabilityStatus::memory_limit;
  return limits_.interruption(interval(), estimate ? EngineLimits::kShareForDividing : 1.0);
}

void PartitionEngine::lookAtBand() {
  if (statistics_.cells < next_look_) return;
  next_look_ = 2 * statistics_.cells;
  const Bounds now = interval();
  const double stalled = band_->isOfSweeps() ? kStalledBySweeps : kStalled;
  stalled_ = now.width() > stalled * at_last_look_.width();
  at_last_look_ = now;
}

ProbabilityStatus PartitionEngine::run(bool estimate) {
  std::optional<ProbabilityStatus> status;
  for (std::size_t step = 0; !status; ++step) {
    if (band_) lookAtBand();
    if (++changes_since_recount_ * 4 > queue_.size()) recount();
    status = satisfied(estimate);
    if (status && changes_since_recount_ > 0) {
      recount();
      status = satisfied(estimate);
    }
    if (!status && !hasCellsLeft(0)) status = ProbabilityStatus::cell_limit;
    if (!status && step % EngineLimits::kCellsBetweenPolls == 0) status = limited(estimate);
    if (!status) divideLargest();
    statistics_.peak_memory = std::max(statistics_.peak_memory, memory());
  }
  recount();
  statistics_.cells_open = queue_.size();
  statistics_.leaf_pairs = obstacles_.pairCount();
  return *status;
}

}  // namespace fcl_prob::detail
