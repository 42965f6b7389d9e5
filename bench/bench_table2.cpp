// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// fcl_prob bench table2: the paper's Table II, paths of a Fetch arm below 5 %, with more rows.
#include <algorithm>
#include <limits>
#include <map>

#include "base/stopwatch.h"
#include "bench/benchmark.h"
#include "bench/table2_methods.h"
#include "bench/table2_plot.h"
#include "bench/uniforms.h"
#include "cli/number_text.h"
#include "fcl_prob/certified_planning.h"

namespace fcl_prob::cli {
namespace {

constexpr double kMostProbable = 0.05;  // the paper's safety level
constexpr double kLargestStep = 0.05;   // radians

/// What the paper's Table II prints.
struct PublishedPath {
  double percent;
  double time_ms;
};

std::optional<PublishedPath> publishedPath(const std::string& row, const std::string& scene) {
  using Column = std::map<std::string, PublishedPath>;
  static const Column cans{{"monte-carlo", {1.00, 20'800}}, {"sphere", {3.81, 3'260}},
                           {"aabb", {3.72, 637}},           {"obb", {2.50, 819}},
                           {"kdop26", {2.11, 1'280}},       {"convex", {1.59, 8'440}}};
  static const Column waving{{"monte-carlo", {1.00, 15'200}}, {"sphere", {4.72, 1'730}},
                             {"aabb", {3.26, 425}},           {"obb", {2.80, 433}},
                             {"kdop26", {2.71, 823}},         {"convex", {1.39, 4'630}}};
  const Column& column = scene == "cans" ? cans : waving;
  const auto found = column.find(row);
  if (found == column.end()) return std::nullopt;
  return found->second;
}

/// Of one seed.
struct FoundPath {
  std::vector<Eigen::VectorXd> waypoints;
  double length = 0.0;
  double query_ms = 0.0;     ///< to find and shorten it
  double hand_length = 0.0;  ///< metres
  double by_method = 0.0;    ///< its largest P of a state of the path
  Bounds certified{0.0, 1.0};
};

/// Of one method in one scene.
struct MethodRuns {
  std::vector<double> states, query_ms, refused;
  std::vector<FoundPath> found;
  std::optional<Bounds> motion;  ///< of the first path found
};

ProbabilityRequest certifyingRequest() {
  ProbabilityRequest request;
  request.relative_tolerance = 0.05;
  request.max_cells = 2'000;
  return request;
}

class Table2Run {
 public:
  Table2Run(const Table2Scene& scene, const BenchOptions& options)
      : scene_(scene), options_(options) {}

  int seeds() const { return options_.quick ? 3 : 10; }
  double limit() const { return options_.quick ? 10.0 : 20.0; }  // seconds

  void runSeed(const Table2Method& method, int k, MethodRuns& runs) const {
    double query_ms = 0.0;
    const StateTest test = [&](const Eigen::VectorXd& values) {
      if (scene_.self.collides(values)) return false;
      const detail::Stopwatch watch;
      const bool below = method.probability(values, kMostProbable) < kMostProbable;
      query_ms += watch.milliseconds();
      return below;
    };
    PlanningRequest request;
    request.joints = scene_.joints;
    request.largest_step = kLargestStep;
    request.seed = options_.seed + static_cast<std::uint64_t>(k);
    request.time_limit = limit();
    const PlanningResult plan =
        planMotion(scene_.query.robot(), test, scene_.start, scene_.goal, request);
    runs.states.push_back(static_cast<double>(plan.states));
    runs.query_ms.push_back(query_ms);
    const bool refused =
        plan.status == PlanningStatus::start_refused || plan.status == PlanningStatus::goal_refused;
    runs.refused.push_back(refused ? 1.0 : 0.0);
    if (plan.status == PlanningStatus::solved)
      runs.found.push_back(measured(method, plan, query_ms));
  }

  /// Errors the same all along.
  Bounds motionOf(const FoundPath& path) const {
    ProbabilityRequest request = certifyingRequest();
    request.max_cells *= 10;
    return scene_.query
        .motion(interpolated(path.waypoints, kLargestStep), ErrorsOverTime::persistent, request)
        .any;
  }

 private:
  FoundPath measured(const Table2Method& method, const PlanningResult& plan,
                     double query_ms) const {
    FoundPath path{plan.waypoints, plan.length, query_ms};
    const auto states = interpolated(plan.waypoints, kLargestStep);
    Eigen::Vector3d before = handAt(states.front());
    for (const Eigen::VectorXd& values : states) {
      const Eigen::Vector3d hand = handAt(values);
      path.hand_length += (hand - before).norm();
      before = hand;
      if (method.answer != Table2Answer::probability) continue;
      path.by_method = std::max(
          path.by_method, method.probability(values, std::numeric_limits<double>::infinity()));
    }
    path.certified = largestProbability(scene_.query, states, certifyingRequest()).probability;
    if (method.answer == Table2Answer::certified) {
      // Every state was decided, which may have taken more than the interval's cells.
      path.certified.upper = std::min(path.certified.upper, kMostProbable);
      path.by_method = path.certified.upper;
    }
    return path;
  }

  Eigen::Vector3d handAt(const Eigen::VectorXd& values) const {
    return scene_.query.robot().linkPose("gripper_link", values).translation();
  }

  const Table2Scene& scene_;
  const BenchOptions& options_;
};

double middleOf(const std::vector<double>& values) { return quantile(values, 0.5); }

double middleOfPaths(const std::vector<FoundPath>& paths, double (*value)(const FoundPath&)) {
  std::vector<double> values;
  for (const FoundPath& path : paths) values.push_back(value(path));
  return middleOf(values);
}

const char* nameOf(Table2Answer answer) {
  switch (answer) {
    case Table2Answer::probability:
      return "probability";
    case Table2Answer::certified:
      return "certified";
    case Table2Answer::probable:
      return "probable";
    case Table2Answer::padding:
      break;
  }
  return "padding";
}

class Table2Report {
 public:
  explicit Table2Report(const BenchOptions& options) {
    report_.title = "Table II: paths of a Fetch arm, P below 5 % at every state";
    report_.table =
        TextTable({"scene", "states decided by", "found", "length", "hand / m", "states",
                   "query / ms", "ms a state", "largest P by it", "certified: median", "worst",
                   "whole motion", "paper: P / %", "paper: ms"});
    report_.notes =
        "RRT-Connect, short cuts and an elastic band, " +
        std::string(options.quick ? "3 seeds and 10 s" : "10 seeds and 20 s") +
        " a path, shortening and self-collision included, the\n"
        "same for every row; medians over the seeds, of paths over those that were found. `length` "
        "is in\n"
        "joint space (radians), `hand` that of the gripper's way. `query` is the time of the tests "
        "of states\n"
        "without self-collision and planner. `largest P by it`: what the row's method says of the "
        "likeliest\n"
        "state of its path; `certified`: upper ends of certified intervals (5 %, 2,000 cells a "
        "state) for\n"
        "the same, in the median and the worst of the paths (the first row: at most 5 %, as "
        "decided); `whole motion`: the certified "
        "interval, of the\n"
        "first path, that any state touches, errors the same all along. `refused`: start or goal "
        "is not\n"
        "below 5 % by the row's method. The probable decision, of the same screens first, is wrong "
        "about a\n"
        "state that it passes with a chance of at most 1e-4: its paths are not certified but by "
        "`certified`,\n"
        "as those of the other rows. Sums are over bodies and obstacles, with at most "
        "8 convex "
        "parts each.\n"
        "Padding: fcl::collide or fcl::distance, by that many of the largest standard deviation. "
        "The paper's\n"
        "columns are published values, of other scenes, models and machines.\n";
  }

  void add(const std::string& scene, const Table2Method& method, const MethodRuns& runs) {
    const auto& found = runs.found;
    const auto number = [](double value) { return numberText(value, 3); };
    const auto ofFound = [&](double (*value)(const FoundPath&)) {
      return found.empty() ? std::string("-") : number(middleOfPaths(found, value));
    };
    const double states = middleOf(runs.states), query_ms = middleOf(runs.query_ms);
    const bool refused = middleOf(runs.refused) > 0.5;
    double worst = 0.0;
    for (const FoundPath& path : found) worst = std::max(worst, path.certified.upper);
    const auto published = publishedPath(method.published, scene);
    report_.table.add(
        {scene, method.name,
         (refused ? "refused, " : "") + std::to_string(found.size()) + " of " +
             std::to_string(runs.states.size()),
         ofFound([](const FoundPath& path) { return path.length; }),
         ofFound([](const FoundPath& path) { return path.hand_length; }), number(states),
         number(query_ms), number(query_ms / std::max(1.0, states)),
         saysProbability(method) ? ofFound([](const FoundPath& path) { return path.by_method; })
                                 : "-",
         ofFound([](const FoundPath& path) { return path.certified.upper; }),
         found.empty() ? "-" : number(worst),
         runs.motion ? number(runs.motion->lower) + " to " + number(runs.motion->upper) : "-",
         published ? number(published->percent) : "-",
         published ? numberText(published->time_ms, 5) : "-"});
    for (const FoundPath& path : found) {
      plotted_.push_back({scene, method.name, path.query_ms, path.length});
    }
    record(scene, method, runs);
  }

  BenchReport take() {
    report_.plot = table2PlotScript(plotted_);
    return std::move(report_);
  }

 private:
  static bool saysProbability(const Table2Method& method) {
    return method.answer == Table2Answer::probability || method.answer == Table2Answer::certified;
  }

  void record(const std::string& scene, const Table2Method& method, const MethodRuns& runs) {
    nlohmann::ordered_json json{{"scene", scene},
                                {"method", method.name},
                                {"answer", nameOf(method.answer)},
                                {"states", runs.states},
                                {"query_ms", runs.query_ms},
                                {"refused", runs.refused},
                                {"paths", nlohmann::ordered_json::array()}};
    if (method.answer == Table2Answer::probable) json["chance_of_error"] = kChanceOfError;
    for (const FoundPath& path : runs.found) {
      nlohmann::ordered_json of_path{
          {"length", path.length}, {"query_ms", path.query_ms}, {"hand_length", path.hand_length}};
      if (saysProbability(method)) of_path["by_method"] = path.by_method;
      of_path["certified"] = {path.certified.lower, path.certified.upper};
      json["paths"].push_back(std::move(of_path));
    }
    if (runs.motion) json["motion"] = {runs.motion->lower, runs.motion->upper};
    report_.records.push_back(std::move(json));
  }

  BenchReport report_;
  std::vector<PlottedPath> plotted_;
};

}  // namespace

BenchReport benchTable2(const BenchOptions& options, const BenchProgress& progress) {
  Table2Report report(options);
  const std::vector<Table2Scene> scenes = table2Scenes(options.models_folder);
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    const Table2Run run(scenes[s], options);
    const auto methods = table2Methods(scenes[s], kMostProbable, options.seed);
    for (std::size_t m = 0; m < methods.size(); ++m) {
      const std::string row = scenes[s].name + ", " + methods[m].name;
      if (row.find(options.only) == std::string::npos) continue;
      MethodRuns runs;
      for (int k = 0; k < run.seeds(); ++k) {
        const auto done = static_cast<double>(m) + k / static_cast<double>(run.seeds());
        const double part = (static_cast<double>(s) + done / static_cast<double>(methods.size())) /
                            static_cast<double>(scenes.size());
        if (!progress(part, row)) return report.take();
        run.runSeed(methods[m], k, runs);
      }
      if (!runs.found.empty()) runs.motion = run.motionOf(runs.found.front());
      report.add(scenes[s].name, methods[m], runs);
    }
  }
  return report.take();
}

}  // namespace fcl_prob::cli
