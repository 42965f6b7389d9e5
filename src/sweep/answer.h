// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// From a line of queries to a line of results.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "sweep/prepared_scenes.h"
#include "sweep/query_line.h"

namespace fcl_prob::sweep {

/// A line of the file of results.
struct Record {
  std::string text;  ///< JSON, without the end of the line
  bool is_error = false;
};

/// Answers a query on one thread: the record depends on nothing but the line and the files that it
/// names. Whatever is wrong with them is a record, too.
/// \param goes_on  asked now and then; once it has returned false there is no record
std::optional<Record> answer(const NumberedLine& line, const std::filesystem::path& folder,
                             PreparedScenes& scenes, const std::function<bool()>& goes_on);

}  // namespace fcl_prob::sweep
