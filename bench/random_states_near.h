// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Random states that are neither safe nor hit for sure: those that cost a planner its time.
#pragma once

#include "bench/benchmark.h"
#include "bench/random_states.h"

namespace fcl_prob::cli {

/// A table of random states with P of 1e-4 to 0.9, by robot and task, over the time of 10,000
/// samples of the whole robot.
void addNearStates(const BenchOptions& options, const Geometry& person,
                   const BenchProgress& progress, BenchReport& report);

}  // namespace fcl_prob::cli
