// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "bench/task_record.h"

#include <algorithm>

#include "cli/json_values.h"

namespace fcl_prob::cli {

void addTaskTo(nlohmann::ordered_json& record, const BenchTask& task, const TimedResult& timed,
               const FclLoop& loop) {
  const ProbabilityResult& result = timed.result;
  record.update({{"task", task.name},
                 {"lower", orNull(result.lower)},
                 {"upper", orNull(result.upper)},
                 {"estimate", orNull(result.estimate)},
                 {"standard_error", orNull(result.standard_error)},
                 {"decision", toString(result.decision)},
                 {"status", toString(result.status)},
                 {"time_ms", timed.time_ms},
                 {"ratio_to_fcl", timed.time_ms / loop.time_ms},
                 {"cells", result.statistics.cells},
                 {"peak_front", result.statistics.peak_front},
                 {"peak_memory", result.statistics.peak_memory}});
}

double overMonteCarlo(const TimedResult& timed, const FclLoop& loop) {
  const ProbabilityResult& result = timed.result;
  const double p = result.probability();
  const double error = result.standard_error.value_or(0.5 * (*result.upper - *result.lower));
  const double samples = p * (1.0 - p) / std::max(error * error, 1e-300);
  const double per_sample = loop.time_ms / static_cast<double>(loop.samples);
  return timed.time_ms / (samples * per_sample);
}

}  // namespace fcl_prob::cli
