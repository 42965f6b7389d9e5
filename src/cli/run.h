// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The fcl_prob command as a function.
#pragma once

#include <vector>

namespace CLI {
class App;
}

namespace fcl_prob::cli {

/// Exit codes of every subcommand.
enum ExitCode {
  kAnswered = 0,
  kBadInput = 2,  ///< bad arguments, unusable input, or output that could not be written
  kStopped = 3    ///< a limit came before the tolerance; what was printed is valid
};

/// Adds a subcommand, as cli/commands.h does.
using AddCommand = void (*)(CLI::App& app, int& exit_code);

/// Runs the command line. Results go to standard output; one line to standard error if the exit
/// code is kBadInput.
/// \param others  subcommands of rooms above this one
int run(int argc, const char* const* argv, const std::vector<AddCommand>& others = {});

}  // namespace fcl_prob::cli
