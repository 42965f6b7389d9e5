// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Estimates by lines: their lengths against points that FCL tests one by one, the estimates against
// intervals.
#include <fcl/narrowphase/collision.h>

#include <cmath>

#include "catch.h"
#include "fcl_prob/normal_mass.h"
#include "lines/whole_body_lines.h"
#include "partition_query.h"
#include "random_bodies.h"
#include "whitened_meshes.h"

namespace {

using fcl_prob::GaussianDisplacement;
using fcl_prob::normalIntervalMass;
using fcl_prob::ProbabilityMethod;
using fcl_prob::ProbabilityRequest;
using fcl_prob::ProbabilityResult;
using fcl_prob::TriangleMesh;
using namespace fcl_prob::detail;
using fcl_prob_test::boxMesh;
using fcl_prob_test::bumpyMesh;
using fcl_prob_test::hullMesh;
using fcl_prob_test::joined;
using fcl_prob_test::PartitionQuery;
using fcl_prob_test::RandomBodies;
using fcl_prob_test::WhitenedMeshes;

const GaussianDisplacement kUnit(Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity());

std::unique_ptr<WholeBodyLines> linesOf(const WhitenedMeshes& meshes) {
  const PartitionObject a = meshes.objectOf(true);
  const PartitionObject b = meshes.objectOf(false);
  const auto whole = wholeBodyOf(a, b, kUnit);
  if (!whole) return nullptr;
  return WholeBodyLines::of(*whole, meshes.pair, meshes.whitening.matrix(), nullptr);
}

bool collides(const WhitenedMeshes& meshes, const Eigen::Vector3d& y) {
  fcl::Transform3d moved = fcl::Transform3d::Identity();
  moved.translation() = y;
  fcl::CollisionResultd result;
  return fcl::collide(meshes.model_a.get(), moved, meshes.model_b.get(),
                      fcl::Transform3d::Identity(), fcl::CollisionRequestd(), result) > 0;
}

/// By points, in the middle of steps.
double massByPoints(const WhitenedMeshes& meshes, const Eigen::Vector2d& u, int steps) {
  constexpr double kEnd = 6.0;
  const double step = 2 * kEnd / steps;
  double mass = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double from = -kEnd + i * step;
    const Eigen::Vector3d y(from + 0.5 * step, u[0], u[1]);
    if (collides(meshes, y)) mass += normalIntervalMass(from, from + step);
  }
  return mass;
}

/// Over lines of a column, in the middle of steps.
double meanOnLines(WholeBodyLines& lines, const Column& column) {
  const auto all = lines.everything();
  constexpr int kSteps = 12;
  const Eigen::Vector2d step = (column.hi - column.lo) / kSteps;
  double sum = 0.0, measure = 0.0;
  for (int i = 0; i < kSteps * kSteps; ++i) {
    const Eigen::Vector2d lo =
        column.lo + step.cwiseProduct(Eigen::Vector2d(i / kSteps, i % kSteps));
    const double of_step =
        normalIntervalMass(lo[0], lo[0] + step[0]) * normalIntervalMass(lo[1], lo[1] + step[1]);
    sum += of_step * lines.massOn(lo + 0.5 * step, all, {0.0, 1e-12}, Taken::cores);
    measure += of_step;
  }
  return sum / measure;
}

ProbabilityRequest estimateRequest(double relative_tolerance, int seed) {
  ProbabilityRequest request;
  request.method = ProbabilityMethod::estimate;
  request.absolute_tolerance = 0.0;
  request.relative_tolerance = relative_tolerance;
  request.seed = static_cast<std::uint64_t>(seed);
  return request;
}

bool isByLines(const ProbabilityResult& result) {
  return fcl_prob_test::planMentions(result, "parallel lines");
}

constexpr int kLineSeeds = 60;

