// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Numbers for people.
#pragma once

#include <string>

namespace fcl_prob::cli {

/// A number rounded to this many significant digits.
std::string numberText(double value, int digits);

}  // namespace fcl_prob::cli
