// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// fcl_prob bench random-states: whole robots in any state beside a person, as a planner asks.
#include <algorithm>
#include <array>
#include <limits>

#include "base/stopwatch.h"
#include "bench/benchmark.h"
#include "bench/least_distance.h"
#include "bench/random_states.h"
#include "cli/number_text.h"
#include "cli/random_displacement.h"

namespace fcl_prob::cli {
namespace {

constexpr double kThresholdOfStates = 0.05;
constexpr double kPaddings[] = {2.0, 3.0};  // largest standard deviations
constexpr double kStepAside = 1e-3;         // metres, of an obstacle between two questions

/// Places of the person for each robot, states for each place.
constexpr int kPlaces = 10;
constexpr int kStatesOfPlace = 500;
constexpr int kStatesQuick = 50;

/// What a state is sampled with, one of so many: that takes up to a second.
constexpr std::uint64_t kSamplesOfRandomState = 10'000;
constexpr std::size_t kStatesOfSampled = 100;

struct StateCosts {
  std::vector<double> certified, moved, collide, probable;  ///< milliseconds a state
  std::vector<std::string> decisions;
  int below = 0, above = 0, open = 0;
  std::vector<double> distance, sampled;  ///< milliseconds a state
  /// By padding: states that it refuses and that are below, and that it allows and that are above.
  std::array<int, std::size(kPaddings)> false_alarms{}, missed{};
};

/// What teams do today: a state is safe where everything is farther than some deviations.
void addPadding(const RobotQuery& query, const Eigen::VectorXd& values, ProbableDecision decision,
                StateCosts& costs) {
  const detail::Stopwatch watch;
  const double distance =
      leastDistance(query.robot(), query.robot().poses(values), query.obstacles()[0],
                    std::numeric_limits<double>::infinity());
  costs.distance.push_back(watch.milliseconds());
  const auto& error = std::get<GaussianDisplacement>(query.obstacles()[0].displacement);
  for (std::size_t i = 0; i < std::size(kPaddings); ++i) {
    const bool allows = distance > kPaddings[i] * error.standardDeviations()[0];
    costs.false_alarms[i] += !allows && decision == ProbableDecision::certainly_below;
    costs.missed[i] += allows && decision == ProbableDecision::certainly_above;
  }
}

double msOfCollide(const RobotQuery& query, const Eigen::VectorXd& values) {
  const auto poses = query.robot().poses(values);
  const Obstacle& obstacle = query.obstacles()[0];
  const detail::Stopwatch watch;
  touchesAny(query.robot(), poses, *obstacle.geometry, obstacle.pose);
  return watch.milliseconds();
}

/// Monte Carlo, its share of samples left alone.
double msOfSamples(const RobotQuery& query, const Eigen::VectorXd& values) {
  const auto poses = query.robot().poses(values);
  const Obstacle& obstacle = query.obstacles()[0];
  const Whitening whitening(std::get<GaussianDisplacement>(obstacle.displacement));
  const detail::Stopwatch watch;
  for (std::uint64_t i = 0; i < kSamplesOfRandomState; ++i) {
    fcl::Transform3d pose = obstacle.pose;
    pose.translation() += randomDisplacement(whitening, 1, i);
    touchesAny(query.robot(), poses, *obstacle.geometry, pose);
  }
  return watch.milliseconds();
}

void addRandomState(const RobotQuery& query, const Eigen::VectorXd& values, StateCosts& costs) {
  ProbabilityRequest request;
  request.threshold = kThresholdOfStates;
  const detail::Stopwatch watch;
  const ProbableDecision decision = query.decideStates(values, request)[0];
  costs.certified.push_back(watch.milliseconds());
  costs.decisions.push_back(toString(decision));
  costs.below += decision == ProbableDecision::certainly_below;
  costs.above += decision == ProbableDecision::certainly_above;
  costs.open += decision == ProbableDecision::undecided;
  const detail::Stopwatch probable;
  query.decideStates(values, request, 1e-4);
  costs.probable.push_back(probable.milliseconds());
  std::vector<Obstacle> moved = query.obstacles();
  moved[0].pose.translation().x() += kStepAside;
  const detail::Stopwatch of_moved;
  query.withObstacles(std::move(moved)).decideStates(values, request);
  costs.moved.push_back(of_moved.milliseconds());
  costs.collide.push_back(msOfCollide(query, values));
  if (costs.collide.size() % kStatesOfSampled == 1) {
    costs.sampled.push_back(msOfSamples(query, values));
  }
  addPadding(query, values, decision, costs);
}

std::string perSecond(const std::vector<double>& milliseconds) {
  double sum = 0.0;
  for (const double one : milliseconds) sum += one;
  return numberText(1e3 * static_cast<double>(milliseconds.size()) / sum, 3);
}

void addRobotRow(const std::string& name, const StateCosts& costs, BenchReport& report) {
  std::vector<std::string> row{name,
                               std::to_string(costs.below) + " / " + std::to_string(costs.above) +
                                   " / " + std::to_string(costs.open),
                               perSecond(costs.certified),
                               perSecond(costs.probable),
                               perSecond(costs.moved),
                               perSecond(costs.collide),
                               perSecond(costs.distance),
                               perSecond(costs.sampled)};
  for (std::size_t i = 0; i < std::size(kPaddings); ++i) {
    row.push_back(std::to_string(costs.false_alarms[i]) + " / " + std::to_string(costs.missed[i]));
  }
  for (const double share : {0.5, 0.9, 0.99, 1.0}) {
    row.push_back(numberText(quantile(costs.certified, share), 3));
  }
  report.table.add(row);
  report.records.push_back({{"robot", name},
                            {"below", costs.below},
                            {"above", costs.above},
                            {"undecided", costs.open},
                            {"decisions", costs.decisions},
                            {"certified_ms", costs.certified},
                            {"probable_ms", costs.probable},
                            {"moved_ms", costs.moved},
                            {"collide_ms", costs.collide},
                            {"distance_ms", costs.distance},
                            {"sampled_ms", costs.sampled},
                            {"false_alarms", costs.false_alarms},
                            {"missed", costs.missed}});
}

}  // namespace

BenchReport benchRandomStates(const BenchOptions& options, const BenchProgress& progress) {
  BenchReport report;
  report.title = "Random states of whole robots beside a person: P < 5 % or not";
  report.table = TextTable({"robot", "below / above / open", "certified / s", "probable / s",
                            "moved / s", "fcl::collide / s", "fcl::distance / s", "Monte Carlo / s",
                            "2 sigma", "3 sigma", "ms: median", "90 %", "99 %", "worst"});
  report.notes =
      "States a second, one thread, of a whole robot beside a person of 4,980 triangles, who "
      "stands\n"
      "0.4 to 1 m away with standard deviations of 10 to 50 mm along random axes. Joint values "
      "are\n"
      "uniform within their limits. `moved`: the person is 1 mm aside of where the query had it;\n"
      "`fcl::collide`: all bodies until one does, where the person is expected; `Monte Carlo`: "
      "the\n"
      "same for 10,000 samples, of every hundredth state. `2 sigma`, `3 sigma`:\n"
      "padding by so many of the largest deviations (fcl::distance): states that it refuses though "
      "P\n"
      "is below, and that it allows though P is above. The times at the right are of certified\n"
      "decisions.\n";
  const Geometry mesh = personMesh(options.models_folder);
  const std::vector<std::string> names{"KUKA iiwa", "Fetch"};
  for (std::size_t r = 0; r < names.size(); ++r) {
    if (names[r].find(options.only) == std::string::npos) continue;
    const Robot robot = benchRobot(options.models_folder, names[r]);
    Uniforms random(options.seed + r);
    StateCosts costs;
    const RobotQuery first(robot, {personBeside(mesh, random)});
    for (int place = 0; place < kPlaces; ++place) {
      const double done = static_cast<double>(place) / kPlaces;
      if (!progress(0.5 * (static_cast<double>(r) + done), names[r])) return report;
      const RobotQuery query = first.withObstacles({personBeside(mesh, random)});
      const Eigen::MatrixXd states =
          drawnStates(robot, random, options.quick ? kStatesQuick : kStatesOfPlace);
      for (Eigen::Index k = 0; k < states.cols(); ++k) addRandomState(query, states.col(k), costs);
    }
    addRobotRow(names[r], costs, report);
  }
  return report;
}

}  // namespace fcl_prob::cli
