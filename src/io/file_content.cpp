// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "io/file_content.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "fcl_prob/exceptions.h"

namespace fcl_prob::detail {

std::string fileContent(const std::string& path, std::size_t max_bytes) {
  // A device or a pipe would be read without end.
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw FileError(path + ": no such file");
  if (!std::filesystem::is_regular_file(status)) throw FileError(path + ": not a regular file");
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) throw FileError(path + ": " + error.message());
  if (size > max_bytes) {
    throw FileError(path + ": " + std::to_string(size) + " bytes are more than the limit of " +
                    std::to_string(max_bytes));
  }
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::string content(size, '\0');
  if (!file || !file.read(content.data(), static_cast<std::streamsize>(size))) {
    throw FileError(path + ": cannot be read" +
                    (errno != 0 ? std::string(": ") + std::strerror(errno) : ""));
  }
  return content;
}

}  // namespace fcl_prob::detail