/// What estimates with different seeds are off the truth by, in standard errors, root mean square.
/// \param by_lines  to it is added how many of them were not left to cells
double deviationOf(const PartitionQuery& query, const GaussianDisplacement& displacement,
                   int& by_lines) {
  const ProbabilityResult truth = query.run(displacement, fcl_prob_test::intervalRequest(5e-4));
  double sum = 0.0;
  for (int seed = 1; seed <= kLineSeeds; ++seed) {
    const ProbabilityResult result = query.run(displacement, estimateRequest(0.01, seed));
    by_lines += isByLines(result);
    CHECK(*result.upper >= *truth.lower);
    CHECK(*result.standard_error <= 0.01 * *result.estimate);
    const double off = (*result.estimate - truth.probability()) / *result.standard_error;
    sum += off * off;
  }
  return std::sqrt(sum / kLineSeeds);
}

/// Two plates, one across and one along the way between the objects.
TriangleMesh cornerMesh() {
  return joined(fcl_prob_test::transformed(boxMesh({0.1, 4, 4}),
                                           Eigen::Isometry3d(Eigen::Translation3d(1.05, 0, 0))),
                fcl_prob_test::transformed(boxMesh({4, 0.1, 4}),
                                           Eigen::Isometry3d(Eigen::Translation3d(-1, 1.1, 0))));
}

/// Of the line { (s, u) } what is in a box around 0.
double massInBox(const Eigen::Vector3d& half, const Eigen::Vector3d& at, const Eigen::Vector2d& u) {
  const Eigen::Vector2d away = (u - at.tail<2>()).cwiseAbs();
  if ((half.array() <= 0.0).any() || away[0] >= half[1] || away[1] >= half[2]) return 0.0;
  return normalIntervalMass(at[0] - half[0], at[0] + half[0]);
}

}  // namespace

// Where faces, edges and lines are parallel but for rounding, searches for ends of lines come to
// planes that hardly differ; what they end at is kept for the lines that follow.
TEST_CASE("lines along faces of boxes have what the boxes tell", "[lines]") {
  RandomBodies random(12);
  int met = 0;
  const auto sides = [&random](double least, double most) {
    return Eigen::Vector3d(random.uniform(least, most), random.uniform(least, most),
                           random.uniform(least, most));
  };
  for (int scene = 0; scene < 60; ++scene) {
    const Eigen::Vector3d half = sides(0.05, 0.4), of_mesh = sides(0.5, 3.0);
    const Eigen::Vector3d at = random.uniform(0.0, 2.0) * random.direction();
    const Eigen::AngleAxisd turn(random.logUniform(1e-17, 1e-7), random.direction());
    const auto turned = [&](const Eigen::Vector3d& box, const Eigen::Vector3d& to) {
      return fcl_prob_test::transformed(boxMesh(2 * box), turn * Eigen::Translation3d(to));
    };
    const WhitenedMeshes meshes(turned(half, Eigen::Vector3d::Zero()), turned(of_mesh, at));
    const auto lines = linesOf(meshes);
    REQUIRE(lines);
    const auto all = lines->everything();
    for (int i = 0; i < 100; ++i) {
      const Eigen::Vector2d u(random.uniform(-4, 4), random.uniform(-4, 4));
      const double truth = massInBox(of_mesh + half, at, u) - massInBox(of_mesh - half, at, u);
      CAPTURE(scene, i, half.transpose(), of_mesh.transpose(), at.transpose(), u.transpose());
      CHECK(std::fabs(lines->massOn(u, all, {0.0, 1e-12}, Taken::cores) - truth) < 1e-6);
      met += truth > 1e-3;
    }
  }
  CHECK(met > 1000);
}

