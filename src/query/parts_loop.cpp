// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "query/parts_loop.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "base/decision.h"

namespace fcl_prob::detail {
namespace {

/// A part that used up its share gets at least this many times as much, as it begins anew: all that
/// it was asked before takes no more than a third of its last answer.
constexpr double kMoreThanBefore = 4.0;

/// Less than this many times as much would hardly tell more.
constexpr double kWorthAsking = 1.25;

/// Of its width: what the widest part is asked for.
constexpr double kNarrowed = 0.25;

/// Intervals narrower than this in relation to their upper end are not asked to be narrowed.
constexpr double kNarrowest = 1e-13;

bool isSampled(ProbabilityMethod method) {
  return method == ProbabilityMethod::monte_carlo || method == ProbabilityMethod::rare_event;
}

/// A part of what is left of a count, at most all of it.
std::size_t moreOf(std::size_t left, std::size_t parts, std::size_t before) {
  const auto wanted = static_cast<std::size_t>(kMoreThanBefore * static_cast<double>(before));
  return std::max<std::size_t>(1, std::min(left, std::max(left / parts, wanted)));
}

bool isWorth(double now, double before) { return now > 0.0 && now >= kWorthAsking * before; }

}  // namespace

PartsLoop::PartsLoop(const ProbabilityRequest& whole, const Ask& ask, const Combine& combine,
                     std::vector<Bounds> known, std::vector<double> weights)
    : whole_(whole),
      ask_(ask),
      combine_(combine),
      budget_(whole),
      bounds_(std::move(known)),
      weights_(std::move(weights)),
      answers_(bounds_.size()),
      last_(bounds_.size()),
      shares_(bounds_.size()),
      stuck_(bounds_.size(), false) {
  weights_.resize(bounds_.size(), 1.0);
}

void PartsLoop::askEach(const Wanted& wanted, double of_limits) {
  const Allowance kept_back = budget_.left().part(1.0 - of_limits);
  const std::vector<std::size_t> order = widestFirst();
  std::size_t left = 0;
  for (const std::size_t i : order) left += wanted(i).has_value();
  for (const std::size_t i : order) {
    auto request = wanted(i);
    if (!request) continue;
    if (!mayGoOn()) return;
    // What is wanted may have become more since it was counted.
    budget_.share(std::max<std::size_t>(left, 1), *request, kept_back);
    left -= left > 0;
    ask(i, std::move(*request));
  }
}

void PartsLoop::askAgain(const Wanted& wanted) {
  while (mayGoOn()) {
    std::vector<std::size_t> dry;
    for (const std::size_t i : widestFirst()) {
      if (ranDry(i) && wanted(i)) dry.push_back(i);
    }
    // The first that can have more than it had; where none can, all has been given out.
    const auto next = std::find_if(dry.begin(), dry.end(), [&](std::size_t i) {
      ProbabilityRequest request = *wanted(i);
      if (!enlargeShare(i, dry.size(), request)) return false;
      ask(i, std::move(request));
      return true;
    });
    if (next == dry.end()) return;
  }
}

bool PartsLoop::narrowWidest(const ProbabilityRequest& request) {
  if (!mayGoOn()) return false;
  for (const std::size_t i : widestFirst()) {
    const double width = bounds_[i].width();
    if (stuck_[i] || !(width > kNarrowest * bounds_[i].upper)) continue;
    ProbabilityRequest narrower = request;
    narrower.relative_tolerance = 0.0;
    narrower.absolute_tolerance = kNarrowed * width;
    budget_.share(1, narrower);
    ask(i, std::move(narrower));
    stuck_[i] = !isAnswered(*last_[i]) || !(bounds_[i].width() < width);
    return true;
  }
  return false;
}

bool PartsLoop::isOut() {
  if (!out_) out_ = budget_.exhausted();
  return out_.has_value();
}

bool PartsLoop::mayGoOn() { return !isOut() && !(enough_ && enough_()); }

double PartsLoop::openOf(std::size_t part) const { return weights_[part] * bounds_[part].width(); }

std::vector<std::size_t> PartsLoop::widestFirst() const {
  std::vector<std::size_t> order(bounds_.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [this](std::size_t x, std::size_t y) { return openOf(x) > openOf(y); });
  return order;
}

void PartsLoop::ask(std::size_t part, ProbabilityRequest request) {
  shares_[part] = {request.time_limit.value_or(0.0), request.max_cells, request.samples};
  reportTo(part, request);
  ProbabilityResult answer = ask_(part, request);
  budget_.spend(answer.statistics);
  ++asked_;
  last_[part] = answer.status;
  if (answer.status == ProbabilityStatus::cancelled) out_ = answer.status;
  keep(part, std::move(answer));
}

void PartsLoop::keep(std::size_t part, ProbabilityResult answer) {
  Bounds& best = bounds_[part];
  best.lower = std::max(best.lower, answer.lower.value_or(0.0));
  // Both hold: that one is above the other is rounding.
  best.upper = std::max(best.lower, std::min(best.upper, answer.upper.value_or(1.0)));
  std::optional<ProbabilityResult>& known = answers_[part];
  if (known) addStatistics(known->statistics, answer.statistics);
  if (answer.lower && answer.upper) {
    answer.lower = best.lower;
    answer.upper = best.upper;
  }
  const bool had_better = known && known->standard_error && answer.standard_error &&
                          *known->standard_error < *answer.standard_error;
  if (had_better) {
    answer.estimate = known->estimate;
    answer.standard_error = known->standard_error;
  }
  known = std::move(answer);
}

bool PartsLoop::ranDry(std::size_t part) const {
  const auto& why = last_[part];
  return why == ProbabilityStatus::time_limit || why == ProbabilityStatus::cell_limit ||
         why == ProbabilityStatus::sampled;
}

/// \param parts  that want more
bool PartsLoop::enlargeShare(std::size_t part, std::size_t parts,
                             ProbabilityRequest& request) const {
  const Allowance& before = shares_[part];
  const Allowance left = budget_.left();
  request.max_cells = moreOf(left.cells, parts, before.cells);
  request.samples = moreOf(left.samples, parts, before.samples);
  if (whole_.time_limit) {
    if (!(left.seconds > 0.0)) return false;
    const double even = left.seconds / static_cast<double>(parts);
    request.time_limit = std::min(left.seconds, std::max(even, kMoreThanBefore * before.seconds));
  }
  switch (*last_[part]) {
    case ProbabilityStatus::time_limit:
      return isWorth(request.time_limit.value_or(0.0), before.seconds);
    case ProbabilityStatus::cell_limit:
      return isWorth(static_cast<double>(request.max_cells), static_cast<double>(before.cells));
    default:
      return isWorth(static_cast<double>(request.samples), static_cast<double>(before.samples));
  }
}

/// Makes the progress of a part that of the whole. Who cancels is not asked again.
void PartsLoop::reportTo(std::size_t part, ProbabilityRequest& request) {
  if (!whole_.on_progress) return;
  request.on_progress = [this, part](const ProbabilityProgress& of_part) {
    if (out_ == ProbabilityStatus::cancelled) return false;
    ProbabilityProgress progress;
    std::vector<Bounds> now = bounds_;
    if (!isSampled(whole_.method)) {
      now[part].lower = std::max(now[part].lower, of_part.interval.lower);
      now[part].upper =
          std::max(now[part].lower, std::min(now[part].upper, of_part.interval.upper));
    }
    progress.interval = combine_(now);
    progress.seconds = budget_.seconds();
    const double parts = static_cast<double>(std::max(bounds_.size(), asked_ + 1));
    fraction_ = std::max(fraction_,
                         std::min(1.0, (static_cast<double>(asked_) + of_part.fraction) / parts));
    progress.fraction = fraction_;
    if (!whole_.on_progress(progress)) out_ = ProbabilityStatus::cancelled;
    return out_ != ProbabilityStatus::cancelled;
  };
}

}  // namespace fcl_prob::detail
