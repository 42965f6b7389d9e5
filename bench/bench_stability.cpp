// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// fcl_prob bench stability: what is left of the answers in stiff and extreme scenes.
#include <algorithm>
#include <cmath>

#include "base/stopwatch.h"
#include "bench/benchmark.h"
#include "bench/stability_case.h"
#include "cli/number_text.h"

namespace fcl_prob::cli {
namespace {

constexpr double kRelativeTolerance = 0.01;
constexpr double kExactTolerance = 1e-10;
constexpr std::size_t kMaxCells = 20'000;

constexpr const char* kStabilityNotes =
    R"(P of every case is known in 100 digits: closed forms of boxes along the principal axes (as shapes,
surfaces and solids), spheres and half-spaces, and quadrature for one triangle; nothing of the library
is used for it. `exact` is asked for 1e-10 of P; interval and estimate for 1 % of P, or the absolute
tolerance of the family, with at most 20,000 cells. `answered` is the share that came that near.
`worst error`: for an interval that of its middle, for an estimate its own, relative to P (or to what
the tolerance allows of it); for an upper bound the largest excess over P, which is no error.
`untold`: cases that are not answered to the tolerance, and of which P changes by more than that when
the boxes grow or shrink by one ε of their sizes and positions: two truths of 100 digits, on either side,
are the proof that the inputs, as doubles, do not tell. `violated`: intervals and bounds that do not hold P.
`failed`: exceptions, NaN, or an interval that is none. Boxes that are turned have the axes that the
displacement reports.

An estimate's standard error comes from few samples a cell, and is too small where all of them happen
to agree: such an estimate can be off by more than that, though never by more than its interval.
Meshes are convex here: what cells leave open of them, far out or with σ far below the size, the
masses of polytopes close. Of other meshes cells are all there is.
)";

struct MethodRow {
  std::size_t cases = 0, answered = 0, untold = 0, violated = 0, failed = 0;
  double worst = 0.0;
  double slowest_ms = 0.0;
  std::size_t worst_case = 0;
  std::vector<std::size_t> short_cases;  ///< not answered, and not untold
  std::string first_failure;
};

ProbabilityResult ask(const StabilityCase& scene, const ProbabilityRequest& request) {
  const PreparedQuery query(scene.a, scene.b);
  ProbabilityResult result;
  if (scene.displacement.size() == 1) {
    query.collisionProbability(scene.pose_a, scene.pose_b, scene.displacement[0].displacement,
                               request, result);
  } else {
    collisionProbability(query, scene.pose_a, scene.pose_b, GaussianMixture(scene.displacement),
                         request, result);
  }
  return result;
}

bool isBound(ProbabilityMethod method) {
  return method == ProbabilityMethod::convex_pcd || method == ProbabilityMethod::general_pcd;
}

double toleranceOf(ProbabilityMethod method) {
  return method == ProbabilityMethod::exact ? kExactTolerance : kRelativeTolerance;
}

/// Distance of a number from the truth.
Precise distanceFrom(const Truth& truth, double value) {
  if (value < truth.lower) return truth.lower - value;
  if (value > truth.upper) return value - truth.upper;
  return 0;
}

bool isSound(const ProbabilityResult& result) {
  const double lower = result.lower.value_or(0.0);
  return result.upper && lower >= 0.0 && lower <= *result.upper && *result.upper <= 1.0 &&
         (!result.estimate || (*result.estimate >= lower && *result.estimate <= *result.upper)) &&
         (!result.standard_error || *result.standard_error >= 0.0);
}

/// Whether P changes by more than the tolerance when all inputs move by one ε.
bool isUntold(const StabilityCase& scene, double tolerance, double absolute_tolerance) {
  if (!scene.nearby) return false;
  const Precise allowed = std::max(tolerance * scene.truth.upper, Precise(absolute_tolerance));
  return scene.nearby->upper - scene.nearby->lower > allowed;
}

/// An answer's distance from the truth next to what the tolerance is a share of; and whether it is
/// as near as was asked for.
struct AnswerError {
  double error;
  bool near;
};

AnswerError errorOf(const Truth& truth, ProbabilityMethod method, double absolute_tolerance,
                    const ProbabilityResult& result) {
  const double lower = result.lower.value_or(0.0), upper = *result.upper;
  if (isBound(method)) return {(Precise(upper) - truth.upper).convert_to<double>(), true};
  const double tolerance = toleranceOf(method);
  const Precise scale = std::max(truth.upper, Precise(absolute_tolerance / tolerance));
  const double value = result.estimate.value_or(0.5 * lower + 0.5 * upper);
  const double error = Precise(distanceFrom(truth, value) / scale).convert_to<double>();
  // Of an estimate, the standard error is what is asked for.
  const double spread = result.standard_error.value_or(0.5 * (upper - lower));
  const bool narrow = method == ProbabilityMethod::exact ||
                      spread <= std::max(absolute_tolerance, tolerance * upper);
  return {error, narrow && error <= (result.standard_error ? 6 * tolerance : tolerance)};
}

