// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// fcl_prob bench mixed: pairs of meshes as users have them.
#include <array>

#include "bench/bench_task.h"
#include "bench/benchmark.h"
#include "bench/mixed_scenes.h"
#include "bench/task_record.h"
#include "cli/number_text.h"

namespace fcl_prob::cli {
namespace {

constexpr double kMostSecondsOfMixed = 20.0;
constexpr std::size_t kQuickScenes = 10;

// No larger than so many deviations, it is small beside its error.
constexpr double kSmall = 3.0;

const std::vector<BenchTask>& mixedTasks() {
  static const std::vector<BenchTask> all{intervalTask(0.1), intervalTask(0.01), estimateTask(0.01),
                                          decisionTask(0.05)};
  return all;
}

/// Pairs of one kind, or all of them.
struct Kind {
  std::string name;
  bool (*has)(const MixedScene& scene);
};

const std::array<Kind, 4> kKinds{
    {{"all", [](const MixedScene&) { return true; }},
     {"small, not convex",
      [](const MixedScene& scene) { return scene.small_size < kSmall && !scene.is_convex; }},
     {"large, not convex",
      [](const MixedScene& scene) { return scene.small_size >= kSmall && !scene.is_convex; }},
     {"one is convex", [](const MixedScene& scene) { return scene.is_convex; }}}};

/// What one task measured over the scenes of one kind.
struct MeasuredKind {
  std::vector<double> ratios, monte_carlo_ratios, times;
  int limits = 0;
};

class MixedTable {
 public:
  explicit MixedTable(const BenchOptions& options)
      : options_(options), measured_(kKinds.size() * mixedTasks().size()) {}

  void add(const MixedScene& scene) {
    for (std::size_t task = 0; task < mixedTasks().size(); ++task) {
      if (mixedTasks()[task].name.find(options_.task) == std::string::npos) continue;
      addTask(scene, task);
    }
  }

  BenchReport take() {
    BenchReport report;
    report.title = "Pairs of meshes as users have them";
    report.table =
        TextTable({"pairs", "task", "scenes", "/ FCL: median", "90 %", "worst",
                   "/ Monte Carlo: median", "90 %", "worst", "ms: median", "worst", "at a limit"});
    for (std::size_t kind = 0; kind < kKinds.size(); ++kind) {
      for (std::size_t task = 0; task < mixedTasks().size(); ++task) {
        const MeasuredKind& all = measured_[kind * mixedTasks().size() + task];
        if (all.times.empty()) continue;
        const auto at = [](const std::vector<double>& values, double share) {
          return numberText(quantile(values, share), 3);
        };
        report.table.add({kKinds[kind].name, mixedTasks()[task].name,
                          std::to_string(all.times.size()), at(all.ratios, 0.5),
                          at(all.ratios, 0.9), at(all.ratios, 1.0), at(all.monte_carlo_ratios, 0.5),
                          at(all.monte_carlo_ratios, 0.9), at(all.monte_carlo_ratios, 1.0),
                          at(all.times, 0.5), at(all.times, 1.0), std::to_string(all.limits)});
      }
    }
    report.notes =
        "CAD parts, cans, links, statues and people at random, each 1 cm to 1 m long; largest\n"
        "standard deviations of 2 to 50 mm, the others smaller by up to 6; 0.1 to 2.5 of the\n"
        "largest apart, P of at least 1e-3. `small`: one of them no longer than 3 deviations. One\n"
        "thread, trees built beforehand, 20 s at most. `/ FCL`: time over that of 10,000 calls of\n"
        "`fcl::collide` in the same run; `/ Monte Carlo`: over that of as many calls as give the\n"
        "same error.\n";
    report.records = std::move(records_);
    return report;
  }

 private:
  void addTask(const MixedScene& scene, std::size_t task) {
    ProbabilityRequest request = mixedTasks()[task].request(options_.seed);
    request.time_limit = kMostSecondsOfMixed;
    const TimedResult timed = scene.scene->query(request);
    const ProbabilityResult& result = timed.result;
    for (std::size_t kind = 0; kind < kKinds.size(); ++kind) {
      if (!kKinds[kind].has(scene)) continue;
      MeasuredKind& all = measured_[kind * mixedTasks().size() + task];
      all.times.push_back(timed.time_ms);
      all.ratios.push_back(timed.time_ms / scene.loop.time_ms);
      all.monte_carlo_ratios.push_back(overMonteCarlo(timed, scene.loop));
      all.limits += stoppedByLimit(result.status);
    }
    nlohmann::ordered_json record{{"scene", scene.name},
                                  {"small_size", scene.small_size},
                                  {"convex", scene.is_convex},
                                  {"fcl_estimate", scene.loop.estimate()},
                                  {"fcl_ms", scene.loop.time_ms}};
    addTaskTo(record, mixedTasks()[task], timed, scene.loop);
    records_.push_back(std::move(record));
  }

  const BenchOptions& options_;
  std::vector<MeasuredKind> measured_;
  nlohmann::ordered_json records_ = nlohmann::ordered_json::array();
};

}  // namespace

BenchReport benchMixed(const BenchOptions& options, const BenchProgress& progress) {
  MixedScenes scenes(options.models_folder, options.seed);
  MixedTable table(options);
  const std::size_t count = options.quick ? kQuickScenes : 2 * options.cases;
  bool goes_on = true;
  for (std::size_t i = 0; i < count && goes_on; ++i) {
    const MixedScene scene = scenes.next();
    goes_on = progress(static_cast<double>(i) / static_cast<double>(count), scene.name);
    if (goes_on) table.add(scene);
  }
  BenchReport report = table.take();
  report.interrupted = !goes_on;
  return report;
}

}  // namespace fcl_prob::cli
