// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// fcl_prob bench states: decisions on the states of a Fetch arm along paths past a human arm.
#include <fcl/narrowphase/collision.h>

#include "base/stopwatch.h"
#include "bench/benchmark.h"
#include "bench/table2_methods.h"
#include "bench/uniforms.h"
#include "cli/number_text.h"
#include "fcl_prob/motion_planning.h"

namespace fcl_prob::cli {
namespace {

constexpr double kThreshold = 0.05;
constexpr double kStepOfPath = 0.05;  // radians
constexpr std::size_t kStatesToPlan = 3'000;
constexpr std::size_t kCellsOfState = 20'000;

/// Calls of fcl::collide for one body and obstacle that a decision is compared with.
constexpr int kCollides = 100;

ProbabilityRequest decision() {
  ProbabilityRequest request;
  request.threshold = kThreshold;
  request.max_cells = kCellsOfState;
  return request;
}

struct StateTimes {
  std::vector<double> certified, probable, collide, ratios;  ///< milliseconds; over fcl::collide
  int below = 0, above = 0, open = 0;
  int probably = 0, wrong = 0;
};

/// All bodies against the obstacle where it is expected, kCollides times.
double timeCollide(const RobotQuery& query, const Eigen::VectorXd& values) {
  const auto poses = query.robot().poses(values);
  const detail::Stopwatch watch;
  for (int i = 0; i < kCollides; ++i) {
    for (std::size_t body = 0; body < poses.size(); ++body) {
      for (const Obstacle& obstacle : query.obstacles()) {
        fcl::CollisionResultd result;
        fcl::collide(query.robot().bodies()[body].geometry.get(), poses[body],
                     obstacle.geometry.get(), obstacle.pose, fcl::CollisionRequestd(), result);
      }
    }
  }
  return watch.milliseconds();
}

void addState(const RobotQuery& query, const Eigen::VectorXd& values, std::uint64_t seed,
              StateTimes& times) {
  const detail::Stopwatch certified_watch;
  const Decision certified = query.state(values, decision()).decision;
  times.certified.push_back(certified_watch.milliseconds());
  ProbabilityRequest request = decision();
  request.threshold.reset();
  request.seed = seed;
  const detail::Stopwatch probable_watch;
  const ProbableResult probable =
      query.decideProbably({values}, kThreshold, kChanceOfError, request);
  times.probable.push_back(probable_watch.milliseconds());
  times.collide.push_back(timeCollide(query, values));
  times.ratios.push_back(times.certified.back() / times.collide.back());
  const bool says_below = probable.decision == ProbableDecision::probably_below ||
                          probable.decision == ProbableDecision::certainly_below;
  times.below += certified == Decision::below;
  times.above += certified == Decision::above;
  times.open += certified != Decision::below && certified != Decision::above;
  times.probably += probable.samples > 0;
  times.wrong +=
      (certified == Decision::below && !says_below) || (certified == Decision::above && says_below);
}

/// States of the paths of several seeds, those that tests of states allow.
std::vector<Eigen::VectorXd> statesOfPaths(const Table2Scene& scene, std::uint64_t first_seed,
                                           int seeds) {
  const RobotQuery& query = scene.around.front()->query;
  const StateTest test = [&](const Eigen::VectorXd& values) {
    return !scene.self.collides(values) &&
           query.state(values, decision()).decision == Decision::below;
  };
  std::vector<Eigen::VectorXd> states;
  for (int k = 0; k < seeds; ++k) {
    PlanningRequest request;
    request.joints = scene.joints;
    request.largest_step = kStepOfPath;
    request.seed = first_seed + static_cast<std::uint64_t>(k);
    request.max_states = kStatesToPlan;
    const PlanningResult plan = planMotion(scene.robot(), test, scene.start, scene.goal, request);
    if (plan.status != PlanningStatus::solved) continue;
    for (const Eigen::VectorXd& values : interpolated(plan.waypoints, kStepOfPath)) {
      states.push_back(values);
    }
  }
  return states;
}

std::vector<std::string> cellsOf(const std::vector<double>& values) {
  return {numberText(quantile(values, 0.5), 3), numberText(quantile(values, 0.9), 3),
          numberText(quantile(values, 0.99), 3)};
}

std::string joined(const std::vector<double>& values) {
  const auto cells = cellsOf(values);
  return cells[0] + " / " + cells[1] + " / " + cells[2];
}

void addRow(const std::string& scene, const StateTimes& times, BenchReport& report) {
  report.table.add({scene, std::to_string(times.certified.size()),
                    std::to_string(times.below) + " / " + std::to_string(times.above) + " / " +
                        std::to_string(times.open),
                    joined(times.certified), joined(times.ratios), joined(times.probable),
                    std::to_string(times.probably), std::to_string(times.wrong)});
  report.records.push_back({{"scene", scene},
                            {"below", times.below},
                            {"above", times.above},
                            {"undecided", times.open},
                            {"certified_ms", times.certified},
                            {"probable_ms", times.probable},
                            {"collide_ms", times.collide},
                            {"by_samples", times.probably},
                            {"wrong", times.wrong}});
}

}  // namespace

BenchReport benchStates(const BenchOptions& options, const BenchProgress& progress) {
  BenchReport report;
  report.title = "States of a Fetch arm along paths past a human arm: P < 5 % or not";
  report.table = TextTable({"scene", "states", "below / above / open", "certified / ms",
                            "over 100 fcl::collide", "probable / ms", "by samples", "wrong"});
  report.notes =
      "Ten bodies of arm and gripper against one human arm of 2,000 triangles, standard deviations "
      "of\n"
      "10 mm (0 s) to 40 mm (3 s). All states, in steps of at most 0.05 rad, of paths by\n"
      "RRT-Connect and short cuts for which each state was decided by the certified decision. "
      "Times are\n"
      "median / 90 % / 99 %, of one query by itself; the ratio is to 100 calls of fcl::collide a "
      "body, where\n"
      "the arm is expected. `by samples`: states that the probable decision (chance of error "
      "1e-4)\n"
      "drew samples for; `wrong`: otherwise than the certified decision.\n";
  const int seeds = options.quick ? 1 : 5;
  const auto scenes = singleArmScenes(options.models_folder);
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    if (scenes[s].name.find(options.only) == std::string::npos) continue;
    const double fraction = static_cast<double>(s) / static_cast<double>(scenes.size());
    if (!progress(fraction, scenes[s].name)) break;
    StateTimes times;
    for (const Eigen::VectorXd& values : statesOfPaths(scenes[s], options.seed, seeds)) {
      addState(scenes[s].around.front()->query, values, options.seed + times.certified.size(),
               times);
    }
    if (!times.certified.empty()) addRow(scenes[s].name, times, report);
  }
  return report;
}

}  // namespace fcl_prob::cli
