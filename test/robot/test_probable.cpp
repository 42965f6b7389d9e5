// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Probable decisions: against certified ones, wrong no more often than stated.
#include <fcl/geometry/shape/halfspace.h>

#include <sstream>

#include "arm_motions.h"
#include "fcl_prob/exceptions.h"
#include "mesh_shapes.h"
#include "temporary_folder.h"

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

std::string objText(const TriangleMesh& mesh) {
  std::ostringstream text;
  text.precision(17);
  for (const auto& v : mesh.vertices) text << "v " << v[0] << ' ' << v[1] << ' ' << v[2] << '\n';
  for (const auto& t : mesh.triangles) {
    text << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
  }
  return text.str();
}

/// Two convex meshes on a carriage that moves along three axes, by 0.4 m.
Robot gantry(const TemporaryFolder& folder) {
  folder.write("hand.obj", objText(sphereMesh(0.06, 8, 12)));
  folder.write("tool.obj", objText(boxMesh({0.02, 0.03, 0.15})));
  std::string urdf = "<robot name=\"gantry\"><link name=\"world\"/>";
  std::string parent = "world";
  for (const char axis : {'x', 'y', 'z'}) {
    const std::string name(1, axis);
    const std::string direction = axis == 'x' ? "1 0 0" : axis == 'y' ? "0 1 0" : "0 0 1";
    urdf += "<link name=\"along_" + name + "\">";
    if (axis == 'z') {
      urdf += R"(<collision><geometry><mesh filename="hand.obj"/></geometry></collision>
        <collision><origin xyz="0 0 0.1"/><geometry><mesh filename="tool.obj"/></geometry></collision>)";
    }
    urdf += "</link><joint name=\"" + name + "\" type=\"prismatic\"><parent link=\"" + parent +
            "\"/><child link=\"along_" + name + "\"/><axis xyz=\"" + direction +
            "\"/><limit lower=\"-0.4\" upper=\"0.4\" velocity=\"1\" effort=\"1\"/></joint>";
    parent = "along_" + name;
  }
  return Robot::fromText(urdf + "</robot>", {}, folder.path(""));
}

/// What a gantry is among: a rock and a ring.
std::vector<Obstacle> rockAndRing() {
  return {{"rock", makeModel<fcl::OBBRSSd>(bumpyMesh(0.12, 12, 16, 3)), at(0.1, 0.1, 0.0),
           sigma(0.03, 0.02, 0.04)},
          {"ring", makeModel<fcl::OBBRSSd>(torusMesh(0.15, 0.03, 24, 10)), at(-0.2, -0.1, 0.1),
           sigma(0.02, 0.05, 0.01)}};
}

Eigen::VectorXd nearbyValues(std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(-0.35, 0.35);
  return Eigen::Vector3d(uniform(random), uniform(random), uniform(random));
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
    const Eigen::VectorXd values = nearbyValues(random);
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
  const TemporaryFolder folder;
  const RobotQuery query(gantry(folder), rockAndRing());
  for (const double chance : {0.1, 1e-4}) {
    const Calibration found = calibrate(query, 0.05, chance, 5'000, 51);
    CAPTURE(chance, found.probable, found.decided, found.wrong, found.outside);
    CHECK(found.probable > 200);
    CHECK(found.wrong <= mostOf(found.decided, chance));
    CHECK(found.outside <= mostOf(found.probable, chance));
  }
}

TEST_CASE("probable decisions just beside a threshold are wrong no more often than stated",
          "[slow]") {
  const TemporaryFolder folder;
  const RobotQuery query(gantry(folder), rockAndRing());
  std::mt19937_64 random(61);
  constexpr double kChance = 0.2;
  int probable = 0, wrong = 0;
  for (int state = 0; state < 40; ++state) {
    const Eigen::VectorXd values = nearbyValues(random);
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
  const TemporaryFolder folder;
  const RobotQuery query(gantry(folder), {rockAndRing()[0]});
  std::mt19937_64 random(7);
  int probable = 0;
  for (int i = 0; i < 60; ++i) {
    const Eigen::VectorXd values = nearbyValues(random);
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
