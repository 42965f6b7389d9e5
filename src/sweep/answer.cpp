// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "sweep/answer.h"

namespace fcl_prob::sweep {
namespace {

using OrderedJson = nlohmann::ordered_json;

template <typename Value>
OrderedJson orNull(const std::optional<Value>& value) {
  return value ? OrderedJson(*value) : OrderedJson(nullptr);
}

OrderedJson orNull(const std::optional<Bounds>& bounds) {
  return bounds ? OrderedJson({bounds->lower, bounds->upper}) : OrderedJson(nullptr);
}

OrderedJson head(const NumberedLine& line, const QueryLine& query) {
  return {{"line", line.number}, {"id", query.id}, {"query", checksumOf(line)}};
}

/// Nothing that another run would not find again: no times.
void addResult(const ProbabilityResult& result, OrderedJson& record) {
  record["method"] = toString(result.method);
  record["probability"] = result.probability();
  record["lower"] = orNull(result.lower);
  record["upper"] = orNull(result.upper);
  record["estimate"] = orNull(result.estimate);
  record["standard_error"] = orNull(result.standard_error);
  record["confidence_interval"] = orNull(result.confidence_interval);
  record["decision"] = result.decision == Decision::none ? OrderedJson(nullptr)
                                                         : OrderedJson(toString(result.decision));
  record["status"] = toString(result.status);
  record["cells"] = result.statistics.cells;
}

Record recordOf(const OrderedJson& json, bool is_error) {
  // What an error quotes need not be UTF-8.
  return {json.dump(-1, ' ', false, OrderedJson::error_handler_t::replace), is_error};
}

}  // namespace

std::optional<Record> answer(const NumberedLine& line, const std::filesystem::path& folder,
                             PreparedScenes& scenes, const std::function<bool()>& goes_on) {
  QueryLine query;
  try {
    readQueryLine(line, folder, query);
    const SceneWithPair prepared = scenes.of(query);
    ProbabilityRequest request = prepared.scene.request;
    request.threads = 1;
    request.on_progress = [&](const ProbabilityProgress&) { return goes_on(); };
    const ProbabilityResult result = prepared.pair->answer(prepared.scene, request);
    if (result.status == ProbabilityStatus::cancelled) return std::nullopt;
    OrderedJson record = head(line, query);
    addResult(result, record);
    return recordOf(record, false);
  } catch (const std::bad_alloc&) {
    throw;  // not the query's fault
  } catch (const std::exception& error) {
    OrderedJson record = head(line, query);
    record["error"] = error.what();
    return recordOf(record, true);
  }
}

}  // namespace fcl_prob::sweep
