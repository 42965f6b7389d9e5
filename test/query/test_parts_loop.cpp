// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Parts of one answer within the limits of the whole, with parts whose cost is known.
#include "query/parts_loop.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "catch.h"
#include "fcl_prob/combined_bounds.h"

using namespace fcl_prob;
using detail::PartsLoop;

namespace {

/// A part that takes `cost` cells to be known to a hundredth of itself; its width falls with the
/// square root of the cells.
struct CostlyPart {
  double p;
  double cost;

  ProbabilityResult answer(const ProbabilityRequest& request) const {
    const auto width = [this](double cells) {
      return std::min(1.0, 0.01 * p * std::sqrt(cost / std::max(1.0, cells)));
    };
    const double wanted = request.toleranceAt(p);
    const double needed = cost * std::pow(0.01 * p / wanted, 2);
    const auto allowed = static_cast<double>(request.max_cells);
    ProbabilityResult result;
    const double cells = std::max(1.0, std::min(needed, allowed));
    const double half = 0.5 * width(cells);
    result.lower = std::max(0.0, p - half);
    result.upper = std::min(1.0, p + half);
    result.statistics.cells = static_cast<std::size_t>(cells);
    result.status =
        needed <= allowed ? ProbabilityStatus::converged : ProbabilityStatus::cell_limit;
    return result;
  }
};

std::vector<CostlyPart> randomParts(std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform;
  std::vector<CostlyPart> parts(2 + random() % 8);
  for (CostlyPart& part : parts) {
    part = {std::pow(10.0, -3.0 * uniform(random)), std::pow(10.0, 1.0 + 5.0 * uniform(random))};
  }
  return parts;
}

struct Outcome {
  std::vector<Bounds> bounds;
  std::size_t cells = 0;
  bool all_asked = true;
};

Outcome outcomeOf(const std::vector<CostlyPart>& parts, const ProbabilityRequest& request) {
  Outcome outcome;
  const PartsLoop::Ask ask = [&](std::size_t i, const ProbabilityRequest& of_one) {
    const ProbabilityResult result = parts[i].answer(of_one);
    outcome.cells += result.statistics.cells;
    return result;
  };
  const PartsLoop::Combine combine = &anyOfIndependent;
  PartsLoop loop(request, ask, combine, std::vector<Bounds>(parts.size(), Bounds{0.0, 1.0}));
  const PartsLoop::Wanted wanted = [&](std::size_t i) -> std::optional<ProbabilityRequest> {
    const Bounds& known = loop.bounds()[i];
    if (known.width() <= 1.0001 * request.toleranceAt(known.upper)) return std::nullopt;
    return request;
  };
  loop.askEach(wanted);
  loop.askAgain(wanted);
  outcome.bounds = loop.bounds();
  for (const auto& answer : loop.answers()) outcome.all_asked &= answer.has_value();
  return outcome;
}

}  // namespace

TEST_CASE("parts are all asked, in any order, and use up what the whole has") {
  std::mt19937_64 random(5);
  int limited = 0, spent_again = 0;
  for (int i = 0; i < 300; ++i) {
    const std::vector<CostlyPart> parts = randomParts(random);
    ProbabilityRequest request;
    request.relative_tolerance = 0.01;
    request.absolute_tolerance = 0.0;
    request.max_cells = static_cast<std::size_t>(std::pow(10.0, 3.0 + static_cast<double>(i % 4)));
    const Outcome outcome = outcomeOf(parts, request);
    CAPTURE(i, parts.size(), request.max_cells, outcome.cells);
    CHECK(outcome.all_asked);
    CHECK(outcome.cells <= request.max_cells + parts.size());
    double all = 0.0, dearest = 0.0;
    for (const CostlyPart& part : parts) {
      all += part.cost;
      dearest = std::max(dearest, part.cost);
    }
    const auto allowed = static_cast<double>(request.max_cells);
    // Asking again begins anew: what parts of their shares were used for is lost.
    const bool fits = 2.0 * all < allowed;
    const double even = allowed / static_cast<double>(parts.size());
    for (std::size_t k = 0; k < parts.size(); ++k) {
      CHECK(outcome.bounds[k].contains(parts[k].p));
      const double width = outcome.bounds[k].width();
      if (fits) CHECK(width <= 0.0101 * parts[k].p);
      // At least its even share.
      CHECK(width <= 1.01 * std::max(0.01, 0.01 * std::sqrt(parts[k].cost / even)) * parts[k].p);
    }
    limited += all > allowed;
    spent_again += all > allowed && static_cast<double>(outcome.cells) > 0.5 * allowed;
  }
  CHECK(limited > 50);
  CHECK(spent_again == limited);
}

