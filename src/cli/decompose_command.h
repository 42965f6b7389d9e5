// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// fcl_prob decompose: a mesh as convex parts that cover it.
#pragma once

#include <string>

#include "fcl_prob/convex_parts.h"

namespace CLI {
class App;
}

namespace fcl_prob::cli {

/// Adds the subcommand; it runs when `app` parses it, and leaves its exit code in `exit_code`,
/// which must live as long as `app`.
void addDecomposeCommand(CLI::App& app, int& exit_code);

/// The parts as a Wavefront file, one object a part, with all digits.
std::string objOf(const ConvexParts& parts);

}  // namespace fcl_prob::cli
