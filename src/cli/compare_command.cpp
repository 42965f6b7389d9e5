// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/commands.h"

#include <CLI/CLI.hpp>
#include <filesystem>

#include "cli/comparison.h"
#include "cli/comparison_report.h"
#include "cli/gnuplot.h"
#include "cli/output.h"
#include "cli/progress_bar.h"
#include "cli/run.h"
#include "cli/scene_arguments.h"

namespace fcl_prob::cli {
namespace {

struct CompareArguments {
  SceneArguments scene;
  bool csv = false;
  bool json = false;
  std::string plot;
  std::string output;
  std::size_t seeds = 10;
};

std::string titleOf(const SceneArguments& arguments) {
  const auto name = [](const std::string& path) {
    return std::filesystem::path(path).stem().string();
  };
  if (!arguments.scene_file.empty()) return name(arguments.scene_file);
  return name(arguments.mesh_a) + " / " + name(arguments.mesh_b);
}

/// The runs of the default list, or only those of the method that --method names.
std::vector<ComparisonRun> runsFor(const ProbabilityRequest& request, PartsUse parts) {
  std::vector<ComparisonRun> runs = defaultRuns(request);
  const bool bounds = parts == PartsUse::bounds;
  if (request.method == ProbabilityMethod::automatic && !bounds) return runs;
  const auto other = [&](const ComparisonRun& run) {
    if (bounds || run.parts == PartsUse::bounds) return !bounds || run.parts != parts;
    return run.prior || run.request.method != request.method;
  };
  runs.erase(std::remove_if(runs.begin(), runs.end(), other), runs.end());
  return runs;
}

Comparison compareWithProgress(const Scene& scene, const SceneArguments& arguments,
                               std::size_t seeds) {
  const PreparedScene prepared(scene, arguments.bounding_volume);
  noteInterrupts();
  ProgressBar bar("fcl_prob compare");
  const auto progress = [&bar](std::size_t index, std::size_t count, const std::string& what) {
    bar.show(static_cast<double>(index) / static_cast<double>(count), what);
    return !interrupted();
  };
  ProbabilityRequest request = scene.request;
  request.on_progress = [](const ProbabilityProgress&) { return !interrupted(); };
  return compare(prepared, runsFor(request, partsUse(arguments)), request, seeds, progress);
}

int runCompare(const CompareArguments& arguments) {
  validatePlotPath(arguments.plot);
  const Comparison comparison =
      compareWithProgress(sceneFrom(arguments.scene), arguments.scene, arguments.seeds);
  if (arguments.json) {
    deliver(jsonOf(comparison).dump(1) + "\n", arguments.output);
  } else {
    deliver(arguments.csv ? csvOf(comparison) : tableOf(comparison), arguments.output);
  }
  if (!arguments.plot.empty()) {
    writePlot(gnuplotScriptOf(comparison, titleOf(arguments.scene)), arguments.plot);
  }
  return interrupted() ? kStopped : kAnswered;
}

}  // namespace

void addCompareCommand(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<CompareArguments>();
  CLI::App& command =
      *app.add_subcommand("compare", "Every method at several budgets on one scene");
  addSceneOptions(command, arguments->scene);
  addRequestOptions(command, arguments->scene);
  auto* csv = command.add_flag("--csv", arguments->csv, "CSV instead of a table");
  command.add_flag("--json", arguments->json, "JSON instead of a table")->excludes(csv);
  command.add_option("--plot", arguments->plot,
                     "Also plot error and bounds against run time, to FILE.svg or FILE.png");
  command
      .add_option("--seeds", arguments->seeds,
                  "Runs of each method that samples, whose errors' root mean square is told")
      ->check(CLI::Range(std::size_t{1}, std::size_t{10'000}))
      ->capture_default_str();
  command.add_option("--output", arguments->output, "Write to this file, whole or not at all");
  command.callback([arguments, &exit_code] { exit_code = runCompare(*arguments); });
}

}  // namespace fcl_prob::cli
