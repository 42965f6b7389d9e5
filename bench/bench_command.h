// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// fcl_prob bench: the benchmark tables.
#pragma once

namespace CLI {
class App;
}

namespace fcl_prob::cli {

/// As cli/commands.h does.
void addBenchCommand(CLI::App& app, int& exit_code);

}  // namespace fcl_prob::cli
