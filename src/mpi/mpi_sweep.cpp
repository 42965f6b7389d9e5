// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "mpi/mpi_sweep.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <iomanip>
#include <iostream>
#include <optional>
#include <sstream>
#include <thread>

#include "fcl_prob/exceptions.h"
#include "mpi/messages.h"
#include "sweep/answer.h"

namespace fcl_prob::mpi {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// What answers queries on a rank, and how long that took.
class Answerer {
 public:
  explicit Answerer(std::string folder) : folder_(std::move(folder)) {}

  Answered answer(const Lines& lines) {
    const Clock::time_point start = Clock::now();
    Answered answered;
    for (const sweep::NumberedLine& line : lines) {
      const auto record = sweep::answer(line, folder_, scenes_, [] { return true; });
      answered.records.push_back(record->text);
      if (record->is_error) ++answered.errors;
    }
    busy_ += secondsSince(start);
    return answered;
  }

  double busySeconds() const { return busy_; }

 private:
  std::string folder_;
  sweep::PreparedScenes scenes_;
  double busy_ = 0.0;
};

/// Ends all ranks: the others wait for what this one will not send.
[[noreturn]] void endAll(const std::exception& error) {
  std::cerr << "fcl_prob_mpi: " << error.what() << std::endl;
  MPI_Abort(MPI_COMM_WORLD, 2);
  std::abort();
}

/// Deals out queries to the other ranks until none is left.
void serveOthers(WorkQueue& queue, int ranks) {
  for (int active = ranks - 1; active > 0;) {
    const Mail mail = mailFromAnyone(kResults);
    if (mail.rank < 0) {
      sleepAWhile();
      continue;
    }
    const Answered answered = answeredFrom(mail.message);
    queue.keep(answered.records, answered.errors);
    const Lines lines = queue.next(mail.rank);
    send(packed(lines), mail.rank, kQueries);
    if (lines.empty()) --active;
  }
}

/// Rank 0: one thread answers, this one deals out and keeps.
void serve(WorkQueue& queue, Answerer& answerer, int ranks) {
  std::exception_ptr failure;
  std::thread worker([&] {
    try {
      for (Lines lines = queue.next(0); !lines.empty(); lines = queue.next(0)) {
        const Answered answered = answerer.answer(lines);
        queue.keep(answered.records, answered.errors);
      }
    } catch (...) {
      failure = std::current_exception();
    }
  });
  try {
    serveOthers(queue, ranks);
  } catch (const std::exception& error) {
    endAll(error);
  }
  worker.join();
  if (failure) std::rethrow_exception(failure);
}

/// All other ranks.
void workFor(Answerer& answerer) {
  Answered answered;
  for (;;) {
    send(packed(answered), 0, kResults);
    const Lines lines = linesFrom(receive(0, kQueries));
    if (lines.empty()) return;
    answered = answerer.answer(lines);
  }
}

/// How evenly the ranks were used.
void report(const sweep::SweepProgress& progress, const std::vector<double>& busy, double seconds) {
  double sum = 0.0;
  for (const double one : busy) sum += one;
  const double share = sum / (seconds * static_cast<double>(busy.size()));
  const double least = *std::min_element(busy.begin(), busy.end()) / seconds;
  std::ostringstream text;
  text << std::fixed << std::setprecision(1) << "fcl_prob_mpi: " << progress.done << " of "
       << progress.total << ", " << progress.errors << " with errors, " << seconds << " s on "
       << busy.size() << " ranks, busy for " << 100.0 * share << " % of it, the least busy one for "
       << 100.0 * least << " %\n";
  std::cerr << text.str() << std::flush;
}

}  // namespace

int runOnRanks(const sweep::SweepOptions& options, Schedule schedule) {
  int rank = 0;
  int ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  std::optional<WorkQueue> queue;
  if (rank == 0) queue.emplace(options, schedule, ranks);
  waitForAll();
  Answerer answerer(std::filesystem::path(options.queries).parent_path().string());
  const Clock::time_point start = Clock::now();
  if (rank == 0) {
    serve(*queue, answerer, ranks);
  } else {
    workFor(answerer);
  }
  waitForAll();
  const double seconds = secondsSince(start);
  const double busy = answerer.busySeconds();
  std::vector<double> all(static_cast<std::size_t>(ranks));
  MPI_Gather(&busy, 1, MPI_DOUBLE, all.data(), 1, MPI_DOUBLE, 0, MPI_COMM_WORLD);
  if (rank == 0) report(queue->finish(), all, seconds);
  return 0;
}

}  // namespace fcl_prob::mpi
