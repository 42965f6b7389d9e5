// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "sweep/results_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <vector>

#include "fcl_prob/exceptions.h"

namespace fcl_prob::sweep {
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw FileError(path + ": " + what + ": " + std::strerror(errno));
}

void writeAll(int descriptor, const std::string& content, const std::string& path) {
  std::size_t done = 0;
  while (done < content.size()) {
    const ssize_t count = ::write(descriptor, content.data() + done, content.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) fail(path, "cannot be written");
    done += static_cast<std::size_t>(count);
  }
}

struct ResultLine {
  std::size_t number = 0;
  std::string query;
};

/// \throws FileError if the line is no result
ResultLine parsed(const std::string& line, const std::string& path, std::size_t position) {
  try {
    const auto json = nlohmann::json::parse(line);
    const auto& number = json.at("line");
    const auto& query = json.at("query");
    if (number.is_number_unsigned() && query.is_string()) {
      return {number.get<std::size_t>(), query.get<std::string>()};
    }
  } catch (const nlohmann::json::exception&) {
  }
  throw FileError(path + ": line " + std::to_string(position) + " is no result of a sweep");
}

/// Whether a killed run may have left this as a last line without end.
bool isBeginOfResult(const std::string& text) {
  const std::string begin = "{\"line\":";
  const std::size_t length = std::min(text.size(), begin.size());
  return text.compare(0, length, begin, 0, length) == 0;
}

}  // namespace

ResultsFile::ResultsFile(const std::string& path, bool resume) : path_(path) {
  if (std::filesystem::exists(path_)) {
    if (!std::filesystem::is_regular_file(path_)) throw FileError(path_ + ": no regular file");
    path_ = std::filesystem::canonical(path_).string();
  }
  descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail(path_, "cannot be written");
  try {
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      throw FileError(path_ + ": is being written by another run");
    }
    if (resume) {
      takeOver();
    } else if (::lseek(descriptor_, 0, SEEK_END) != 0) {
      throw FileError(path_ + ": is there already; --resume goes on with it");
    }
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

ResultsFile::~ResultsFile() { ::close(descriptor_); }

void ResultsFile::takeOver() {
  std::ifstream file(path_, std::ios::binary);
  std::size_t kept = 0;
  std::size_t position = 0;
  for (std::string line; std::getline(file, line);) {
    ++position;
    if (file.eof()) {  // no end of the line
      if (!isBeginOfResult(line)) parsed(line, path_, position);
      break;
    }
    const ResultLine result = parsed(line, path_, position);
    if (!done_.emplace(result.number, result.query).second) {
      throw FileError(path_ + ": has two results of line " + std::to_string(result.number));
    }
    kept += line.size() + 1;
  }
  if (::ftruncate(descriptor_, static_cast<off_t>(kept)) != 0) fail(path_, "cannot be cut");
}

void ResultsFile::append(const std::string& record) { writeAll(descriptor_, record + "\n", path_); }

void ResultsFile::finish() {
  std::vector<std::pair<std::size_t, std::string>> lines;
  std::ifstream file(path_, std::ios::binary);
  for (std::string line; std::getline(file, line);) {
    const std::size_t number = parsed(line, path_, lines.size() + 1).number;
    lines.emplace_back(number, std::move(line));
  }
  if (std::is_sorted(lines.begin(), lines.end())) return;
  std::sort(lines.begin(), lines.end());
  std::string content;
  for (const auto& [number, line] : lines) content += line + "\n";
  const std::string temporary = path_ + ".sorted";
  const int sorted = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (sorted < 0) fail(temporary, "cannot be written");
  try {
    writeAll(sorted, content, temporary);
    if (::fsync(sorted) != 0) fail(temporary, "cannot be written");
    if (::rename(temporary.c_str(), path_.c_str()) != 0) fail(path_, "cannot be replaced");
  } catch (...) {
    ::close(sorted);
    ::unlink(temporary.c_str());
    throw;
  }
  ::close(sorted);
}

}  // namespace fcl_prob::sweep
