// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// OFF: the header's counts, then one line a vertex and one line a face.
#include "fcl_prob/exceptions.h"
#include "io/file_checks.h"
#include "io/text_reader.h"

namespace fcl_prob::detail {
namespace {

/// Lines that hold anything but a comment.
class OffLines {
 public:
  OffLines(const std::string& path, std::string_view content) : path_(path), reader_(content) {}

  /// The words of the next such line; `wanted` is what the message misses if the file has ended.
  std::vector<std::string_view> next(const std::string& wanted) {
    while (const auto line = reader_.next()) {
      std::vector<std::string_view> words = splitWords(line->substr(0, line->find('#')));
      if (!words.empty()) return words;
    }
    throw FileError(path_ + ": the OFF file ends before its " + wanted);
  }

  [[noreturn]] void fail(const std::string& fault) const {
    throw FileError(path_ + ": line " + std::to_string(reader_.lineNumber()) + ": " + fault);
  }

 private:
  const std::string& path_;
  LineReader reader_;
};

long long count(const OffLines& lines, std::string_view word) {
  const std::optional<long long> value = parseInteger(word);
  if (!value || *value < 0) lines.fail(inQuotes(word) + " is not a count");
  return *value;
}

std::size_t checkFace(OffLines& lines, const std::string& ordinal, long long vertices) {
  const std::vector<std::string_view> words = lines.next(ordinal);
  const long long corners = count(lines, words[0]);
  if (corners < 3) lines.fail("a face has " + std::to_string(corners) + " corners, not 3 or more");
  if (words.size() - 1 < static_cast<std::size_t>(corners)) {
    lines.fail("a face of " + std::to_string(corners) + " corners has " +
               std::to_string(words.size() - 1) + " indices");
  }
  for (std::size_t i = 1; i <= static_cast<std::size_t>(corners); ++i) {
    const std::optional<long long> index = parseInteger(words[i]);
    if (!index || *index < 0 || *index >= vertices) {
      lines.fail(inQuotes(words[i]) + " is not the index of one of " + std::to_string(vertices) +
                 " vertices");
    }
  }
  return static_cast<std::size_t>(corners) - 2;
}

}  // namespace

std::size_t checkOff(const std::string& path, std::string_view content) {
  OffLines lines(path, content);
  std::vector<std::string_view> words = lines.next("header");
  // The keyword may carry prefixes for colours and normals, and the counts may follow it at once.
  const std::size_t keyword = words[0].find("OFF");
  if (keyword == std::string_view::npos) lines.fail("an OFF file begins with 'OFF'");
  words[0].remove_prefix(keyword + 3);
  if (words[0].empty()) words.erase(words.begin());
  if (words.empty()) words = lines.next("counts");
  if (words.size() < 2) lines.fail("the header needs the number of vertices and of faces");
  const long long vertices = count(lines, words[0]);
  const long long faces = count(lines, words[1]);

  for (long long i = 0; i < vertices; ++i) {
    words = lines.next("vertex " + std::to_string(i + 1) + " of " + std::to_string(vertices));
    if (words.size() < 3) lines.fail("a vertex needs three numbers");
    for (std::size_t k = 0; k < 3; ++k) {
      if (!parseNumber(words[k])) lines.fail(inQuotes(words[k]) + " is not a number");
    }
  }
  std::size_t triangles = 0;
  for (long long i = 0; i < faces; ++i) {
    triangles += checkFace(lines, "face " + std::to_string(i + 1) + " of " + std::to_string(faces),
                           vertices);
  }
  return triangles;
}

}  // namespace fcl_prob::detail
