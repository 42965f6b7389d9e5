// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cells/partition_engine.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/constants.h"
#include "base/decision.h"
#include "base/rounded_sum.h"
#include "cells/cell_split.h"
#include "cells/claim_observer.h"
#include "cells/open_cell.h"
#include "scene/band_margin.h"

namespace fcl_prob::detail {

namespace {

/// Whether dividing an open cell would hardly settle more of it: it is small beside the band, or
/// what is open of it is a layer hardly thicker than that. Steers; no bound depends on it.
bool isAllBand(const OpenCell& open, const BandMargin& band);

// Shares of the band's thickness: of the widths of a cell that is small beside it, and of a layer
// that is not worth making thinner.
constexpr double kSmallCell = 0.7;
constexpr double kThinnestLayer = 1.2;

bool isSmallBeside(const BandMargin& band, const OpenCell& open) {
  for (int k = 0; k < open.cell.rank; ++k) {
    const double thickness = band.thicknessAlong(Eigen::Vector3d::Unit(k));
    if (open.cell.hi[k] - open.cell.lo[k] > kSmallCell * thickness) return false;
  }
  return true;
}

bool isThinLayerOf(const BandMargin& band, const OpenCell& open) {
  if (!open.planeCovers()) return false;
  const double layer = open.plane.s - open.possible_from;
  return layer <= kThinnestLayer * band.thicknessAlong(open.plane.m);
}

bool isAllBand(const OpenCell& open, const BandMargin& band) {
  return isSmallBeside(band, open) || isThinLayerOf(band, open);
}

// Samples drawn for every cell examined. Measured on the benchmark scenes: with 25 an estimate
// takes half the time that it takes with the least number; from 15 to 40 it hardly matters.
constexpr double kSamplesPerCell = 25;

// The standard deviation of samples, which lie evenly in their cells, over the bound on that of
// samples drawn anywhere in them. Measured on the benchmark scenes: 0.4 to 0.7. Where it turns out
// larger more samples are drawn, so that a little more than half is quickest.
constexpr double kDeviationShare = 0.6;

// Cells after which the interval is looked at, again whenever there are twice as many: what has
// left this share of its width is all that bands around the shapes leave, or, where not all axes
// move, a section that lies along a surface to within rounding. Else it leaves 0.7 or so.
constexpr std::size_t kFirstLook = 4000;
constexpr double kStalled = 0.97;

// As long as no more cells were examined and pairs tested than these, one cell is divided at a
// time: a few milliseconds, for which threads are not worth waking.
constexpr std::size_t kCellsOneByOne = 300;
constexpr std::size_t kPairsOneByOne = 50'000;

// Of the time limit, what an estimate may divide cells for: the rest is for sampling them.
constexpr double kShareForDividing = 0.8;

// Cells that are examined for one that is divided, about.
constexpr std::size_t kCellsOfDivided = 6;

}  // namespace

PartitionEngine::PartitionEngine(const PartitionScene& scene, const ProbabilityRequest& request,
                                 Budget& budget, ProbabilityStatistics& statistics)
    : scene_(scene),
      request_(request),
      statistics_(statistics),
      obstacles_(scene.pair),
      band_(scene.pair.band && scene.pair.band->isOfSweeps() ? nullptr : scene.pair.band),
      next_look_(kFirstLook),
      queue_(request, budget, statistics, claim_observer ? 1 : request.threads, makeWorker()) {
  Division root;
  queue_.worker().divider.examineRoot(root);
  queue_.collectStatistics();
  add(root);
}

void PartitionEngine::Totals::add(const OpenCell& cell) {
  open.lower += cell.lower;
  open.upper += cell.upper;
  deviation += cell.samplingDeviation();
  memory += cell.memory();
}

void PartitionEngine::Totals::remove(const OpenCell& cell) {
  open.lower -= cell.lower;
  open.upper -= cell.upper;
  deviation -= cell.samplingDeviation();
  memory -= cell.memory();
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
  queue_.push(std::move(cell));
}

bool PartitionEngine::isOneByOne() const {
  return statistics_.cells < kCellsOneByOne && statistics_.pairs_tested < kPairsOneByOne;
}

PartitionEngine::Enough PartitionEngine::enough() const {
  const Bounds now = interval();
  return {*this, missingWidth(now, request_), targetError(now.middle()),
          CellDivider::kSoon * queue_.largest().gap()};
}

bool PartitionEngine::Enough::operator()(double taken, std::size_t count, double next) const {
  if (taken >= needed || next < least) return true;
  const std::size_t cells = engine.statistics_.cells + count * kCellsOfDivided;
  return engine.estimate_ && engine.samplesNeeded(target) <= engine.samplesAffordable(cells);
}

// Each with its share of the cells that are left.
void PartitionEngine::beginRound(std::vector<Queue::InRound>& /*round*/, std::size_t count) {
  most_cells_ = queue_.cellsLeft() / count;
  if (count > 1 && queue_.areSeveralWorkers()) obstacles_.share();
  hint_of_round_ = hint_;
}

void PartitionEngine::divide(Worker& worker, OpenCell& cell, Parts& parts) const {
  parts.division.clear();
  worker.divider.setHint(hint_of_round_);
  worker.divider.divide(cell, most_cells_, parts.division);
  parts.hint = worker.divider.hint();
}

void PartitionEngine::add(Parts& parts) {
  add(parts.division);
  if (parts.hint != hint_of_round_) hint_ = parts.hint;
}

// The sums of up to `cells` rounded terms each, with up to as many removals since the last recount.
Bounds PartitionEngine::interval() const {
  return roundedSum(settled_.mass.lower + queue_.totals().open.lower,
                    settled_.mass.upper + queue_.totals().open.upper,
                    4.0 * static_cast<double>(statistics_.cells) + 16.0);
}

MomentBounds PartitionEngine::moment() const {
  MomentBounds bounds{settled_.moment, settled_.moment};
  // What is no double here may be one after the division by a deviation.
  double error = settled_.moment_error + kUnderflow;
  for (const OpenCell& open : queue_.cells()) {
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

std::optional<ProbabilityStatus> PartitionEngine::satisfied() {
  if (band_ || scene_.rank < 3) lookForStall();
  const Bounds now = interval();
  const auto status = detail::satisfied(now, request_);
  if (status == ProbabilityStatus::decided) return status;
  if (queue_.empty() && !(left_by_band_ > 0.0)) {
    return indivisible_ ? ProbabilityStatus::resolution_limit : ProbabilityStatus::exact;
  }
  if (status) return status;
  if (band_ && isOpenByBand(now)) return ProbabilityStatus::band_limit;
  if (!band_ && stalled_) return ProbabilityStatus::resolution_limit;
  if (estimate_ &&
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
  for (const OpenCell& cell : queue_.cells()) mass += cell.lower;
  return {std::clamp(mass, bounds.lower, bounds.upper), error};
}

// With n_i samples in cell i in proportion to the deviations s_i, the variance is (Σ s_i)² / Σ n_i
// (Neyman 1934).
double PartitionEngine::samplesNeeded(double target) const {
  if (!(queue_.totals().deviation > 0.0))
    return 0.0;  // the target may be 0, too: P below the least double
  const double ratio = kDeviationShare * deviation_share_ * queue_.totals().deviation / target;
  return ratio * ratio;
}

double PartitionEngine::samplesAffordable(std::size_t cells) const {
  return kSamplesPerCell * static_cast<double>(cells);
}

double PartitionEngine::samplesToDraw(ProbabilityStatus status) const {
  if (status == ProbabilityStatus::time_limit || status == ProbabilityStatus::cancelled) return 0.0;
  return std::min(samplesNeeded(targetError(interval().middle())),
                  samplesAffordable(statistics_.cells));
}

std::optional<ProbabilityStatus> PartitionEngine::interruption() const {
  return queue_.budget().look(interval(), queue_.fraction());
}

void PartitionEngine::lookForStall() {
  if (statistics_.cells < next_look_) return;
  next_look_ = 2 * statistics_.cells;
  const Bounds now = interval();
  stalled_ = now.width() > kStalled * at_last_look_.width();
  at_last_look_ = now;
}

ProbabilityStatus PartitionEngine::run(bool estimate) {
  estimate_ = estimate;
  const ProbabilityStatus status = queue_.run(*this, estimate ? kShareForDividing : 1.0);
  statistics_.leaf_pairs = obstacles_.pairCount();
  return status;
}

}  // namespace fcl_prob::detail
