// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Writing that does not pass half a report off as a whole one.
#pragma once

#include <string>

#include "io/write_file.h"

namespace fcl_prob::cli {

using detail::writeFile;

/// `text` without line breaks and other control characters.
std::string onOneLine(const std::string& text);

/// Writes `content` to the file at `path`, or to standard output if `path` is empty. \throws
/// FileError
void deliver(const std::string& content, const std::string& path);

}  // namespace fcl_prob::cli
