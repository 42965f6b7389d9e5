// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "sweep/pending_lines.h"

#include <charconv>

#include "fcl_prob/exceptions.h"
#include "io/text_reader.h"

namespace fcl_prob::sweep {
namespace {

constexpr std::size_t kLongestLine = std::size_t{1} << 20;

bool isBlank(const NumberedLine& line) {
  return !line.too_long && line.text.find_first_not_of(" \t\r") == std::string::npos;
}

/// A whole number, of which nothing is left over.
std::optional<std::size_t> countFrom(std::string_view text) {
  std::size_t count = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (fault != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return count;
}

}  // namespace

Shard shardFrom(const std::string& text) {
  const std::size_t slash = text.find('/');
  if (slash != std::string::npos) {
    const auto index = countFrom(std::string_view(text).substr(0, slash));
    const auto count = countFrom(std::string_view(text).substr(slash + 1));
    if (index && count && *index >= 1 && *index <= *count) return {*index, *count};
  }
  throw InvalidRequest(detail::inQuotes(text) + " is no shard: of 4 they are 1/4, 2/4, 3/4, 4/4");
}

PendingLines::PendingLines(const std::string& path, const Shard& shard, Done done)
    : path_(path), shard_(shard), done_(std::move(done)) {
  if (!std::filesystem::exists(path_)) throw FileError(path_ + ": no such file");
  if (!std::filesystem::is_regular_file(path_)) throw FileError(path_ + ": no regular file");
  rewind();
  std::size_t found = 0;
  for (NumberedLine line; nextOfShard(line); ++total_) {
    const auto result = done_.find(line.number);
    if (result == done_.end()) continue;
    ++found;
    if (result->second != checksumOf(line)) {
      throw FileError(path_ + ": line " + std::to_string(line.number) +
                      " is not the query that the result there is of");
    }
  }
  if (found < done_.size()) {
    throw FileError(path_ + ": there are results of " + std::to_string(done_.size() - found) +
                    " lines that are not queries of it, or of another shard");
  }
  pending_ = total_ - found;
  rewind();
}

void PendingLines::rewind() {
  file_.close();
  file_.clear();
  file_.open(path_, std::ios::binary);
  if (!file_) throw FileError(path_ + ": cannot be read");
  number_ = 0;
  queries_ = 0;
}

bool PendingLines::read(NumberedLine& line) {
  line.text.clear();
  line.too_long = false;
  std::streambuf& buffer = *file_.rdbuf();
  int character = buffer.sbumpc();
  if (character == std::char_traits<char>::eof()) return false;
  for (; character != '\n' && character != std::char_traits<char>::eof();
       character = buffer.sbumpc()) {
    if (line.text.size() < kLongestLine) {
      line.text += static_cast<char>(character);
    } else {
      line.too_long = true;
    }
  }
  if (line.too_long) line.text.clear();
  line.number = ++number_;
  return true;
}

bool PendingLines::nextOfShard(NumberedLine& line) {
  while (read(line)) {
    if (isBlank(line)) continue;
    if (queries_++ % shard_.count == shard_.index - 1) return true;
  }
  return false;
}

std::optional<NumberedLine> PendingLines::next() {
  for (NumberedLine line; nextOfShard(line);) {
    if (done_.count(line.number) == 0) return line;
  }
  return std::nullopt;
}

}  // namespace fcl_prob::sweep
