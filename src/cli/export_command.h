// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// fcl_prob export: a scene to look at.
#pragma once

namespace CLI {
class App;
}

namespace fcl_prob::cli {

/// As addCheckCommand().
void addExportCommand(CLI::App& app, int& exit_code);

}  // namespace fcl_prob::cli
