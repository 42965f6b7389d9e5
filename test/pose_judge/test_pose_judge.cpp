// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// That the judge's truths are true, and some of what it asks.
#include <boost/math/distributions/non_central_chi_squared.hpp>
#include <cmath>

#include "catch.h"
#include "given_mass.h"
#include "judge_report.h"
#include "random_bodies.h"
#include "scene_parts.h"

using namespace fcl_prob_judge;
using fcl_prob_test::RandomBodies;

namespace {

bool agree(double a, double b, double relative) {
  return std::fabs(a - b) <= relative * std::max(std::fabs(a), std::fabs(b));
}

/// How often A and B meet, by fcl::collide: it shares nothing with the truths.
fcl_prob::ProbabilityResult counted(const JudgedScene& scene, std::size_t samples) {
  fcl_prob::ProbabilityRequest request;
  request.method = fcl_prob::ProbabilityMethod::monte_carlo;
  request.relative_tolerance = 1e-9;
  request.absolute_tolerance = 1e-12;
  request.samples = samples;
  request.confidence = 0.99999;
  return AskableScene(scene).ask(request);
}

}  // namespace

TEST_CASE("the mass of a ball is noncentral chi-square in every rank") {
  RandomBodies random(1);
  for (int trial = 0; trial < 300; ++trial) {
    const double sigma = random.logUniform(0.01, 1.0), radius = random.logUniform(0.01, 3.0);
    const Vector3d offset = random.uniform(0.0, 2.0) * random.direction();
    for (int rank = 1; rank <= 3; ++rank) {
      const Translation translation{sigma, rank, random.rotation()};
      const Vector3d along = translation.within(offset);
      const double square = radius * radius - (offset - along).squaredNorm();
      double expected = 0.0;
      if (square > 0.0) {
        const boost::math::non_central_chi_squared law(rank, along.squaredNorm() / (sigma * sigma));
        expected = cdf(law, square / (sigma * sigma));
      }
      CAPTURE(sigma, radius, offset.norm(), rank);
      CHECK(std::fabs(massOfBall(offset, radius, translation) - expected) < 1e-12);
    }
  }
}

TEST_CASE("the mass of two rectangles is a product where their sides are parallel") {
  RandomBodies random(2);
  for (int trial = 0; trial < 300; ++trial) {
    const Eigen::Vector2d half(random.logUniform(0.01, 3.0), random.logUniform(0.01, 3.0));
    const Eigen::Vector2d other(random.logUniform(0.01, 3.0), random.logUniform(0.01, 3.0));
    const Eigen::Vector2d centre(random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0));
    const double angle = random.uniform(-3.0, 3.0), sigma = random.logUniform(0.05, 1.0);
    const Eigen::Rotation2Dd turn(angle);
    const Eigen::Vector2d reach = half + other;
    const double expected = massBetween(-reach.x(), reach.x(), centre.x(), sigma) *
                            massBetween(-reach.y(), reach.y(), centre.y(), sigma);
    const double mass = massOfRectangles({Eigen::Vector2d::Zero(), half, angle},
                                         {turn * centre, other, angle}, sigma);
    CHECK(std::fabs(mass - expected) < 1e-13);
  }
}

TEST_CASE("both rules agree to eight digits, and with what is known of the known scenes") {
  // To three digits, as they were found by others.
  const std::vector<double> published{0.0427, 0.01463, 0.0070, 0.1985, 0.99998};
  const std::vector<JudgedScene> scenes = knownScenes();
  REQUIRE(scenes.size() == published.size());
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    CAPTURE(scenes[i].name, scenes[i].truth);
    CHECK(agree(scenes[i].truth, published[i], 6e-3));
    Integrand truth = scenes[i].components.front().truth;
    // Wide panels are halved where they must be, which takes less than to begin with narrow ones.
    truth.feature = std::max(truth.feature, 0.1);
    CHECK(agree(meanByPanels(truth), scenes[i].truth, 1e-8));
  }
}

