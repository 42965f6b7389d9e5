// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// How long computations are told to leave off.
#pragma once

#include <functional>

namespace fcl_prob::detail {

/// Asked once in a few microseconds of work: whether to leave off with what is certain so far. Once
/// it has returned true it goes on doing so. Empty: never.
using Interruption = std::function<bool()>;

inline bool isDue(const Interruption& interruption) { return interruption && interruption(); }

}  // namespace fcl_prob::detail
