// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Wavefront OBJ. Not by a library: tinyobjloader 2.0.0rc10 in its double build has 39 % of numbers
// of three decimals and 64 % of those of 17 digits off by up to 5 units in the last place, takes a
// word that is no number for 0, knows no continued lines, and cuts concave quadrilaterals along the
// wrong diagonal.
#include <algorithm>
#include <array>

#include "io/mesh_formats.h"
#include "io/polygon_mesh.h"
#include "io/text_reader.h"

namespace fcl_prob::detail {
namespace {

using Words = std::vector<std::string_view>;

template <std::size_t count>
bool isOneOf(std::string_view word, const std::array<std::string_view, count>& list) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

/// Surfaces, curves and other files, which would be lost.
constexpr std::array<std::string_view, 9> kRefused{"curv", "curv2", "surf", "bzp", "bsp",
                                                   "cdc",  "cdp",   "call", "csh"};

/// What bears no surface. (Colours of vertices, vc, are no part of the standard.)
constexpr std::array<std::string_view, 34> kPassedOver{
    "vt",    "vn",     "vp",       "vc",       "p",          "l",         "g",   "o",      "s",
    "mg",    "usemtl", "mtllib",   "usemap",   "maplib",     "bevel",     "lod", "cstype", "deg",
    "bmat",  "step",   "parm",     "trim",     "hole",       "scrv",      "sp",  "end",    "con",
    "ctech", "stech",  "c_interp", "d_interp", "shadow_obj", "trace_obj", "res"};

/// Statements that are made of numbers or indices, whose lines a backslash at the end continues. A
/// name or a comment may end in one.
constexpr std::array<std::string_view, 17> kContinued{"v",    "vt",   "vn", "vp",   "vc",   "f",
                                                      "fo",   "p",    "l",  "bmat", "parm", "trim",
                                                      "hole", "scrv", "sp", "con",  "res"};

class ObjReader {
 public:
  explicit ObjReader(const std::string& path) : path_(path), mesh_(path, kFirstIndex) {}

  TriangleMesh read(std::string_view content) {
    LineReader lines(content);
    while (const auto line = lines.next()) {
      place_.position = lines.lineNumber();
      splitWords(withoutComment(*line), words_);
      if (words_.empty()) continue;
      if (words_.back().back() == '\\' && isOneOf(words_[0], kContinued)) continued(*line, lines);
      statement();
    }
    if (unknown_lines_ > 0) mesh_.addNote(noteOfUnknownLines());
    return std::move(mesh_).triangulated();
  }

 private:
  /// Takes in the lines that belong to this one, whose words stay within joined_.
  void continued(std::string_view line, LineReader& lines) {
    joined_.clear();
    for (std::optional<std::string_view> next = line; next; next = lines.next()) {
      const std::string_view text = withoutComment(*next);
      const std::size_t end = text.find_last_not_of(" \t\v\f");
      const bool more = end != text.npos && text[end] == '\\';
      joined_.append(more ? text.substr(0, end) : text).push_back(' ');
      if (!more) break;
    }
    splitWords(joined_, words_);
  }

  void statement() {
    const std::string_view keyword = words_[0];
    if (isOneOf(keyword, kPassedOver)) return;
    if (keyword == "v") return vertex();
    if (keyword == "f" || keyword == "fo") return face();
    if (isOneOf(keyword, kRefused)) {
      fail(inQuotes(keyword) + " is not supported, and what it bears would be missing");
    }
    unknown(keyword);
  }

  void vertex() {
    const std::size_t numbers = words_.size() - 1;
    if (numbers < 3) fail("a vertex needs three numbers");
    if (numbers == 5 || numbers > 6) {
      fail("a vertex has three numbers, a weight or a colour of three more, not " +
           std::to_string(numbers) + " numbers");
    }
    fcl::Vector3d vertex = parseVertex(&words_[1], path_, place_);
    if (numbers == 4) vertex = weighted(vertex);
    mesh_.addVertex(vertex);
  }

  fcl::Vector3d weighted(const fcl::Vector3d& vertex) const {
    const std::optional<double> weight = parseNumber(words_[4]);
    if (!weight) fail(inQuotes(words_[4]) + " is not a number");
    fcl::Vector3d result = vertex / *weight;
    checkVertex(result, path_, place_);
    return result;
  }

  void face() {
    if (words_.size() < 4) {
      fail("a face has " + std::to_string(words_.size() - 1) + " corners, not 3 or more");
    }
    corners_.clear();
    for (std::size_t i = 1; i < words_.size(); ++i) corners_.push_back(corner(words_[i]));
    mesh_.addPolygon(corners_, place_);
  }

  std::size_t corner(std::string_view word) const {
    const std::optional<long long> index = parseInteger(word.substr(0, word.find('/')));
    const auto vertices = static_cast<long long>(mesh_.vertexCount());
    if (!index || *index == 0 || *index < -vertices) {
      fail(inQuotes(word) + " is not the index of a vertex");
    }
    return static_cast<std::size_t>(*index < 0 ? vertices + *index : *index - 1);
  }

  /// Other readers pass over what they do not know, too. Numbers may be meant for a surface.
  void unknown(std::string_view keyword) {
    const auto is_number = [](std::string_view word) {
      return parseNumber(word.substr(0, word.find('/'))).has_value();
    };
    if (words_.size() > 3 && std::all_of(words_.begin() + 1, words_.begin() + 4, is_number)) {
      fail(inQuotes(keyword) + " is not a statement of OBJ");
    }
    if (unknown_lines_++ > 0) return;
    first_unknown_ = inQuotes(keyword);
    first_unknown_line_ = place_.position;
  }

  std::string noteOfUnknownLines() const {
    return path_ + ": line " + std::to_string(first_unknown_line_) + ": " + first_unknown_ +
           " is not a statement of OBJ; such lines passed over: " + std::to_string(unknown_lines_);
  }

  static constexpr std::size_t kFirstIndex = 1;

  [[noreturn]] void fail(const std::string& fault) const {
    throw FileError(placeText(path_, place_) + ": " + fault);
  }

  const std::string& path_;
  PolygonMesh mesh_;
  FilePlace place_;  ///< of the first line of the statement
  Words words_;
  std::string joined_;
  std::vector<std::size_t> corners_;
  std::size_t unknown_lines_ = 0;
  std::string first_unknown_;
  std::size_t first_unknown_line_ = 0;
};

}  // namespace

TriangleMesh readObj(const std::string& path, std::string_view content) {
  if (content.find('\0') != content.npos) {
    throw FileError(path + ": not a text in ASCII or UTF-8, as an OBJ file has to be");
  }
  return ObjReader(path).read(withoutByteOrderMark(content));
}

}  // namespace fcl_prob::detail
