// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The subcommands of fcl_prob. Each runs when `app` parses it, and leaves its exit code in
// `exit_code`, which must live as long as `app`.
#pragma once

namespace CLI {
class App;
}

namespace fcl_prob::cli {

void addCheckCommand(CLI::App& app, int& exit_code);      ///< one scene, one answer
void addCompareCommand(CLI::App& app, int& exit_code);    ///< every method on one scene
void addDecomposeCommand(CLI::App& app, int& exit_code);  ///< a mesh as convex parts
void addExportCommand(CLI::App& app, int& exit_code);     ///< a scene to look at
void addPathCommand(CLI::App& app, int& exit_code);       ///< a robot in a state or along a motion
void addPlanCommand(CLI::App& app, int& exit_code);  ///< a motion that stays below a probability
void addReconstructCommand(CLI::App& app, int& exit_code);  ///< a point cloud to meshes, errors
void addSweepCommand(CLI::App& app, int& exit_code);        ///< many queries from a file

}  // namespace fcl_prob::cli
