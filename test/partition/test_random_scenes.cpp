// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The certified interval against displaced fcl::collide on random scenes of real parts.
#ifdef FCL_PROB_HAS_IO
#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>

#include "catch.h"
#include "fcl_prob/mesh_io.h"
#include "fcl_prob/monte_carlo.h"
#include "models.h"
#include "partition_query.h"
#include "random_bodies.h"

namespace {

using fcl_prob::Bounds;
using fcl_prob::GaussianDisplacement;
using fcl_prob::ProbabilityRequest;
using fcl_prob::ProbabilityResult;
using fcl_prob_test::PartitionQuery;
using fcl_prob_test::RandomBodies;

// Five standard errors of a normal distribution.
constexpr double kFiveSigma = 0.9999994;

std::vector<fcl_prob::TriangleMesh> partsOrSkip() {
  std::vector<fcl_prob::TriangleMesh> parts;
  for (const char* path :
       {"fetch_robot/fetch_description/meshes/gripper_link.STL",
        "fetch_robot/fetch_description/meshes/elbow_flex_link_collision.STL",
        "fetch_robot/fetch_description/meshes/l_gripper_finger_link.STL",
        "fetch_robot/fetch_description/meshes/bellows_link_collision.STL",
        "objects/coke_can_500.obj", "human/hand_lowres.obj", "human/human_arm_left_2000.obj",
        "fetch_robot/fetch_description/meshes/wrist_roll_link_collision.STL"}) {
    const auto full = fcl_prob_test::modelOrSkip(path);
    if (!full) return {};
    parts.push_back(fcl_prob::normalized(fcl_prob::loadMesh(*full)));
  }
  return parts;
}

// Standard deviations with a condition number of the covariance between 1 and 1e8.
GaussianDisplacement randomDisplacement(RandomBodies& random) {
  const double largest = random.logUniform(0.02, 0.5);
  const double ratio = random.logUniform(1e-4, 1.0);
  const Eigen::Vector3d sigma(largest, largest * std::sqrt(ratio), largest * ratio);
  return GaussianDisplacement::fromStandardDeviations(sigma, random.quaternion());
}

struct Comparison {
  ProbabilityResult interval;
  std::optional<Bounds> sampled;
};

// Plain sampling where it sees hits, importance sampling below that.
Comparison compare(const PartitionQuery& query, const GaussianDisplacement& displacement,
                   std::size_t most_cells) {
  Comparison comparison;
  ProbabilityRequest request = fcl_prob_test::intervalRequest(0.05);
  request.max_cells = most_cells;
  comparison.interval = query.run(displacement, request);
  ProbabilityRequest sampling;
  sampling.relative_tolerance = 1e-9;
  sampling.absolute_tolerance = 0.0;
  sampling.confidence = kFiveSigma;
  sampling.samples = 2'000;
  if (*comparison.interval.upper > 0.01) {
    sampling.method = fcl_prob::ProbabilityMethod::monte_carlo;
    comparison.sampled =
        fcl_prob::monteCarloProbability(*query.model_a, query.pose_a, *query.model_b, query.pose_b,
                                        displacement, sampling)
            .confidence_interval;
  } else if (*comparison.interval.upper > 1e-12) {
    sampling.method = fcl_prob::ProbabilityMethod::rare_event;
    comparison.sampled =
        fcl_prob::rareEventProbability(*query.model_a, query.pose_a, *query.model_b, query.pose_b,
                                       displacement, sampling)
            .confidence_interval;
  }
  return comparison;
}

void checkScenes(int count, unsigned seed, std::size_t most_cells) {
  const auto parts = partsOrSkip();
  if (parts.empty()) return;
  RandomBodies random(seed);
  std::map<int, int> decades;
  int limited = 0;
  for (int i = 0; i < count; ++i) {
    const auto& a = parts[static_cast<std::size_t>(random.integer(0, 7))];
    const auto& b = parts[static_cast<std::size_t>(random.integer(0, 7))];
    PartitionQuery query(a, b);
    query.pose_a.linear() = random.rotation();
    query.pose_b.linear() = random.rotation();
    query.pose_b.translation() = random.uniform(0.0, 1.6) * random.direction();
    const Comparison comparison = compare(query, randomDisplacement(random), most_cells);
    const ProbabilityResult& interval = comparison.interval;
    INFO("scene " << i << ": " << *interval.lower << " .. " << *interval.upper);
    REQUIRE(*interval.lower <= *interval.upper);
    if (comparison.sampled) {
      INFO("sampled " << comparison.sampled->lower << " .. " << comparison.sampled->upper);
      CHECK(comparison.sampled->lower <= *interval.upper);
      CHECK(comparison.sampled->upper >= *interval.lower);
    }
    if (interval.status == fcl_prob::ProbabilityStatus::cell_limit) ++limited;
    const double p = 0.5 * (*interval.lower + *interval.upper);
    ++decades[p > 0 ? std::max(-20, static_cast<int>(std::floor(std::log10(p)))) : -20];
  }
  std::cout << "scenes by decade of P:";
  int rare = 0;
  for (const auto& [decade, scenes] : decades) {
    std::cout << "  1e" << decade << ": " << scenes;
    if (decade < -2 && decade > -20) rare += scenes;
  }
  std::cout << "; stopped by the cell limit: " << limited << "\n";
  CHECK(decades[-1] > count / 10);
  CHECK(rare > count / 20);
  CHECK(limited < count / 2);
}

}  // namespace

TEST_CASE("intervals hold sampled probabilities on 60 random scenes", "[random]") {
  checkScenes(60, 1, 1'000);
}

TEST_CASE("intervals hold sampled probabilities on 2,000 random scenes", "[random][long]") {
  checkScenes(2'000, 2, 20'000);
}
#endif
