// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// fcl_prob path: the probability that a robot touches anything, in a state or along a motion.
#pragma once

namespace CLI {
class App;
}

namespace fcl_prob::cli {

/// Adds the subcommand; it runs when `app` parses it, and leaves its exit code in `exit_code`,
/// which must live as long as `app`.
void addPathCommand(CLI::App& app, int& exit_code);

}  // namespace fcl_prob::cli
