// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Writing all of a file, or leaving what was there.
#pragma once

#include <unistd.h>

#include <string>

namespace fcl_prob::detail {

/// Closed when it goes out of scope.
class FileDescriptor {
 public:
  explicit FileDescriptor(int number) : number_(number) {}
  ~FileDescriptor() { close(); }
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  int number() const { return number_; }
  void close() {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }

 private:
  int number_;
};

/// \throws FileError with what errno says
[[noreturn]] void failToWrite(const std::string& name);

/// Whether all could be written.
bool writeAll(int descriptor, const void* data, std::size_t size);

/// \throws FileError
void writeAll(int descriptor, const std::string& content, const std::string& name);

/// Writes a file under another name beside it and renames it when it is complete and on the disk.
/// \throws FileError; then a file that was there before is untouched.
void writeFile(const std::string& path, const std::string& content);

}  // namespace fcl_prob::detail
