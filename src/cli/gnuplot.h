// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Plots by way of gnuplot, if it is installed.
#pragma once

#include <optional>
#include <string>

namespace fcl_prob::cli {

/// gnuplot's terminal for a file name that ends in .svg or .png; nothing for another.
std::optional<std::string> gnuplotTerminal(const std::string& path);

/// Runs `script`, whose plot goes to standard output, and writes it to `path`.
/// \returns false if gnuplot is not installed. \throws FileError if it fails, or `path` cannot be
/// written
bool runGnuplot(const std::string& script, const std::string& path);

}  // namespace fcl_prob::cli
