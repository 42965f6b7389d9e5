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

/// \throws FileError for what is there and no regular file
std::string canonicalPath(const std::string& path) {
  if (!std::filesystem::exists(path)) return path;
  if (!std::filesystem::is_regular_file(path)) throw FileError(path + ": no regular file");
  return std::filesystem::canonical(path).string();
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

ResultsFile::ResultsFile(const std::string& path, bool resume)
    : path_(canonicalPath(path)),
      descriptor_(::open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666)) {
  if (descriptor_.number() < 0) detail::failToWrite(path_);
  if (::flock(descriptor_.number(), LOCK_EX | LOCK_NB) != 0) {
    throw FileError(path_ + ": is being written by another run");
  }
  if (resume) {
    takeOver();
  } else if (::lseek(descriptor_.number(), 0, SEEK_END) != 0) {
    throw FileError(path_ + ": is there already; --resume goes on with it");
  }
}

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
  if (::ftruncate(descriptor_.number(), static_cast<off_t>(kept)) != 0) {
    throw FileError(path_ + ": cannot be cut: " + std::strerror(errno));
  }
}

void ResultsFile::append(const std::string& record) {
  detail::writeAll(descriptor_.number(), record + "\n", path_);
}

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
  detail::writeFile(path_, content);
}

}  // namespace fcl_prob::sweep
