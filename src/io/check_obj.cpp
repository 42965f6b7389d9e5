// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Wavefront OBJ: vertices are numbers, faces have three corners or more that exist.
#include <algorithm>

#include "fcl_prob/exceptions.h"
#include "io/file_checks.h"
#include "io/text_reader.h"

namespace fcl_prob::detail {
namespace {

class ObjChecker {
 public:
  explicit ObjChecker(const std::string& path) : path_(path) {}

  void line(std::size_t number, std::string_view text) {
    const std::vector<std::string_view> words = splitWords(text.substr(0, text.find('#')));
    if (words.empty()) return;
    if (words[0] == "v") vertex(number, words);
    if (words[0] == "f" || words[0] == "fo") face(number, words);
  }

  std::size_t finish() const {
    // An index may refer forward, so only the end of the file can tell.
    if (largest_index_ > vertices_) {
      fail(largest_index_line_, "vertex index " + std::to_string(largest_index_) +
                                    ", but the file has only " + std::to_string(vertices_) +
                                    " vertices");
    }
    return triangles_;
  }

 private:
  void vertex(std::size_t number, const std::vector<std::string_view>& words) {
    if (words.size() < 4) fail(number, "a vertex needs three numbers");
    for (std::size_t i = 1; i < 4; ++i) {
      if (!parseNumber(words[i])) fail(number, inQuotes(words[i]) + " is not a number");
    }
    ++vertices_;
  }

  void face(std::size_t number, const std::vector<std::string_view>& words) {
    if (words.size() < 4) {
      fail(number, "a face has " + std::to_string(words.size() - 1) + " corners, not 3 or more");
    }
    for (std::size_t i = 1; i < words.size(); ++i) corner(number, words[i]);
    triangles_ += words.size() - 3;
  }

  void corner(std::size_t number, std::string_view word) {
    const std::optional<long long> index = parseInteger(word.substr(0, word.find('/')));
    if (!index || *index == 0 || *index < -vertices_) {
      fail(number, inQuotes(word) + " is not the index of a vertex");
    }
    if (*index > largest_index_) {
      largest_index_ = *index;
      largest_index_line_ = number;
    }
  }

  [[noreturn]] void fail(std::size_t number, const std::string& fault) const {
    throw FileError(path_ + ": line " + std::to_string(number) + ": " + fault);
  }

  const std::string& path_;
  long long vertices_ = 0;
  std::size_t triangles_ = 0;
  long long largest_index_ = 0;
  std::size_t largest_index_line_ = 0;
};

}  // namespace

std::size_t checkObj(const std::string& path, std::string_view content) {
  if (content.find('\0') != content.npos) {
    throw FileError(path + ": not a text in ASCII or UTF-8, as an OBJ file has to be");
  }
  ObjChecker checker(path);
  LineReader reader(content);
  std::string joined;  // a backslash at the end continues a line
  while (const auto line = reader.next()) {
    if (!line->empty() && line->back() == '\\') {
      joined.append(line->substr(0, line->size() - 1)).push_back(' ');
    } else if (joined.empty()) {
      checker.line(reader.lineNumber(), *line);
    } else {
      checker.line(reader.lineNumber(), joined.append(*line));
      joined.clear();
    }
  }
  checker.line(reader.lineNumber(), joined);
  return checker.finish();
}

}  // namespace fcl_prob::detail
