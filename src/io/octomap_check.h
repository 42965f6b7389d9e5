// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#pragma once

#include <string>
#include <string_view>

namespace fcl_prob::detail {

/// What an OctoMap file claims against what it holds. \returns whether it is a .bt (binary) one
/// \throws FileError that begins with `path`
bool checkOctomap(const std::string& path, std::string_view content);

}  // namespace fcl_prob::detail
