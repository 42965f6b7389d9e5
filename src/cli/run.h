// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The fcl_prob command as a function.
#pragma once

namespace fcl_prob::cli {

/// Exit codes of every subcommand.
enum ExitCode {
  kAnswered = 0,
  kBadInput = 2,  ///< bad arguments, unusable input, or output that could not be written
  kStopped = 3    ///< a limit came before the tolerance; what was printed is valid
};

/// Runs the command line. Results go to standard output; one line to standard error if the exit
/// code is kBadInput.
int run(int argc, const char* const* argv);

}  // namespace fcl_prob::cli
