// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// fcl_prob reconstruct: a point cloud to meshes and their errors.
#pragma once

namespace CLI {
class App;
}

namespace fcl_prob::cli {

void addReconstructCommand(CLI::App& app, int& exit_code);

}  // namespace fcl_prob::cli
