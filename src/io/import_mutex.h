// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// One import at a time.
#pragma once

#include <mutex>

namespace fcl_prob::detail {

/// Held during every import, because assimp's logger and some of its importers keep global state;
/// and during a fork, because a child that is forked in the middle of an import would inherit half
/// of it.
std::mutex& importMutex();

}  // namespace fcl_prob::detail
