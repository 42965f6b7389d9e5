// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A sweep on the ranks of MPI.
#pragma once

#include "mpi/work_queue.h"

namespace fcl_prob::mpi {

/// Answers every query that has no result yet; the file of results is that of fcl_prob sweep to the
/// byte. Rank 0 alone reads and writes those files; scenes and meshes every rank reads by itself.
/// Every rank answers queries on one thread, rank 0 beside dealing them out. Rank 0 reports on
/// standard error. To be called by all ranks. \throws FileError on rank 0 \returns the exit code
int runOnRanks(const sweep::SweepOptions& options, Schedule schedule);

}  // namespace fcl_prob::mpi
