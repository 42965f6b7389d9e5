// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cells/carving_engine.h"

#include <algorithm>
#include <utility>

#include "base/decision.h"
#include "base/rounded_sum.h"

namespace fcl_prob::detail {
namespace {

// As long as no more cells than these were looked at it is one at a time: a few milliseconds, for
// which threads are not worth waking.
constexpr std::size_t kCarvedOneByOne = 200;

std::size_t memoryOf(const CarvedCell& cell) {
  return sizeof(CarvedCell) + sizeof(CarvedLayer) + cell.body.memory();
}

}  // namespace

CarvingEngine::CarvingEngine(FatMembers& obstacles, const SolidContact* solids,
                             const ProbabilityRequest& request, Budget& budget,
                             ProbabilityStatistics& statistics)
    : obstacles_(obstacles),
      solids_(solids),
      request_(request),
      statistics_(statistics),
      queue_(request, budget, statistics, claim_observer ? 1 : request.threads, makeWorker()) {
  auto root = std::make_unique<CarvedCell>();
  root->box =
      detail::Cell{Eigen::Vector3d::Constant(-kReach), Eigen::Vector3d::Constant(kReach), 3};
  root->mass = {0.0, 1.0};
  std::vector<FatNode> roots;
  for (int member = 0; member < obstacles.count(); ++member) {
    for (const int node : obstacles.pieces().roots()) roots.push_back({member, node});
  }
  root->nodes = std::make_shared<const std::vector<FatNode>>(std::move(roots));
  push(std::move(root));
}

void CarvingEngine::Totals::add(const Queued& queued) {
  open.lower += queued.cell->inner;
  open.upper += queued.cell->mass.upper;
  memory += memoryOf(*queued.cell);
}

void CarvingEngine::Totals::remove(const Queued& queued) {
  open.lower -= queued.cell->inner;
  open.upper -= queued.cell->mass.upper;
  memory -= memoryOf(*queued.cell);
}

void CarvingEngine::push(std::unique_ptr<CarvedCell> cell) {
  const double gap = cell->gap();
  queue_.push({gap, std::move(cell)});
}

bool CarvingEngine::isOneByOne() const { return statistics_.cells < kCarvedOneByOne; }

CarvingEngine::Enough CarvingEngine::enough() const { return {missingWidth(interval(), request_)}; }

// A single cell adds to the totals itself.
void CarvingEngine::beginRound(std::vector<Queue::InRound>& round, std::size_t count) {
  const bool is_single = count == 1;
  certain_ = is_single ? 0.0 : settled_.lower;
  for (std::size_t i = 0; i < count; ++i) {
    round[i].parts.settled = is_single ? std::exchange(settled_, {0.0, 0.0}) : Bounds{0.0, 0.0};
    round[i].parts.slivers = is_single ? std::exchange(slivers_, 0.0) : 0.0;
  }
}

void CarvingEngine::divide(Worker& worker, Queued& queued, Carving& carving) const {
  worker.carver.divide(std::move(*queued.cell), certain_, carving);
  queued.cell.reset();
}

void CarvingEngine::add(Carving& carving) {
  settled_.lower += carving.settled.lower;
  settled_.upper += carving.settled.upper;
  slivers_ += carving.slivers;
  for (std::unique_ptr<CarvedCell>& cell : carving.cells) push(std::move(cell));
  carving.cells.clear();
}

Bounds CarvingEngine::interval() const {
  const Bounds& open = queue_.totals().open;
  return roundedSum(settled_.lower + open.lower - slivers_, settled_.upper + open.upper + slivers_,
                    16.0 * static_cast<double>(statistics_.cells) + 64.0);
}

std::optional<ProbabilityStatus> CarvingEngine::satisfied() const {
  if (obstacles_.failed()) return ProbabilityStatus::resolution_limit;
  const Bounds now = interval();
  if (const auto status = detail::satisfied(now, request_)) return status;
  // What is settled as unknown stays so.
  const double unknown = settled_.upper - settled_.lower;
  const double open = queue_.totals().open.width();
  const bool is_settled = asksForDecision(request_) ? !mayBeDecided(now, open, request_)
                                                    : unknown > request_.toleranceAt(now.upper);
  if (is_settled) return ProbabilityStatus::resolution_limit;
  // What is left is rounding and the accuracy of masses.
  if (queue_.empty() || open < 0.1 * now.width()) return ProbabilityStatus::resolution_limit;
  return std::nullopt;
}

ProbabilityStatus CarvingEngine::run() {
  const ProbabilityStatus status = queue_.run(*this);
  statistics_.leaf_pairs = obstacles_.built();
  return status;
}

}  // namespace fcl_prob::detail
