// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A comparison as a table, CSV, JSON and a gnuplot script.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "cli/comparison.h"

namespace fcl_prob::cli {

std::string tableOf(const Comparison& comparison);

/// One line a method and budget, after a header line.
std::string csvOf(const Comparison& comparison);

/// {"reference": {...}, "fcl": {...}, "build_ms": ..., "records": [one object a method and budget]}
nlohmann::ordered_json jsonOf(const Comparison& comparison);

/// Two panels: relative error against run time, one curve a method with its confidence bars; and
/// the intervals and bounds themselves against run time. For writePlot().
std::string gnuplotScriptOf(const Comparison& comparison, const std::string& title);

}  // namespace fcl_prob::cli
