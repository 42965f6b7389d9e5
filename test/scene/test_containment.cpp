// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Solids of several shells (contact = solid), against a test of boxes by comparison of coordinates.
#include <fcl/geometry/octree/octree.h>
#include <fcl/geometry/shape/box.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "catch.h"
#include "fcl_prob/collision_probability.h"
#include "fcl_prob/group.h"
#include "mesh_shapes.h"
#include "random_bodies.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

struct Box {
  Eigen::Vector3d middle;
  Eigen::Vector3d half;

  Box movedBy(const Eigen::Vector3d& move) const { return {middle + move, half}; }
  bool meets(const Box& other) const {
    return ((middle - other.middle).cwiseAbs().array() <= (half + other.half).array()).all();
  }
  bool isWithin(const Box& other) const {
    return ((middle - other.middle).cwiseAbs().array() < (other.half - half).array()).all();
  }
};

/// A box, perhaps hollow, perhaps a mere point.
struct Shell {
  Box outside;
  std::optional<Box> cavity;

  bool meets(const Shell& other, const Eigen::Vector3d& move) const {
    const Box moved = outside.movedBy(move);
    if (!moved.meets(other.outside)) return false;
    if (other.cavity && moved.isWithin(*other.cavity)) return false;
    return !cavity || !other.outside.isWithin(cavity->movedBy(move));
  }
};

using Shells = std::vector<Shell>;

bool meet(const Shells& a, const Shells& b, const Eigen::Vector3d& move) {
  return std::any_of(a.begin(), a.end(), [&](const Shell& x) {
    return std::any_of(b.begin(), b.end(), [&](const Shell& y) { return x.meets(y, move); });
  });
}

TriangleMesh meshOf(const Box& box) {
  return transformed(boxMesh(2 * box.half), Eigen::Isometry3d(Eigen::Translation3d(box.middle)));
}

/// A triangle with equal corners.
TriangleMesh pointMesh(const Eigen::Vector3d& at) {
  TriangleMesh mesh;
  mesh.vertices = {at};
  mesh.triangles = {{0, 0, 0}};
  return mesh;
}

TriangleMesh meshOf(const Shells& shells, RandomBodies& random) {
  TriangleMesh mesh;
  for (const Shell& shell : shells) {
    TriangleMesh part =
        shell.outside.half.isZero() ? pointMesh(shell.outside.middle) : meshOf(shell.outside);
    if (shell.cavity) part = joined(part, reversed(meshOf(*shell.cavity)));
    if (random.integer(0, 2) == 0) part = reversed(part);
    mesh = random.integer(0, 1) == 0 ? joined(mesh, part) : joined(part, mesh);
  }
  return mesh;
}

Eigen::Vector3d positive(RandomBodies& random, double least, double most) {
  return {random.uniform(least, most), random.uniform(least, most), random.uniform(least, most)};
}

/// Beside each other, in a row with gaps: near ones and some that are far away.
Shells randomShells(RandomBodies& random, double size) {
  Shells shells;
  double x = 0.0;
  const int count = random.integer(1, 4);
  for (int i = 0; i < count; ++i) {
    Shell shell{{Eigen::Vector3d::Zero(), size * positive(random, 0.4, 1.0)}, std::nullopt};
    if (random.integer(0, 3) == 0) {
      shell.cavity = Box{0.05 * size * random.direction(), 0.8 * shell.outside.half};
    }
    if (i > 0 && random.integer(0, 3) == 0) {
      shell = Shell{{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()}, std::nullopt};
    }
    const double gap = random.integer(0, 1) == 0 ? 0.2 * size : 10.0 * random.uniform(1.0, 2.0);
    x += shell.outside.half.x() + (i > 0 ? gap : 0.0);
    const Eigen::Vector3d move(x, size * random.uniform(-0.2, 0.2), 0.0);
    shell.outside = shell.outside.movedBy(move);
    if (shell.cavity) shell.cavity = shell.cavity->movedBy(move);
    x += shell.outside.half.x();
    shells.push_back(shell);
  }
  // A shell of its own is at the origin, sometimes the first, sometimes the last of them.
  const std::size_t chosen = random.integer(0, 1) == 0 ? 0 : shells.size() - 1;
  const Eigen::Vector3d back = -shells[chosen].outside.middle;
  for (Shell& shell : shells) {
    shell.outside = shell.outside.movedBy(back);
    if (shell.cavity) shell.cavity = shell.cavity->movedBy(back);
  }
  return shells;
}

struct Sampled {
  double value;
  double deviation;
};

Sampled sample(const Shells& a, const Shells& b, const Eigen::Vector3d& mean, double sigma,
               RandomBodies& random) {
  constexpr int kSamples = 4000;
  int hits = 0;
  for (int i = 0; i < kSamples; ++i) hits += meet(a, b, mean + sigma * random.normalVector());
  const double value = static_cast<double>(hits) / kSamples;
  const double variance = std::max(value * (1 - value), 3.0 / kSamples);
  return {value, std::sqrt(variance / kSamples)};
}

ProbabilityRequest solidRequest(ProbabilityMethod method) {
  ProbabilityRequest request;
  request.method = method;
  request.contact = ContactMeaning::solid;
  request.relative_tolerance = 0.03;
  request.absolute_tolerance = 1e-4;
  request.max_cells = 3000;
  return request;
}

void checkHolds(const ProbabilityResult& result, const Sampled& truth) {
  CAPTURE(truth.value);
  CAPTURE(*result.lower);
  CAPTURE(*result.upper);
  CHECK(*result.lower <= truth.value + 5 * truth.deviation);
  CHECK(*result.upper >= truth.value - 5 * truth.deviation);
  if (result.estimate && result.status == ProbabilityStatus::converged) {
    const double error = std::hypot(truth.deviation, result.standard_error.value());
    CHECK(std::abs(*result.estimate - truth.value) <= 5 * error);
  }
}

}  // namespace

