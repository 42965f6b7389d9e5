// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#ifdef FCL_PROB_HAS_BENCH
#include "bench/bench_command.h"
#endif
#include "cli/run.h"

int main(int argc, char* argv[]) {
#ifdef FCL_PROB_HAS_BENCH
  return fcl_prob::cli::run(argc, argv, {fcl_prob::cli::addBenchCommand});
#else
  return fcl_prob::cli::run(argc, argv);
#endif
}
