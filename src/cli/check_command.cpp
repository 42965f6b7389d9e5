// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/check_command.h"

#include <CLI/CLI.hpp>
#include <chrono>
#include <iostream>

#include "cli/progress_bar.h"
#include "cli/result_report.h"
#include "cli/run.h"
#include "cli/scene_arguments.h"
#include "fcl_prob/collision_probability.h"

namespace fcl_prob::cli {
namespace {

using Clock = std::chrono::steady_clock;

struct CheckArguments {
  SceneArguments scene;
  bool json = false;
};

double millisecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// A limit came before what was asked for.
bool stoppedByLimit(ProbabilityStatus status) {
  switch (status) {
    case ProbabilityStatus::time_limit:
    case ProbabilityStatus::cell_limit:
    case ProbabilityStatus::memory_limit:
    case ProbabilityStatus::resolution_limit:
    case ProbabilityStatus::cancelled:
      return true;
    default:
      return false;
  }
}

NominalAnswer answerOfFcl(const LoadedObject& a, const LoadedObject& b, const Scene& scene) {
  constexpr const char* kVolume = "obbrss";
  return nominalAnswer(buildGeometry(a, kVolume), a.pose, buildGeometry(b, kVolume), b.pose,
                       scene.displacement.mean());
}

CheckReport check(Scene scene, const std::string& bounding_volume) {
  const LoadedObject a = loadObject(scene.a);
  const LoadedObject b = loadObject(scene.b);

  CheckReport report;
  Clock::time_point start = Clock::now();
  const Geometry geometry_a = buildGeometry(a, bounding_volume);
  const Geometry geometry_b = buildGeometry(b, bounding_volume);
  report.build_ms = millisecondsSince(start);

  noteInterrupts();
  ProgressBar bar("fcl_prob check");
  scene.request.gradient = true;
  scene.request.on_progress = std::ref(bar);
  start = Clock::now();
  collisionProbability(geometry_a.get(), a.pose, geometry_b.get(), b.pose, scene.displacement,
                       scene.request, report.result);
  report.time_ms = millisecondsSince(start);

  report.nominal = answerOfFcl(a, b, scene);
  report.threshold = scene.request.threshold.value_or(-1.0);
  return report;
}

int runCheck(const CheckArguments& arguments) {
  const CheckReport report = check(sceneFrom(arguments.scene), arguments.scene.bounding_volume);
  std::cout << (arguments.json ? jsonOf(report).dump() + "\n" : textOf(report));
  return stoppedByLimit(report.result.status) ? kStopped : kAnswered;
}

}  // namespace

void addCheckCommand(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<CheckArguments>();
  CLI::App& command = *app.add_subcommand("check", "The collision probability of one scene");
  addSceneOptions(command, arguments->scene);
  addRequestOptions(command, arguments->scene);
  command.add_flag("--json", arguments->json, "One JSON object instead of text");
  command.callback([arguments, &exit_code] { exit_code = runCheck(*arguments); });
}

}  // namespace fcl_prob::cli
