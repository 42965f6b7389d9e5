// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "bench/task_record.h"

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

}  // namespace fcl_prob::cli
