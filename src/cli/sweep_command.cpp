// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/commands.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <thread>

#include "base/stopwatch.h"
#include "cli/number_text.h"
#include "cli/progress_bar.h"
#include "cli/run.h"
#include "fcl_prob/exceptions.h"
#include "sweep/sweep.h"

namespace fcl_prob::cli {
namespace {

struct SweepArguments {
  sweep::SweepOptions options;
  std::string shard;
};

std::string textOf(const sweep::SweepProgress& progress) {
  std::string text = std::to_string(progress.done) + " of " + std::to_string(progress.total);
  if (progress.errors > 0) text += ", " + std::to_string(progress.errors) + " with errors";
  return text;
}

/// A bar for people; for files a line now and then.
class SweepReport {
 public:
  void operator()(const sweep::SweepProgress& progress) {
    constexpr double kBetweenLines_ms = 30000.0;
    const double total = static_cast<double>(std::max<std::size_t>(progress.total, 1));
    bar_.show(static_cast<double>(progress.done) / total, textOf(progress));
    if (since_last_.milliseconds() < kBetweenLines_ms) return;
    since_last_ = detail::Stopwatch();
    std::cerr << "fcl_prob sweep: " << textOf(progress) << std::endl;
  }

 private:
  ProgressBar bar_{"fcl_prob sweep"};
  detail::Stopwatch since_last_;
};

int runSweep(const SweepArguments& arguments) {
  sweep::SweepOptions options = arguments.options;
  if (!arguments.shard.empty()) {
    try {
      options.shard = sweep::shardFrom(arguments.shard);
    } catch (const Exception& error) {
      throw InvalidRequest(std::string("--shard: ") + error.what());
    }
  }
  if (options.threads == 0) throw InvalidRequest("--threads is 0, must be at least 1");
  noteInterrupts();
  const detail::Stopwatch watch;
  sweep::SweepProgress progress;
  {
    SweepReport report;
    progress = sweep::runSweep(options, std::ref(report), [] { return !interrupted(); });
  }
  std::cerr << "fcl_prob sweep: " << textOf(progress) << ", "
            << numberText(watch.milliseconds() / 1000.0, 3) << " s" << std::endl;
  return progress.done < progress.total ? kStopped : kAnswered;
}

}  // namespace

void addSweepCommand(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<SweepArguments>();
  arguments->options.threads = std::max(1U, std::thread::hardware_concurrency());
  CLI::App& command = *app.add_subcommand("sweep", "Many queries from a file (docs/sweep.md)");
  command.add_option("QUERIES", arguments->options.queries, "One JSON object a line")->required();
  command.add_option("--output", arguments->options.output, "One result a line")->required();
  command.add_flag("--resume", arguments->options.resume,
                   "Go on with the results that are there already");
  command.add_option("--shard", arguments->shard, "Only part i of n of the queries: i/n, from 1");
  command
      .add_option("--threads", arguments->options.threads,
                  "All cores if not given; results do not depend on it")
      ->check(CLI::NonNegativeNumber);
  command.callback([arguments, &exit_code] { exit_code = runSweep(*arguments); });
}

}  // namespace fcl_prob::cli