// Of the plane of a face that is along a triangle and the lines nothing is left but rounding: a
// search that takes it in ends at nowhere, and so do those of the lines that follow.
TEST_CASE("lines along faces of turned boxes have what the boxes tell", "[lines]") {
  RandomBodies random(13);
  const auto sides = [&random](double scale) -> Eigen::Vector3d {
    return Eigen::Vector3d(random.uniform(0.05, 0.5), random.uniform(0.05, 0.5),
                           random.uniform(0.05, 0.5)) *
           scale;
  };
  int met = 0, wrong = 0;
  for (int scene = 0; scene < 400; ++scene) {
    const double scale = random.logUniform(0.3, 10.0);
    const Eigen::Vector3d half = sides(scale * random.logUniform(0.3, 3.0)), other = sides(scale);
    const Eigen::Vector3d around = half + other, within = (half - other).cwiseAbs();
    const Eigen::Vector3d at = random.uniform(0.0, 1.2) * around.cwiseProduct(random.direction());
    const bool may_hold = (other.array() > half.array()).all();
    const double angle = random.uniform(0.0, 6.0);
    const Eigen::AngleAxisd turn(angle, Eigen::Vector3d::UnitX());
    const Eigen::AngleAxisd rounding(random.logUniform(1e-17, 1e-15), random.direction());
    const auto turned = [&](const Eigen::Vector3d& box, const Eigen::Vector3d& to) {
      return fcl_prob_test::transformed(boxMesh(2 * box),
                                        rounding * turn * Eigen::Translation3d(to));
    };
    const WhitenedMeshes meshes(turned(half, Eigen::Vector3d::Zero()), turned(other, at));
    const auto lines = linesOf(meshes);
    if (!lines) continue;  // the mesh may be within the body
    const auto all = lines->everything();
    const Eigen::Rotation2Dd about_lines(angle);
    for (int i = 0; i < 400; ++i) {
      const Eigen::Vector2d of_box =
          at.tail<2>() + 1.3 * around.tail<2>().cwiseProduct(
                                   Eigen::Vector2d(random.uniform(-1, 1), random.uniform(-1, 1)));
      const double hidden = may_hold ? massInBox(within, at, of_box) : 0.0;
      const double truth = massInBox(around, at, of_box) - hidden;
      const double mass = lines->massOn(about_lines * of_box, all, {0.0, 1e-12}, Taken::cores);
      wrong += std::fabs(mass - truth) > 1e-6;
      met += truth > 1e-3;
    }
  }
  CHECK(met > 20000);
  CHECK(wrong == 0);
}

TEST_CASE("what is small enough to be inside a surface is not taken whole", "[lines]") {
  const WhitenedMeshes meshes(fcl_prob_test::sphereMesh(1.0, 20, 30), boxMesh({0.2, 0.2, 0.2}));
  CHECK_FALSE(linesOf(meshes));
}

TEST_CASE("lines have as much of a C-obstacle as the points on them", "[lines]") {
  RandomBodies random(1);
  int met = 0;
  int covered = 0, followed = 0;
  for (int scene = 0; scene < 10; ++scene) {
    const TriangleMesh body = fcl_prob_test::transformed(
        hullMesh(random.onSphere(random.integer(4, 200), random.uniform(0.2, 0.6))),
        Eigen::Isometry3d(Eigen::Translation3d(random.uniform(0.5, 1.5) * random.direction())));
    const TriangleMesh other = bumpyMesh(1.0, 12, 16, static_cast<std::uint64_t>(scene));
    const bool body_is_a = scene % 2 == 0;
    const WhitenedMeshes meshes(body_is_a ? body : other, body_is_a ? other : body);
    const auto lines = linesOf(meshes);
    REQUIRE(lines);
    const auto all = lines->everything();
    for (int i = 0; i < 30; ++i) {
      const Eigen::Vector2d u(random.normal(), random.normal());
      constexpr int kSteps = 600;
      const double mass = lines->massOn(u, all, {0.0, 1e-12}, Taken::cores);
      // At most some ends, each within half a step.
      CHECK(std::fabs(mass - massByPoints(meshes, u, kSteps)) < 4 * 0.4 * 6.0 / kSteps);
      const Eigen::Vector2d width(random.uniform(0, 1), random.uniform(0, 1));
      CHECK(lines->mostOn(lines->meet({u - width, u + width}, all)) >= mass);
      const Column around{u - 0.2 * width, u + 0.2 * width};
      const auto middle = lines->contactsOn(u, all, Taken::cores);
      CHECK(std::fabs(middle.mass - mass) <= 0.1 * mass + 2e-6);
      const double mean = meanOnLines(*lines, around);
      const double of_chain = lines->leastOn(around, middle.chain);
      CHECK(of_chain <= mean + 1e-3);
      covered += of_chain > 0.0;
      followed += of_chain > 0.8 * mean;
      CHECK(lines->mostMeanOn(around, lines->meet(around, all)) >= mean - 1e-3);
      CHECK(std::fabs(lines->massOn(u, all, {1e-3, 1e-9}, Taken::cores) - mass) <=
            1e-3 * mass + 2e-9);
      met += mass > 0.0;
    }
  }
  CHECK(met > 100);
  CHECK(covered > 50);
  CHECK(followed > 10);
}

