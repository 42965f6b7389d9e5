// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// fcl_prob compare: every method on one scene.
#pragma once

namespace CLI {
class App;
}

namespace fcl_prob::cli {

/// As addCheckCommand().
void addCompareCommand(CLI::App& app, int& exit_code);

}  // namespace fcl_prob::cli
