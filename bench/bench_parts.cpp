// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// fcl_prob bench parts: robot parts and a can beside a human arm, scenes at random.
#include <algorithm>

#include "bench/bench_task.h"
#include "bench/benchmark.h"
#include "bench/part_scenes.h"
#include "bench/result_hash.h"
#include "bench/task_record.h"
#include "cli/number_text.h"

namespace fcl_prob::cli {
namespace {

const std::vector<BenchTask>& tasks() {
  static const std::vector<BenchTask> all{intervalTask(0.1), intervalTask(0.01),
                                          intervalTask(0.001), estimateTask(0.01),
                                          decisionTask(0.05)};
  return all;
}

/// What one task measured over all scenes.
struct Measured {
  std::vector<double> times, ratios, monte_carlo_ratios, cells;
  std::size_t front = 0;
  std::size_t memory = 0;
  int limits = 0;
  ResultHash hash;
};

class PartsTable {
 public:
  explicit PartsTable(const BenchOptions& options)
      : options_(options),
        drawn_(options.models_folder, options.seed, armMesh(options.models_folder)),
        measured_(2 * tasks().size()) {}

  /// All tasks for a scene of one part.
  void addScene(std::size_t part) {
    const PartScene drawn = drawn_.next(part);
    std::size_t row = 0;
    for (const ContactMeaning contact : {ContactMeaning::fcl, ContactMeaning::solid}) {
      for (const BenchTask& task : tasks()) {
        const std::size_t of_task = row++;
        if (task.name.find(options_.task) == std::string::npos) continue;
        addTask(part, *drawn.scene, contact, task, drawn.loop, of_task);
      }
    }
    ++scenes_;
  }

  BenchReport take() {
    BenchReport report;
    report.title = "Robot parts and a can beside a human arm";
    report.table =
        TextTable({"contact", "task", "scenes", "/ FCL: median", "90 %", "largest",
                   "/ Monte Carlo: median", "90 %", "ms: median", "90 %", "cells: median",
                   "largest", "front", "memory / MB", "at a limit", "hash"});
    for (std::size_t row = 0; row < measured_.size(); ++row) {
      const Measured& all = measured_[row];
      if (all.times.empty()) continue;
      const auto at = [](const std::vector<double>& values, double share) {
        return numberText(quantile(values, share), 3);
      };
      report.table.add({row < tasks().size() ? "fcl" : "solid", tasks()[row % tasks().size()].name,
                        std::to_string(all.times.size()), at(all.ratios, 0.5), at(all.ratios, 0.9),
                        at(all.ratios, 1.0), at(all.monte_carlo_ratios, 0.5),
                        at(all.monte_carlo_ratios, 0.9), at(all.times, 0.5), at(all.times, 0.9),
                        at(all.cells, 0.5), at(all.cells, 1.0), std::to_string(all.front),
                        numberText(static_cast<double>(all.memory) / 1e6, 3),
                        std::to_string(all.limits), all.hash.text()});
    }
    report.notes =
        "Six parts of a Fetch and a can in turn, at random poses 2 to 80 mm from an arm of 2,000\n"
        "triangles; standard deviations of 10 to 50 mm along random axes; P of at least 1e-3. One\n"
        "thread; trees are built and queries prepared beforehand. `/ FCL` is the time over that "
        "of\n"
        "10,000 calls of `fcl::collide` in the same run, `/ Monte Carlo` over that of as many "
        "calls\n"
        "as give a standard error of the same size (half the width of an interval). `front` is "
        "the\n"
        "longest list of pairs that one cell had to look at. Equal hashes mean equal results.\n";
    report.records = std::move(records_);
    return report;
  }

 private:
  void addTask(std::size_t part, const PreparedScene& scene, ContactMeaning contact,
               const BenchTask& task, const FclLoop& loop, std::size_t row) {
    ProbabilityRequest request = task.request(options_.seed);
    request.contact = contact;
    const TimedResult timed = quickestOfThree(scene, request);
    const ProbabilityResult& result = timed.result;
    Measured& all = measured_[row];
    all.times.push_back(timed.time_ms);
    all.ratios.push_back(timed.time_ms / loop.time_ms);
    all.monte_carlo_ratios.push_back(overMonteCarlo(timed, loop));
    all.cells.push_back(static_cast<double>(result.statistics.cells));
    all.front = std::max(all.front, result.statistics.peak_front);
    all.memory = std::max(all.memory, result.statistics.peak_memory);
    all.limits += stoppedByLimit(result.status);
    all.hash.add(result);
    nlohmann::ordered_json record{{"scene", scenes_},
                                  {"part", PartScenes::names()[part]},
                                  {"contact", contact == ContactMeaning::fcl ? "fcl" : "solid"}};
    addTaskTo(record, task, timed, loop);
    record.update({{"fcl_estimate", loop.estimate()},
                   {"fcl_ms", loop.time_ms},
                   {"ratio_to_monte_carlo", all.monte_carlo_ratios.back()}});
    records_.push_back(std::move(record));
  }

  const BenchOptions& options_;
  PartScenes drawn_;
  std::size_t scenes_ = 0;
  std::vector<Measured> measured_;
  nlohmann::ordered_json records_ = nlohmann::ordered_json::array();
};

}  // namespace

BenchReport benchParts(const BenchOptions& options, const BenchProgress& progress) {
  const std::size_t scenes = options.quick ? 2 * PartScenes::names().size() : 100;
  PartsTable table(options);
  for (std::size_t i = 0; i < scenes; ++i) {
    const std::size_t part = i % PartScenes::names().size();
    const std::string& name = PartScenes::names()[part];
    if (name.find(options.only) == std::string::npos) continue;
    if (!progress(static_cast<double>(i) / static_cast<double>(scenes), name)) break;
    table.addScene(part);
  }
  return table.take();
}

}  // namespace fcl_prob::cli