// Lines that pass a plate must not make up for those that meet it.
TEST_CASE("bounds by columns hold at the rims of thin plates", "[lines]") {
  RandomBodies random(21);
  int partial = 0, covered = 0;
  const auto plateAt = [&random](double x) {
    const Eigen::Vector3d sides(random.logUniform(1e-3, 0.1), random.uniform(0.5, 3.0),
                                random.uniform(0.5, 3.0));
    const Eigen::AngleAxisd turn(random.uniform(0.0, 0.3), random.direction());
    const Eigen::Translation3d to(x, random.uniform(-1, 1), random.uniform(-1, 1));
    return fcl_prob_test::transformed(boxMesh(sides), to * turn);
  };
  for (int scene = 0; scene < 40; ++scene) {
    const TriangleMesh body = hullMesh(random.onSphere(30, random.logUniform(1e-3, 0.05)));
    const double x = random.uniform(0.2, 2.0);
    const WhitenedMeshes meshes(body, joined(plateAt(x), plateAt(x + random.uniform(0.2, 1.0))));
    const auto lines = linesOf(meshes);
    REQUIRE(lines);
    for (int i = 0; i < 40; ++i) {
      const Eigen::Vector2d u(random.uniform(-2, 2), random.uniform(-2, 2));
      const Eigen::Vector2d half(random.logUniform(0.01, 0.5), random.logUniform(0.01, 0.5));
      const Column column{u - half, u + half};
      const double mean = meanOnLines(*lines, column);
      const auto met = lines->meet(column, lines->everything());
      const auto middle = lines->contactsOn(u, met, Taken::cores);
      CAPTURE(scene, i, u.transpose(), half.transpose(), mean, middle.mass);
      // The mean is of 144 lines, some of which pass the rims.
      CHECK(lines->mostMeanOn(column, met) >= 0.7 * mean);
      CHECK(lines->leastOn(column, middle.chain) <= 1.3 * mean);
      partial += mean > 0.0 && middle.mass == 0.0;
      covered += lines->leastOn(column, middle.chain) > 0.0;
    }
  }
  CHECK(partial > 20);
  CHECK(covered > 20);
}

TEST_CASE("estimates by lines scatter as their standard errors say", "[lines][slow]") {
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.1, 0.2, 0.15});
  RandomBodies random(2);
  const TriangleMesh bumpy = bumpyMesh(0.7, 12, 16, 5);
  struct QueryScene {
    TriangleMesh body;
    double distance;
  };
  const std::vector<QueryScene> scenes{
      {hullMesh(random.onSphere(60, 0.5)), 1.2},   {hullMesh(random.onSphere(60, 0.5)), 1.5},
      {hullMesh(random.onSphere(200, 0.1)), 0.95}, {boxMesh({0.02, 0.8, 0.8}), 1.0},
      {boxMesh({0.8, 0.05, 0.05}), 1.2},
  };
  int by_lines = 0, all = 0;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    PartitionQuery query(scenes[i].body, bumpy);
    query.pose_a.linear() = random.rotation();
    query.pose_a.translation() = Eigen::Vector3d(scenes[i].distance, 0.1, -0.2);
    for (const bool solid : {false, true}) {
      if (solid) query.makeSolid();
      const double deviation = deviationOf(query, displacement, by_lines);
      all += kLineSeeds;
      CAPTURE(i, solid);
      // What may be unseen makes the standard error larger than the deviation, most of all beside
      // the edges of a thin box.
      CHECK(deviation > (i == 4 ? 0.25 : 0.5));
      CHECK(deviation < 1.3);
    }
  }
  CHECK(by_lines > 0.9 * all);
}

