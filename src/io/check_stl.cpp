// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// STL: binary by its size, otherwise text.
#include <cstdint>
#include <cstring>

#include "fcl_prob/exceptions.h"
#include "io/file_checks.h"
#include "io/text_reader.h"

namespace fcl_prob::detail {
namespace {

constexpr std::size_t kBinaryStlHeaderSize = 84;
constexpr std::size_t kBinaryTriangleSize = 50;

/// Counts the facets of a text STL and sees that each has its three vertices and its end.
class TextStlChecker {
 public:
  explicit TextStlChecker(const std::string& path) : path_(path) {}

  void line(std::size_t number, const std::vector<std::string_view>& words) {
    if (words.empty()) return;
    if (words[0] == "facet") {
      if (inside_facet_) fail(number, "a facet begins inside a facet");
      inside_facet_ = true;
      vertices_ = 0;
    } else if (words[0] == "vertex") {
      vertex(number, words);
    } else if (words[0] == "endfacet") {
      if (vertices_ != 3) fail(number, "a facet has " + std::to_string(vertices_) + " vertices");
      inside_facet_ = false;
      ++facets_;
    } else if (words[0] == "endsolid") {
      ended_ = true;
    } else if (words[0] == "solid") {
      ended_ = false;
    }
  }

  std::size_t finish() const {
    if (inside_facet_ || !ended_) throw FileError(path_ + ": the STL text ends before 'endsolid'");
    return facets_;
  }

 private:
  void vertex(std::size_t number, const std::vector<std::string_view>& words) {
    if (!inside_facet_) fail(number, "a vertex outside of a facet");
    if (words.size() != 4) fail(number, "a vertex needs three numbers");
    for (std::size_t i = 1; i < 4; ++i) {
      if (!parseNumber(words[i])) fail(number, inQuotes(words[i]) + " is not a number");
    }
    ++vertices_;
  }

  [[noreturn]] void fail(std::size_t number, const std::string& fault) const {
    throw FileError(path_ + ": line " + std::to_string(number) + ": " + fault);
  }

  const std::string& path_;
  std::size_t facets_ = 0;
  int vertices_ = 0;
  bool inside_facet_ = false;
  bool ended_ = false;
};

bool beginsWithSolid(std::string_view content) {
  const std::size_t begin = content.find_first_not_of(" \t\r\n");
  return begin != content.npos && content.substr(begin, 5) == "solid";
}

}  // namespace

std::size_t checkStl(const std::string& path, std::string_view content) {
  std::uint32_t claimed = 0;
  if (content.size() >= kBinaryStlHeaderSize) std::memcpy(&claimed, content.data() + 80, 4);
  const std::size_t expected_size = kBinaryStlHeaderSize + kBinaryTriangleSize * claimed;
  if (content.size() >= kBinaryStlHeaderSize && content.size() == expected_size) return claimed;

  const bool text = beginsWithSolid(content) && content.find('\0') == content.npos;
  if (!text) {
    if (content.size() < kBinaryStlHeaderSize) {
      throw FileError(path + ": neither a text STL nor a binary one: only " +
                      std::to_string(content.size()) + " bytes");
    }
    throw FileError(path + ": the binary STL header claims " + std::to_string(claimed) +
                    " triangles, which take " + std::to_string(expected_size) +
                    " bytes, but the file has " + std::to_string(content.size()));
  }
  TextStlChecker checker(path);
  LineReader reader(content);
  while (const auto line = reader.next()) checker.line(reader.lineNumber(), splitWords(*line));
  return checker.finish();
}

}  // namespace fcl_prob::detail
