// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "partition/partition_engine.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/constants.h"
#include "base/decision.h"
#include "base/rounded_sum.h"
#include "cells/cell_split.h"
#include "cells/claim_observer.h"
#include "partition/band_stall.h"

namespace fcl_prob::detail {

namespace {

bool smallerGap(const OpenCell& x, const OpenCell& y) { return x.gap() < y.gap(); }

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

// Cells after which the interval is looked at, again whenever there are twice as many: what has
// left this share of its width is all that bands around the shapes leave, or, where not all axes
// move, a section that lies along a surface to within rounding. Else it leaves 0.7 or so.
constexpr std::size_t kFirstLook = 4000;
constexpr double kStalled = 0.97;

// Sweeps can be made shorter, which helps more than cells once they are about half of the width:
// without them twice as many cells leave about 0.6 of it.
constexpr std::size_t kFirstLookAtSweeps = 500;
constexpr double kStalledBySweeps = 0.75;

// As long as no more cells were examined and pairs tested than these, one cell is divided at a
// time: a few milliseconds, for which threads are not worth waking.
constexpr std::size_t kCellsOneByOne = 300;
constexpr std::size_t kPairsOneByOne = 50'000;

// Cells that are divided in a round: so many, or one in so many of the open ones.
constexpr std::size_t kMostOfRound = 32;
constexpr std::size_t kLeastOfRound = 4;
constexpr std::size_t kOpenOfRound = 8;

// Cells that are examined for one that is divided, about; and so many there have to be left for
// each of a round, so that the limit on them cuts few short.
constexpr std::size_t kCellsOfDivided = 6;
constexpr std::size_t kCellsLeftOfDivided = 16;

}  // namespace

PartitionEngine::PartitionEngine(const PartitionScene& scene, const ProbabilityRequest& request,
                                 ProbabilityStatistics& statistics)
    : scene_(scene),
      request_(request),
      statistics_(statistics),
      obstacles_(scene.pair),
      workers_(claim_observer ? 1 : request.threads, std::make_unique<Worker>(scene, obstacles_)),
      round_(1),
      band_(scene.pair.band),
      next_look_(band_ && band_->isOfSweeps() ? kFirstLookAtSweeps : kFirstLook),
      limits_(request, statistics) {
  Division root;
  workers_.first().divider.examineRoot(root);
  collectStatistics();
  add(root);
}

void PartitionEngine::add(Division& division) {
  indivisible_ = indivisible_ || division.indivisible;
  for (Examination& part : division.parts) add(std::move(part));
}

void PartitionEngine::add(Examination&& examination) {
  settled_ += examination.settled;
  if (!examination.open) return;
  OpenCell& cell = *examination.open;
  if (band_ && isAllBand(cell, *band_)) {
    left_by_band_ += cell.gap();
    settled_ += asItIs(cell);
    return;
  }
  open_.lower += cell.lower;
  open_.upper += cell.upper;
  open_deviation_ += cell.samplingDeviation();
  cell_memory_ += cell.memory();
  queue_.push_back(std::move(cell));
  std::push_heap(queue_.begin(), queue_.end(), smallerGap);
}

void PartitionEngine::remove(const OpenCell& cell) {
  open_.lower -= cell.lower;
  open_.upper -= cell.upper;
  open_deviation_ -= cell.samplingDeviation();
  cell_memory_ -= cell.memory();
}

// How many cells were divided.
std::size_t PartitionEngine::divideLargest(bool estimate) {
  const std::size_t count = takeLargest(estimate);
  divideTaken(count);
  collectStatistics();
  const CrossingWitness::Hint before = hint_;
  for (std::size_t i = 0; i < count; ++i) {
    add(round_[i].division);
    if (round_[i].hint != before) hint_ = round_[i].hint;
  }
  return count;
}

std::size_t PartitionEngine::mostOfRound() const {
  if (statistics_.cells < kCellsOneByOne && statistics_.pairs_tested < kPairsOneByOne) return 1;
  const std::size_t cells_left = request_.max_cells - statistics_.cells;
  const std::size_t most = std::clamp(queue_.size() / kOpenOfRound, kLeastOfRound, kMostOfRound);
  return std::clamp<std::size_t>(cells_left / kCellsLeftOfDivided, 1, most);
}

// No more than have to be divided in any case: if fewer were settled altogether, that would not be
// enough. Parts of the largest may have larger gaps than those that are much smaller.
std::size_t PartitionEngine::takeLargest(bool estimate) {
  const std::size_t most = mostOfRound();
  if (round_.size() < most) round_.resize(most);
  const double needed = missingWidth(interval(), request_);
  const double target = targetError(interval().middle());
  const double least = CellDivider::kSoon * queue_.front().gap();
  double taken = 0.0;
  std::size_t count = 0;
  bool may_be_enough = false;
  do {
    std::pop_heap(queue_.begin(), queue_.end(), smallerGap);
    OpenCell& cell = round_[count++].cell;
    cell = std::move(queue_.back());
    queue_.pop_back();
    remove(cell);
    taken += cell.gap();
    const std::size_t cells = statistics_.cells + count * kCellsOfDivided;
    may_be_enough =
        taken >= needed || (estimate && samplesNeeded(target) <= samplesAffordable(cells));
  } while (count < most && !may_be_enough && !queue_.empty() && queue_.front().gap() >= least);
  return count;
}

// Each with its share of the cells that are left.
void PartitionEngine::divideTaken(std::size_t count) {
  const std::size_t most_cells = (request_.max_cells - statistics_.cells) / count;
  if (count > 1 && workers_.areSeveral()) obstacles_.share();
  workers_.run(
      count, [this] { return std::make_unique<Worker>(scene_, obstacles_); },
      [&](Worker& worker, std::size_t i) {
        Divided& of = round_[i];
        of.division.clear();
        worker.divider.setHint(hint_);
        worker.divider.divide(of.cell, most_cells, of.division);
        of.hint = worker.divider.hint();
      });
}

void PartitionEngine::collectStatistics() {
  workers_.visit(
      [this](Worker& worker) { addWork(std::exchange(worker.statistics, {}), statistics_); });
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
    const SettledMass part = coveredPart(open);
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
  const auto status = detail::satisfied(now, request_);
  if (status == ProbabilityStatus::decided) return status;
  if (queue_.empty() && !(left_by_band_ > 0.0)) {
    return indivisible_ ? ProbabilityStatus::resolution_limit : ProbabilityStatus::exact;
  }
  if (status) return status;
  if (band_ && isOpenByBand(now)) return ProbabilityStatus::band_limit;
  if (!band_ && stalled_) return ProbabilityStatus::resolution_limit;
  if (estimate &&
      samplesNeeded(targetError(now.middle())) <= samplesAffordable(statistics_.cells)) {
    return ProbabilityStatus::converged;
  }
  return std::nullopt;
}

// Whether cells have no more to tell than what is asked for, or nearly nothing.
bool PartitionEngine::isOpenByBand(const Bounds& now) const {
  if (queue_.empty() || stalled_) return true;
  const double open = now.width() - left_by_band_;
  if (asksForDecision(request_)) return !mayBeDecided(now, open, request_);
  return open <= request_.toleranceAt(now.upper);
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
double PartitionEngine::samplesNeeded(double target) const {
  if (!(open_deviation_ > 0.0)) return 0.0;  // the target may be 0, too: P below the least double
  const double ratio = kDeviationShare * deviation_share_ * open_deviation_ / target;
  return ratio * ratio;
}

double PartitionEngine::samplesAffordable(std::size_t cells) const {
  return (quick_samples_ ? kQuickSamplesPerCell : kSamplesPerCell) * static_cast<double>(cells);
}

double PartitionEngine::samplesToDraw(ProbabilityStatus status) const {
  if (status == ProbabilityStatus::time_limit || status == ProbabilityStatus::cancelled) return 0.0;
  return std::min(samplesNeeded(targetError(interval().middle())),
                  samplesAffordable(statistics_.cells));
}

std::size_t PartitionEngine::memory() const { return obstacles_.memory() + cell_memory_; }

std::optional<ProbabilityStatus> PartitionEngine::interruption() const {
  return limits_.interruption(interval());
}

// Dividing a cell examines two.
bool PartitionEngine::hasCellsLeft() const {
  return statistics_.cells < request_.max_cells && request_.max_cells - statistics_.cells >= 2;
}

std::optional<ProbabilityStatus> PartitionEngine::limited(bool estimate) const {
  return limits_.interruption(interval(), estimate ? EngineLimits::kShareForDividing : 1.0);
}

void PartitionEngine::lookForStall() {
  if (statistics_.cells < next_look_) return;
  next_look_ = 2 * statistics_.cells;
  const Bounds now = interval();
  const double stalled = band_ && band_->isOfSweeps() ? kStalledBySweeps : kStalled;
  stalled_ = now.width() > stalled * at_last_look_.width();
  at_last_look_ = now;
}

ProbabilityStatus PartitionEngine::run(bool estimate) {
  std::optional<ProbabilityStatus> status;
  ++changes_since_recount_;
  std::size_t divided = 0;
  std::size_t next_poll = 0;
  while (!status) {
    if (band_ || scene_.rank < 3) lookForStall();
    if (changes_since_recount_ * 4 > queue_.size()) recount();
    status = satisfied(estimate);
    if (status && changes_since_recount_ > 0) {
      recount();
      status = satisfied(estimate);
    }
    if (!status && !hasCellsLeft()) status = ProbabilityStatus::cell_limit;
    if (!status && memory() >= request_.max_memory) status = ProbabilityStatus::memory_limit;
    if (!status && divided >= next_poll) {
      status = limited(estimate);
      next_poll = divided + EngineLimits::kCellsBetweenPolls;
    }
    if (!status) {
      const std::size_t count = divideLargest(estimate);
      divided += count;
      changes_since_recount_ += count;
    }
    statistics_.peak_memory = std::max(statistics_.peak_memory, memory());
  }
  recount();
  statistics_.cells_open = queue_.size();
  statistics_.leaf_pairs = obstacles_.pairCount();
  return *status;
}

}  // namespace fcl_prob::detail
