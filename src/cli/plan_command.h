// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// fcl_prob plan: a motion of a robot that stays below a probability.
#pragma once

namespace CLI {
class App;
}

namespace fcl_prob::cli {

/// Adds the subcommand; it runs when `app` parses it, and leaves its exit code in `exit_code`,
/// which must live as long as `app`.
void addPlanCommand(CLI::App& app, int& exit_code);

}  // namespace fcl_prob::cli
