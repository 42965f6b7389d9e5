// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "bench/random_states_near.h"

#include <functional>
#include <utility>
#include <vector>

#include "base/decision.h"
#include "base/stopwatch.h"
#include "bench/bench_task.h"
#include "cli/number_text.h"

namespace fcl_prob::cli {
namespace {

constexpr double kLeastOfNear = 1e-4, kMostOfNear = 0.9;
constexpr double kThresholdOfNear = 0.05;
constexpr double kChanceOfNear = 1e-4;
constexpr double kSecondsOfNear = 20.0;

constexpr int kNear = 100;
constexpr int kNearQuick = 10;

/// A place of the person has no more of them: where the base is about as likely to be hit as the
/// threshold, all states are alike.
constexpr int kNearOfPlace = 5;
constexpr int kDrawnOfPlace = 50;

/// A loop over so many is timed, and stands for ten times as many.
constexpr std::uint64_t kTimedSamples = 1'000;

struct TaskCosts {
  std::vector<double> ratios, milliseconds;
  int open = 0;  ///< not answered within the limits
};

/// P roughly, and for nothing but to choose states by.
double roughly(const RobotQuery& query, const Eigen::VectorXd& values) {
  ProbabilityRequest request = estimateTask(0.05).request(1);
  request.absolute_tolerance = 0.1 * kLeastOfNear;
  request.time_limit = kSecondsOfNear;
  return query.state(values, request).estimate.value_or(0.0);
}

/// A name, and whether a state was answered.
using Ask = std::function<bool(const RobotQuery&, const Eigen::VectorXd&)>;

Ask certified(const BenchTask& task) {
  ProbabilityRequest request = task.request(1);
  request.time_limit = kSecondsOfNear;
  return [request](const RobotQuery& query, const Eigen::VectorXd& values) {
    return detail::isAnswered(query.state(values, request).status);
  };
}

bool askProbably(const RobotQuery& query, const Eigen::VectorXd& values) {
  ProbabilityRequest request;
  request.time_limit = kSecondsOfNear;
  return query.decideProbably({values}, kThresholdOfNear, kChanceOfNear, request).decision !=
         ProbableDecision::undecided;
}

std::vector<std::pair<std::string, Ask>> tasksOfNear() {
  const auto named = [](const BenchTask& task) { return std::pair(task.name, certified(task)); };
  return {named(decisionTask(kThresholdOfNear)),
          {"probable P < 5 %", askProbably},
          named(estimateTask(0.01)),
          named(intervalTask(0.01))};
}

void addNearState(const RobotQuery& query, const Eigen::VectorXd& values,
                  const std::vector<std::pair<std::string, Ask>>& tasks,
                  std::vector<TaskCosts>& costs) {
  const double yardstick =
      msOfSamples(query, query.robot().poses(values), kTimedSamples) * 10'000.0 / kTimedSamples;
  for (std::size_t t = 0; t < tasks.size(); ++t) {
    const detail::Stopwatch watch;
    costs[t].open += !tasks[t].second(query, values);
    costs[t].milliseconds.push_back(watch.milliseconds());
    costs[t].ratios.push_back(costs[t].milliseconds.back() / yardstick);
  }
}

}  // namespace

void addNearStates(const BenchOptions& options, const Geometry& person,
                   const BenchProgress& progress, BenchReport& report) {
  NamedTable near{"States whose P is 1e-4 to 0.9: time over that of 10,000 samples",
                  TextTable({"robot", "task", "states", "median", "90 %", "worst", "ms: median",
                             "worst", "open"})};
  const auto tasks = tasksOfNear();
  const std::vector<std::string> robots{"KUKA iiwa", "Fetch"};
  const int wanted = options.quick ? kNearQuick : kNear;
  for (std::size_t r = 0; r < robots.size(); ++r) {
    if (robots[r].find(options.only) == std::string::npos) continue;
    const Robot robot = benchRobot(options.models_folder, robots[r]);
    Uniforms random(options.seed + 100 + r);
    std::vector<TaskCosts> costs(tasks.size());
    const RobotQuery first(robot, {personBeside(person, random)});
    for (int found = 0; found < wanted;) {
      const double done = static_cast<double>(found) / wanted;
      if (!progress(0.5 + 0.25 * (static_cast<double>(r) + done), robots[r])) return;
      const RobotQuery query = first.withObstacles({personBeside(person, random)});
      const Eigen::MatrixXd states = drawnStates(robot, random, kDrawnOfPlace);
      int here = 0;
      for (Eigen::Index i = 0; i < states.cols(); ++i) {
        if (here == kNearOfPlace || found == wanted) break;
        const double p = roughly(query, states.col(i));
        if (!(p >= kLeastOfNear && p <= kMostOfNear)) continue;
        addNearState(query, states.col(i), tasks, costs);
        ++here, ++found;
      }
    }
    for (std::size_t t = 0; t < tasks.size(); ++t) {
      std::vector<std::string> row{robots[r], tasks[t].first, std::to_string(wanted)};
      for (const double share : {0.5, 0.9, 1.0}) {
        row.push_back(numberText(quantile(costs[t].ratios, share), 3));
      }
      for (const double share : {0.5, 1.0}) {
        row.push_back(numberText(quantile(costs[t].milliseconds, share), 3));
      }
      row.push_back(std::to_string(costs[t].open));
      near.table.add(row);
      report.records.push_back({{"robot", robots[r]},
                                {"task", tasks[t].first},
                                {"ratios", costs[t].ratios},
                                {"ms", costs[t].milliseconds},
                                {"open", costs[t].open}});
    }
  }
  report.more_tables.push_back(std::move(near));
}

}  // namespace fcl_prob::cli
