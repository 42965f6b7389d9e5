// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// fcl_prob bench certified: what a certificate costs, measured in fcl::collide.
#include "bench/bench_scenes.h"
#include "bench/bench_task.h"
#include "bench/benchmark.h"
#include "bench/fcl_loop.h"
#include "bench/result_hash.h"
#include "cli/json_values.h"
#include "cli/number_text.h"

namespace fcl_prob::cli {
namespace {

constexpr std::size_t kFclSamples = 10'000;

/// The lines of the table besides that of FCL.
const std::vector<BenchTask>& allTasks() {
  static const std::vector<BenchTask> tasks{
      intervalTask(0.1),   intervalTask(0.01),  intervalTask(0.001), estimateTask(0.01),
      estimateTask(0.003), estimateTask(0.001), decisionTask(0.05)};
  return tasks;
}

const std::vector<BenchTask>& growthTasks() {
  static const std::vector<BenchTask> tasks{intervalTask(0.01)};
  return tasks;
}

std::string hashOf(const ProbabilityResult& result) {
  ResultHash hash;
  hash.add(result);
  return hash.text();
}

class CertifiedTable {
 public:
  explicit CertifiedTable(const BenchOptions& options) : options_(options) {
    report_.title = "Certified intervals against Monte Carlo with fcl::collide";
    report_.table = TextTable({"scene", "method", "P", "error", "time / ms", "/ FCL", "cells",
                               "front", "memory / MB", "status", "hash"});
    report_.notes =
        "One thread; trees are built beforehand. `/ FCL` is the time over that of 10,000 calls of\n"
        "`fcl::collide` on OBBRSS trees in the same run. `error` is half the relative width of "
        "the\n"
        "certified interval, or the relative standard error. `front` is the longest list of node\n"
        "pairs that one cell had to look at. `hash` is of the bits of the results: equal hashes "
        "mean\n"
        "equal results.\n";
  }

  void addScene(const std::string& name, const PreparedScene& scene,
                const std::vector<BenchTask>& tasks) {
    const FclLoop loop = timeFclLoop(scene, kFclSamples, options_.seed);
    addLoop(name, loop);
    for (const BenchTask& task : tasks) addTask(name, scene, task, loop);
  }

  BenchReport take() { return std::move(report_); }

 private:
  void addLoop(const std::string& name, const FclLoop& loop) {
    const double p = loop.estimate();
    const double error = std::sqrt(p * (1.0 - p) / static_cast<double>(loop.samples));
    report_.table.add({name, "10,000 fcl::collide", numberText(p, 6), numberText(error / p, 2),
                       numberText(loop.time_ms, 4), "1", "", "", "", "", ""});
    report_.records.push_back({{"scene", name},
                               {"method", "fcl"},
                               {"samples", loop.samples},
                               {"estimate", p},
                               {"standard_error", error},
                               {"time_ms", loop.time_ms}});
  }

  void addTask(const std::string& name, const PreparedScene& scene, const BenchTask& task,
               const FclLoop& loop) {
    const TimedResult timed = scene.quickestOfThree(task.request(options_.seed));
    const ProbabilityResult& result = timed.result;
    const double p = result.probability();
    const double error = result.standard_error.value_or(
        0.5 * (result.upper.value_or(1.0) - result.lower.value_or(0.0)));
    const std::string status = task.threshold ? toString(result.decision) : toString(result.status);
    const double megabytes = static_cast<double>(result.statistics.peak_memory) / 1e6;
    report_.table.add({name, task.name, numberText(p, 6), numberText(error / p, 2),
                       numberText(timed.time_ms, 4), numberText(timed.time_ms / loop.time_ms, 3),
                       std::to_string(result.statistics.cells),
                       std::to_string(result.statistics.peak_front), numberText(megabytes, 3),
                       status, hashOf(result)});
    report_.records.push_back({{"scene", name},
                               {"method", toString(task.method)},
                               {"task", task.name},
                               {"lower", orNull(result.lower)},
                               {"upper", orNull(result.upper)},
                               {"estimate", orNull(result.estimate)},
                               {"standard_error", orNull(result.standard_error)},
                               {"decision", toString(result.decision)},
                               {"status", toString(result.status)},
                               {"time_ms", timed.time_ms},
                               {"ratio_to_fcl", timed.time_ms / loop.time_ms},
                               {"cells", result.statistics.cells},
                               {"peak_front", result.statistics.peak_front},
                               {"peak_memory", result.statistics.peak_memory},
                               {"hash", hashOf(result)}});
  }

  const BenchOptions& options_;
  BenchReport report_;
};

/// A scene, perhaps moved apart, and what is measured on it.
struct Job {
  BenchScene scene;
  std::string name;
  double extra_offset;
  const std::vector<BenchTask>& tasks;
};

std::vector<Job> jobsFor(const BenchOptions& options) {
  // Moved away until P is about 1 %, where a decision against 5 % is a matter of a few cells.
  constexpr double kFurther = 0.05;
  std::vector<Job> jobs;
  for (const BenchScene& scene : benchScenes())
    jobs.push_back({scene, scene.name, 0.0, allTasks()});
  jobs.push_back({benchScenes()[1], "bunny_10cm", kFurther, allTasks()});
  for (const BenchScene& scene : growthScenes()) {
    jobs.push_back({scene, scene.name, 0.0, growthTasks()});
  }
  const auto unwanted = [&](const Job& job) {
    return job.name.find(options.only) == std::string::npos;
  };
  std::vector<Job> wanted;
  for (const Job& job : jobs) {
    if (!unwanted(job)) wanted.push_back(job);
  }
  return wanted;
}

}  // namespace

BenchReport benchCertified(const BenchOptions& options, const BenchProgress& progress) {
  CertifiedTable table(options);
  const std::vector<Job> jobs = jobsFor(options);
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const Job& job = jobs[i];
    if (!progress(static_cast<double>(i) / static_cast<double>(jobs.size()), job.name)) break;
    table.addScene(job.name,
                   prepareBenchScene(job.scene, options.models_folder, "obbrss", job.extra_offset),
                   job.tasks);
  }
  return table.take();
}

}  // namespace fcl_prob::cli
