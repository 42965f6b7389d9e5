// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "io/write_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "fcl_prob/exceptions.h"

namespace fcl_prob::detail {
namespace {

int openToWrite(const std::string& path, int flags, const std::string& name) {
  const int descriptor = ::open(path.c_str(), flags | O_WRONLY | O_CLOEXEC, 0666);
  if (descriptor < 0) failToWrite(name);
  return descriptor;
}

/// Removes a file when it goes out of scope, unless it has become what it was meant to be.
class RemovedUnlessKept {
 public:
  explicit RemovedUnlessKept(std::string path) : path_(std::move(path)) {}
  ~RemovedUnlessKept() {
    if (!kept_) ::unlink(path_.c_str());
  }
  RemovedUnlessKept(const RemovedUnlessKept&) = delete;
  RemovedUnlessKept& operator=(const RemovedUnlessKept&) = delete;
  void keep() { kept_ = true; }

 private:
  std::string path_;
  bool kept_ = false;
};

}  // namespace

void failToWrite(const std::string& name) {
  const std::string reason = errno != 0 ? std::string(": ") + std::strerror(errno) : "";
  throw FileError(name + ": cannot be written" + reason);
}

bool writeAll(int descriptor, const void* data, std::size_t size) {
  const char* position = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t written = ::write(descriptor, position, size);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    position += written;
    size -= static_cast<std::size_t>(written);
  }
  return true;
}

void writeAll(int descriptor, const std::string& content, const std::string& name) {
  if (!writeAll(descriptor, content.data(), content.size())) failToWrite(name);
}

void writeFile(const std::string& path, const std::string& content) {
  errno = 0;
  // A device or a pipe cannot be replaced, and shall not be.
  if (std::filesystem::exists(path) && !std::filesystem::is_regular_file(path)) {
    writeAll(FileDescriptor(openToWrite(path, 0, path)).number(), content, path);
    return;
  }
  const std::string temporary = path + ".part" + std::to_string(::getpid());
  ::unlink(temporary.c_str());  // a killed process of the same number may have left it
  const FileDescriptor file(openToWrite(temporary, O_CREAT | O_EXCL, path));
  RemovedUnlessKept guard(temporary);
  writeAll(file.number(), content, path);
  if (::fsync(file.number()) != 0) failToWrite(path);
  if (::rename(temporary.c_str(), path.c_str()) != 0) failToWrite(path);
  guard.keep();
}

}  // namespace fcl_prob::detail
