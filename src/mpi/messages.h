// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Queries and results as messages of MPI.
#pragma once

#include <mpi.h>

#include <string>
#include <vector>

#include "mpi/work_queue.h"

namespace fcl_prob::mpi {

enum Tag : int { kResults = 1, kQueries = 2 };

/// What a rank has answered of its last queries.
struct Answered {
  std::vector<std::string> records;
  std::size_t errors = 0;
};

std::string packed(const Lines& lines);
Lines linesFrom(const std::string& message);

std::string packed(const Answered& answered);
Answered answeredFrom(const std::string& message);

void send(const std::string& message, int rank, Tag tag);

/// Waits without using the processor, which the ranks of one machine share.
std::string receive(int rank, Tag tag);

/// The same of whoever has sent something; its rank is -1 if nobody has.
struct Mail {
  int rank = -1;
  std::string message;
};
Mail mailFromAnyone(Tag tag);

/// As MPI_Barrier, without using the processor.
void waitForAll();

/// For as long as an answer of another rank may well take.
void sleepAWhile();

}  // namespace fcl_prob::mpi
