// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#pragma once

#include "cli/benchmark.h"

namespace fcl_prob::cli {

/// Only in a build with fcl_prob::cloud.
BenchReport benchCloud(const BenchOptions& options, const BenchProgress& progress);

}  // namespace fcl_prob::cli
