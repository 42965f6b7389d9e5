// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#pragma once

#include "bench/benchmark.h"
#include "cli/geometry.h"

namespace fcl_prob::cli {

/// Only in a build with fcl_prob::cloud.
BenchReport benchCloud(const BenchOptions& options, const BenchProgress& progress);

/// From file to answer, times by stage; no truth is known.
void addRealClouds(const Geometry& finger, const BenchOptions& options,
                   const BenchProgress& progress, BenchReport& report);

}  // namespace fcl_prob::cli