TEST_CASE("panels meet jumps: a lever's end beside a ball that it reaches along few axes") {
  for (int rank = 0; rank < 3; ++rank) {
    const Translation translation{rank == 0 ? 0.0 : 0.03, rank, Matrix3d::Identity()};
    const Lever lever{1.0, {0.0, 0.1, 0.1}, translation};
    const Obstacle ball = ballObstacle({0.98, 0.15, 0.02}, 0.08, 0.02, translation);
    Integrand truth = leverBeside(lever, {ball}, fcl::Transform3d::Identity(), false).truth;
    truth.feature = 0.2;
    const double mean = meanByPanels(truth);
    // The same angles the other way round, from other panels.
    Integrand swapped = truth;
    swapped.feature = 0.15;
    swapped.value = [&](const Vector3d& z) { return truth.value({z[1], z[0], 0.0}); };
    swapped.inside = [&](const Vector3d& z) { return truth.inside({z[1], z[0], 0.0}); };
    CAPTURE(rank, mean);
    CHECK(mean > 1e-3);
    CHECK(agree(meanByPanels(swapped), mean, 1e-8));
  }
}

TEST_CASE("panels meet kinks wherever they begin: boxes that turn") {
  for (const int index : {5, 6, 14, 15, 23, 32}) {
    const JudgedScene scene = drawnScene(1, index);
    CAPTURE(scene.name, scene.truth);
    Integrand other = scene.components.front().truth;
    CHECK_FALSE(other.smooth);
    other.feature *= 0.7;
    CHECK(agree(meanByPanels(other), scene.truth, 1e-8));
  }
}

TEST_CASE("P of the judge's scenes is what counting finds") {
  std::vector<JudgedScene> scenes = knownScenes();
  for (int index = 0; index < 9; ++index) scenes.push_back(drawnScene(3, index));
  for (const JudgedScene& scene : scenes) {
    const auto result = counted(scene, 20'000);
    CAPTURE(scene.name, scene.truth, *result.estimate);
    REQUIRE(result.confidence_interval);
    CHECK(result.confidence_interval->contains(scene.truth));
  }
}

TEST_CASE("misses are too many where chance has less than one in a thousand") {
  CHECK_FALSE(Misses{0, 0}.tooMany(1e-4));
  CHECK_FALSE(Misses{1, 100}.tooMany(1e-4));
  CHECK(Misses{1, 5}.tooMany(1e-4));
  CHECK(Misses{2, 400}.tooMany(1e-4));
  CHECK_FALSE(Misses{18, 1000}.tooMany(0.01));
  CHECK(Misses{25, 1000}.tooMany(0.01));
}

TEST_CASE("what is wrong is told: decisions, intervals, estimates and bounds") {
  Answer answer;
  answer.scene = "some";
  answer.truth = 0.2;
  answer.threshold = 0.1;
  answer.confidence = 0.9999;
  answer.decision = "below";
  CHECK(answer.decidedWrongly());
  answer.interval_lower = 0.01;
  answer.interval_upper = 0.1;
  CHECK(answer.missed());
  const Answer read = answerFromJson(jsonOf(answer));
  CHECK(jsonOf(read) == jsonOf(answer));
  CHECK(read.decidedWrongly());
  answer.lower = 0.3;
  CHECK(answer.violated());
  answer.mode = Mode::estimate;
  answer.status = "converged";
  answer.estimate = 0.1;
  answer.standard_error = 0.01;
  CHECK(agree(*answer.deviations(), -10.0, 1e-12));
  JudgeReport report;
  report.add(answer);
  CHECK(report.hasFaults());
  CHECK(report.total().beyond(6.0) == 1);
  CHECK_FALSE(report.text().empty());
}

TEST_CASE("decisions and estimates over poses and joints hold as often as is stated", "[long]") {
  JudgePlan plan;
  plan.seeds = 20;
  plan.factors = {0.5, 1.03};
  plan.confidences = {0.9999};
  // In place of a time limit, by which answers would not repeat.
  plan.max_cells = 2'000;
  std::vector<AskableScene> scenes;
  for (JudgedScene& scene : knownScenes()) scenes.emplace_back(std::move(scene));
  for (int index = 0; index < 9; ++index) scenes.emplace_back(drawnScene(2, index));
  JudgeReport report;
  runJudge(plan, scenes, [&](const Answer& answer) { report.add(answer); });
  INFO(report.text());
  CHECK_FALSE(report.hasFaults());
}
