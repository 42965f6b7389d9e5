// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/output.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <iostream>

#include "fcl_prob/exceptions.h"

namespace fcl_prob::cli {
namespace {

[[noreturn]] void failToWrite(const std::string& name) {
  const std::string reason = errno != 0 ? std::string(": ") + std::strerror(errno) : "";
  throw FileError(name + ": cannot be written" + reason);
}

void writeAll(int descriptor, const std::string& content, const std::string& name) {
  std::size_t done = 0;
  while (done < content.size()) {
    const ssize_t count = ::write(descriptor, content.data() + done, content.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) failToWrite(name);
    done += static_cast<std::size_t>(count);
  }
}

class OpenFile {
 public:
  OpenFile(const std::string& path, int flags, const std::string& name)
      : descriptor_(::open(path.c_str(), flags | O_WRONLY | O_CLOEXEC, 0666)) {
    if (descriptor_ < 0) failToWrite(name);
  }
  ~OpenFile() { ::close(descriptor_); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

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

std::string onOneLine(const std::string& text) {
  std::string result;
  for (const char character : text) {
    const bool control = static_cast<unsigned char>(character) < 0x20 || character == 0x7f;
    result += control ? ' ' : character;
  }
  while (!result.empty() && result.back() == ' ') result.pop_back();
  return result;
}

void flushOutput(std::ostream& stream, const std::string& name) {
  errno = 0;
  stream.flush();
  if (!stream) failToWrite(name);
}

void deliver(const std::string& content, const std::string& path) {
  if (path.empty()) {
    std::cout << content;
    flushOutput(std::cout, "standard output");
  } else {
    writeFile(path, content);
  }
}

void writeFile(const std::string& path, const std::string& content) {
  errno = 0;
  // A device or a pipe cannot be replaced, and shall not be.
  if (std::filesystem::exists(path) && !std::filesystem::is_regular_file(path)) {
    writeAll(OpenFile(path, 0, path).descriptor(), content, path);
    return;
  }
  const std::string temporary = path + ".part" + std::to_string(::getpid());
  const OpenFile file(temporary, O_CREAT | O_EXCL, path);
  RemovedUnlessKept guard(temporary);
  writeAll(file.descriptor(), content, path);
  if (::fsync(file.descriptor()) != 0) failToWrite(path);
  if (::rename(temporary.c_str(), path.c_str()) != 0) failToWrite(path);
  guard.keep();
}

}  // namespace fcl_prob::cli
