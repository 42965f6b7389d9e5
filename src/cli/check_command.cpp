// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/commands.h"

#include <CLI/CLI.hpp>
#include <sstream>

#include "cli/number_text.h"
#include "cli/output.h"
#include "cli/prepared_scene.h"
#include "cli/progress_bar.h"
#include "cli/result_report.h"
#include "cli/run.h"
#include "cli/scene_arguments.h"
#include "fcl_prob/version.h"

namespace fcl_prob::cli {
namespace {

// Of a scene that has no limit of its own: no command is silent for minutes. What is known by then
// is told.
constexpr double kSecondsOfPair = 20.0;

struct CheckArguments {
  SceneArguments scene;
  bool json = false;
  std::string output;
  std::string certificate;  ///< its file, empty for none
  std::string reproduce;    ///< likewise
};

TimedResult answerOf(const PreparedScene& prepared, const ProbabilityRequest& request,
                     const std::string& certificate) {
  if (certificate.empty()) return prepared.query(request);
  std::ostringstream text;
  TimedResult timed = prepared.certified(request, text);
  writeFile(certificate, text.str());
  return timed;
}

// Which limit ended it, and what allows more.
void noteLimit(const ProbabilityRequest& request, ProbabilityResult& result) {
  std::string limit;
  if (result.status == ProbabilityStatus::time_limit) {
    limit = numberText(*request.time_limit, 6) + " s: --time-limit";
  } else if (result.status == ProbabilityStatus::cell_limit) {
    limit = std::to_string(request.max_cells) + " cells: --max-cells";
  } else if (result.status == ProbabilityStatus::memory_limit) {
    limit = std::to_string(request.max_memory) + " bytes: --max-memory";
  }
  if (!limit.empty()) result.plan.push_back("stopped at " + limit + " allows more");
}

CheckReport check(Scene scene, const CheckArguments& arguments) {
  if (!scene.request.time_limit) scene.request.time_limit = kSecondsOfPair;
  const std::string& bounding_volume = arguments.scene.bounding_volume;
  const PartsUse parts = partsUse(arguments.scene);
  const PreparedScene prepared(scene, bounding_volume, parts);
  noteInterrupts();
  CheckReport report;
  if (parts == PartsUse::bounds) report.method = kPartsBounds;
  {
    ProgressBar bar("fcl_prob check");
    scene.request.on_progress = std::ref(bar);
    const TimedResult timed = answerOf(prepared, scene.request, arguments.certificate);
    report.result = timed.result;
    noteLimit(scene.request, report.result);
    report.time_ms = timed.time_ms;
  }
  report.build_ms = prepared.buildTime();
  report.nominal = prepared.nominal();
  report.threshold = scene.request.threshold.value_or(-1.0);
  return report;
}

// What was answered by which version stands in the file itself.
void writeReproduction(const Scene& scene, const CheckReport& report, const std::string& file) {
  std::ostringstream text;
  writeScene(scene,
             std::string("fcl_prob ") + FCL_PROB_VERSION + " answered: " + jsonOf(report).dump(),
             text);
  writeFile(file, text.str());
}

int runCheck(const CheckArguments& arguments) {
  const Scene scene = sceneFrom(arguments.scene);
  const CheckReport report = check(scene, arguments);
  if (!arguments.reproduce.empty()) writeReproduction(scene, report, arguments.reproduce);
  deliver(arguments.json ? jsonOf(report).dump() + "\n" : textOf(report), arguments.output);
  return stoppedByLimit(report.result.status) ? kStopped : kAnswered;
}

}  // namespace

void addCheckCommand(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<CheckArguments>();
  CLI::App& command = *app.add_subcommand("check", "The collision probability of one scene");
  addSceneOptions(command, arguments->scene);
  addRequestOptions(command, arguments->scene);
  command
      .add_flag("--gradient", arguments->scene.gradient,
                "Also the derivative of the probability by the mean displacement")
      ->group("Question");
  command.add_flag("--json", arguments->json, "One JSON object instead of text");
  command.add_option("--output", arguments->output, "Write to this file, whole or not at all");
  command.add_option("--certificate", arguments->certificate,
                     "Write what fcl_prob_verify needs to check the interval to this file; of "
                     "meshes and boxes");
  command.add_option("--reproduce", arguments->reproduce,
                     "Write a scene file to this file that needs no other one: meshes as numbers, "
                     "the request, version and answer, for a report of a fault");
  command.callback([arguments, &exit_code] { exit_code = runCheck(*arguments); });
}

}  // namespace fcl_prob::cli
