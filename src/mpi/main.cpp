// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// fcl_prob_mpi: a sweep on the ranks of MPI.
#include <mpi.h>

#include <CLI/CLI.hpp>
#include <iostream>

#include "fcl_prob/exceptions.h"
#include "mpi/mpi_sweep.h"

namespace {

constexpr int kBadInput = 2;

int rankOfThis() {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}

int complain(const std::string& message) {
  if (rankOfThis() == 0) std::cerr << "fcl_prob_mpi: " << message << std::endl;
  return kBadInput;
}

int run(int argc, char* argv[]) {
  CLI::App app("fcl_prob sweep on the ranks of MPI (docs/sweep.md)");
  app.name("fcl_prob_mpi");
  fcl_prob::sweep::SweepOptions options;
  std::string schedule = "queue";
  app.add_option("QUERIES", options.queries, "One JSON object a line")->required();
  app.add_option("--output", options.output, "One result a line")->required();
  app.add_flag("--resume", options.resume, "Go on with the results that are there already");
  app.add_option("--schedule", schedule, "shards is for comparison")
      ->check(CLI::IsMember({"queue", "shards"}));
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) return complain(error.what());
    if (rankOfThis() == 0) app.exit(error, std::cout, std::cerr);
    return 0;
  }
  return fcl_prob::mpi::runOnRanks(options, schedule == "queue" ? fcl_prob::mpi::Schedule::queue
                                                                : fcl_prob::mpi::Schedule::shards);
}

}  // namespace

int main(int argc, char* argv[]) {
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  try {
    const int exit_code = run(argc, argv);
    MPI_Finalize();
    return exit_code;
  } catch (const std::exception& error) {
    // The others wait for this rank, or for what it will not send.
    std::cerr << "fcl_prob_mpi: " << error.what() << std::endl;
    MPI_Abort(MPI_COMM_WORLD, kBadInput);
  }
  return kBadInput;
}
