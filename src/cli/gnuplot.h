// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Plots by way of gnuplot, if it is installed.
#pragma once

#include <string>

namespace fcl_prob::cli {

/// \param path  of a plot that is asked for; empty: of none
/// \throws InvalidRequest unless it ends in .svg or .png
void validatePlotPath(const std::string& path);

/// Runs `script`, which draws and sets no terminal, and writes the plot to `path`. Where gnuplot is
/// not installed, or the script is empty, there is no plot, which the error output says.
/// \param path  a valid one \throws FileError if gnuplot fails, or `path` cannot be written
void writePlot(const std::string& script, const std::string& path);

}  // namespace fcl_prob::cli