TEST_CASE("bounds by columns hold, and decide what is clear", "[lines]") {
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.1, 0.2, 0.15});
  RandomBodies random(6);
  int by_columns = 0;
  for (int scene = 0; scene < 12; ++scene) {
    PartitionQuery query(hullMesh(random.onSphere(random.integer(10, 200), 0.5)),
                         bumpyMesh(0.7, 12, 16, static_cast<std::uint64_t>(scene)));
    query.pose_a.linear() = random.rotation();
    query.pose_a.translation() = random.uniform(1.0, 1.6) * random.direction();
    if (scene % 2 == 0) query.makeSolid();
    const ProbabilityResult truth = query.run(displacement, fcl_prob_test::intervalRequest(5e-3));
    for (const double factor : {0.1, 0.3, 0.6, 1.6, 3.0}) {
      ProbabilityRequest request = fcl_prob_test::intervalRequest(1e-9);
      request.threshold = std::min(0.999, factor * truth.probability());
      const ProbabilityResult result = query.run(displacement, request);
      CAPTURE(scene, factor, truth.probability(), *result.lower, *result.upper);
      CHECK(*result.lower <= *truth.upper);
      CHECK(*result.upper >= *truth.lower);
      CHECK(result.decision == (*request.threshold > truth.probability()
                                    ? fcl_prob::Decision::below
                                    : fcl_prob::Decision::above));
      by_columns += fcl_prob_test::planMentions(result, "decided by bounds on");
    }
  }
  CHECK(by_columns > 12);
}

// Along the axes of the displacement, so that lines have all or nothing of the C-obstacle, and its
// edges are along the sides of columns: often none of the few lines of a column misses it. P is a
// product of tails.
TEST_CASE("edges along the sides of columns count in the standard error", "[lines][slow]") {
  const Eigen::Vector3d sigma(0.07, 0.06, 0.1);
  const auto displacement = GaussianDisplacement::fromStandardDeviations(sigma);
  // Two corners, of which one is out of reach: not convex.
  const Eigen::Isometry3d corner(Eigen::Translation3d(2.5, 2.5, 0));
  const Eigen::Isometry3d far(Eigen::Translation3d(-9, 0, 0));
  const TriangleMesh others = joined(fcl_prob_test::transformed(boxMesh({4, 4, 4}), corner),
                                     fcl_prob_test::transformed(boxMesh({1, 1, 1}), far));
  RandomBodies random(12);
  double sum = 0.0, largest = 0.0;
  int count = 0;
  for (int scene = 0; scene < 60; ++scene) {
    PartitionQuery query(boxMesh({0.2, 0.4, 0.3}), others);
    const Eigen::Vector2d deviations(random.uniform(0.5, 3.0), random.uniform(0.5, 3.0));
    query.pose_a.translation() = Eigen::Vector3d(0.5 - 0.1 - deviations[0] * sigma[0],
                                                 0.5 - 0.2 - deviations[1] * sigma[1], 0.0);
    const double truth =
        normalIntervalMass(deviations[0], 40) * normalIntervalMass(deviations[1], 40);
    for (int seed = 1; seed <= 10; ++seed) {
      const ProbabilityResult result = query.run(displacement, estimateRequest(0.003, seed));
      if (!isByLines(result)) continue;
      const double off = (*result.estimate - truth) / *result.standard_error;
      sum += off * off;
      largest = std::max(largest, std::fabs(off));
      ++count;
    }
  }
  CAPTURE(count, largest, std::sqrt(sum / count));
  CHECK(count > 500);
  CHECK(std::sqrt(sum / count) < 1.2);
  CHECK(largest < 6.5);
}

// A threshold just above P takes a few hundred columns, if they are allowed.
TEST_CASE("columns count as cells, of which there is a limit", "[lines]") {
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.1, 0.2, 0.15});
  RandomBodies random(16);
  std::size_t most = 0;
  for (int scene = 0; scene < 4; ++scene) {
    PartitionQuery query(hullMesh(random.onSphere(80, 0.5)),
                         bumpyMesh(0.7, 12, 16, static_cast<std::uint64_t>(scene)));
    query.pose_a.translation() = 1.3 * random.direction();
    const ProbabilityResult truth = query.run(displacement, fcl_prob_test::intervalRequest(5e-3));
    for (const std::size_t limit : {std::size_t{2'000'000}, std::size_t{100}, std::size_t{40}}) {
      ProbabilityRequest request = fcl_prob_test::intervalRequest(1e-9);
      request.threshold = 1.12 * truth.probability();
      request.max_cells = limit;
      const ProbabilityResult result = query.run(displacement, request);
      CAPTURE(scene, limit, result.statistics.cells);
      CHECK(*result.lower <= *truth.upper);
      CHECK(*result.upper >= *truth.lower);
      CHECK(result.statistics.cells <= limit);
      if (limit > 100) most = std::max(most, result.statistics.cells);
    }
  }
  CHECK(most > 150);
}