TEST_CASE("random solids of several shells hold what comparing coordinates counts") {
  RandomBodies random(12);
  int sure = 0;
  for (int i = 0; i < 150; ++i) {
    INFO("scene " << i);
    const bool same_size = random.integer(0, 3) == 0;
    const Shells small = randomShells(random, 0.1);
    const Shells large = randomShells(random, same_size ? 0.1 : 2.0);
    const bool small_first = random.integer(0, 1) == 0;
    const Shells& a = small_first ? small : large;
    const Shells& b = small_first ? large : small;
    const Eigen::Vector3d mean = random.uniform(0.0, 0.5) * random.direction();
    const double sigma = random.logUniform(0.02, 0.5);
    const auto model_a = makeModel<fcl::OBBRSSd>(meshOf(a, random));
    const auto model_b = makeModel<fcl::OBBRSSd>(meshOf(b, random));
    const auto method = i % 3 == 0 ? ProbabilityMethod::estimate : ProbabilityMethod::interval;
    ProbabilityResult result;
    collisionProbability(model_a.get(), fcl::Transform3d::Identity(), model_b.get(),
                         fcl::Transform3d::Identity(),
                         GaussianDisplacement::fromStandardDeviations(
                             Eigen::Vector3d::Constant(sigma), random.quaternion(), mean),
                         solidRequest(method), result);
    const Sampled truth = sample(a, b, mean, sigma, random);
    sure += truth.value > 0.9;
    checkHolds(result, truth);
  }
  CHECK(sure > 30);
}

TEST_CASE("voxels and members of groups are found in a solid one by one") {
  RandomBodies random(13);
  for (int i = 0; i < 30; ++i) {
    INFO("scene " << i);
    const double x = random.uniform(3.0, 10.0);
    const auto tree = std::make_shared<octomap::OcTree>(0.1);
    tree->updateNode(0.05, 0.05, 0.05, true);
    tree->updateNode(static_cast<float>(x), 0.05, 0.05, true);
    const auto octree = std::make_shared<fcl::OcTreed>(tree);
    const auto voxel = std::make_shared<fcl::Boxd>(0.1, 0.1, 0.1);
    const auto solid = makeModel<fcl::OBBRSSd>(boxMesh({4, 4, 4}));
    fcl::Transform3d far = fcl::Transform3d::Identity();
    far.translation().x() = x;
    const fcl::Transform3d here = fcl::Transform3d::Identity();
    const auto displacement = GaussianDisplacement::fromStandardDeviations({0.1, 0.1, 0.05});
    const auto method = i % 2 == 0 ? ProbabilityMethod::estimate : ProbabilityMethod::interval;
    ProbabilityResult result;
    collisionProbability(octree.get(), here, solid.get(), here, displacement, solidRequest(method),
                         result);
    CHECK(*result.upper == Approx(1.0));
    CHECK(result.probability() == Approx(1.0).epsilon(0.02));
    collisionProbability(solid.get(), here, octree.get(), here, displacement, solidRequest(method),
                         result);
    CHECK(*result.upper == Approx(1.0));
    GroupQuery(GroupQuery::Geometries{voxel, voxel}, GroupQuery::Geometries{solid})
        .collisionProbability({far, here}, {here}, displacement, solidRequest(method), result);
    CHECK(*result.upper == Approx(1.0));
    CHECK(result.probability() == Approx(1.0).epsilon(0.02));
  }
}

TEST_CASE("solids far from the origin contain what they contain beside it") {
  RandomBodies random(14);
  int changed = 0;
  for (int i = 0; i < 60; ++i) {
    INFO("scene " << i);
    // All coordinates are multiples of 2⁻⁸: moved by whole numbers they stay what they are.
    const double far = std::ldexp(1.0, random.integer(10, 40));
    const Eigen::Vector3d away = (far * random.direction()).array().round();
    const double side = std::ldexp(random.integer(1, 200), -8);
    const auto small = makeModel<fcl::OBBRSSd>(boxMesh({side, side, side}));
    const auto large = makeModel<fcl::OBBRSSd>(boxMesh({4, 4, 4}));
    fcl::Transform3d pose = fcl::Transform3d::Identity();
    pose.translation() = away;
    fcl::Transform3d beside = pose;
    const double offset = std::ldexp(random.integer(0, 1000), -8);
    beside.translation().x() += offset;
    // The mean brings it back, or the pose does.
    const bool by_mean = random.integer(0, 1) == 0;
    const Eigen::Vector3d mean = by_mean ? Eigen::Vector3d(-away) : Eigen::Vector3d::Zero();
    const double sigma = random.logUniform(1e-9, 0.1);
    ProbabilityResult result;
    collisionProbability(small.get(), beside, large.get(),
                         by_mean ? fcl::Transform3d::Identity() : pose,
                         GaussianDisplacement::fromStandardDeviations(
                             {sigma, 0, 0}, Eigen::Quaterniond::Identity(), mean),
                         solidRequest(ProbabilityMethod::interval), result);
    const double x = beside.translation().x() - away.x();
    const double reach = 2.0 + 0.5 * side;
    const double truth = 0.5 * (std::erfc((x - reach) / sigma * std::sqrt(0.5)) -
                                std::erfc((x + reach) / sigma * std::sqrt(0.5)));
    CAPTURE(x, reach, sigma, truth, *result.lower, *result.upper);
    CHECK(*result.lower <= truth * (1 + 1e-12));
    CHECK(*result.upper >= truth * (1 - 1e-12));
    CHECK(*result.upper - *result.lower < 0.04);
    changed += truth < 0.5;
  }
  CHECK(changed > 10);
}
