// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The lines of a file of queries that are still to be answered.
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <string>

#include "sweep/query_line.h"

namespace fcl_prob::sweep {

/// Part `index` (from 1) of `count`: every count-th query.
struct Shard {
  std::size_t index = 1;
  std::size_t count = 1;
};

/// "2/8". \throws InvalidRequest
Shard shardFrom(const std::string& text);

/// Results that are there already: the checksums of their queries by the number of the line.
using Done = std::map<std::size_t, std::string>;

/// Lines are numbered from 1, those that are blank have no query.
class PendingLines {
 public:
  /// Looks at the whole file once. \throws FileError if it is no regular file or cannot be read, or
  /// `done` has results that are not of its queries
  PendingLines(const std::string& path, const Shard& shard, Done done);

  /// Queries of the shard, and those among them that have no result yet.
  std::size_t total() const { return total_; }
  std::size_t pending() const { return pending_; }

  /// The next one that is pending, in the order of the file.
  std::optional<NumberedLine> next();

  /// Begins again with the first one.
  void rewind();

  /// That paths in the queries are relative to.
  std::filesystem::path folder() const { return std::filesystem::path(path_).parent_path(); }

 private:
  bool read(NumberedLine& line);
  bool nextOfShard(NumberedLine& line);

  std::string path_;
  Shard shard_;
  Done done_;
  std::ifstream file_;
  std::size_t number_ = 0;
  std::size_t queries_ = 0;
  std::size_t total_ = 0;
  std::size_t pending_ = 0;
};

}  // namespace fcl_prob::sweep
