// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "carving/carving_engine.h"

#include <algorithm>
#include <utility>

#include "base/decision.h"
#include "base/rounded_sum.h"

namespace fcl_prob::detail {
namespace {

// As long as no more cells than these were looked at it is one at a time: a few milliseconds, for
// which threads are not worth waking.
constexpr std::size_t kCarvedOneByOne = 200;

// Cells of a round: so many, or one in so many of the open ones.
constexpr std::size_t kMostCarvedAtOnce = 64;
constexpr std::size_t kLeastCarvedAtOnce = 8;
constexpr std::size_t kOpenCarvedOfRound = 8;

std::size_t memoryOf(const CarvedCell& cell) {
  return sizeof(CarvedCell) + sizeof(CarvedLayer) + cell.body.memory();
}

}  // namespace

CarvingEngine::CarvingEngine(FatMembers& obstacles, const SolidContact* solids,
                             const ProbabilityRequest& request, ProbabilityStatistics& statistics)
    : obstacles_(obstacles),
      solids_(solids),
      request_(request),
      statistics_(statistics),
      workers_(claim_observer ? 1 : request.threads, std::make_unique<Worker>(*this)),
      round_(1),
      limits_(request, statistics) {
  auto root = std::make_unique<CarvedCell>();
  root->box = Cell{Eigen::Vector3d::Constant(-kReach), Eigen::Vector3d::Constant(kReach), 3};
  root->mass = {0.0, 1.0};
  std::vector<FatNode> roots;
  for (int member = 0; member < obstacles.count(); ++member) {
    for (const int node : obstacles.pieces().roots()) roots.push_back({member, node});
  }
  root->nodes = std::make_shared<const std::vector<FatNode>>(std::move(roots));
  push(std::move(root));
}

void CarvingEngine::push(std::unique_ptr<CarvedCell> cell) {
  open_.lower += cell->inner;
  open_.upper += cell->mass.upper;
  cell_memory_ += memoryOf(*cell);
  const double gap = cell->gap();
  queue_.push_back({gap, std::move(cell)});
  std::push_heap(queue_.begin(), queue_.end());
}

// How many cells were looked at.
std::size_t CarvingEngine::divideLargest() {
  const std::size_t count = takeLargest();
  divideTaken(count);
  workers_.visit(
      [this](Worker& worker) { addWork(std::exchange(worker.statistics, {}), statistics_); });
  for (std::size_t i = 0; i < count; ++i) {
    for (std::unique_ptr<CarvedCell>& cell : round_[i].carving.cells) push(std::move(cell));
    round_[i].carving.cells.clear();
  }
  return count;
}

std::size_t CarvingEngine::mostOfRound() const {
  if (statistics_.cells < kCarvedOneByOne) return 1;
  const std::size_t most =
      std::clamp(queue_.size() / kOpenCarvedOfRound, kLeastCarvedAtOnce, kMostCarvedAtOnce);
  return std::min(request_.max_cells - statistics_.cells, most);
}

// No more than have to be divided in any case: if fewer were settled altogether, that would not be
// enough.
std::size_t CarvingEngine::takeLargest() {
  const std::size_t most = mostOfRound();
  if (round_.size() < most) round_.resize(most);
  const double needed = missingWidth(interval(), request_);
  double taken = 0.0;
  std::size_t count = 0;
  do {
    std::pop_heap(queue_.begin(), queue_.end());
    const CarvedCell& cell = *queue_.back().cell;
    open_.lower -= cell.inner;
    open_.upper -= cell.mass.upper;
    cell_memory_ -= memoryOf(cell);
    taken += cell.gap();
    round_[count++].cell = std::move(queue_.back().cell);
    queue_.pop_back();
  } while (count < most && !queue_.empty() && taken < needed);
  return count;
}

// A single cell adds to the totals itself.
void CarvingEngine::divideTaken(std::size_t count) {
  const bool is_single = count == 1;
  const CarvedSoFar so_far{is_single ? 0.0 : settled_.lower, statistics_.cells + count};
  const auto divide = [&](Worker& worker, std::size_t i) {
    auto& [cell, carving] = round_[i];
    carving.settled = is_single ? settled_ : Bounds{0.0, 0.0};
    carving.slivers = is_single ? slivers_ : 0.0;
    worker.carver.divide(std::move(*cell), so_far, carving);
    cell.reset();
  };
  workers_.run(
      count, [this] { return std::make_unique<Worker>(*this); }, divide);
  if (is_single) settled_ = {0.0, 0.0};
  if (is_single) slivers_ = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const Carving& of_one = round_[i].carving;
    settled_.lower += of_one.settled.lower;
    settled_.upper += of_one.settled.upper;
    slivers_ += of_one.slivers;
  }
}

void CarvingEngine::recount() {
  open_ = {0.0, 0.0};
  for (const Queued& queued : queue_) {
    open_.lower += queued.cell->inner;
    open_.upper += queued.cell->mass.upper;
  }
  changes_since_recount_ = 0;
}

Bounds CarvingEngine::interval() const {
  return roundedSum(settled_.lower + open_.lower - slivers_,
                    settled_.upper + open_.upper + slivers_,
                    16.0 * static_cast<double>(statistics_.cells) + 64.0);
}

std::optional<ProbabilityStatus> CarvingEngine::satisfied() const {
  if (obstacles_.failed()) return ProbabilityStatus::resolution_limit;
  const Bounds now = interval();
  if (const auto status = detail::satisfied(now, request_)) return status;
  // What is settled as unknown stays so.
  const double unknown = settled_.upper - settled_.lower;
  const double open = open_.upper - open_.lower;
  const bool is_settled = asksForDecision(request_) ? !mayBeDecided(now, open, request_)
                                                    : unknown > request_.toleranceAt(now.upper);
  if (is_settled) return ProbabilityStatus::resolution_limit;
  // What is left is rounding and the accuracy of masses.
  if (queue_.empty() || open < 0.1 * now.width()) return ProbabilityStatus::resolution_limit;
  return std::nullopt;
}

std::optional<ProbabilityStatus> CarvingEngine::limited() const {
  return limits_.interruption(interval());
}

ProbabilityStatus CarvingEngine::run() {
  std::optional<ProbabilityStatus> status;
  ++changes_since_recount_;
  std::size_t divided = 0;
  std::size_t next_poll = 0;
  while (!status) {
    if (changes_since_recount_ * 4 > queue_.size()) recount();
    status = satisfied();
    if (status && changes_since_recount_ > 0) {
      recount();
      status = satisfied();
    }
    if (!status && statistics_.cells >= request_.max_cells) status = ProbabilityStatus::cell_limit;
    if (!status && memory() >= request_.max_memory) status = ProbabilityStatus::memory_limit;
    if (!status && divided >= next_poll) {
      status = limited();
      next_poll = divided + EngineLimits::kCellsBetweenPolls;
    }
    if (!status) {
      const std::size_t count = divideLargest();
      divided += count;
      changes_since_recount_ += count;
    }
    statistics_.peak_memory = std::max(statistics_.peak_memory, memory());
  }
  recount();
  statistics_.cells_open = queue_.size();
  statistics_.leaf_pairs = obstacles_.built();
  return *status;
}

}  // namespace fcl_prob::detail
