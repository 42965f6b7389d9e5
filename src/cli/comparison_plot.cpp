// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The gnuplot script of a comparison.
#include <algorithm>
#include <iomanip>
#include <sstream>

#include "cli/comparison_report.h"

namespace fcl_prob::cli {
namespace {

/// The records of one method that gave an answer, in the order of their run time.
struct Curve {
  std::string method;
  std::vector<const ComparisonRecord*> records;
};
using Curves = std::vector<Curve>;

Curves curvesOf(const Comparison& comparison) {
  Curves curves;
  for (const ComparisonRecord& record : comparison.records) {
    if (record.refusal) continue;
    // The records of a method follow one another.
    if (curves.empty() || curves.back().method != record.method)
      curves.push_back({record.method, {}});
    curves.back().records.push_back(&record);
  }
  for (auto& [method, records] : curves) {
    std::sort(records.begin(), records.end(),
              [](const auto* a, const auto* b) { return a->time_ms < b->time_ms; });
  }
  return curves;
}

/// The range that the method gives for P: certified, of confidence, or up to a bound.
Bounds rangeOf(const ComparisonRecord& record) {
  const ProbabilityResult& result = record.result;
  if (result.lower && result.upper) return {*result.lower, *result.upper};
  if (result.confidence_interval) return *result.confidence_interval;
  return {record.value, record.value};
}

/// Logarithms have no zero: how far below the reference a lower end is still shown.
constexpr double kLeastShown = 0.1;

std::string blockName(std::size_t curve) { return "$method" + std::to_string(curve); }

/// One block of data a method: time, relative error, its bar, value, range.
void writeData(const Curves& curves, const ComparisonReference& reference, std::ostream& out) {
  // A method may be right to the last digit of the reference, which a logarithm cannot show.
  const double floor =
      std::max(0.5 * reference.interval.width() / std::max(reference.value, 1e-300), 1e-12);
  for (std::size_t i = 0; i < curves.size(); ++i) {
    out << blockName(i) << " << EOD\n";
    for (const ComparisonRecord* record : curves[i].records) {
      // A method that sampled the reference, too, has nothing but what it says of itself.
      const double stated = record->stated_error.value_or(record->error.value_or(0.0)) /
                            std::max(reference.value, 1e-300);
      const double error = std::max(record->relative_error.value_or(stated), floor);
      const Bounds range = rangeOf(*record);
      const double least = kLeastShown * reference.value;
      out << record->time_ms << ' ' << error << ' ' << std::min(error, std::max(stated, floor))
          << ' ' << std::max(error, stated) << ' ' << std::max(record->value, least) << ' '
          << std::max(range.lower, least) << ' ' << std::max(range.upper, least) << '\n';
    }
    out << "EOD\n";
  }
}

void writeCurves(const Curves& curves, const std::string& columns, std::ostream& out) {
  for (std::size_t i = 0; i < curves.size(); ++i) {
    out << (i == 0 ? "plot " : ", \\\n     ") << blockName(i) << " using " << columns
        << " with yerrorlines lt " << 1 + i << " pt " << 4 + i << " title '" << curves[i].method
        << "'";
  }
}

}  // namespace

std::string gnuplotScriptOf(const Comparison& comparison, const std::string& title) {
  const Curves curves = curvesOf(comparison);
  std::ostringstream out;
  out << std::setprecision(10);
  writeData(curves, comparison.reference, out);
  std::string safe_title = title;
  std::replace(safe_title.begin(), safe_title.end(), '\'', ' ');
  out << "set multiplot layout 1,2 title '" << safe_title << "'\n"
      << "set logscale x\nset xtics 100\nset grid\nset xlabel 'run time / ms'\nset key off\n"
      << "set logscale y\nset format y '%.0e'\nset ylabel 'relative error'\n";
  writeCurves(curves, "1:2:3:4", out);
  out << "\nset key on outside right\nset format y '%g'\nset ylabel 'P'\n";
  writeCurves(curves, "1:5:6:7", out);
  out << ", \\\n     " << comparison.reference.value
      << " with lines lc 'black' dt 2 title 'reference'\nunset multiplot\n";
  return out.str();
}

}  // namespace fcl_prob::cli
