// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What can be left out, to measure what it is worth (`fcl_prob bench ladder`).
#pragma once

#include <string>
#include <vector>

namespace fcl_prob::detail {

/// Names of rungs, and of mechanisms inside of them, that are not used where something else
/// answers. Only to be changed while no query is answered.
std::vector<std::string>& leftOut();

bool isLeftOut(const char* name);

}  // namespace fcl_prob::detail
