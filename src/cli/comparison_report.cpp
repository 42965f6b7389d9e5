// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/comparison_report.h"

#include "base/known_text.h"
#include "cli/json_values.h"
#include "cli/number_text.h"
#include "cli/text_table.h"

namespace fcl_prob::cli {
namespace {

using Json = nlohmann::ordered_json;

std::string number(double value, int digits = 4) { return numberText(value, digits); }

std::string numberOrEmpty(const std::optional<double>& value) {
  return value ? number(*value, 17) : "";
}

/// How the answer is known: an interval, a bound, or a number with its error.
std::string rangeOf(const ProbabilityResult& result) {
  if (result.lower && result.upper) {
    return "[" + number(*result.lower, 6) + ", " + number(*result.upper, 6) + "]";
  }
  if (result.upper) return "<= " + number(*result.upper, 6);
  if (result.confidence_interval) {
    return "~ [" + number(result.confidence_interval->lower, 6) + ", " +
           number(result.confidence_interval->upper, 6) + "]";
  }
  return "";
}

std::string describe(ReferenceKind kind) {
  switch (kind) {
    case ReferenceKind::certified:
      return " (certified, ";
    case ReferenceKind::estimated:
      return " (estimate with other samples, not certified, ";
    default:
      return " (Monte Carlo, not certified, ";
  }
}

std::string referenceText(const ComparisonReference& reference) {
  return number(reference.interval.lower, 8) + " <= P <= " + number(reference.interval.upper, 8) +
         describe(reference.kind) + number(reference.time_ms) + " ms)";
}

std::string relativeText(const std::optional<double>& value) {
  return value ? number(*value, 3) : "";
}

std::optional<double> statedRelative(const ComparisonRecord& record,
                                     const ComparisonReference& reference) {
  if (!record.stated_error || !(reference.value > 0.0)) return std::nullopt;
  return *record.stated_error / reference.value;
}

}  // namespace

std::string tableOf(const Comparison& comparison) {
  TextTable table({"method", "budget", "value", "interval or bound", "relative error", "stated",
                   "seeds", "time / ms", "status"});
  std::string refusals;
  for (const ComparisonRecord& record : comparison.records) {
    const std::string& name = record.method;
    if (record.refusal) {
      const std::string line = "no answer: " + name + ": " + *record.refusal + "\n";
      if (refusals.find(line) == std::string::npos) refusals += line;
      continue;
    }
    table.add({name, record.budget, detail::knownText(record.result), rangeOf(record.result),
               relativeText(record.relative_error),
               relativeText(statedRelative(record, comparison.reference)),
               std::to_string(record.seeds), number(record.time_ms), record.status});
  }
  const std::string interrupted =
      comparison.interrupted ? "INTERRUPTED: methods are missing\n" : "";
  return interrupted + "reference: " + referenceText(comparison.reference) + "\n" +
         "trees built in " + number(comparison.build_ms) +
         " ms; errors of methods that sample are root mean squares over the seeds\n\n" +
         table.text() + refusals;
}

std::string csvOf(const Comparison& comparison) {
  constexpr int kAllDigits = 17;
  TextTable table({"method", "budget", "value", "lower", "upper", "confidence_lower",
                   "confidence_upper", "standard_error", "error", "relative_error", "stated_error",
                   "seeds", "time_ms", "status"});
  for (const ComparisonRecord& record : comparison.records) {
    if (record.refusal) continue;
    const ProbabilityResult& result = record.result;
    const auto& confidence = result.confidence_interval;
    table.add({record.method, record.budget, number(record.value, kAllDigits),
               numberOrEmpty(result.lower), numberOrEmpty(result.upper),
               confidence ? number(confidence->lower, kAllDigits) : "",
               confidence ? number(confidence->upper, kAllDigits) : "",
               numberOrEmpty(result.standard_error), numberOrEmpty(record.error),
               numberOrEmpty(record.relative_error), numberOrEmpty(record.stated_error),
               std::to_string(record.seeds), number(record.time_ms, kAllDigits), record.status});
  }
  return table.csv() + (comparison.interrupted ? "# interrupted: methods are missing\n" : "");
}

Json jsonOf(const Comparison& comparison) {
  Json records = Json::array();
  for (const ComparisonRecord& record : comparison.records) {
    Json json{{"method", record.method}, {"budget", record.budget}};
    if (record.refusal) {
      json["refusal"] = *record.refusal;
    } else {
      json["value"] = record.value;
      json["lower"] = orNull(record.result.lower);
      json["upper"] = orNull(record.result.upper);
      json["confidence_interval"] = orNull(record.result.confidence_interval);
      json["standard_error"] = orNull(record.result.standard_error);
      json["raw_sum"] = orNull(record.result.statistics.raw_sum);
      json["error"] = orNull(record.error);
      json["relative_error"] = orNull(record.relative_error);
      json["stated_error"] = orNull(record.stated_error);
      json["seeds"] = record.seeds;
      json["time_ms"] = record.time_ms;
      json["status"] = record.status;
    }
    records.push_back(json);
  }
  return {{"reference",
           {{"value", comparison.reference.value},
            {"lower", comparison.reference.interval.lower},
            {"upper", comparison.reference.interval.upper},
            {"certified", comparison.reference.certified()},
            {"time_ms", comparison.reference.time_ms}}},
          {"fcl", jsonOf(comparison.nominal)},
          {"build_ms", comparison.build_ms},
          {"interrupted", comparison.interrupted},
          {"records", records}};
}

}  // namespace fcl_prob::cli
