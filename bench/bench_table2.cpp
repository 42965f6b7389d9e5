// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// fcl_prob bench table2: the paper's Table II, a trajectory of a Fetch arm by every method and a
// path for every method, P below 5 % at every state.
#include <algorithm>
#include <future>

#include "bench/benchmark.h"
#include "bench/published_table.h"
#include "bench/table2_paths.h"
#include "bench/table2_plot.h"
#include "bench/table2_trajectory.h"
#include "bench/uniforms.h"
#include "cli/number_text.h"

namespace fcl_prob::cli {
namespace {

constexpr int kPlansOfTrajectory = 10;  // seeds that are tried for one
constexpr int kAtOnce = 2;              // plans of further seeds

const char* nameOf(Table2Answer answer) {
  switch (answer) {
    case Table2Answer::counted:
      return "counted";
    case Table2Answer::upper_bound:
      return "upper bound";
    case Table2Answer::certified:
      return "certified";
    case Table2Answer::probable:
      return "probable";
    case Table2Answer::padding:
      break;
  }
  return "padding";
}

std::string number(double value) { return numberText(value, 3); }

std::string percent(const std::optional<double>& value) {
  return value ? number(100.0 * *value) : "-";
}

double middleOf(const std::vector<double>& values) { return quantile(values, 0.5); }

/// In the middle of several.
double middleOf(const std::vector<PathRun>& runs, double (*value)(const PathRun&)) {
  std::vector<double> values;
  for (const PathRun& run : runs) values.push_back(value(run));
  return middleOf(values);
}

std::string middleOfPaths(const std::vector<PathRun>& paths, double (*value)(const PathRun&)) {
  return paths.empty() ? "-" : number(middleOf(paths, value));
}

/// By a test of its start or its goal, whatever the seed.
bool isRefused(const PathRuns& runs) {
  return std::any_of(runs.all.begin(), runs.all.end(), [](const PathRun& run) {
    return run.status == PlanningStatus::start_refused ||
           run.status == PlanningStatus::goal_refused;
  });
}

constexpr const char* kNotes =
    R"(First table: the path that the certified decision found at 1 %, in steps of at most 0.05 rad; each
state bounded by every row. `largest P`: of a state, as the row has it, sums unclipped; `time`: of
all states; what depends on the geometries only is prepared before. `below 5 %`: states that are by
the row (decisions: at 1 %); `too small`: states of which it says less than is certain (Monte Carlo:
by 5 standard errors). The paper's columns are published values of other scenes, models and machines.

Second table: RRT-Connect (waving: in joints and time), short cuts and an elastic band, P below 5 %,
at most the same number of states asked for with every row and seed, two seeds at once; medians over
the seeds, of paths over those that were found. `length`: radians. `arrival`: of waving, which has
obstacles predicted for 6 s. `query`: of the row's tests, without self-collision, the table and the
planner. `certified`: upper ends of certified intervals (5 %, 2,000 cells a state) of the likeliest
state, in the median and the worst of the paths; `whole motion`: the certified interval, of the first
path, that any state touches, errors the same all along (waving: of any dependence).

The probable decision is wrong about a state that it passes with a chance of at most 1e-4. Sums are
over bodies and obstacles, with at most 8 convex parts each. Padding: fcl::collide with obstacles
whose vertices are moved outwards by that many of the largest standard deviation; no bound.
)";

/// Both tables, filled row by row.
class Table2Report {
 public:
  Table2Report() {
    report_.title = "Table II: one trajectory, every method";
    report_.table = TextTable({"scene", "states bounded by", "largest P / %", "/ Monte Carlo",
                               "time / ms", "/ Monte Carlo", "below 5 %", "too small",
                               "paper: P / %", "/ Monte Carlo", "paper: ms", "/ Monte Carlo"});
    report_.more_tables.push_back(
        {"A path for every method",
         TextTable({"scene", "states decided by", "found", "length", "arrival / s", "states",
                    "query / ms", "ms a state", "certified: median", "worst", "whole motion"})});
    report_.notes = kNotes;
  }

