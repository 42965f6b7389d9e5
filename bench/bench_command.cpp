// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "bench/bench_command.h"

#include <CLI/CLI.hpp>
#include <cstdlib>

#include "bench/benchmark.h"
#include "cli/gnuplot.h"
#include "cli/output.h"
#include "cli/progress_bar.h"
#include "cli/run.h"
#include "fcl_prob/exceptions.h"

namespace fcl_prob::cli {
namespace {

struct BenchArguments {
  std::string name;
  BenchOptions options;
  bool csv = false;
  bool json = false;
  std::string output;
  std::string plot;
};

std::string listOfBenchmarks() {
  std::string text = "Benchmarks:\n";
  for (const Benchmark& benchmark : benchmarks()) {
    text += "  " + benchmark.name + ": " + benchmark.description + "\n";
  }
  return text;
}

const Benchmark& benchmarkNamed(const std::string& name) {
  for (const Benchmark& benchmark : benchmarks()) {
    if (benchmark.name == name) return benchmark;
  }
  throw InvalidRequest("no benchmark is called '" + name + "'; `fcl_prob bench` lists them");
}

std::string modelsFolder(const std::string& option) {
  if (!option.empty()) return option;
  const char* const folder = std::getenv("FCL_PROB_MODELS");
  if (folder == nullptr) throw InvalidRequest("needs --models DIR or FCL_PROB_MODELS");
  return folder;
}

int runBench(BenchArguments arguments) {
  if (arguments.name.empty()) {
    deliver(listOfBenchmarks(), arguments.output);
    return kAnswered;
  }
  const Benchmark& benchmark = benchmarkNamed(arguments.name);
  validatePlotPath(arguments.plot);
  if (!arguments.plot.empty() && !benchmark.has_plot) {
    throw InvalidRequest("--plot: " + benchmark.name + " has no plot");
  }
  if (benchmark.needs_models) {
    arguments.options.models_folder = modelsFolder(arguments.options.models_folder);
  }
  noteInterrupts();
  BenchReport report;
  bool stopped_early = false;
  {
    ProgressBar bar("fcl_prob bench");
    report = benchmark.run(arguments.options, [&](double fraction, const std::string& what) {
      bar.show(fraction, what);
      stopped_early = interrupted();
      return !stopped_early;
    });
  }
  report.interrupted = stopped_early;
  if (arguments.json) {
    deliver(report.json(), arguments.output);
  } else {
    deliver(arguments.csv ? report.csv() : report.markdown(), arguments.output);
  }
  if (!arguments.plot.empty()) writePlot(report.plot, arguments.plot);
  return interrupted() ? kStopped : kAnswered;
}

}  // namespace

void addBenchCommand(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<BenchArguments>();
  CLI::App& command = *app.add_subcommand("bench", "The benchmark tables");
  command.add_option("NAME", arguments->name, "Which; without it they are listed");
  command.add_option("--models", arguments->options.models_folder,
                     "Folder of the benchmark models; default $FCL_PROB_MODELS");
  command.add_option("--only", arguments->options.only,
                     "Only scenes whose name contains this; table2: or SCENE,ROW, parts of both");
  command.add_option("--task", arguments->options.task,
                     "parts: only tasks whose name contains this (estimate, decision, ...); "
                     "stability: only methods");
  command.add_option("--seed", arguments->options.seed, "Fixes all samples")
      ->check(CLI::NonNegativeNumber);
  command
      .add_option("--frames", arguments->options.frames,
                  "table1: random frames that bounds by AABBs are averaged over (the paper: "
                  "10000, hours)")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  command
      .add_option("--cases", arguments->options.cases,
                  "pose_pairs, stability: scenes of each family; pose: seeds of the calibration")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  command
      .add_option("--states", arguments->options.states,
                  "table2: that the planner may ask for, with every row and seed")
      ->check(CLI::PositiveNumber);
  command.add_option(
      "--parts", arguments->options.parts_folder,
      "table2: keep the convex parts of its meshes in this folder, by their content");
  command.add_flag(
      "--quick", arguments->options.quick,
      "parts: two scenes of each part; pose_pairs: 2,000 samples; table2: two seeds, fewer states");
  auto* csv = command.add_flag("--csv", arguments->csv, "CSV instead of Markdown");
  command.add_flag("--json", arguments->json, "JSON instead of Markdown")->excludes(csv);
  command.add_option("--plot", arguments->plot,
                     "table2: also plot length of paths against time, to FILE.svg or FILE.png");
  command.add_option("--output", arguments->output, "Write to this file, whole or not at all");
  command.callback([arguments, &exit_code] { exit_code = runBench(*arguments); });
}

}  // namespace fcl_prob::cli
