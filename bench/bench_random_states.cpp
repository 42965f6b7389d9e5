// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// fcl_prob bench random-states: whole robots in any state beside a person, as a planner asks.
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>

#include "base/stopwatch.h"
#include "bench/benchmark.h"
#include "bench/least_distance.h"
#include "bench/random_states.h"
#include "bench/random_states_near.h"
#include "cli/number_text.h"
#include "robot/joint_indices.h"
#include "robot/many_states.h"
#include "robot/state_screen.h"

namespace fcl_prob::cli {
namespace {

constexpr double kThresholdOfStates = 0.05;
constexpr double kPaddings[] = {2.0, 3.0};  // largest standard deviations
constexpr double kStepAside = 1e-3;         // metres, of an obstacle between two questions
constexpr int kCans = 9;                    // beside the person, where there are ten obstacles

/// Places of the obstacles for each robot, states for each place.
constexpr int kPlaces = 10;
constexpr int kStatesOfPlace = 500;
constexpr int kStatesAmongCans = 100;
constexpr int kStatesQuick = 50;

/// What a state is sampled with, one of so many: that takes up to a second.
constexpr std::uint64_t kSamplesOfRandomState = 10'000;
constexpr std::size_t kStatesOfSampled = 100;

/// What teams do today: a state is safe where everything is farther than some deviations.
struct Padding {
  std::vector<double> milliseconds;  ///< a state
  /// States that it refuses and that are below, and that it allows and that are above.
  std::array<int, std::size(kPaddings)> false_alarms{}, missed{};

  void count(std::size_t i, bool allows, ProbableDecision decision) {
    false_alarms[i] += !allows && decision == ProbableDecision::certainly_below;
    missed[i] += allows && decision == ProbableDecision::certainly_above;
  }
};

struct StateCosts {
  std::vector<double> certified, moved, collide, probable, sampled;  ///< milliseconds a state
  std::vector<std::string> decisions;
  int below = 0, above = 0, open = 0;
  Padding by_distance, by_mesh;
  double mebibytes = 0.0;  ///< of what was prepared and kept
};

/// One place of the obstacles, and what planners keep for all states there.
struct Place {
  RobotQuery query;
  detail::StateScreen screen;
  std::array<std::vector<Geometry>, std::size(kPaddings)> padded;  ///< bodies

  explicit Place(RobotQuery at)
      : query(std::move(at)),
        screen(query.among(), query.robot().values({}), detail::allJoints(query.robot())) {
    double most = 0.0;
    for (const Obstacle& obstacle : query.obstacles()) most = std::max(most, deviationOf(obstacle));
    for (std::size_t i = 0; i < std::size(kPaddings); ++i) {
      padded[i] = paddedBodies(query.robot(), kPaddings[i] * most);
    }
  }