  void add(const std::string& scene, const std::vector<TrajectoryRow>& rows, std::size_t states) {
    const auto counted = std::find_if(rows.begin(), rows.end(), [](const TrajectoryRow& row) {
      return row.published == "monte-carlo";
    });
    const auto ratio = [&](std::optional<double> value, std::optional<double> to) {
      return value && to && *to > 0.0 ? number(*value / *to) : "-";
    };
    const bool is_counted = counted != rows.end();
    for (const TrajectoryRow& row : rows) {
      const auto published = publishedPath(row.published, scene);
      const auto sampled = publishedPath("monte-carlo", scene);
      report_.table.add(
          {scene, row.name,
           row.certain ? percent(row.certain) + " to " + percent(row.largest)
                       : percent(row.largest),
           is_counted ? ratio(row.largest, counted->largest) : "-", numberText(row.time_ms, 3),
           is_counted ? ratio(row.time_ms, counted->time_ms) : "-",
           row.below ? std::to_string(*row.below) + " of " + std::to_string(states) : "-",
           row.below ? std::to_string(row.too_small) : "-",
           published ? number(published->probability_percent) : "-",
           published ? number(published->probability_percent / sampled->probability_percent) : "-",
           published ? numberText(published->time_ms, 5) : "-",
           published ? number(published->time_ms / sampled->time_ms) : "-"});
      record(scene, row, states);
    }
  }

  void add(const std::string& scene, const Table2Method& method, const PathRuns& runs) {
    const std::vector<PathRun> found = runs.found();
    const double states =
        middleOf(runs.all, [](const PathRun& run) { return static_cast<double>(run.states); });
    const double query_ms = middleOf(runs.all, [](const PathRun& run) { return run.query_ms; });
    double worst = 0.0;
    for (const PathRun& path : found) worst = std::max(worst, path.certified.upper);
    report_.more_tables[0].table.add(
        {scene, method.name,
         (isRefused(runs) ? "refused, " : "") + std::to_string(found.size()) + " of " +
             std::to_string(runs.all.size()),
         middleOfPaths(found, [](const PathRun& path) { return path.length; }),
         middleOfPaths(found, [](const PathRun& path) { return path.arrival(); }), number(states),
         number(query_ms), number(query_ms / std::max(1.0, states)),
         middleOfPaths(found, [](const PathRun& path) { return path.certified.upper; }),
         found.empty() ? "-" : number(worst),
         runs.motion ? number(runs.motion->lower) + " to " + number(runs.motion->upper) : "-"});
    for (const PathRun& path : found) {
      plotted_.push_back({scene, method.name, path.query_ms, path.length});
    }
    record(scene, method, runs);
  }

  /// Of the convex parts of all rows, whose time is in none of them.
  void addPreparation(const PartsStore& parts) {
    report_.notes += "\nConvex parts: " + std::to_string(parts.found()) + " meshes decomposed in " +
                     number(1e-3 * parts.foundMs()) + " s, those of " +
                     std::to_string(parts.read()) + " read.\n";
  }

  BenchReport take() {
    report_.plot = table2PlotScript(plotted_);
    return std::move(report_);
  }

 private:
  void record(const std::string& scene, const TrajectoryRow& row, std::size_t states) {
    nlohmann::ordered_json json{{"table", "trajectory"}, {"scene", scene},
                                {"method", row.name},    {"states", states},
                                {"ms", row.time_ms},     {"too_small", row.too_small}};
    if (row.largest) json["largest"] = *row.largest;
    if (row.certain) json["largest_at_least"] = *row.certain;
    if (row.below) json["below"] = *row.below;
    report_.records.push_back(std::move(json));
  }

  void record(const std::string& scene, const Table2Method& method, const PathRuns& runs) {
    nlohmann::ordered_json json{
        {"table", "paths"},           {"scene", scene},
        {"method", method.name},      {"answer", nameOf(method.answer)},
        {"refused", isRefused(runs)}, {"paths", nlohmann::ordered_json::array()}};
    if (method.answer == Table2Answer::probable) json["chance_of_error"] = kChanceOfError;
    for (const PathRun& run : runs.all) {
      nlohmann::ordered_json one{
          {"status", toString(run.status)}, {"states", run.states}, {"query_ms", run.query_ms}};
      if (run.found()) {
        one["length"] = run.length;
        one["arrival"] = run.arrival();
        one["certified"] = {run.certified.lower, run.certified.upper};
      }
      json["paths"].push_back(std::move(one));
    }
    if (runs.motion) json["motion"] = {runs.motion->lower, runs.motion->upper};
    report_.records.push_back(std::move(json));
  }

  BenchReport report_;
  std::vector<PlottedPath> plotted_;
};

/// SCENE or SCENE,ROW: parts of their names.
struct WantedRows {
  std::string scene, row;

