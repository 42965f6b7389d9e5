// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Several events, each asked for to a tolerance or a threshold of its own, against one threshold.
#include "robot/obstacle_answer.h"

#include <cmath>
#include <random>

#include "base/decision.h"
#include "catch.h"
#include "fcl_prob/combined_bounds.h"

using namespace fcl_prob;
using namespace fcl_prob::detail;

namespace {

/// Events whose P is known, answered by intervals around it that are as wide as they may be, but
/// never narrower than `least` of it.
struct Events {
  std::vector<double> truth;
  double least = 0.0;
  std::size_t asked = 0;

  std::vector<Bounds> unknown() const { return std::vector<Bounds>(truth.size(), {0.0, 1.0}); }

  PartsLoop::Ask ask() {
    return [this](std::size_t i, const ProbabilityRequest& request) {
      ProbabilityResult result;
      ++asked;
      const double p = truth[i];
      double half = request.threshold ? 0.9 * std::fabs(p - *request.threshold)
                                      : 0.49 * std::max(request.absolute_tolerance,
                                                        request.relative_tolerance * p);
      const bool is_limited = half < least * p;
      half = std::max(half, least * p);
      result.lower = std::max(0.0, p - half);
      result.upper = std::min(1.0, p + half);
      result.decision = decisionOf({*result.lower, *result.upper}, request);
      result.status = is_limited ? ProbabilityStatus::resolution_limit
                                 : satisfied({*result.lower, *result.upper}, request)
                                       .value_or(ProbabilityStatus::resolution_limit);
      result.statistics.cells = 1;
      return result;
    };
  }
};

Events randomEvents(std::mt19937_64& random, int count) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  Events events;
  for (int i = 0; i < count; ++i)
    events.truth.push_back(std::pow(10.0, -0.3 - 3.0 * uniform(random)));
  return events;
}

double anyTruth(const Events& events) {
  double none = 1.0;
  for (const double p : events.truth) none *= 1.0 - p;
  return 1.0 - none;
}

}  // namespace

TEST_CASE("a threshold over several events is decided however close to it P is") {
  std::mt19937_64 random(1);
  for (const int count : {1, 2, 3, 7}) {
    for (const double near : {0.5, 1e-2, 1e-4, 1e-7, 1e-10}) {
      for (const double side : {-1.0, 1.0}) {
        Events events = randomEvents(random, count);
        const double p = anyTruth(events);
        ProbabilityRequest request;
        request.threshold = p * (1.0 - side * near);
        const RobotResult result = anyOfAsked(events.unknown(), request, events.ask());
        CAPTURE(count, near, side, p, toString(result.status));
        CHECK(result.status == ProbabilityStatus::decided);
        CHECK(result.decision == (side > 0.0 ? Decision::above : Decision::below));
      }
    }
  }
}

TEST_CASE("a threshold that no event's resolution reaches ends undecided, and not converged") {
  std::mt19937_64 random(2);
  for (const int count : {2, 3, 7}) {
    for (const double least : {1e-1, 1e-3, 1e-6}) {
      Events events = randomEvents(random, count);
      events.least = least;
      ProbabilityRequest request;
      request.threshold = anyTruth(events);
      const RobotResult result = anyOfAsked(events.unknown(), request, events.ask());
      CAPTURE(count, least, toString(result.status));
      CHECK(result.decision == Decision::undecided);
      CHECK_FALSE(isAnswered(result.status));
      CHECK(events.asked < 200);
    }
  }
}

TEST_CASE("errors of any dependence: what the bounds leave open is no reason to go on") {
  std::mt19937_64 random(3);
  const PartsLoop::Combine any = [](const std::vector<Bounds>& events) { return anyOf(events); };
  for (const double share : {-0.2, 0.3, 0.6, 0.99, 1.01, 1.5}) {
    Events events = randomEvents(random, 5);
    double most = 0.0, sum = 0.0;
    for (const double p : events.truth) {
      most = std::max(most, p);
      sum += p;
    }
    ProbabilityRequest request;
    request.threshold = most + share * (std::min(sum, 1.0) - most);
    const RobotResult result = anyOfDependent(events.unknown(), request, events.ask(), any);
    CAPTURE(share, most, sum, toString(result.status));
    const Decision expected = share < 0.0   ? Decision::above
                              : share > 1.0 ? Decision::below
                                            : Decision::undecided;
    CHECK(result.decision == expected);
    CHECK(isAnswered(result.status) == (expected != Decision::undecided));
    CHECK(events.asked < 200);
  }
}

TEST_CASE("obstacles are asked for no more than a decision") {
  // The others may have so much of the threshold that 0.0495 is above what is left, and not above.
  Events events{{0.052, 3e-3, 1e-3, 1e-3}};
  ProbabilityRequest request;
  request.threshold = 0.05;
  const RobotResult result =
      anyOfAsked({{0.0, 1.0}, {0.0, 4e-3}, {0.0, 2e-3}, {0.0, 2e-3}}, request, events.ask());
  CHECK(result.decision == Decision::above);
  CHECK(events.asked <= 4);  // not each to a tolerance besides
  CHECK(result.any.upper - result.any.lower > 1e-3);
}
