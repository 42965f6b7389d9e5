// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A file for code that wants a path, without a disk.
#pragma once

#include <cstddef>
#include <string>

namespace fcl_prob_fuzz {

class MemoryFile {
 public:
  /// \param ending  of the path, such as ".ply"
  explicit MemoryFile(const std::string& ending);
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  const std::string& path() const { return path_; }

  /// Puts `content` in the place of what was in the file.
  void write(const void* content, std::size_t size) const;

 private:
  std::string path_;
};

}  // namespace fcl_prob_fuzz