  explicit WantedRows(const std::string& only) {
    const std::size_t comma = std::min(only.find(','), only.size());
    const std::size_t first = std::min(only.find_first_not_of(", ", comma), only.size());
    scene = only.substr(0, comma);
    row = only.substr(first);
  }

  static bool holds(const std::string& name, const std::string& part) {
    return name.find(part) != std::string::npos;
  }
};

/// One scene, whose rows are those that were asked for.
class Table2Run {
 public:
  Table2Run(const Table2Scene& scene, const BenchOptions& options, PartsStore& parts,
            BenchProgress progress)
      : scene_(scene),
        options_(options),
        parts_(parts),
        progress_(std::move(progress)),
        paths_(scene, options),
        methods_(table2Methods(scene, kMostProbable, options.seed, parts)) {}

  /// \return false if it was stopped
  bool run(Table2Report& report) { return addTrajectory(report) && addPaths(report); }

 private:
  bool isWanted(const std::string& row) const {
    return WantedRows::holds(row, WantedRows(options_.only).row);
  }

  bool addTrajectory(Table2Report& report) {
    if (!progress_(0.0, scene_.name + ", one trajectory")) return false;
    const auto methods = table2Methods(scene_, kMostOfTrajectory, options_.seed, parts_);
    PathRun plan;
    for (int k = 0; k < kPlansOfTrajectory && !plan.found(); ++k) {
      plan = paths_.plan(methods.front(), k, kMostOfTrajectory);
    }
    if (!plan.found()) return true;
    Trajectory trajectory(scene_, plan.path);
    std::vector<TrajectoryRow> rows{trajectory.interval(), trajectory.estimate(options_.seed)};
    bool goes_on = true;
    for (const Table2Method& method : methods) {
      if (!isWanted(method.name)) continue;
      goes_on = progress_(0.0, scene_.name + ", one trajectory, " + method.name);
      if (!goes_on) break;
      rows.push_back(trajectory.row(method));
    }
    report.add(scene_.name, rows, trajectory.size());
    return goes_on;
  }

  /// What was run until it was stopped.
  bool addPaths(Table2Report& report) const {
    bool goes_on = true;
    for (std::size_t m = 0; m < methods_.size() && goes_on; ++m) {
      if (!methods_[m].plans || !isWanted(methods_[m].name)) continue;
      PathRuns runs;
      const int seeds = paths_.seeds();
      for (int k = 0; k < seeds && goes_on; k += kAtOnce) {
        const double done = static_cast<double>(m) + k / static_cast<double>(seeds);
        const double part = done / static_cast<double>(methods_.size());
        goes_on = progress_(part, scene_.name + ", " + methods_[m].name);
        if (goes_on) runSeeds(methods_[m], k, std::min(k + kAtOnce, seeds), runs);
      }
      const std::vector<PathRun> found = runs.found();
      if (!found.empty()) runs.motion = paths_.motionOf(found.front());
      if (!runs.all.empty()) report.add(scene_.name, methods_[m], runs);
    }
    return goes_on;
  }

  /// From `first` to before `end`, a thread each.
  void runSeeds(const Table2Method& method, int first, int end, PathRuns& runs) const {
    std::vector<std::future<PathRun>> running;
    for (int k = first; k < end; ++k) {
      running.push_back(std::async(std::launch::async, [&, k] { return paths_.run(method, k); }));
    }
    for (std::future<PathRun>& one : running) runs.all.push_back(one.get());
  }

  const Table2Scene& scene_;
  const BenchOptions& options_;
  PartsStore& parts_;
  BenchProgress progress_;
  Table2Paths paths_;
  std::vector<Table2Method> methods_;
};

}  // namespace

BenchReport benchTable2(const BenchOptions& options, const BenchProgress& progress) {
  Table2Report report;
  const std::vector<Table2Scene> scenes = table2Scenes(options.models_folder);
  PartsStore parts(options.parts_folder);
  const auto count = static_cast<double>(scenes.size());
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    if (!WantedRows::holds(scenes[s].name, WantedRows(options.only).scene)) continue;
    Table2Run run(scenes[s], options, parts, [&](double part, const std::string& what) {
      return progress((static_cast<double>(s) + part) / count, what);
    });
    if (!run.run(report)) break;
  }
  report.addPreparation(parts);
  return report.take();
}

}  // namespace fcl_prob::cli
