// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What programs are told of a task that was measured.
#pragma once

#include <nlohmann/json.hpp>

#include "bench/bench_task.h"
#include "bench/fcl_loop.h"
#include "cli/prepared_scene.h"

namespace fcl_prob::cli {

/// The task, its answer, its time and that over the loop's, cells, front and memory, added to what
/// a record says of the scene.
void addTaskTo(nlohmann::ordered_json& record, const BenchTask& task, const TimedResult& timed,
               const FclLoop& loop);

/// The time over that of as many calls of fcl::collide as have the same standard error; of an
/// interval, half its width.
double overMonteCarlo(const TimedResult& timed, const FclLoop& loop);

}  // namespace fcl_prob::cli
