// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Whole files in, whole files out.
#pragma once

#include <cstddef>
#include <string>

namespace fcl_prob::detail {

/// The bytes of a regular file.
/// \throws FileError if it is missing, not a regular file, unreadable, or larger than `max_bytes`.
std::string fileContent(const std::string& path, std::size_t max_bytes);

}  // namespace fcl_prob::detail
