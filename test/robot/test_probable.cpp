// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Probable decisions: against certified ones, wrong no more often than stated.
#include <fcl/geometry/shape/halfspace.h>

#include "arm_motions.h"
#include "fcl_prob/exceptions.h"
#include "mesh_shapes.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

bool isBelow(ProbableDecision decision) {
  return decision == ProbableDecision::certainly_below ||
         decision == ProbableDecision::probably_below;
}

bool isAbove(ProbableDecision decision) {
  return decision == ProbableDecision::certainly_above ||
         decision == ProbableDecision::probably_above;
}

bool isProbable(const ProbableResult& result) {
  return result.decision == ProbableDecision::probably_below ||
         result.decision == ProbableDecision::probably_above;
}

/// States in which the arm is near what it may touch.
Eigen::VectorXd nearbyValues(const Robot& arm, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  return arm.values({{"turn", 0.7 * uniform(random)},
                     {"shoulder", 0.1 + 0.3 * uniform(random)},
                     {"elbow", 0.3 + 0.4 * uniform(random)},
                     {"roll", uniform(random)},
                     {"bend", uniform(random)},
                     {"grip", 0.02}});
}

struct Calibration {
  int decided = 0;
  int probable = 0;
  int wrong = 0;
  int outside = 0;  ///< the probable interval and the certified one do not meet
};

/// States that a certified decision leaves open to a hundredth are left out.
Calibration calibrate(const RobotQuery& query, double threshold, double chance, int states,
                      unsigned seed) {
  std::mt19937_64 random(seed);
  Calibration found;
  for (int i = 0; i < states; ++i) {
    const Eigen::VectorXd values = nearbyValues(query.robot(), random);
    ProbabilityRequest request;
    request.seed = 1'000 + static_cast<std::uint64_t>(i);
    const ProbableResult probable = query.decideProbably({values}, threshold, chance, request);
    CHECK(probable.probable.lower >= probable.certified.lower);
    CHECK(probable.probable.upper <= probable.certified.upper);
    CHECK((probable.chance_of_error == chance) == isProbable(probable));
    if (!isProbable(probable)) continue;
    ++found.probable;
    request = withTolerance(0.01);
    request.threshold = threshold;
    const RobotResult truth = query.state(values, request);
    found.outside += !overlap(truth.any, probable.probable);
    if (truth.decision != Decision::below && truth.decision != Decision::above) continue;
    ++found.decided;
    found.wrong +=
        truth.decision == Decision::below ? isAbove(probable.decision) : isBelow(probable.decision);
  }
  return found;
}

double mostOf(int states, double chance) {
  const double mean = states * chance;
  return mean + 4.0 * std::sqrt(mean + 1.0);
}

}  // namespace

TEST_CASE("probable decisions are wrong no more often than stated", "[slow]") {
  const RobotQuery query(shippedArm(), ballAndBox());
  for (const double chance : {0.1, 1e-4}) {
    const Calibration found = calibrate(query, 0.05, chance, 1'000, 51);
    CAPTURE(chance, found.probable, found.decided, found.wrong, found.outside);
    CHECK(found.probable > 200);
    CHECK(found.wrong <= mostOf(found.decided, chance));
    CHECK(found.outside <= mostOf(found.probable, chance));
  }
}

TEST_CASE("probable decisions just beside a threshold are wrong no more often than stated",
          "[slow]") {
  const RobotQuery query(shippedArm(), ballAndBox());
  std::mt19937_64 random(61);
  constexpr double kChance = 0.2;
  int probable = 0, wrong = 0;
  for (int state = 0; state < 40; ++state) {
    const Eigen::VectorXd values = nearbyValues(query.robot(), random);
    const Bounds truth = query.state(values, withTolerance(0.004)).any;
    if (truth.upper < 1e-3 || truth.lower > 0.9) continue;
    const bool below = state % 2 == 0;
    const double threshold = below ? 1.01 * truth.upper : 0.99 * truth.lower;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      ProbabilityRequest request;
      request.seed = seed;
      const ProbableResult one = query.decideProbably({values}, threshold, kChance, request);
      probable += isProbable(one);
      wrong += below ? isAbove(one.decision) : isBelow(one.decision);
    }
  }
  CAPTURE(probable, wrong);
  CHECK(probable > 100);
  CHECK(wrong <= mostOf(probable, kChance));
}

TEST_CASE("probable decisions beside a mesh, as a surface and as a solid") {
  std::vector<Obstacle> obstacles = ballAndBox();
  obstacles.pop_back();
  obstacles[0].geometry = makeModel<fcl::OBBRSSd>(boxMesh(Eigen::Vector3d(0.3, 0.3, 0.3)));
  const RobotQuery query(shippedArm(), obstacles);
  std::mt19937_64 random(7);
  int probable = 0;
  for (int i = 0; i < 60; ++i) {
    const Eigen::VectorXd values = nearbyValues(query.robot(), random);
    for (const ContactMeaning contact : {ContactMeaning::fcl, ContactMeaning::solid}) {
      ProbabilityRequest request = withTolerance(1e-3);
      request.contact = contact;
      const ProbableResult decided = query.decideProbably({values}, 0.05, 1e-6, request);
      request.threshold = 0.05;
      const RobotResult truth = query.state(values, request);
      CAPTURE(i, truth.any.lower, truth.any.upper, decided.probable.lower, decided.probable.upper);
      if (truth.decision == Decision::below) CHECK_FALSE(isAbove(decided.decision));
      if (truth.decision == Decision::above) CHECK_FALSE(isBelow(decided.decision));
      CHECK(overlap(truth.any, decided.certified));
      probable += isProbable(decided);
    }
  }
  CHECK(probable > 0);
}