  static double deviationOf(const Obstacle& obstacle) {
    return std::get<GaussianDisplacement>(obstacle.displacement).standardDeviations()[0];
  }
};

void addDistances(const Place& place, const std::vector<fcl::Transform3d>& poses,
                  ProbableDecision decision, Padding& costs) {
  const detail::Stopwatch watch;
  double least = std::numeric_limits<double>::infinity();  // deviations
  for (const Obstacle& obstacle : place.query.obstacles()) {
    const double deviation = Place::deviationOf(obstacle);
    least = leastDistance(place.query.robot(), poses, obstacle, least * deviation) / deviation;
  }
  costs.milliseconds.push_back(watch.milliseconds());
  for (std::size_t i = 0; i < std::size(kPaddings); ++i) {
    costs.count(i, least > kPaddings[i], decision);
  }
}

/// \param bodies  those of the robot, or padded ones
template <typename Bodies>
bool touchesObstacles(const RobotQuery& query, const Bodies& bodies,
                      const std::vector<fcl::Transform3d>& poses) {
  return std::any_of(query.obstacles().begin(), query.obstacles().end(), [&](const Obstacle& one) {
    return touchesAny(bodies, poses, *one.geometry, one.pose);
  });
}

void addPaddedMeshes(const Place& place, const std::vector<fcl::Transform3d>& poses,
                     ProbableDecision decision, Padding& costs) {
  const detail::Stopwatch watch;
  for (std::size_t i = 0; i < std::size(kPaddings); ++i) {
    costs.count(i, !touchesObstacles(place.query, place.padded[i], poses), decision);
  }
  costs.milliseconds.push_back(watch.milliseconds() / std::size(kPaddings));
}

void addRandomState(const Place& place, const Eigen::VectorXd& values, StateCosts& costs) {
  const RobotQuery& query = place.query;
  ProbabilityRequest request;
  request.threshold = kThresholdOfStates;
  const detail::Stopwatch watch;
  const ProbableDecision decision = detail::certain(place.screen.decision(values, request));
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
  const auto poses = query.robot().poses(values);
  const detail::Stopwatch of_collide;
  touchesObstacles(query, query.robot(), poses);
  costs.collide.push_back(of_collide.milliseconds());
  if (costs.collide.size() % kStatesOfSampled == 1) {
    costs.sampled.push_back(msOfSamples(query, poses, kSamplesOfRandomState));
  }
  addDistances(place, poses, decision, costs.by_distance);
  addPaddedMeshes(place, poses, decision, costs.by_mesh);
}

std::string perSecond(const std::vector<double>& milliseconds) {
  double sum = 0.0;
  for (const double one : milliseconds) sum += one;
  return numberText(1e3 * static_cast<double>(milliseconds.size()) / sum, 3);
}

void addWorldRow(const std::string& world, const StateCosts& costs, BenchReport& report) {
  std::vector<std::string> row{world,
                               std::to_string(costs.below) + " / " + std::to_string(costs.above) +
                                   " / " + std::to_string(costs.open),
                               perSecond(costs.certified),
                               perSecond(costs.probable),
                               perSecond(costs.moved),
                               perSecond(costs.collide),
                               perSecond(costs.sampled)};
  for (const double share : {0.5, 0.9, 0.99, 1.0}) {
    row.push_back(numberText(quantile(costs.certified, share), 3));
  }
  row.push_back(numberText(costs.mebibytes, 3));
  report.table.add(row);
  report.records.push_back({{"world", world},
                            {"below", costs.below},
                            {"above", costs.above},
                            {"undecided", costs.open},
                            {"decisions", costs.decisions},
                            {"certified_ms", costs.certified},
                            {"probable_ms", costs.probable},
                            {"moved_ms", costs.moved},
                            {"collide_ms", costs.collide},
                            {"sampled_ms", costs.sampled},
                            {"mebibytes", costs.mebibytes}});
}

void addPaddingRow(const std::string& world, const std::string& way, const Padding& costs,
                   BenchReport& report) {
  std::vector<std::string> row{world, way, perSecond(costs.milliseconds)};
  for (std::size_t i = 0; i < std::size(kPaddings); ++i) {
    row.push_back(std::to_string(costs.false_alarms[i]) + " / " + std::to_string(costs.missed[i]));
  }
  report.more_tables[0].table.add(row);
  report.records.push_back({{"world", world},
                            {"padding", way},
                            {"ms", costs.milliseconds},
                            {"false_alarms", costs.false_alarms},
                            {"missed", costs.missed}});
}

/// Resident now; 0 where the system does not say.
double residentMebibytes() {
  std::ifstream file("/proc/self/statm");
  double all = 0.0, resident = 0.0;
  file >> all >> resident;
  return resident * static_cast<double>(::sysconf(_SC_PAGESIZE)) / (1 << 20);
}

BenchReport reportOfWorlds() {
  BenchReport report;
  report.title = "Random states of whole robots beside a person: P < 5 % or not";
  report.table = TextTable({"world", "below / above / open", "certified / s", "probable / s",
                            "moved / s", "fcl::collide / s", "Monte Carlo / s", "ms: median",
                            "90 %", "99 %", "worst", "MiB"});
  report.notes =
      "States a second, one thread, as planners ask, of a whole robot beside a person of 4,980 "
      "triangles, who "
      "stands\n"
      "0.4 to 1 m away, and in a world of ten obstacles besides nine cans of 500, with standard\n"
      "deviations of 10 to 50 mm along random axes. Joint values are uniform within their limits.\n"
      "`moved`: the person is 1 mm aside of where the query had it; `fcl::collide`: all bodies "
      "until\n"
      "one does, where the obstacles are expected; `Monte Carlo`: the same for 10,000 samples, of\n"
      "every hundredth state. The times at the right are of certified decisions; `MiB`: what the\n"
      "process has grown by when all were answered.\n"
      "Padding by 2 and 3 of the largest deviations, by `fcl::distance` or by meshes\n"
      "that are moved outwards so far: of the states above those that it refuses though P is\n"
      "below / that it allows though P is above.\n";
  report.more_tables.push_back(
      {"Padding", TextTable({"world", "by", "states / s", "2 sigma", "3 sigma"})});
  return report;
}

struct World {
  std::string robot;
  int cans;
  int states() const { return cans > 0 ? kStatesAmongCans : kStatesOfPlace; }
  std::string name() const { return robot + (cans > 0 ? ", ten obstacles" : ""); }
};

}  // namespace

BenchReport benchRandomStates(const BenchOptions& options, const BenchProgress& progress) {
  BenchReport report = reportOfWorlds();
  const Geometry person = personMesh(options.models_folder), can = canMesh(options.models_folder);
  const std::vector<World> worlds{
      {"KUKA iiwa", 0}, {"Fetch", 0}, {"KUKA iiwa", kCans}, {"Fetch", kCans}};
  for (std::size_t w = 0; w < worlds.size(); ++w) {
    const World& world = worlds[w];
    if (world.name().find(options.only) == std::string::npos) continue;
    const double before = residentMebibytes();
    const Robot robot = benchRobot(options.models_folder, world.robot);
    Uniforms random(options.seed + w);
    const auto obstaclesOfPlace = [&] {
      std::vector<Obstacle> all{personBeside(person, random)};
      for (Obstacle& one : cansAround(can, random, world.cans)) all.push_back(std::move(one));
      return all;
    };
    StateCosts costs;
    const RobotQuery first(robot, obstaclesOfPlace());
    for (int k = 0; k < kPlaces; ++k) {
      const double done = (static_cast<double>(w) + static_cast<double>(k) / kPlaces) /
                          static_cast<double>(worlds.size());
      if (!progress(0.5 * done, world.name())) return report;
      const Place place(first.withObstacles(obstaclesOfPlace()));
      const Eigen::MatrixXd states =
          drawnStates(robot, random, options.quick ? kStatesQuick : world.states());
      for (Eigen::Index i = 0; i < states.cols(); ++i) addRandomState(place, states.col(i), costs);
    }
    costs.mebibytes = residentMebibytes() - before;
    addWorldRow(world.name(), costs, report);
    addPaddingRow(world.name(), "distance", costs.by_distance, report);
    addPaddingRow(world.name(), "mesh", costs.by_mesh, report);
  }
  addNearStates(options, person, progress, report);
  return report;
}

}  // namespace fcl_prob::cli
