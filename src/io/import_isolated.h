// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Any import, in a child process, and one at a time.
#pragma once

#include <functional>
#include <mutex>
#include <string>

#include "fcl_prob/mesh_io.h"

namespace fcl_prob::detail {

/// Held during every import, because assimp's logger and some of its importers keep global state;
/// and during a fork, because a child that is forked in the middle of an import would inherit half
/// of it.
std::mutex& importMutex();

/// Runs `import` in a forked child within `limits` and returns the mesh that it returned.
/// Exceptions of this library are passed on; a crash, a timeout or too much memory is a FileError
/// that begins with `path`.
TriangleMesh importIsolated(const std::string& path, const std::function<TriangleMesh()>& import,
                            const ImportLimits& limits);

/// Whether the limit on memory is kept: not in a build under a sanitizer that reserves terabytes of
/// address space.
bool importMemoryIsLimited();

}  // namespace fcl_prob::detail
