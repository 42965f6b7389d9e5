// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// fcl_prob bench conjunction: encounters of satellites, and what their file says of them.
#include <fcl/geometry/shape/sphere.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "base/stopwatch.h"
#include "bench/benchmark.h"
#include "bench/encounters.h"
#include "bench/uniforms.h"
#include "cli/number_text.h"
#include "fcl_prob/collision_probability.h"
#include "fcl_prob/exceptions.h"

namespace fcl_prob::cli {
namespace {

/// Rows of the table: encounters with a probability of at least this, and below the row before.
constexpr std::array<double, 5> kLeast{1e-2, 1e-4, 1e-6, 1e-10, 0.0};

struct EncounterRow {
  std::vector<double> widths, times, stated, approximations, maxima;
};

/// How far a column of the file is from P.
double differenceOf(double column, double probability) { return column / probability - 1.0; }

double largestSize(const std::vector<double>& values) {
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

class ConjunctionTable {
 public:
  void add(const Encounter& encounter) {
    const detail::Stopwatch stopwatch;
    const GaussianDisplacement displacement = encounter.displacement();
    const fcl::Sphered half(0.5 * encounter.radius);
    fcl::Transform3d pose = fcl::Transform3d::Identity();
    pose.translation() = encounter.offset();
    ProbabilityResult result;
    collisionProbability(&half, fcl::Transform3d::Identity(), &half, pose, displacement, {},
                         result);
    const double time = stopwatch.milliseconds();
    const double middle = 0.5 * (*result.lower + *result.upper);
    const double width = *result.upper - *result.lower;
    EncounterRow& row = rows_[rowOf(middle)];
    row.times.push_back(1e3 * time);
    row.widths.push_back(middle > 0.0 ? width / middle : 0.0);
    row.stated.push_back(differenceOf(encounter.stated, middle));
    row.approximations.push_back(differenceOf(encounter.approximation, middle));
    row.maxima.push_back(encounter.maximum / middle);
    total_ += time;
    report_.records.push_back({{"id", encounter.id},
                               {"lower", *result.lower},
                               {"upper", *result.upper},
                               {"status", toString(result.status)},
                               {"time_ms", time},
                               {"Pc", encounter.stated},
                               {"Pc_approx", encounter.approximation},
                               {"Pc_max", encounter.maximum}});
  }

  BenchReport take() {
    report_.title = "Encounters of satellites";
    report_.table = TextTable({"P", "encounters", "width: median", "90 %", "largest", "us: median",
                               "90 %", "largest", "Pc: median", "largest", "Pc_approx: median",
                               "largest", "Pc_max / P: median", "least"});
    for (std::size_t k = 0; k < kLeast.size(); ++k) addRow(k);
    report_.notes = "All together: " + numberText(total_, 3) +
                    " ms. `width` is upper - lower over P; Pc and Pc_approx are the file's columns "
                    "over P, less 1.\n";
    return std::move(report_);
  }

 private:
  static std::size_t rowOf(double probability) {
    std::size_t k = 0;
    while (probability < kLeast[k]) ++k;
    return k;
  }

  void addRow(std::size_t k) {
    const EncounterRow& row = rows_[k];
    if (row.times.empty()) return;
    const auto text = [](double value) { return numberText(value, 3); };
    report_.table.add({kLeast[k] > 0.0 ? "from " + text(kLeast[k]) : "below",
                       std::to_string(row.times.size()), text(quantile(row.widths, 0.5)),
                       text(quantile(row.widths, 0.9)), text(quantile(row.widths, 1.0)),
                       text(quantile(row.times, 0.5)), text(quantile(row.times, 0.9)),
                       text(quantile(row.times, 1.0)), text(quantile(row.stated, 0.5)),
                       text(largestSize(row.stated)), text(quantile(row.approximations, 0.5)),
                       text(largestSize(row.approximations)), text(quantile(row.maxima, 0.5)),
                       text(quantile(row.maxima, 0.0))});
  }

  std::array<EncounterRow, kLeast.size()> rows_;
  double total_ = 0.0;
  BenchReport report_;
};

}  // namespace

BenchReport benchConjunction(const BenchOptions& options, const BenchProgress& progress) {
  const auto path = std::filesystem::path(options.models_folder) / "conjunctions" / "data.csv";
  std::ifstream file(path);
  if (!file) throw FileError("cannot read " + path.string());
  const std::vector<Encounter> encounters = readEncounters(file, path.string());
  ConjunctionTable table;
  for (std::size_t k = 0; k < encounters.size(); ++k) {
    if (encounters[k].id.find(options.only) == std::string::npos) continue;
    table.add(encounters[k]);
    if (k % 100 != 0) continue;
    const double done = static_cast<double>(k) / static_cast<double>(encounters.size());
    if (!progress(done, encounters[k].id)) break;
  }
  return table.take();
}

}  // namespace fcl_prob::cli