TEST_CASE("a probable decision of a motion is that of the union; the same seed, the same answer") {
  const RobotQuery query(shippedArm(), ballAndBox());
  const auto waypoints = sweep(query.robot(), 12);
  const Bounds truth = query.motion(waypoints, ErrorsOverTime::persistent, withTolerance(0.01)).any;
  for (const double factor : {0.8, 1.0 / 0.8}) {
    const double threshold = std::min(0.9999, factor * truth.middle());
    if (threshold > truth.lower && threshold < truth.upper) continue;
    const ProbableResult one = query.decideProbably(waypoints, threshold, 1e-6, {});
    const ProbableResult two = query.decideProbably(waypoints, threshold, 1e-6, {});
    CHECK(one.status == ProbabilityStatus::decided);
    CHECK((threshold < truth.lower ? isAbove(one.decision) : isBelow(one.decision)));
    CHECK(one.decision == two.decision);
    CHECK(one.samples == two.samples);
    CHECK(one.probable.lower == two.probable.lower);
    CHECK(one.probable.upper == two.probable.upper);
  }
}

TEST_CASE("what cannot be sampled is decided for certain") {
  const Robot arm = shippedArm();
  const Eigen::VectorXd values = arm.values({{"shoulder", 0.2}, {"elbow", 0.3}});
  std::vector<Obstacle> obstacles = ballAndBox();
  const GaussianDisplacement gaussian = sigma(0.03, 0.02, 0.04);
  obstacles[0].displacement = GaussianMixture({{0.5, gaussian}, {0.5, gaussian}});
  obstacles[1].geometry = std::make_shared<fcl::Halfspaced>(Eigen::Vector3d(0, 0, 1), -0.4);
  obstacles[1].pose = fcl::Transform3d::Identity();
  const ProbableResult result = RobotQuery(arm, obstacles).decideProbably({values}, 0.5, 0.1, {});
  CHECK(result.decision == ProbableDecision::certainly_below);
  CHECK(result.chance_of_error == 0.0);
  CHECK(result.samples == 0);
}

TEST_CASE("limits leave a probable decision open, with intervals that hold") {
  const RobotQuery query(shippedArm(), ballAndBox());
  const auto waypoints = sweep(query.robot(), 12);
  const Bounds truth = query.motion(waypoints, ErrorsOverTime::persistent, withTolerance(0.01)).any;
  ProbabilityRequest request;
  request.max_cells = 10;
  const ProbableResult few = query.decideProbably(waypoints, truth.middle(), 1e-9, request);
  CHECK(few.status == ProbabilityStatus::cell_limit);
  CHECK(few.decision == ProbableDecision::undecided);
  CHECK(overlap(few.certified, truth));
  CHECK(overlap(few.probable, truth));
  // Samples, a proof and more samples share them.
  request.max_cells = 150;
  const ProbableResult more = query.decideProbably(waypoints, truth.middle(), 1e-9, request);
  CHECK(more.status == ProbabilityStatus::cell_limit);
  CHECK(more.cells >= 150);
  CHECK(more.cells <= 160);
  CHECK(overlap(more.certified, truth));
  CHECK(overlap(more.probable, truth));
  request = {};
  request.on_progress = [](const ProbabilityProgress&) { return false; };
  const ProbableResult cancelled = query.decideProbably(waypoints, truth.middle(), 1e-9, request);
  CHECK(cancelled.status == ProbabilityStatus::cancelled);
}

TEST_CASE("a probable decision refuses what makes no sense") {
  const RobotQuery query(shippedArm(), ballAndBox());
  const std::vector<Eigen::VectorXd> values{query.robot().values({})};
  CHECK_THROWS_AS(query.decideProbably(values, 0.05, 0.0, {}), InvalidRequest);
  CHECK_THROWS_AS(query.decideProbably(values, 0.05, 1.0, {}), InvalidRequest);
  CHECK_THROWS_AS(query.decideProbably(values, 1.5, 0.1, {}), InvalidRequest);
  CHECK_THROWS_AS(query.decideProbably({}, 0.05, 0.1, {}), InvalidRequest);
  ProbabilityRequest estimate;
  estimate.method = ProbabilityMethod::estimate;
  CHECK_THROWS_AS(query.decideProbably(values, 0.05, 0.1, estimate), InvalidRequest);
  CHECK(toString(ProbableDecision::probably_below) == "probably-below");
}
