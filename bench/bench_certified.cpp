// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// fcl_prob bench certified: what a certificate costs, measured in fcl::collide.
#include <memory>
#include <optional>

#include "bench/bench_scenes.h"
#include "bench/bench_task.h"
#include "bench/benchmark.h"
#include "bench/fcl_loop.h"
#include "bench/result_hash.h"
#include "bench/task_record.h"
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

/// One job made ready, and the quickest times so far.
class MeasuredScene {
 public:
  MeasuredScene(const Job& job, const BenchOptions& options)
      : job_(job),
        seed_(options.seed),
        scene_(prepareBenchScene(job.scene, options.models_folder, "obbrss", job.extra_offset)) {}

  /// Runs everything anew.
  void measure() {
    const FclLoop loop = timeFclLoop(scene_, kFclSamples, seed_);
    if (!loop_ || loop.time_ms < loop_->time_ms) loop_ = loop;
    for (std::size_t task = 0; task < job_.tasks.size(); ++task) {
      TimedResult timed = quickestOfThree(scene_, job_.tasks[task].request(seed_));
      if (task == timed_.size()) {
        timed_.push_back(std::move(timed));
      } else if (timed.time_ms < timed_[task].time_ms) {
        timed_[task] = std::move(timed);
      }
    }
  }

  void addTo(BenchReport& report) const {
    if (!loop_) return;
    addLoop(report);
    for (std::size_t task = 0; task < timed_.size(); ++task) {
      addTask(report, job_.tasks[task], timed_[task]);
    }
  }

 private:
  void addLoop(BenchReport& report) const {
    const double p = loop_->estimate();
    const double error = std::sqrt(p * (1.0 - p) / static_cast<double>(loop_->samples));
    report.table.add({job_.name, "10,000 fcl::collide", numberText(p, 6), numberText(error / p, 2),
                      numberText(loop_->time_ms, 4), "1", "", "", "", "", ""});
    report.records.push_back({{"scene", job_.name},
                              {"method", "fcl"},
                              {"samples", loop_->samples},
                              {"estimate", p},
                              {"standard_error", error},
                              {"time_ms", loop_->time_ms}});
  }

  void addTask(BenchReport& report, const BenchTask& task, const TimedResult& timed) const {
    const ProbabilityResult& result = timed.result;
    const double p = result.probability();
    const double error = result.standard_error.value_or(
        0.5 * (result.upper.value_or(1.0) - result.lower.value_or(0.0)));
    const std::string status = task.threshold ? toString(result.decision) : toString(result.status);
    const double megabytes = static_cast<double>(result.statistics.peak_memory) / 1e6;
    report.table.add({job_.name, task.name, numberText(p, 6), numberText(error / p, 2),
                      numberText(timed.time_ms, 4), numberText(timed.time_ms / loop_->time_ms, 3),
                      std::to_string(result.statistics.cells),
                      std::to_string(result.statistics.peak_front), numberText(megabytes, 3),
                      status, hashOf(result)});
    nlohmann::ordered_json record{{"scene", job_.name}, {"method", toString(task.method)}};
    addTaskTo(record, task, timed, *loop_);
    record["hash"] = hashOf(result);
    report.records.push_back(std::move(record));
  }

  Job job_;
  std::uint64_t seed_;
  PreparedScene scene_;
  std::optional<FclLoop> loop_;
  std::vector<TimedResult> timed_;  ///< one a task; the results of all runs are the same
};

BenchReport emptyReport() {
  BenchReport report;
  report.title = "Certified intervals against Monte Carlo with fcl::collide";
  report.table = TextTable({"scene", "method", "P", "error", "time / ms", "/ FCL", "cells", "front",
                            "memory / MB", "status", "hash"});
  report.notes =
      "One thread; trees are built beforehand. All scenes are measured in turn, five rounds of\n"
      "three runs, and the quickest run counts: the speed of a machine that others use, too,\n"
      "changes from second to second. `/ FCL` is the time over that of 10,000 calls of\n"
      "`fcl::collide` on OBBRSS trees in the same run. `error` is half the relative width of the\n"
      "certified interval, or the relative standard error. `front` is the longest list of node\n"
      "pairs that one cell had to look at. `hash` is of the bits of the results: equal hashes "
      "mean\n"
      "equal results.\n";
  return report;
}

}  // namespace

BenchReport benchCertified(const BenchOptions& options, const BenchProgress& progress) {
  constexpr std::size_t kRounds = 5;
  std::vector<std::unique_ptr<MeasuredScene>> scenes;
  const std::vector<Job> jobs = jobsFor(options);
  const auto steps = static_cast<double>(kRounds * jobs.size());
  for (std::size_t step = 0; step < kRounds * jobs.size(); ++step) {
    const std::size_t job = step % jobs.size();
    if (!progress(static_cast<double>(step) / steps, jobs[job].name)) break;
    if (step < jobs.size()) scenes.push_back(std::make_unique<MeasuredScene>(jobs[job], options));
    scenes[job]->measure();
  }
  BenchReport report = emptyReport();
  for (const auto& scene : scenes) scene->addTo(report);
  return report;
}

}  // namespace fcl_prob::cli
