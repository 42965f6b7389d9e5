// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/commands.h"

#include <CLI/CLI.hpp>
#include <sstream>

#include "base/known_text.h"
#include "base/stopwatch.h"
#include "cli/gradient_report.h"
#include "cli/json_values.h"
#include "cli/number_text.h"
#include "cli/output.h"
#include "cli/prepared_scene.h"
#include "cli/progress_bar.h"
#include "cli/result_report.h"
#include "cli/robot_reproduction.h"
#include "cli/run.h"
#include "cli/self_report.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/robot_scene.h"
#include "robot/motion_names.h"
#include "robot/robot_notes.h"

namespace fcl_prob::cli {
namespace {

using nlohmann::ordered_json;

struct PathArguments {
  std::string scene;
  std::string motion;
  std::optional<double> relative_tolerance;
  std::optional<double> threshold;
  std::optional<double> time_limit;
  std::optional<double> largest_step;
  std::optional<std::size_t> max_cells;
  std::optional<double> probable;
  std::string method;
  std::string errors;
  bool between = false;
  bool allow_outside_limits = false;
  bool by_body = false;
  bool gradient = false;
  bool json = false;
  std::string output;
  std::string certificate;  ///< its file, empty for none
  std::string reproduce;    ///< a folder, likewise
};

struct PathReport {
  std::vector<RobotBody> bodies;  ///< of the robot
  std::vector<std::string> links_without_body;
  RobotResult result;
  std::vector<RobotResult> by_body;
  std::optional<ordered_json> gradient;
  std::string gradient_text;
  ProbabilityStatus gradient_status = ProbabilityStatus::sampled;
  std::vector<TouchingBodies> self_collisions;
  std::optional<ProbabilityResult> touches_itself;  ///< with errors of joints
  std::size_t waypoints = 0;
  double build_ms = 0.0;
  double time_ms = 0.0;
};

std::string errorsTold(ErrorsOverTime errors) {
  switch (errors) {
    case ErrorsOverTime::persistent:
      return "the same errors at all of them";
    case ErrorsOverTime::independent:
      return "errors drawn anew at each";
    case ErrorsOverTime::any_dependence:
      return "whatever the errors at one have to do with those at another";
  }
  return "";
}

RobotScene sceneOf(const PathArguments& arguments) {
  RobotScene scene = loadRobotScene(arguments.scene);
  if (!arguments.motion.empty()) loadMotion(arguments.motion, scene);
  if (arguments.relative_tolerance) {
    scene.request.relative_tolerance = *arguments.relative_tolerance;
  }
  if (arguments.threshold) scene.request.threshold = arguments.threshold;
  if (arguments.time_limit) scene.request.time_limit = arguments.time_limit;
  if (arguments.largest_step) scene.largest_step = arguments.largest_step;
  if (arguments.max_cells) scene.request.max_cells = *arguments.max_cells;
  if (!arguments.method.empty()) scene.request.method = *methodFromString(arguments.method);
  if (!arguments.errors.empty()) {
    scene.errors = detail::valueOf(detail::kErrorsOverTime, arguments.errors).value();
  }
  if (arguments.between) scene.between = BetweenWaypoints::swept;
  scene.robot.allow_outside_limits |= arguments.allow_outside_limits;
  return scene;
}

/// What has no answer where the robot itself has errors.
void refuseWithErrors(const RobotScene& scene, const PathArguments& arguments, bool moves) {
  const bool anew = moves && scene.errors != ErrorsOverTime::persistent;
  if (arguments.by_body || arguments.gradient || anew || !arguments.certificate.empty() ||
      scene.between != BetweenWaypoints::ignored) {
    throw InvalidRequest(
        "errors of joints or base are persistent: with them there is no answer by body, anew at "
        "waypoints or between them, and neither gradient nor certificate");
  }
}

RobotResult certifiedAnswer(const RobotQuery& query, const std::vector<Eigen::VectorXd>& waypoints,
                            const RobotScene& scene, const std::string& file) {
  const bool is_persistent = waypoints.size() == 1 || scene.errors == ErrorsOverTime::persistent;
  if (!is_persistent || scene.between != BetweenWaypoints::ignored) {
    throw InvalidRequest("a certificate is of one state, or of waypoints with persistent errors");
  }
  std::ostringstream text;
  RobotResult result = query.certified(waypoints, scene.request, text);
  writeFile(file, text.str());
  return result;
}

PathReport answer(RobotScene scene, const PathArguments& arguments) {
  PathReport report;
  const detail::Stopwatch building;
  const RobotQuery query = loadRobotQuery(scene);
  const std::vector<Eigen::VectorXd> waypoints = waypointsOf(scene, query.robot());
  report.waypoints = waypoints.size();
  report.bodies = query.robot().bodies();
  report.links_without_body = query.robot().linksWithoutBody();
  report.build_ms = building.milliseconds();
  noteInterrupts();
  ProgressBar bar("fcl_prob path");
  scene.request.on_progress = std::ref(bar);
  const detail::Stopwatch watch;
  const RobotErrors errors = errorsOf(scene, query.robot());
  if (!errors.none()) {
    refuseWithErrors(scene, arguments, waypoints.size() > 1);
    report.result = query.motion(waypoints, errors, scene.request);
  } else if (!arguments.certificate.empty()) {
    report.result = certifiedAnswer(query, waypoints, scene, arguments.certificate);
  } else {
    report.result = query.motion(waypoints, scene.errors, scene.request, scene.between);
  }
  report.time_ms = watch.milliseconds();
  if (arguments.by_body) report.by_body = query.byBody(waypoints, scene.request);
  if (arguments.gradient) {
    // What is certain of P is what it was before: lines add nothing to that.
    scene.request.on_progress = [&](ProbabilityProgress progress) {
      progress.interval = report.result.any;
      return bar(progress);
    };
    const JointGradient gradient = jointGradient(query, waypoints, scene);
    report.gradient_status = gradient.status;
    report.gradient = jsonOf(gradient, query.robot());
    report.gradient_text = textOf(gradient, query.robot());
  }
  const SelfCollision self = loadSelfCollision(scene, query.robot());
  report.self_collisions = selfCollisionsOf(self, waypoints);
  if (errors.joints.size() > 0 && waypoints.size() == 1) {
    ProbabilityRequest counting = scene.request;
    counting.method = ProbabilityMethod::automatic;
    counting.contact = ContactMeaning::fcl;
    report.touches_itself = self.probability(waypoints[0], errors.joints, counting);
  }
  return report;
}

/// What each obstacle, or each obstacle at each waypoint, adds.
ordered_json partsOf(const PathReport& report, const RobotScene& scene) {
  ordered_json parts = ordered_json::array();
  for (std::size_t i = 0; i < report.result.parts.size(); ++i) {
    const ProbabilityResult& part = report.result.parts[i];
    ordered_json entry{{"obstacle", scene.obstacles[i % scene.obstacles.size()].name}};
    if (scene.errors != ErrorsOverTime::persistent) {
      entry["waypoint"] = i / scene.obstacles.size();
    }
    entry["lower"] = orNull(part.lower);
    entry["upper"] = orNull(part.upper);
    entry["estimate"] = orNull(part.estimate);
    entry["cells"] = part.statistics.cells;
    parts.push_back(entry);
  }
  return parts;
}

ordered_json intervalOf(const Bounds& bounds) {
  return {{"lower", bounds.lower}, {"upper", bounds.upper}};
}

/// P at every waypoint, the worst of them, and what holds for all whatever the dependence.
void addWaypoints(const RobotResult& result, ordered_json& json) {
  if (!result.any_dependence) return;
  std::size_t worst = 0;
  for (const Bounds& bounds : result.by_waypoint) {
    const std::size_t i = json["by_waypoint"].size();
    json["by_waypoint"].push_back(intervalOf(bounds));
    if (bounds.middle() > result.by_waypoint[worst].middle()) worst = i;
  }
  json["worst"] = intervalOf(result.by_waypoint[worst]);
  json["worst"]["waypoint"] = worst;
  json["any_dependence"] = intervalOf(*result.any_dependence);
}

/// What is told of the time between the waypoints: null where it was not looked at.
ordered_json betweenOf(const RobotResult& result) {
  if (!result.swept_band) return nullptr;
  return {{"steps", result.swept_steps}, {"widening", *result.swept_band}};
}

ordered_json jsonOf(const PathReport& report, const RobotScene& scene) {
  const RobotResult& result = report.result;
  ordered_json json{{"probability", result.probability()},
                    {"lower", result.any.lower},
                    {"upper", result.any.upper},
                    {"estimate", orNull(result.estimate)},
                    {"standard_error", orNull(result.standard_error)},
                    {"confidence_interval", orNull(result.confidence_interval)},
                    {"status", toString(result.status)},
                    {"decision", toString(result.decision)},
                    {"waypoints", report.waypoints},
                    {"between", betweenOf(result)},
                    {"far_bodies", result.far_bodies},
                    {"far_upper", result.far_upper},
                    {"build_ms", report.build_ms},
                    {"time_ms", report.time_ms},
                    {"parts", partsOf(report, scene)},
                    {"plan", result.plan},
                    {"links_without_body", report.links_without_body},
                    {"self_collisions", jsonOf(report.self_collisions)}};
  if (report.touches_itself) json["touches_itself"] = touchesItselfJson(*report.touches_itself);
  addWaypoints(result, json);
  if (report.gradient) json["gradient"] = *report.gradient;
  for (std::size_t i = 0; i < report.by_body.size(); ++i) {
    json["bodies"].push_back({{"link", report.bodies[i].link},
                              {"name", report.bodies[i].name()},
                              {"lower", report.by_body[i].any.lower},
                              {"upper", report.by_body[i].any.upper}});
  }
  return json;
}

std::string textOf(const PathReport& report, const RobotScene& scene) {
  const RobotResult& result = report.result;
  const bool persistent = scene.errors == ErrorsOverTime::persistent;
  std::string text = "P(the robot touches anything) " +
                     detail::knownText(result.estimate, result.any) + ", certainly in " +
                     intervalText(result.any) + "\n";
  if (result.standard_error) {
    text += "standard error " + numberText(*result.standard_error, 3) + "\n";
  }
  if (result.confidence_interval) {
    text += "confidence interval " + intervalText(*result.confidence_interval) + "\n";
  }
  if (result.decision != Decision::none) text += "decision: " + toString(result.decision) + "\n";
  text += "status: " + toString(result.status) + "\n";
  text += std::to_string(report.waypoints) + " waypoints, " + errorsTold(scene.errors) + "\n";
  if (result.any_dependence) {
    text += "whatever the dependence: " + intervalText(*result.any_dependence) + "\n";
  }
  if (persistent) {
    for (std::size_t i = 0; i < result.parts.size(); ++i) {
      const ProbabilityResult& part = result.parts[i];
      text += "  " + scene.obstacles[i].name + ": " +
              (part.upper ? intervalText(detail::boundsOf(part)) : "not asked for") + "\n";
    }
  }
  for (std::size_t i = 0; i < report.by_body.size(); ++i) {
    text += "  " + report.bodies[i].name() + ": " + intervalText(report.by_body[i].any) + "\n";
  }
  text += report.gradient_text + textOf(report.self_collisions);
  if (report.touches_itself) text += touchesItselfText(*report.touches_itself);
  if (result.swept_band) {
    text += "at all times: " + std::to_string(result.swept_steps) + " steps of bodies, within " +
            numberText(*result.swept_band, 3) + " m of the states looked at\n";
  }
  text += std::to_string(result.far_bodies) +
          (result.swept_band ? " steps of bodies" : " bodies at waypoints") +
          " left out as far away, with P <= " + numberText(result.far_upper, 3) + " together\n";
  for (const std::string& line : result.plan) text += onOneLine(line) + "\n";
  return text + numberText(report.time_ms, 4) + " ms, and " + numberText(report.build_ms, 4) +
         " ms to load\n";
}

struct ProbableReport {
  ProbableResult result;
  std::vector<std::string> plan;
  std::vector<std::string> links_without_body;
  std::size_t waypoints = 0;
  double build_ms = 0.0;
  double time_ms = 0.0;
};

ordered_json jsonOf(const ProbableReport& report) {
  const ProbableResult& result = report.result;
  return {{"decision", toString(result.decision)},
          {"chance_of_error", result.chance_of_error},
          {"certified", intervalOf(result.certified)},
          {"probable", intervalOf(result.probable)},
          {"status", toString(result.status)},
          {"waypoints", report.waypoints},
          {"cells", result.cells},
          {"samples", result.samples},
          {"plan", report.plan},
          {"links_without_body", report.links_without_body},
          {"build_ms", report.build_ms},
          {"time_ms", report.time_ms}};
}

std::string textOf(const ProbableReport& report) {
  const ProbableResult& result = report.result;
  std::string notes;
  for (const std::string& line : report.plan) notes += onOneLine(line) + "\n";
  return "decision: " + toString(result.decision) + ", wrong with a chance of at most " +
         numberText(result.chance_of_error, 3) + "\nP certainly in " +
         intervalText(result.certified) + ", probably in " + intervalText(result.probable) +
         "\nstatus: " + toString(result.status) + ", " + std::to_string(result.cells) + " cells, " +
         std::to_string(result.samples) + " samples\n" + notes + numberText(report.time_ms, 4) +
         " ms, and " + numberText(report.build_ms, 4) + " ms to load\n";
}

ProbableReport answerProbably(RobotScene scene, double chance) {
  requireExactRobot(scene, "a probable decision");
  if (!scene.request.threshold) throw InvalidRequest("a probable decision needs a threshold");
  if (scene.errors != ErrorsOverTime::persistent || scene.between != BetweenWaypoints::ignored) {
    throw InvalidRequest("a probable decision is of waypoints with persistent errors");
  }
  ProbableReport report;
  const detail::Stopwatch building;
  const RobotQuery query = loadRobotQuery(scene);
  const std::vector<Eigen::VectorXd> waypoints = waypointsOf(scene, query.robot());
  report.waypoints = waypoints.size();
  report.plan = detail::allNotes(query, scene.request.toleranceAt(*scene.request.threshold));
  report.links_without_body = query.robot().linksWithoutBody();
  report.build_ms = building.milliseconds();
  noteInterrupts();
  ProgressBar bar("fcl_prob path");
  scene.request.on_progress = std::ref(bar);
  const detail::Stopwatch watch;
  report.result = query.decideProbably(waypoints, *scene.request.threshold, chance, scene.request);
  report.time_ms = watch.milliseconds();
  return report;
}

void reproduce(const RobotScene& scene, const PathArguments& arguments,
               const ordered_json& answer) {
  if (arguments.reproduce.empty()) return;
  writeRobotReproduction(scene, arguments.scene, answer, arguments.reproduce);
}

int runProbably(const PathArguments& arguments, const RobotScene& scene) {
  const ProbableReport report = answerProbably(scene, *arguments.probable);
  reproduce(scene, arguments, jsonOf(report));
  deliver(arguments.json ? jsonOf(report).dump() + "\n" : textOf(report), arguments.output);
  return stoppedByLimit(report.result.status) ? kStopped : kAnswered;
}

int runPath(const PathArguments& arguments) {
  const RobotScene scene = sceneOf(arguments);
  if (arguments.probable) return runProbably(arguments, scene);
  const PathReport report = answer(scene, arguments);
  reproduce(scene, arguments, jsonOf(report, scene));
  deliver(arguments.json ? jsonOf(report, scene).dump() + "\n" : textOf(report, scene),
          arguments.output);
  const bool stopped =
      stoppedByLimit(report.result.status) || stoppedByLimit(report.gradient_status);
  return stopped ? kStopped : kAnswered;
}

}  // namespace

void addPathCommand(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<PathArguments>();
  CLI::App& command =
      *app.add_subcommand("path", "The probability that a robot touches anything along a motion");
  command.add_option("--scene", arguments->scene, "Robot scene file (docs/robots.md)")->required();
  command.add_option("--motion", arguments->motion,
                     "JSON or CSV file of waypoints in place of the scene's, as plan writes them");
  command.add_option("--method", arguments->method)
      ->check(CLI::IsMember({"auto", "interval", "estimate"}));
  command
      .add_option("--errors", arguments->errors,
                  "Drawn once, anew at every waypoint, or bounds for whatever they are")
      ->check(CLI::IsMember({"persistent", "independent", "any-dependence"}));
  command.add_option("--tolerance,--relative-tolerance", arguments->relative_tolerance, "Relative");
  command.add_option("--max-cells", arguments->max_cells, "Cells to look at, at most")
      ->check(CLI::PositiveNumber);
  command.add_option("--threshold", arguments->threshold, "Decide whether P is below or above");
  command.add_option("--probable", arguments->probable,
                     "Decide the threshold with samples, wrong with at most this chance");
  command.add_option("--time-limit", arguments->time_limit, "Seconds");
  command.add_option("--largest-step", arguments->largest_step,
                     "Add waypoints such that no joint moves further at once (radians, metres)");
  command.add_flag("--between", arguments->between,
                   "Certified for all of the way between the waypoints, too");
  command.add_flag("--allow-outside-limits", arguments->allow_outside_limits,
                   "Answer for states beyond the limits of joints, too");
  command.add_flag("--by-body", arguments->by_body, "Also each collision body by itself")
      ->excludes("--probable");
  command
      .add_flag("--gradient", arguments->gradient,
                "Also how P changes with the joints at each waypoint, an estimate")
      ->excludes("--probable");
  command.add_flag("--json", arguments->json, "One JSON object instead of text");
  command.add_option("--certificate", arguments->certificate,
                     "Write what fcl_prob_verify needs to check the interval to this file: one "
                     "state, or waypoints with persistent errors, of meshes and boxes");
  command.add_option("--reproduce", arguments->reproduce,
                     "Write a folder to this path that needs no other file: scene, URDF, meshes, "
                     "version and answer, for a report of a fault");
  command.add_option("--output", arguments->output, "Write to this file, whole or not at all");
  command.callback([arguments, &exit_code] { exit_code = runPath(*arguments); });
}

}  // namespace fcl_prob::cli
