// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Numbers for people.
#pragma once

#include <string>

#include "fcl_prob/bounds.h"

namespace fcl_prob::cli {

/// A number rounded to this many significant digits.
std::string numberText(double value, int digits);

/// "[lower, upper]", each to six digits.
std::string intervalText(const Bounds& bounds);

}  // namespace fcl_prob::cli