TEST_CASE("an obstacle along the lines is not missed", "[lines]") {
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.2, 0.2, 0.2});
  RandomBodies random(3);
  PartitionQuery query(hullMesh(random.onSphere(60, 0.3)), cornerMesh());
  const ProbabilityResult truth = query.run(displacement, fcl_prob_test::intervalRequest(3e-3));
  for (int seed = 1; seed <= 20; ++seed) {
    const ProbabilityResult result = query.run(displacement, estimateRequest(0.01, seed));
    CHECK(isByLines(result));
    CHECK(std::fabs(*result.estimate - truth.probability()) < 4 * *result.standard_error);
  }
}

// Axes whose deviations are far apart are not turned towards the nearest contact, so that all that
// collides may be far out across the lines, where few are drawn.
TEST_CASE("what collides far out across the lines is not missed", "[lines]") {
  const auto displacement = GaussianDisplacement::fromStandardDeviations({1.0, 0.02, 0.02});
  RandomBodies random(8);
  PartitionQuery query(hullMesh(random.onSphere(60, 0.3)), bumpyMesh(0.7, 12, 16, 5));
  int by_lines = 0;
  for (int seed = 1; seed <= 20; ++seed) {
    query.pose_b.translation() = Eigen::Vector3d(0.0, random.uniform(1.0, 1.1), 0.0);
    const ProbabilityResult truth = query.run(displacement, fcl_prob_test::intervalRequest(3e-3));
    ProbabilityRequest request = estimateRequest(0.01, seed);
    request.absolute_tolerance = 0.01 * truth.probability();
    const ProbabilityResult result = query.run(displacement, request);
    CAPTURE(seed, truth.probability(), *result.estimate, *result.standard_error);
    by_lines += isByLines(result);
    CHECK(std::fabs(*result.estimate - truth.probability()) <
          6 * *result.standard_error + 3e-3 * truth.probability());
  }
  CHECK(by_lines > 10);
}

TEST_CASE("lines in a closed mesh count as collisions of solids, and not of surfaces", "[lines]") {
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.3, 0.3, 0.3});
  RandomBodies random(4);
  PartitionQuery query(hullMesh(random.onSphere(60, 0.2)), bumpyMesh(1.0, 16, 20, 7));
  query.pose_a.translation() = Eigen::Vector3d(0.6, 0.1, 0.0);
  for (const bool solid : {false, true}) {
    if (solid) query.makeSolid();
    const ProbabilityResult truth = query.run(displacement, fcl_prob_test::intervalRequest(2e-3));
    const ProbabilityResult result = query.run(displacement, estimateRequest(0.01, 1));
    CAPTURE(solid, truth.probability(), *result.estimate);
    CHECK(isByLines(result));
    CHECK(std::fabs(*result.estimate - truth.probability()) < 5 * *result.standard_error);
  }
}

TEST_CASE("an estimate by lines that is interrupted says how little it knows", "[lines]") {
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.1, 0.2, 0.15});
  RandomBodies random(5);
  PartitionQuery query(hullMesh(random.onSphere(60, 0.5)), bumpyMesh(0.7, 12, 16, 5));
  query.pose_a.translation() = Eigen::Vector3d(1.3, 0.1, -0.2);
  const ProbabilityResult truth = query.run(displacement, fcl_prob_test::intervalRequest(1e-3));
  for (const int calls : {1, 5, 20}) {
    ProbabilityRequest request = estimateRequest(0.001, 1);
    int left = calls;
    request.on_progress = [&left](const fcl_prob::ProbabilityProgress&) { return --left > 0; };
    const ProbabilityResult result = query.run(displacement, request);
    CHECK(result.status == fcl_prob::ProbabilityStatus::cancelled);
    CHECK(std::fabs(*result.estimate - truth.probability()) < 3 * *result.standard_error);
    CHECK(*result.upper >= *truth.lower);
  }
}
