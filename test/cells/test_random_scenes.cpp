// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The certified interval against displaced fcl::collide on random scenes of real parts.
#ifdef FCL_PROB_HAS_IO
#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <sstream>

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
GaussianDisplacement randomDisplacement(RandomBodies& random, double largest) {
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

double roughProbability(const PartitionQuery& query, const GaussianDisplacement& displacement) {
  ProbabilityRequest request = fcl_prob_test::intervalRequest(0.5);
  request.max_cells = 300;
  const ProbabilityResult result = query.run(displacement, request);
  // Of an interval over many decades, as far away ones are, the upper end counts.
  return *result.lower > 0.01 * *result.upper ? result.probability() : *result.upper;
}

// Moves B along `direction` until P is about `target`, if there is such a distance.
void moveApart(PartitionQuery& query, const GaussianDisplacement& displacement,
               const Eigen::Vector3d& direction, double target) {
  double near = 0.0;
  double far = 6.0;
  for (int step = 0; step < 9; ++step) {
    const double middle = 0.5 * (near + far);
    query.pose_b.translation() = middle * direction;
    (roughProbability(query, displacement) > target ? near : far) = middle;
  }
}

// One in eight scenes is of objects deep in each other with little noise, where P is nearly 1; in
// the others P is spread evenly over nine decades.
GaussianDisplacement placeAtRandom(PartitionQuery& query, RandomBodies& random, int number) {
  query.pose_a.linear() = random.rotation();
  query.pose_b.linear() = random.rotation();
  const Eigen::Vector3d direction = random.direction();
  if (number % 8 == 7) {
    query.pose_b.translation() = random.uniform(0.0, 0.3) * direction;
    return randomDisplacement(random, random.logUniform(0.002, 0.05));
  }
  const auto displacement = randomDisplacement(random, random.logUniform(0.02, 0.5));
  moveApart(query, displacement, direction, random.logUniform(1e-9, 1.0));
  return displacement;
}

/// How many scenes have P, or 1 - P where that is smaller, in each decade.
class Decades {
 public:
  void add(const Bounds& interval) {
    const double p = interval.middle();
    if (p > 0.5) {
      ++likely_[decadeOf(1.0 - p)];
    } else {
      ++unlikely_[decadeOf(p)];
    }
  }

  int unlikely(int decade) const { return count(unlikely_, decade); }
  int likely() const {
    int sum = 0;
    for (const auto& [decade, scenes] : likely_) sum += scenes;
    return sum;
  }

  std::string text() const {
    std::ostringstream out;
    for (const auto& [decade, scenes] : unlikely_) out << "  1e" << decade << ": " << scenes;
    for (const auto& [decade, scenes] : likely_) out << "  1-1e" << decade << ": " << scenes;
    return out.str();
  }

 private:
  static int decadeOf(double p) {
    return p > 0.0 ? std::max(-20, static_cast<int>(std::floor(std::log10(p)))) : -20;
  }
  static int count(const std::map<int, int>& decades, int decade) {
    const auto found = decades.find(decade);
    return found == decades.end() ? 0 : found->second;
  }

  std::map<int, int> unlikely_;
  std::map<int, int> likely_;
};

void checkScenes(int count, unsigned seed, std::size_t most_cells) {
  const auto parts = partsOrSkip();
  if (parts.empty()) return;
  RandomBodies random(seed);
  Decades decades;
  int limited = 0;
  for (int i = 0; i < count; ++i) {
    const auto& a = parts[static_cast<std::size_t>(random.integer(0, 7))];
    const auto& b = parts[static_cast<std::size_t>(random.integer(0, 7))];
    PartitionQuery query(a, b);
    const GaussianDisplacement displacement = placeAtRandom(query, random, i);
    const Comparison comparison = compare(query, displacement, most_cells);
    const ProbabilityResult& interval = comparison.interval;
    INFO("scene " << i << ": " << *interval.lower << " .. " << *interval.upper);
    REQUIRE(*interval.lower <= *interval.upper);
    if (comparison.sampled) {
      INFO("sampled " << comparison.sampled->lower << " .. " << comparison.sampled->upper);
      CHECK(comparison.sampled->lower <= *interval.upper);
      CHECK(comparison.sampled->upper >= *interval.lower);
    }
    if (interval.status == fcl_prob::ProbabilityStatus::cell_limit) ++limited;
    decades.add({*interval.lower, *interval.upper});
  }
  std::cout << "scenes by decade of P:" << decades.text()
            << "; stopped by the cell limit: " << limited << "\n";
  int populated = 0;
  for (int decade = -8; decade < 0; ++decade) populated += decades.unlikely(decade) >= count / 50;
  INFO("scenes by decade:" << decades.text());
  CHECK(populated >= 7);
  CHECK(decades.likely() >= count / 20);
  CHECK(limited < count * 3 / 4);
}

}  // namespace

TEST_CASE("intervals hold sampled probabilities on 25 random scenes", "[random][slow]") {
  checkScenes(25, 1, 1'000);
}

TEST_CASE("intervals hold sampled probabilities on 2,000 random scenes", "[random][long]") {
  checkScenes(2'000, 2, 5'000);
}
#endif
