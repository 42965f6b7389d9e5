// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "memory_file.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "fuzz_tally.h"

namespace fcl_prob_fuzz {

MemoryFile::MemoryFile(const std::string& ending) {
  const std::filesystem::path memory = "/dev/shm";
  const auto folder =
      std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path();
  path_ = (folder / ("fcl_prob_fuzz_" + std::to_string(::getpid()) + ending)).string();
}

MemoryFile::~MemoryFile() { ::unlink(path_.c_str()); }

void MemoryFile::write(const void* content, std::size_t size) const {
  std::ofstream file(path_, std::ios::binary | std::ios::trunc);
  file.write(static_cast<const char*>(content), static_cast<std::streamsize>(size));
  file.close();
  require(file.good(), "cannot write " + path_);
}

}  // namespace fcl_prob_fuzz
