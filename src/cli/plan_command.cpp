// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/commands.h"

#include <CLI/CLI.hpp>
#include <functional>

#include "base/stopwatch.h"
#include "cli/output.h"
#include "cli/planned_path.h"
#include "cli/progress_bar.h"
#include "cli/robot_reproduction.h"
#include "cli/run.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/robot_scene.h"
#include "robot/robot_notes.h"

namespace fcl_prob::cli {
namespace {

struct PlanArguments {
  std::string scene;
  std::optional<double> threshold;
  std::optional<double> motion_threshold;
  std::optional<double> largest_step;
  std::optional<double> time_limit;
  std::optional<std::size_t> max_states;
  std::optional<std::size_t> max_cells;
  std::optional<std::uint64_t> seed;
  bool not_shortened = false;
  bool no_descent = false;
  bool json = false;
  std::string output;
  std::string csv;
  std::string reproduce;  ///< a folder, empty for none
};

RobotScene planSceneOf(const PlanArguments& arguments) {
  RobotScene scene = loadRobotScene(arguments.scene);
  if (!scene.plan) throw FileError(arguments.scene + ": plan: is missing");
  // A plan knows its states, and the whole of them under the same error.
  if (scene.between != BetweenWaypoints::ignored) {
    throw FileError(arguments.scene +
                    ": between: a plan looks at its states only; ask path for its result");
  }
  if (scene.errors != ErrorsOverTime::persistent) {
    throw FileError(arguments.scene +
                    ": errors: a plan knows persistent ones only; ask path for its result");
  }
  if (arguments.threshold) scene.request.threshold = arguments.threshold;
  if (!scene.request.threshold) {
    throw FileError(arguments.scene + ": request: threshold: is missing, nor is it an option");
  }
  if (arguments.motion_threshold) scene.plan->motion_threshold = arguments.motion_threshold;
  if (arguments.largest_step) scene.largest_step = arguments.largest_step;
  if (arguments.max_states) scene.plan->max_states = arguments.max_states;
  if (arguments.seed) scene.plan->seed = *arguments.seed;
  if (arguments.max_cells) scene.request.max_cells = *arguments.max_cells;
  return scene;
}

/// The scene's own time limit is that of a state.
CertifiedPlanningRequest requestOf(const RobotScene& scene, const PlanArguments& arguments) {
  CertifiedPlanningRequest request;
  request.state = scene.request;
  request.motion_threshold = scene.plan->motion_threshold;
  request.planning.joints = scene.plan->joints;
  request.planning.seed = scene.plan->seed;
  if (scene.largest_step) request.planning.largest_step = *scene.largest_step;
  if (scene.plan->max_states) request.planning.max_states = *scene.plan->max_states;
  request.planning.time_limit = arguments.time_limit;
  request.planning.shorten = !arguments.not_shortened;
  request.descend = !arguments.no_descent;
  return request;
}

TimedPlanningRequest timedRequestOf(const RobotScene& scene, const PlanArguments& arguments) {
  if (scene.plan->motion_threshold) {
    throw FileError(arguments.scene +
                    ": motion_threshold: is not to be had among predicted obstacles, whose errors "
                    "change over time");
  }
  TimedPlanningRequest request;
  request.state = scene.request;
  request.planning = requestOf(scene, arguments).planning;
  if (scene.plan->largest_time_step) request.largest_time_step = *scene.plan->largest_time_step;
  request.start_time = scene.plan->start_time;
  request.hold = scene.plan->hold;
  request.latest = scene.plan->latest;
  request.velocities = scene.plan->velocities;
  request.velocity_scale = scene.plan->velocity_scale;
  return request;
}

/// What is told of a plan of either kind.
struct PlanReport {
  bool solved;
  std::string text;
  nlohmann::ordered_json json;
  std::string csv;
};

PlanReport answer(const RobotScene& scene, const PlanArguments& arguments, const RobotQuery& query,
                  const std::function<bool(const PlanningProgress&)>& on_progress) {
  const Robot& robot = query.robot();
  const SelfCollision self = loadSelfCollision(scene, robot);
  const auto [start, goal] = plannedEnds(scene, robot);
  if (isPredicted(scene) || scene.plan->latest) {
    TimedPlanningRequest request = timedRequestOf(scene, arguments);
    request.errors = errorsOf(scene, robot);
    request.planning.on_progress = on_progress;
    const TimedPlan plan = planInTime(query, self, start, goal, request);
    PlanReport report{plan.status == PlanningStatus::solved,
                      planText(plan, robot, *request.state.threshold), planJson(plan, robot),
                      planCsv(plan, robot)};
    report.json["largest_time_step"] = request.largest_time_step;
    return report;
  }
  CertifiedPlanningRequest request = requestOf(scene, arguments);
  request.errors = errorsOf(scene, robot);
  request.planning.on_progress = on_progress;
  const CertifiedPlan plan = planCertified(query, self, start, goal, request);
  return {plan.path.status == PlanningStatus::solved, planText(plan, robot), planJson(plan, robot),
          planCsv(plan, robot)};
}

int runPlan(const PlanArguments& arguments) {
  RobotScene scene = planSceneOf(arguments);
  const detail::Stopwatch building;
  const RobotQuery query = loadRobotQuery(scene);
  const Robot& robot = query.robot();
  scene.plan->joints = plannedJoints(scene, robot);
  const PlanningRequest planning = requestOf(scene, arguments).planning;
  const double build_ms = building.milliseconds();
  noteInterrupts();
  ProgressBar bar("fcl_prob plan");
  const auto on_progress = [&](const PlanningProgress& progress) {
    const auto most = static_cast<double>(planning.max_states);
    bar.show(static_cast<double>(progress.states) / most,
             std::to_string(progress.states) + " states" +
                 (progress.shortening ? ", shortening a path" : ", looking for a path"));
    return !interrupted();
  };
  const detail::Stopwatch watch;
  const PlanReport plan = answer(scene, arguments, query, on_progress);
  const std::vector<std::string> notes =
      detail::allNotes(query, scene.request.toleranceAt(*scene.request.threshold));
  std::string report;
  for (const std::string& line : notes) report += onOneLine(line) + "\n";
  report += plan.text;
  if (arguments.json) {
    nlohmann::ordered_json json = plan.json;
    json["largest_step"] = planning.largest_step;
    json["seed"] = planning.seed;
    json["links_without_body"] = robot.linksWithoutBody();
    json["notes"] = notes;
    json["build_ms"] = build_ms;
    json["time_ms"] = watch.milliseconds();
    report = json.dump() + "\n";
  }
  if (!arguments.reproduce.empty()) {
    writeRobotReproduction(scene, arguments.scene, plan.json, arguments.reproduce);
  }
  deliver(report, arguments.output);
  if (plan.solved && !arguments.csv.empty()) writeFile(arguments.csv, plan.csv);
  return plan.solved ? kAnswered : kStopped;
}

}  // namespace

void addPlanCommand(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<PlanArguments>();
  CLI::App& command = *app.add_subcommand(
      "plan", "A motion of a robot at every state of which P is certainly below a threshold");
  command
      .add_option("--scene", arguments->scene, "Robot scene file with a plan (docs/planning.md)")
      ->required();
  command.add_option("--threshold", arguments->threshold, "P of every state stays below");
  command.add_option("--motion-threshold", arguments->motion_threshold,
                     "P of the whole motion stays below, errors being the same all along");
  command.add_option("--largest-step", arguments->largest_step,
                     "States are asked for so that no joint moves further (radians, metres)");
  command.add_option("--seed", arguments->seed, "The same seed gives the same path");
  command.add_option("--max-states", arguments->max_states, "States to ask for at most");
  command
      .add_option("--max-cells", arguments->max_cells,
                  "Cells to look at for a state, at most; what is not decided then is refused")
      ->check(CLI::PositiveNumber);
  command.add_option("--time-limit", arguments->time_limit, "Seconds, of the whole plan");
  command.add_flag("--no-descent", arguments->no_descent,
                   "Do not move a path along the gradient of P for --motion-threshold");
  command.add_flag("--not-shortened", arguments->not_shortened, "The path as it is found");
  command.add_flag("--json", arguments->json, "One JSON object, which path reads, instead of text");
  command.add_option("--output", arguments->output, "Write to this file, whole or not at all");
  command.add_option("--reproduce", arguments->reproduce,
                     "Write a folder to this path that needs no other file: scene, URDF, meshes, "
                     "version and answer, for a report of a fault");
  command.add_option("--csv", arguments->csv, "Also write the waypoints as CSV, which path reads");
  command.callback([arguments, &exit_code] { exit_code = runPlan(*arguments); });
}

}  // namespace fcl_prob::cli