TEST_CASE("the order of parts does not matter by more than what was shared out") {
  std::mt19937_64 random(6);
  for (int i = 0; i < 100; ++i) {
    std::vector<CostlyPart> parts = randomParts(random);
    ProbabilityRequest request;
    request.max_cells = 20'000;
    const Outcome one = outcomeOf(parts, request);
    std::vector<std::size_t> order(parts.size());
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), random);
    std::vector<CostlyPart> shuffled;
    for (const std::size_t k : order) shuffled.push_back(parts[k]);
    const Outcome other = outcomeOf(shuffled, request);
    for (std::size_t k = 0; k < order.size(); ++k) {
      CAPTURE(i, k);
      const double a = one.bounds[order[k]].width(), b = other.bounds[k].width();
      CHECK(std::max(a, b) <= 6.0 * std::min(a, b) + 1e-6);
    }
  }
}

TEST_CASE("a part that cannot go on does not end the others") {
  const ProbabilityRequest request;
  for (const ProbabilityStatus why :
       {ProbabilityStatus::memory_limit, ProbabilityStatus::resolution_limit,
        ProbabilityStatus::cell_limit, ProbabilityStatus::time_limit, ProbabilityStatus::band_limit,
        ProbabilityStatus::sampled}) {
    std::vector<int> asked(4, 0);
    const PartsLoop::Ask ask = [&](std::size_t i, const ProbabilityRequest&) {
      ++asked[i];
      ProbabilityResult result;
      result.lower = i == 0 ? 0.0 : 0.1;
      result.upper = i == 0 ? 0.9 : 0.1;
      result.status = i == 0 ? why : ProbabilityStatus::converged;
      return result;
    };
    const PartsLoop::Combine combine = &anyOfIndependent;
    PartsLoop loop(request, ask, combine, std::vector<Bounds>(4, Bounds{0.0, 1.0}));
    const PartsLoop::Wanted wanted = [&](std::size_t i) -> std::optional<ProbabilityRequest> {
      if (loop.bounds()[i].width() < 0.01) return std::nullopt;
      return request;
    };
    loop.askEach(wanted);
    loop.askAgain(wanted);
    CAPTURE(toString(why), asked[0]);
    for (std::size_t i = 1; i < 4; ++i) CHECK(asked[i] == 1);
    CHECK(asked[0] >= 1);
    CHECK(asked[0] <= 40);
    CHECK(!loop.isOut());
  }
}

TEST_CASE("progress is that of the whole, and who cancels is not asked again") {
  ProbabilityRequest request;
  std::vector<Bounds> told;
  std::size_t last_call = 7;
  request.on_progress = [&](const ProbabilityProgress& progress) {
    told.push_back(progress.interval);
    return told.size() < last_call;
  };
  const std::vector<double> truth{0.3, 0.02, 0.001, 0.2};
  const PartsLoop::Ask ask = [&](std::size_t i, const ProbabilityRequest& of_one) {
    ProbabilityResult result;
    result.lower = 0.0;
    result.upper = 1.0;
    result.status = ProbabilityStatus::converged;
    for (const double width : {0.5, 0.1, 0.01}) {
      result.lower = std::max(0.0, truth[i] - width);
      result.upper = std::min(1.0, truth[i] + width);
      if (of_one.on_progress({{*result.lower, *result.upper}, 0.5, 0.0})) continue;
      result.status = ProbabilityStatus::cancelled;
      of_one.on_progress({{0.0, 1.0}, 0.5, 0.0});  // as some do
      break;
    }
    return result;
  };
  const PartsLoop::Combine combine = &anyOfIndependent;
  for (last_call = 1; last_call < 14; ++last_call) {
    told.clear();
    PartsLoop loop(request, ask, combine, std::vector<Bounds>(4, Bounds{0.0, 1.0}));
    loop.askEach([&](std::size_t) { return request; });
    CAPTURE(last_call);
    CHECK(told.size() == std::min<std::size_t>(last_call, 12));
    CHECK(loop.isOut() == (last_call <= 12));
    double none = 1.0;
    for (const double p : truth) none *= 1.0 - p;
    for (std::size_t k = 0; k < told.size(); ++k) {
      CHECK(told[k].contains(1.0 - none));
      if (k > 0) CHECK(told[k].width() <= told[k - 1].width() + 1e-12);
    }
  }
}