void judge(const StabilityCase& scene, ProbabilityMethod method, double absolute_tolerance,
           const ProbabilityResult& result, std::size_t index, MethodRow& row) {
  if (!isSound(result)) {
    ++row.failed;
    return;
  }
  const Truth& truth = scene.truth;
  row.violated += truth.upper < result.lower.value_or(0.0) || truth.lower > *result.upper;
  const AnswerError answer = errorOf(truth, method, absolute_tolerance, result);
  row.answered += answer.near;
  const bool untold = isUntold(scene, toleranceOf(method), absolute_tolerance);
  row.untold += !answer.near && untold;
  if (!answer.near && !untold) row.short_cases.push_back(index);
  if (!(answer.error <= row.worst)) {
    row.worst = answer.error;
    row.worst_case = index;
  }
}

void runCase(const StabilityCase& scene, const StabilityFamily& family,
             const ProbabilityRequest& request, std::size_t index, MethodRow& row) {
  ++row.cases;
  const detail::Stopwatch watch;
  try {
    const ProbabilityResult result = ask(scene, request);
    row.slowest_ms = std::max(row.slowest_ms, watch.milliseconds());
    judge(scene, request.method, family.absolute_tolerance, result, index, row);
  } catch (const std::exception& exception) {
    ++row.failed;
    if (row.first_failure.empty()) row.first_failure = exception.what();
  }
}

/// One row for each of the family's methods.
std::vector<MethodRow> runFamily(const StabilityFamily& family, std::size_t number,
                                 const BenchOptions& options) {
  std::vector<MethodRow> rows(family.methods.size());
  const auto isAsked = [&](ProbabilityMethod method) {
    return toString(method).find(options.task) != std::string::npos;
  };
  for (std::size_t i = 0; i < options.cases; ++i) {
    StabilityRandom random(options.seed, number, i);
    const StabilityCase scene = family.make(random);
    ProbabilityRequest request;
    request.seed = options.seed;
    request.contact = scene.contact;
    request.absolute_tolerance = family.absolute_tolerance;
    request.max_cells = kMaxCells;
    for (std::size_t m = 0; m < rows.size(); ++m) {
      request.method = family.methods[m];
      if (!isAsked(request.method)) continue;
      request.relative_tolerance = toleranceOf(request.method);
      runCase(scene, family, request, i, rows[m]);
    }
  }
  return rows;
}

class StabilityTable {
 public:
  StabilityTable() {
    report_.title = "Stiff and extreme scenes";
    report_.table = TextTable({"family", "objects", "method", "cases", "answered", "untold",
                               "worst error", "violated", "failed", "slowest / ms"});
  }

  void add(const StabilityFamily& family, ProbabilityMethod method, const MethodRow& row) {
    if (row.cases == 0) return;
    const double share = static_cast<double>(row.answered) / static_cast<double>(row.cases);
    report_.table.add({family.name, family.objects, toString(method), std::to_string(row.cases),
                       numberText(100 * share, 4) + " %", std::to_string(row.untold),
                       numberText(row.worst, 2), std::to_string(row.violated),
                       std::to_string(row.failed), numberText(row.slowest_ms, 3)});
    report_.records.push_back({{"family", family.name},
                               {"objects", family.objects},
                               {"method", toString(method)},
                               {"cases", row.cases},
                               {"answered", row.answered},
                               {"untold", row.untold},
                               {"worst_error", row.worst},
                               {"worst_case", row.worst_case},
                               {"short_cases", row.short_cases},
                               {"violated", row.violated},
                               {"failed", row.failed},
                               {"first_failure", row.first_failure},
                               {"slowest_ms", row.slowest_ms}});
    if (row.answered + row.untold == row.cases && row.violated == 0) return;
    short_ += "- " + family.name + ", " + family.objects + ", " + toString(method) + ": " +
              std::to_string(row.cases - row.answered - row.untold) + " of " +
              std::to_string(row.cases) + " not to tolerance";
    if (row.violated > 0) short_ += ", " + std::to_string(row.violated) + " violated";
    if (row.failed > 0) {
      short_ += ", " + std::to_string(row.failed) + " failed (" + row.first_failure + ")";
    }
    short_ += "\n";
  }

  BenchReport take() {
    report_.notes = kStabilityNotes;
    report_.notes += short_.empty() ? "\nNone falls short for another reason.\n"
                                    : "\n**What falls short for another reason:**\n\n" + short_;
    return std::move(report_);
  }

 private:
  BenchReport report_;
  std::string short_;
};

}  // namespace

BenchReport benchStability(const BenchOptions& options, const BenchProgress& progress) {
  StabilityTable table;
  const std::vector<StabilityFamily> families = stabilityFamilies();
  for (std::size_t k = 0; k < families.size(); ++k) {
    const StabilityFamily& family = families[k];
    const std::string name = family.name + ", " + family.objects;
    if (name.find(options.only) == std::string::npos) continue;
    const double done = static_cast<double>(k) / static_cast<double>(families.size());
    if (!progress(done, name)) break;
    const std::vector<MethodRow> rows = runFamily(family, k, options);
    for (std::size_t m = 0; m < rows.size(); ++m) table.add(family, family.methods[m], rows[m]);
  }
  return table.take();
}

}  // namespace fcl_prob::cli
