// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/result_report.h"

#include <iomanip>
#include <sstream>

#include "base/known_text.h"
#include "cli/json_values.h"

namespace fcl_prob::cli {
namespace {

using Json = nlohmann::ordered_json;

Json jsonOf(const ProbabilityStatistics& statistics) {
  Json seconds = Json::object();
  for (const auto& [stage, time] : statistics.seconds) {
    seconds[stage] = seconds.value(stage, 0.0) + time;
  }
  Json rungs = Json::array();
  for (const RungRecord& rung : statistics.rungs) {
    rungs.push_back({{"name", rung.name},
                     {"seconds", rung.seconds},
                     {"lower", rung.known.lower},
                     {"upper", rung.known.upper},
                     {"times", rung.times},
                     {"answered", rung.answered},
                     {"note", rung.note}});
  }
  return {{"cells", statistics.cells},
          {"cells_open", statistics.cells_open},
          {"pairs_tested", statistics.pairs_tested},
          {"leaf_pairs", statistics.leaf_pairs},
          {"peak_front", statistics.peak_front},
          {"peak_memory", statistics.peak_memory},
          {"samples", statistics.samples},
          {"hits", statistics.hits},
          {"raw_sum", orNull(statistics.raw_sum)},
          {"seconds", seconds},
          {"rungs", rungs}};
}

/// Label, padding, value: one line of the text report.
class Lines {
 public:
  std::ostringstream& operator()(const std::string& label) {
    if (text_.tellp() > 0) text_ << '\n';
    text_ << std::left << std::setw(16) << label;
    return text_;
  }
  std::string text() const { return text_.str() + '\n'; }

 private:
  std::ostringstream text_;
};

void addTrust(const ProbabilityResult& result, Lines& line) {
  if (result.lower && result.upper) {
    line("certified") << *result.lower << " <= P <= " << *result.upper;
  } else if (result.upper) {
    line("certified") << "P <= " << *result.upper;
  }
  if (result.estimate) {
    std::ostringstream& text = line("estimate");
    text << *result.estimate;
    if (result.standard_error) text << ", standard error " << *result.standard_error;
  }
  if (result.confidence_interval) {
    line("confidence") << result.confidence_interval->lower << " ... "
                       << result.confidence_interval->upper << " (not certified)";
  }
  if (result.statistics.raw_sum) line("sum of bounds") << *result.statistics.raw_sum;
}

void addNominal(const NominalAnswer& nominal, Lines& line) {
  std::ostringstream& text = line("fcl::collide");
  if (!nominal.collides) {
    text << "has no answer for such a pair";
  } else if (*nominal.collides) {
    text << "collides, at the mean displacement";
  } else {
    text << "free, at the mean displacement";
    if (nominal.distance) text << "; distance " << *nominal.distance << " m";
  }
}

std::string methodOf(const CheckReport& report) {
  return report.method.empty() ? toString(report.result.method) : report.method;
}

}  // namespace

Json jsonOf(const CheckReport& report) {
  const ProbabilityResult& result = report.result;
  const Json decision =
      result.decision == Decision::none ? Json(nullptr) : Json(toString(result.decision));
  return {{"method", methodOf(report)},
          {"probability", result.probability()},
          {"lower", orNull(result.lower)},
          {"upper", orNull(result.upper)},
          {"estimate", orNull(result.estimate)},
          {"standard_error", orNull(result.standard_error)},
          {"confidence_interval", orNull(result.confidence_interval)},
          {"decision", decision},
          {"gradient", orNull(result.gradient)},
          {"status", toString(result.status)},
          {"time_ms", report.time_ms},
          {"build_ms", report.build_ms},
          {"fcl", jsonOf(report.nominal)},
          {"plan", result.plan},
          {"statistics", jsonOf(result.statistics)}};
}

std::string textOf(const CheckReport& report) {
  const ProbabilityResult& result = report.result;
  Lines line;
  line("P(collision)") << std::setprecision(6) << detail::knownText(result);
  addTrust(result, line);
  if (result.decision != Decision::none) {
    line("decision") << toString(result.decision) << " (threshold " << report.threshold << ")";
  }
  addNominal(report.nominal, line);
  line("method") << methodOf(report) << ": " << toString(result.status);
  line("time") << std::setprecision(4) << report.time_ms << " ms, and " << report.build_ms
               << " ms to build the trees";
  if (result.gradient) {
    line("gradient") << result.gradient->x() << ", " << result.gradient->y() << ", "
                     << result.gradient->z() << " per metre of mean displacement";
  }
  for (std::size_t i = 0; i < result.plan.size(); ++i) {
    line(i == 0 ? "plan" : "") << result.plan[i];
  }
  return line.text();
}

}  // namespace fcl_prob::cli
